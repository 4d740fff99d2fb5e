#include <fmt/format.h>

#include "runner/commands/command.h"
#include "runner/commands/reported.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/run_folder.h"

namespace seapile::commands {
namespace {

struct ReportArguments {
  ReportRequest request;
  std::string out;
};

/// A word as a shell takes it.
std::string shell_word(const std::string& word) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=,:+%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) c == '\'' ? quoted += "'\\''" : quoted += c;
  return quoted + "'";
}

std::string command_of(const ReportArguments& arguments, const std::string& out) {
  const study::Options& options = arguments.request.options;
  std::string command = "runner report " + shell_word(arguments.request.study);
  for (const std::string& one : options.set) command += " --set " + shell_word(one);
  if (!options.fidelity.empty()) command += " --fidelity " + shell_word(options.fidelity);
  if (options.seeds) command += fmt::format(" --seeds {}", *options.seeds);
  if (arguments.request.root != "results") command += " --store " + shell_word(arguments.request.root);
  return command + " -o " + shell_word(out);
}

int report(const ReportArguments& arguments) {
  ReportRequest request = arguments.request;
  const std::filesystem::path out =
      arguments.out.empty() ? std::filesystem::path(request.study).stem().string() + ".html" : arguments.out;
  if (out.extension() != ".html") throw UsageError(fmt::format("{}: a report's name ends in .html", out.string()));
  request.command = command_of(arguments, out.string());
  const auto gathered = reported(request);
  if (!gathered) {
    fmt::print(stderr, "no case of {} was ever run in {}\n", request.study, request.root);
    return execute::kNothingMatched;
  }
  try {
    store::write_text(out, present::report_html(*gathered));
  } catch (const store::StoreError& error) {
    throw UsageError(error.what());
  }
  fmt::print("{}\n", out.string());
  return execute::kDone;
}

}  // namespace

void add_report(CLI::App& app, Call& call) {
  static ReportArguments arguments;
  CLI::App* command = app.add_subcommand("report", "Write a study's results as one HTML file to look at");
  command->add_option("STUDY", arguments.request.study, "Study file")->required();
  add_study_options(*command, arguments.request.options);
  command->add_option("-o,--out", arguments.out, "File to write, .html; default: STUDY.html")->type_name("FILE");
  add_store_option(*command, arguments.request.root);
  command->footer(
      "The file holds all that it shows and asks for nothing from anywhere: it can be mailed, kept, and read without "
      "a\n"
      "network. Verdicts come first, then results and curves, cost and stability, figures, failures with the ends of\n"
      "their logs, parameters and provenance. It is made from the run folders as they are; nothing is run.\n"
      "Pictures below figures/ of the store that are named after the study are in it, STUDY.svg and STUDY_*.svg.\n"
      "\n"
      "Examples:\n"
      "  runner report studies/tip_shape.json\n"
      "  runner report studies/die_swell.json -o die_swell.html\n"
      "  runner report studies/velocity.json --seeds 5 --store /data/velocity -o velocity.html");
  command->callback([&call] { call = [] { return report(arguments); }; });
}

}  // namespace seapile::commands
