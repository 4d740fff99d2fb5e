#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "runner/commands/command.h"
#include "runner/commands/named_run.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/run_comparison.h"

namespace seapile::commands {
namespace {

struct CompareArguments {
  std::string a, b, root = "results", other_root, tolerance;
  present::Format format = present::Format::table;
  bool expect_equal = false;
};

/// 0 where none was written: to the last bit.
double tolerance_of(const std::string& text) {
  double tolerance = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), tolerance);
  const bool read = text.empty() || (error == std::errc() && end == text.data() + text.size() && tolerance >= 0);
  if (!read)
    throw UsageError(
        fmt::format("--expect-equal: \"{}\" is no tolerance; a relative difference from 0 up, such as 1e-9", text));
  return tolerance;
}

int compare(const CompareArguments& arguments) {
  const double tolerance = tolerance_of(arguments.tolerance);
  const auto a = find_run(arguments.root, arguments.a);
  const auto b = find_run(arguments.other_root.empty() ? arguments.root : arguments.other_root, arguments.b);
  if (!a || !b) return execute::kNothingMatched;
  const present::RunComparison comparison = present::compare(*a, *b);
  if (arguments.format == present::Format::table) {
    fmt::print("{}", present::comparison_text(comparison));
  } else {
    fmt::print("{}", present::text(present::comparison_table(comparison), arguments.format));
    fmt::print(stderr, "{}\n", present::verdict(comparison));
  }
  if (!arguments.expect_equal || present::inequality(comparison, tolerance).empty()) return execute::kDone;
  fmt::print(stderr, "FAILED  {} and {} were expected to be equal{}\n", arguments.a, arguments.b,
             tolerance > 0 ? fmt::format(" within {:g}", tolerance) : " to the last bit");
  return execute::kCheckFailed;
}

}  // namespace

void add_compare(CLI::App& app, Call& call) {
  static CompareArguments arguments;
  CLI::App* command = app.add_subcommand("compare", "What two runs differ in, by how much, and what explains it");
  command->add_option("A", arguments.a, "Case id, or how it begins; ID/2: its run 0002 instead of the newest")
      ->required();
  command->add_option("B", arguments.b, "Likewise")->required();
  CLI::Option* expect =
      command
          ->add_option("--expect-equal", arguments.tolerance,
                       "Fail unless they are equal: to the last bit, or every metric and curve within TOL")
          ->type_name("[TOL]")
          ->expected(0, 1);
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->add_option("--with-store", arguments.other_root, "Folder of results that B is in, where it is another")
      ->type_name("DIR");
  command->footer(
      "Curves are compared over what both cover: the L2 norm of the difference over the larger of both norms, and the\n"
      "largest difference and where it is. Exit code 0 whatever they differ in; with --expect-equal, which comes "
      "last,\n"
      "3 when they differ by more.\n\n"
      "Examples:\n"
      "  runner compare 1a2b3c4d5e 5e4d3c2b1a\n"
      "  runner compare 1a2b3c4d5e/1 1a2b3c4d5e/2 --expect-equal 1e-9\n"
      "  runner compare 1a2b3c4d5e 1a2b3c4d5e --with-store ../colleague/results --expect-equal");
  command->callback([&call, expect] {
    arguments.expect_equal = expect->count() > 0;
    call = [] { return compare(arguments); };
  });
}

}  // namespace seapile::commands
