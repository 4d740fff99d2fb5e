#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "runner/commands/accept.h"
#include "runner/commands/checked.h"
#include "runner/commands/claimed.h"
#include "runner/commands/command.h"
#include "runner/commands/packings.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/tint.h"
#include "runner/present/check_table.h"
#include "runner/present/claim_table.h"
#include "runner/present/junit.h"

namespace seapile::commands {
namespace {

struct CheckArguments {
  std::string study, root = "results", note;
  std::optional<std::string> accept;
  study::Options options;
  present::Format format = present::Format::table;
  std::string junit;
};

/// A failure outweighs what cannot be decided. What a claim comes to is a finding, and no failure, unless the study
/// expects something of it.
int exit_code(const std::vector<present::Comparison>& comparisons, const std::vector<present::Claimed>& claims) {
  const auto any = [&](present::Finding finding) {
    return std::ranges::any_of(comparisons,
                               [&](const present::Comparison& one) { return present::judge(one).finding == finding; });
  };
  const auto any_claim = [&](present::Standing standing) {
    return std::ranges::any_of(
        claims, [&](const present::Claimed& one) { return present::standing(one, present::judge(one)) == standing; });
  };
  if (any(present::Finding::failed) || any_claim(present::Standing::contrary)) return execute::kCheckFailed;
  const bool open =
      any(present::Finding::missing) || any(present::Finding::underpowered) || any_claim(present::Standing::undecided);
  return open ? execute::kNothingMatched : execute::kDone;
}

int check(const CheckArguments& arguments) {
  const study::Study study = read_settled(arguments.study, arguments.options, arguments.root);
  const CheckedCases cases(study, arguments.root);
  const std::vector<present::Claimed> claims = claimed(study, cases);
  if (cases.watched().empty() && (claims.empty() || arguments.accept)) {
    const bool none = study.checks.empty() && (study.claims.empty() || arguments.accept);
    fmt::print(stderr, "{} has no {}\n", study.name, none ? "checks" : "check of any of these cases");
    return execute::kNothingMatched;
  }
  if (arguments.accept) return accept_values(study, cases, *arguments.accept, arguments.note);

  std::vector<present::Comparison> comparisons = cases.with_published();
  for (auto& drift : cases.with_accepted(study::read_accepted(study::accepted_path(study))))
    comparisons.push_back(std::move(drift));
  const bool for_people = arguments.format == present::Format::table;
  const bool packings = std::ranges::any_of(study.cases, [](const study::Case& one) { return !is_water(one.scene); });
  if (for_people) {
    const std::string checks = present::check_text(comparisons), of_claims = present::claim_text(claims);
    const char* between = checks.empty() || of_claims.empty() ? "" : "\n";
    fmt::print("{}\n", execute::tinted(checks + between + of_claims, stdout));
  } else {
    fmt::print("{}", present::text(present::with_claims(present::check_table(comparisons), claims), arguments.format));
  }
  if (!arguments.junit.empty())
    store::write_text(arguments.junit, present::junit_text(study.name, comparisons, claims));
  std::FILE* beside = for_people ? stdout : stderr;
  const std::string remark = present::check_remark(comparisons, packings) + present::claim_remark(claims);
  fmt::print(beside, "{}", execute::tinted(remark, beside));
  return exit_code(comparisons, claims);
}

}  // namespace

void add_check(CLI::App& app, Call& call) {
  static CheckArguments arguments;
  CLI::App* command = app.add_subcommand("check", "Compare results with published and with accepted values");
  command->add_option("STUDY", arguments.study, "Study file")->required();
  add_study_options(*command, arguments.options);
  CLI::Option* accept =
      command->add_option("--accept", arguments.accept, "Record our own values of a case as right, instead")
          ->type_name("ID|all");
  CLI::Option* note = command->add_option("--note", arguments.note, "Why they are right")->type_name("TEXT");
  accept->needs(note);
  note->needs(accept);
  command->add_option("--junit", arguments.junit, "Write the checks as JUnit XML too, for continuous integration")
      ->type_name("FILE.xml")
      ->excludes(accept);
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "The last lines say FAILED where a mean is further from the published value than the tolerance, where our own\n"
      "value has moved since it was accepted, or where a claim came out otherwise than the study expects. Exit code\n"
      "3: a check failed; 4: none, but results are missing or too few.\n\n"
      "Examples:\n"
      "  runner check my_study.json\n"
      "  runner check my_study.json --seeds 5 --format csv\n"
      "  runner check my_study.json --junit checks.xml\n"
      "  runner check my_study.json --accept 1a2b3c4d5e --note \"grains 4: rebounds are no longer lost\"");
  command->callback([&call] { call = [] { return check(arguments); }; });
}

}  // namespace seapile::commands
