#include "runner/store/dropped.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runner/store/durable.h"
#include "runner/store/layout.h"
#include "runner/store/sealed_text.h"
#include "runner/store/stamp.h"

namespace seapile::store {

namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

}  // namespace

std::string dropped_text(const Manifest& manifest, const std::vector<std::string>& paths) {
  std::vector<std::string> all = manifest.dropped;
  all.insert(all.end(), paths.begin(), paths.end());
  std::ranges::sort(all);
  const auto twice = std::ranges::unique(all);
  all.erase(twice.begin(), twice.end());
  const Json json = {{"schema", kSchema},
                     {"case", manifest.header.case_id},
                     {"run", manifest.run},
                     {"manifest", manifest.seal},
                     {"files", all}};
  return with_seal(json.dump(2));
}

void write_dropped(const Path& run_folder, const Manifest& manifest, const std::vector<std::string>& paths) {
  write_text(run_folder / kDroppedFile, dropped_text(manifest, paths));
}

void apply_dropped(const Path& run_folder, Manifest& manifest) {
  const Path file = run_folder / kDroppedFile;
  if (!is_there(file)) return;
  try {
    const Json json = Json::parse(unsealed(read_text(file), file));
    if (json.at("schema") > kSchema || json.at("manifest") != manifest.seal)
      throw StoreError(StoreError::Kind::damaged, file.string() + " is of another manifest, or of a newer program");
    manifest.dropped = json.at("files").get<std::vector<std::string>>();
  } catch (const Json::exception& error) {
    throw StoreError(StoreError::Kind::damaged, file.string() + " is damaged: " + error.what());
  }
  const auto is_dropped = [&](const std::string& path) {
    return std::ranges::find(manifest.dropped, path) != manifest.dropped.end();
  };
  std::erase_if(manifest.files, [&](const FileEntry& entry) { return is_dropped(entry.path); });
  if (is_dropped("grains.vtkhdf")) manifest.frames = 0;
  if (is_dropped("flow.vtkhdf")) manifest.flow_frames = 0;
}

}  // namespace seapile::store
