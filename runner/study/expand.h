#pragma once

#include <filesystem>
#include <vector>

#include "runner/study/grammar.h"
#include "runner/study/study.h"

namespace seapile::study {

/// The cases of a study and what is recorded of them. `folder`: where grain files lie; `probes`: as Options have them.
/// Every case is checked as a whole; a problem that several cases share is reported once, at the text that caused it.
struct Expansion {
  scene::RecordSpec record;
  std::vector<Case> cases;
};
Expansion expand(const Grammar& grammar, const std::filesystem::path& folder,
                 const std::vector<std::vector<double>>& probes, base::Problems& problems);

}  // namespace seapile::study
