#include "solver/simulation/basin.h"

#include <stdexcept>

namespace seapile::simulation {

RunResult run_basin(const basin::BasinSpec&, const scene::RecordSpec&, const Execution&, const std::vector<Array>&,
                    const std::vector<FlowRecord>&, const BasinHooks&) {
  throw std::logic_error("the time loop of a basin follows in a later commit");
}

}  // namespace seapile::simulation
