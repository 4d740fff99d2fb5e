#include "runner/execute/attempt.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

#include "runner/store/run_folder.h"
#include "runner/study/study.h"

namespace seapile::execute {
namespace {

using nlohmann::json;

std::filesystem::path file_in(const std::filesystem::path& run_folder) { return run_folder / "attempt.json"; }

}  // namespace

void write_attempt(const std::filesystem::path& run_folder, const Attempt& attempt) {
  json numerics = json::object();
  for (const auto& [module, version] : attempt.numerics) numerics[module] = version;
  const json object = {{"count", attempt.count},
                       {"cpu_seconds", attempt.cpu_seconds},
                       {"wall_seconds", attempt.wall_seconds},
                       {"numerics", numerics},
                       {"record", attempt.record ? json::parse(study::to_json(*attempt.record)) : json()},
                       {"bed_run", attempt.bed_run}};
  store::write_text(file_in(run_folder), object.dump(1) + "\n");
}

std::optional<Attempt> read_attempt(const std::filesystem::path& run_folder) {
  std::ifstream in(file_in(run_folder));
  if (!in) return std::nullopt;
  try {
    const json object = json::parse(in);
    Attempt attempt;
    object.at("count").get_to(attempt.count);
    object.at("cpu_seconds").get_to(attempt.cpu_seconds);
    object.at("wall_seconds").get_to(attempt.wall_seconds);
    for (const auto& [module, version] : object.at("numerics").items()) {
      attempt.numerics.push_back({module, version.get<int>()});
    }
    if (!object.at("record").is_null()) attempt.record = study::record_from_json(object.at("record").dump());
    object.at("bed_run").get_to(attempt.bed_run);
    return attempt;
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const study::BadInput&) {
    return std::nullopt;
  }
}

void remove_attempt(const std::filesystem::path& run_folder) {
  std::error_code ignored;
  std::filesystem::remove(file_in(run_folder), ignored);
}

}  // namespace seapile::execute
