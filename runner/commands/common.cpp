#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/commands/matching.h"
#include "runner/study/fidelity.h"
#include "runner/study/nearest.h"

namespace seapile::commands {

void add_store_option(CLI::App& command, std::string& root) {
  command.add_option("--store", root, "Folder of all results")->capture_default_str()->type_name("DIR");
}

void add_where_option(CLI::App& command, std::vector<std::string>& where) {
  command.add_option("--where", where, "Condition on a parameter, a metric or the outcome; all have to hold")
      ->type_name("\"NAME OP VALUE\"")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

void add_study_options(CLI::App& command, study::Options& options) {
  command.add_option("--set", options.set, "Change the base scene or the record, e.g. pile.depth=0.3")
      ->type_name("PATH=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  command.add_option("--fidelity", options.fidelity, "Level of fidelity, in place of the study's")
      ->type_name(fmt::format("{}", fmt::join(study::fidelity_names(), "|")));
  command.add_option("--seeds", options.seeds, "Repeat every case on N packings: bed.seed = 1..N")->type_name("N");
}

void add_sharing_options(CLI::App& command, execute::Sharing& sharing) {
  command.add_option("-j,--jobs", sharing.jobs, "Cases at a time; default: the cores are shared out")
      ->type_name("N")
      ->check(from_up(1));
  command.add_option("--threads", sharing.threads, "Threads per case; changes no bit of the results")
      ->type_name("N")
      ->check(from_up(1));
  command
      .add_option_function<std::uint64_t>(
          "--memory", [&sharing](const std::uint64_t& bytes) { sharing.memory_mb = static_cast<double>(bytes) / 1e6; },
          "Memory of all running cases together, as in 800M or 12G; default: most of what is free now. By their "
          "history; a case that needs more runs by itself")
      ->type_name("SIZE")
      ->transform(CLI::AsSizeValue(true));
  command.add_flag("--oversubscribe", sharing.oversubscribe, "Let cases have more threads than there are cores");
}

CLI::Validator from_up(double least) {
  // The library's own words name the largest number of all, in three hundred digits.
  return {[least](std::string& word) {
            double number = 0;
            if (CLI::detail::lexical_cast(word, number) && number >= least) return std::string();
            return fmt::format("\"{}\" is no number from {:g} up", word, least);
          },
          ""};
}

CLI::Option* one_of(CLI::Option* option, const std::vector<std::string>& names) {
  const auto objection = [names](std::string& word) {
    if (std::ranges::find(names, word) != names.end()) return std::string();
    const std::string near = study::nearest(word, names);
    return fmt::format("\"{}\" is unknown; allowed: {}{}", word, fmt::join(names, ", "),
                       near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
  };
  return option->check(CLI::Validator(objection, ""))->type_name(fmt::format("{}", fmt::join(names, "|")));
}

void add_format_option(CLI::App& command, present::Format& format) {
  static const std::vector<std::string> kNames = {"table", "csv", "json", "ndjson"};  // in the order of the enum
  const auto choose = [&format](const std::string& name) {
    format = static_cast<present::Format>(std::ranges::find(kNames, name) - kNames.begin());
  };
  one_of(command.add_option_function<std::string>(
             "--format", choose, "How the answer is written; ndjson: one JSON object per row and line"),
         kNames);
}

std::string study_name(const std::string& study) { return is_study_file(study) ? study::read(study).name : study; }

bool is_known(const std::string& study, const store::Catalogue& catalogue) {
  const auto studies = catalogue.studies();
  if (study.empty() || std::ranges::find(studies, study) != studies.end()) return true;
  const std::string near = study::nearest(study, studies);
  fmt::print(stderr, "no study called \"{}\" was run here; {}\n", study,
             !near.empty() ? fmt::format("did you mean \"{}\"?", near)
             : studies.empty()
                 ? "there are none"
                 : fmt::format("there {} {}", studies.size() == 1 ? "is" : "are", fmt::join(studies, ", ")));
  return false;
}

}  // namespace seapile::commands
