#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/commands/templates.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/durable.h"
#include "runner/study/nearest.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

struct NewArguments {
  std::string name, from, question, out;
  present::Format format = present::Format::table;
  bool list = false;
};

/// Every study that ships, with what it asks.
int list(present::Format format) {
  store::Table table{{"study", "cases", "question"}, {"", "", ""}, {}};
  for (const std::string& name : shipped_names()) {
    const study::Study study = study::read(shipped_studies() / (name + ".json"));
    table.rows.push_back({name, static_cast<double>(study.cases.size()), study.question});
  }
  if (table.rows.empty()) {
    fmt::print(stderr, "there are no studies beside the program\n");
    return execute::kNothingMatched;
  }
  fmt::print("{}", present::text(table, format));
  return execute::kDone;
}

/// The file of a template: one that ships, by its name, or a study file of the user's own.
fs::path template_file(const std::string& from) {
  if (fs::is_regular_file(from)) return from;
  const auto names = shipped_names();
  if (std::ranges::find(names, from) != names.end()) return shipped_studies() / (from + ".json");
  const std::string near = study::nearest(from, names);
  throw UsageError(fmt::format("--from: there is no study \"{}\"; {}", from,
                               near.empty() ? "`runner new --list` names all" : "did you mean \"" + near + "\"?"));
}

/// The study is read before it gets its name, from a file beside it, as it will be.
int write_study(const fs::path& file, const std::string& text) {
  const fs::path temporary = store::temporary_name(file);
  try {
    store::write_text(temporary, text);
    study::read(temporary);
    // A link, not a renaming: it fails where a file of that name has appeared meanwhile.
    std::error_code error;
    fs::create_hard_link(temporary, file, error);
    if (error) throw UsageError(fmt::format("cannot write {}: {}", file.string(), error.message()));
    store::discard(temporary);
  } catch (const study::BadInput& bad) {
    store::discard(temporary);
    throw study::BadInput(file.string(), bad.problems);
  } catch (...) {
    store::discard(temporary);
    throw;
  }
  fmt::print("{}\n", file.string());
  fmt::print(stderr,
             "`runner {} --dry-run` says what it would run; docs/study.md and `runner schema study --format table` "
             "explain every key\n",
             file.string());
  return execute::kDone;
}

int make(const NewArguments& arguments) {
  if (arguments.list) return list(arguments.format);
  if (arguments.name.empty())
    throw UsageError("NAME is missing: the new study's, 1 to 64 characters of a-z, 0-9 and _");
  const fs::path file = arguments.out.empty() ? arguments.name + ".json" : arguments.out;
  if (store::is_there(file))
    throw UsageError(fmt::format("{} is there already; it is not written over", file.string()));
  const fs::path folder = file.parent_path().empty() ? "." : file.parent_path();
  if (!fs::is_directory(folder)) throw UsageError(fmt::format("there is no folder {}", folder.string()));
  if (arguments.from.empty()) return write_study(file, smallest_study(arguments.name, arguments.question));
  const fs::path from = template_file(arguments.from);
  study::read(from);
  const NewStudy study = derived(from, arguments.name, arguments.question, folder);
  for (const std::string& sentence : study.left_out) fmt::print(stderr, "{}\n", sentence);
  return write_study(file, study.text);
}

}  // namespace

void add_new(CLI::App& app, Call& call) {
  static NewArguments arguments;
  CLI::App* command = app.add_subcommand("new", "Write a study file to begin with");
  command->add_option("NAME", arguments.name, "Name of the new study");
  command
      ->add_option("--from", arguments.from, "Study that it begins as: one that ships, or a file; default: a small one")
      ->type_name("STUDY");
  command->add_option("--question", arguments.question, "What it asks, in one line")->type_name("TEXT");
  command->add_option("-o,--out", arguments.out, "File to write; default: NAME.json")->type_name("FILE");
  command->add_flag("--list", arguments.list, "List the studies that ship, with their questions, instead");
  add_format_option(*command, arguments.format);
  command->footer(
      "A file that is there is never written over. Checks that need a file of published values are left out where "
      "that\n"
      "file is not beside the new study.\n\n"
      "Examples:\n"
      "  runner new --list\n"
      "  runner new my_tips --from tip_shape --question \"Which tip goes down more easily in our sand?\"\n"
      "  runner new first && runner first.json");
  command->callback([&call] { call = [] { return make(arguments); }; });
}

}  // namespace seapile::commands
