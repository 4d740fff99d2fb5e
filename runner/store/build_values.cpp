#include "runner/store/build_values.h"

namespace seapile::store {

std::vector<std::pair<std::string, std::string>> build_values(const Provenance& made) {
  return {{"version", made.version},    {"commit", made.commit}, {"dirty", made.dirty ? "yes" : "no"},
          {"compiler", made.compiler},  {"flags", made.flags},   {"build type", made.build_type},
          {"libraries", made.libraries}};
}

}  // namespace seapile::store
