#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "runner/commands/command.h"
#include "runner/commands/matching.h"

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

void add_format_option(CLI::App& command, present::Format& format) {
  const std::map<std::string, present::Format> formats = {
      {"table", present::Format::table}, {"csv", present::Format::csv}, {"json", present::Format::json}};
  command.add_option("--format", format, "table, csv or json")
      ->transform(CLI::CheckedTransformer(formats).description(""))
      ->type_name("FORMAT");
}

std::string study_name(const std::string& study) { return is_study_file(study) ? study::read(study).name : study; }

bool is_known(const std::string& study, const store::Catalogue& catalogue) {
  const auto studies = catalogue.studies();
  if (study.empty() || std::ranges::find(studies, study) != studies.end()) return true;
  fmt::print(stderr, "no study called \"{}\" was run here; there {} {}\n", study, studies.size() == 1 ? "is" : "are",
             studies.empty() ? "none" : fmt::format("{}", fmt::join(studies, ", ")));
  return false;
}

}  // namespace seapile::commands
