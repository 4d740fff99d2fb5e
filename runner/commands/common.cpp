#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/study/study.h"

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
