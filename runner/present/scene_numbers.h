#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace seapile::present {

/// The numbers of a run's scene by their dotted paths [SI].
class SceneNumbers {
 public:
  /// Throws store::StoreError.
  explicit SceneNumbers(const std::filesystem::path& run_folder);
  bool has(const std::string& path) const { return numbers_.contains(path); }
  /// Throws store::StoreError when the scene has no such number.
  double at(const std::string& path) const;

 private:
  std::string folder_;
  std::map<std::string, double> numbers_;
};

}  // namespace seapile::present
