#include "solver/simulation/jet_state.h"

#include "solver/simulation/flow_state.h"

namespace seapile::simulation {

FlowFrame frame_of(const fluid::Jet& jet, double time) {
  return frame_of(jet.flow, &jet.surface, time, {", in H", ", in U", ", in mu U/H", ", in 1/H"});
}

std::vector<Array> snapshot(const fluid::JetInTime& run) {
  std::vector<Array> state{{{"jet/steps", "-", "steps done, corrections so far", 1, Entity::run},
                            std::vector<std::int64_t>{run.step, run.iterations}},
                           {{"surface/height", "m", "height", 1, Entity::surface}, run.jet.surface.height}};
  add_flow(state, run.jet.flow, run.past, run.solver);
  return state;
}

void restore(fluid::JetInTime& run, const std::vector<Array>& state) {
  const auto& steps = array_of<std::int64_t>(state, "jet/steps", 2);
  restore_flow(run.jet.flow, run.past, run.solver, state);
  run.step = steps[0];
  run.iterations = steps[1];
  run.jet.surface.height =
      array_of<double>(state, "surface/height", static_cast<std::ptrdiff_t>(run.jet.surface.vertex.size()));
}

}  // namespace seapile::simulation
