#include "tests/verification/law.h"

namespace seapile::verification {

std::vector<Law> laws() {
  std::vector<Law> all;
  for (const auto& theme : {fall_laws(), impact_laws(), rolling_laws(), stack_laws(), heap_laws(), collapse_laws(),
                            conservation_laws(), symmetry_laws()})
    all.insert(all.end(), theme.begin(), theme.end());
  return all;
}

}  // namespace seapile::verification
