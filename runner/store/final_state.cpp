#include "runner/store/final_state.h"

#include <algorithm>
#include <variant>

#include "runner/store/manifest.h"
#include "runner/store/sha256.h"

namespace seapile::store {

namespace {

constexpr std::size_t kDigits = 16;

/// The names of the arrays go along, so that no value can change its place unseen.
std::string bytes_of(const std::vector<simulation::Array>& arrays) {
  std::string bytes;
  for (const simulation::Array& array : arrays) {
    bytes += array.info.name + '\0';
    std::visit(
        [&](const auto& values) {
          bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0]));
        },
        array.values);
  }
  return bytes;
}

}  // namespace

std::string final_state(const std::filesystem::path& run_folder, const Manifest& manifest) {
  if (manifest.header.kind != "bed") return hex(manifest.result.state_hash);
  if (std::ranges::find(manifest.files, "bed.h5", &FileEntry::path) == manifest.files.end()) return "";
  return sha256(bytes_of(read_bed(run_folder).grains)).substr(0, kDigits);
}

}  // namespace seapile::store
