#include "solver/simulation/jet_state.h"

#include "solver/simulation/flow_state.h"

namespace seapile::simulation {
namespace {

constexpr const char* kPart = "jet/clock";

}  // namespace

FlowFrame frame_of(const fluid::Jet& jet, double time) {
  return frame_of(jet.flow, &jet.surface, time, {", in H", ", in U", ", in mu U/H", ", in 1/H"});
}

std::vector<Array> snapshot(const fluid::JetInTime& run) {
  std::vector<Array> state{
      {{"jet/steps", "-", "steps done, corrections so far", 1, Entity::run},
       std::vector<std::int64_t>{run.clock.step, run.iterations}},
      {{"surface/height", "m", "height", 1, Entity::surface}, run.jet.surface.height},
      {{"flow/mesh_velocity", "m/s", "velocity of the mesh", 2, Entity::vertex}, flat(run.jet.flow.mesh_velocity)}};
  if (run.clock.part != 0 || run.clock.halvings != 0)
    state.push_back({{kPart, "-", "ticks since the last whole step, halvings", 1, Entity::run},
                     std::vector<std::int64_t>{run.clock.part, run.clock.halvings}});
  add_flow(state, run.jet.flow, run.past, run.solver);
  return state;
}

void restore(fluid::JetInTime& run, const std::vector<Array>& state) {
  const auto& steps = array_of<std::int64_t>(state, "jet/steps", 2);
  fluid::Flow& flow = run.jet.flow;
  restore_flow(flow, run.past, run.solver, state);
  flow.mesh_velocity =
      vectors(array_of<double>(state, "flow/mesh_velocity", 2 * static_cast<std::ptrdiff_t>(flow.mesh.vertices())));
  run.clock.step = steps[0];
  run.clock.part = run.clock.halvings = 0;
  if (has_array(state, kPart)) {
    const auto& part = array_of<std::int64_t>(state, kPart, 2);
    run.clock.part = static_cast<int>(part[0]);
    run.clock.halvings = static_cast<int>(part[1]);
  }
  run.past.dt = run.clock.size();
  run.iterations = steps[1];
  run.jet.surface.height =
      array_of<double>(state, "surface/height", static_cast<std::ptrdiff_t>(run.jet.surface.vertex.size()));
}

}  // namespace seapile::simulation
