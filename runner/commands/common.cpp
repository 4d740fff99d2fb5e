#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>

#include "runner/commands/command.h"

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
  command.add_option("--fidelity", options.fidelity, "Level of fidelity, in place of the study's")->type_name("LEVEL");
  command.add_option("--seeds", options.seeds, "Repeat every case on N packings: bed.seed = 1..N")->type_name("N");
}

void add_sharing_options(CLI::App& command, execute::Sharing& sharing) {
  command.add_option("-j,--jobs", sharing.jobs, "Cases at a time; default: the cores are shared out")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command.add_option("--threads", sharing.threads, "Threads per case; changes no bit of the results")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command
      .add_option_function<std::uint64_t>(
          "--memory", [&sharing](const std::uint64_t& bytes) { sharing.memory_mb = static_cast<double>(bytes) / 1e6; },
          "Memory of all running cases together, as in 800M or 12G; default: most of what is free now. By their "
          "history; a case that needs more runs by itself")
      ->type_name("SIZE")
      ->transform(CLI::AsSizeValue(true));
  command.add_flag("--oversubscribe", sharing.oversubscribe, "Let cases have more threads than there are cores");
}

void add_format_option(CLI::App& command, present::Format& format) {
  const std::map<std::string, present::Format> formats = {
      {"table", present::Format::table}, {"csv", present::Format::csv}, {"json", present::Format::json}};
  command.add_option("--format", format, "table, csv or json")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->type_name("FORMAT");
}

std::string study_name(const std::string& study) {
  const bool is_file = study.ends_with(".json") || std::filesystem::is_regular_file(study);
  return is_file ? study::read(study).name : study;
}

bool is_known(const std::string& study, const store::Catalogue& catalogue) {
  const auto studies = catalogue.studies();
  if (study.empty() || std::ranges::find(studies, study) != studies.end()) return true;
  fmt::print(stderr, "no study called \"{}\" was run here; there {} {}\n", study, studies.size() == 1 ? "is" : "are",
             studies.empty() ? "none" : fmt::format("{}", fmt::join(studies, ", ")));
  return false;
}

}  // namespace seapile::commands
