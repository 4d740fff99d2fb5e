#include "tests/runner/store/scratch.h"

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace seapile::store {

Scratch::Scratch() {
  const std::filesystem::path memory = "/dev/shm";
  const bool has_memory = ::access(memory.c_str(), W_OK) == 0;
  std::string name = ((has_memory ? memory : std::filesystem::temp_directory_path()) / "seapile_XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot create a scratch folder");
  path_ = name;
}

Scratch::~Scratch() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path Scratch::fresh(const std::string& name) const {
  std::filesystem::remove_all(path_ / name);
  std::filesystem::create_directories(path_ / name);
  return path_ / name;
}

}  // namespace seapile::store
