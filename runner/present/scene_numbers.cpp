#include "runner/present/scene_numbers.h"

#include <fmt/format.h>

#include "runner/store/parameters.h"
#include "runner/store/run_folder.h"

namespace seapile::present {

SceneNumbers::SceneNumbers(const std::filesystem::path& run_folder) : folder_(run_folder.string()) {
  const store::RunHeader header = store::read_manifest(run_folder).header;
  for (const store::Parameter& parameter : store::parameters(header.scene_json, header.kind)) {
    if (parameter.number) numbers_[parameter.path] = *parameter.number;
  }
}

double SceneNumbers::at(const std::string& path) const {
  const auto found = numbers_.find(path);
  if (found != numbers_.end()) return found->second;
  throw store::StoreError(store::StoreError::Kind::damaged, fmt::format("{} has no {}", folder_, path));
}

}  // namespace seapile::present
