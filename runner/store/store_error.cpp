#include "runner/store/store_error.h"

#include <cerrno>
#include <system_error>

namespace seapile::store {

StoreError::StoreError(Kind what_failed, const std::string& sentence)
    : std::runtime_error(sentence), kind(what_failed) {}

StoreError system_error(StoreError::Kind kind, const std::string& doing, const std::filesystem::path& path) {
  return {kind, "cannot " + doing + " " + path.string() + ": " + std::generic_category().message(errno)};
}

}  // namespace seapile::store
