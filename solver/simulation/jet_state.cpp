#include "solver/simulation/jet_state.h"

#include <xxhash.h>

#include <algorithm>
#include <span>
#include <stdexcept>

namespace seapile::simulation {
namespace {

std::vector<double> flat(std::span<const base::Vec2> vectors) {
  std::vector<double> values;
  values.reserve(2 * vectors.size());
  for (const base::Vec2& v : vectors) values.insert(values.end(), {v.x, v.y});
  return values;
}

std::vector<base::Vec2> vectors(const std::vector<double>& values) {
  std::vector<base::Vec2> result(values.size() / 2);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values[2 * i], values[2 * i + 1]};
  return result;
}

/// The array `name`, of so many values (-1: any number).
template <class T>
const std::vector<T>& array(const std::vector<Array>& state, const std::string& name, std::ptrdiff_t count = -1) {
  const auto found = std::ranges::find(state, name, [](const Array& a) { return a.info.name; });
  const auto* values = found == state.end() ? nullptr : std::get_if<std::vector<T>>(&found->values);
  if (!values || (count >= 0 && static_cast<std::ptrdiff_t>(values->size()) != count))
    throw std::invalid_argument("the state of the jet has no fitting array " + name);
  return *values;
}

std::vector<std::int32_t> corners(const mesh::TriangleMesh& mesh) {
  std::vector<std::int32_t> values;
  for (const auto& t : mesh.triangle) values.insert(values.end(), t.begin(), t.end());
  return values;
}

std::vector<std::int64_t> wide(const std::vector<std::int32_t>& values) { return {values.begin(), values.end()}; }

std::string level_name(std::size_t k, const char* what) { return "past/" + std::to_string(k) + "/" + what; }

}  // namespace

FlowFrame frame_of(const fluid::Jet& jet, double time) {
  const fluid::Flow& flow = jet.flow;
  const fluid::FreeSurface& surface = jet.surface;
  std::vector<double> velocity, pressure;
  std::vector<base::Vec2> v(flow.mesh.vertices());
  for (std::size_t i = 0; i < flow.mesh.vertices(); ++i) {
    v[i] = {flow.unknown[3 * i], flow.unknown[3 * i + 1]};
    pressure.push_back(flow.unknown[3 * i + 2]);
  }
  velocity = flat(v);
  std::vector<double> across;
  for (std::size_t s = 0; s < surface.vertex.size(); ++s) {
    const std::size_t a = s == 0 ? 0 : s - 1, b = s + 1 == surface.vertex.size() ? s : s + 1;
    const base::Vec2 along{surface.x[b] - surface.x[a], surface.height[b] - surface.height[a]};
    across.push_back(dot(v[surface.vertex[s]], base::perpendicular(along)) / norm(along));
  }

  FlowFrame frame;
  frame.time = time;
  frame.vertices = {
      {{"vertices/position", "m", "place, in H", 2, Entity::vertex}, flat(flow.mesh.position)},
      {{"vertices/velocity", "m/s", "superficial velocity, in U", 2, Entity::vertex}, velocity},
      {{"vertices/pressure", "Pa", "pressure, in mu U/H", 1, Entity::vertex}, pressure},
      {{"vertices/porosity", "-", "share of fluid", 1, Entity::vertex}, flow.porosity},
      {{"vertices/mesh_velocity", "m/s", "velocity of the mesh, in U", 2, Entity::vertex}, flat(flow.mesh_velocity)}};
  frame.triangles = {{{"triangles/corner", "-", "rows of its vertices, counterclockwise", 3, Entity::triangle},
                      wide(corners(flow.mesh))}};
  frame.surface = {
      {{"surface/vertex", "-", "row of the vertex", 1, Entity::surface}, wide(surface.vertex)},
      {{"surface/x", "m", "place along the jet, in H", 1, Entity::surface}, surface.x},
      {{"surface/height", "m", "height h, in H", 1, Entity::surface}, surface.height},
      {{"surface/curvature", "1/m", "curvature kappa, in 1/H", 1, Entity::surface},
       fluid::curvature(surface, flow.fluid.geometry)},
      {{"surface/normal_velocity", "m/s", "velocity across the surface, in U", 1, Entity::surface}, across}};
  return frame;
}

std::uint64_t hash_of(const FlowFrame& frame) {
  XXH3_state_t* hash = XXH3_createState();
  XXH3_64bits_reset(hash);
  for (const auto* list : {&frame.vertices, &frame.triangles, &frame.surface})
    for (const Array& a : *list) {
      XXH3_64bits_update(hash, a.info.name.data(), a.info.name.size());
      std::visit([&](const auto& v) { XXH3_64bits_update(hash, v.data(), v.size() * sizeof v[0]); }, a.values);
    }
  const std::uint64_t digest = XXH3_64bits_digest(hash);
  XXH3_freeState(hash);
  return digest;
}

std::vector<Array> snapshot(const fluid::JetInTime& run) {
  const fluid::Flow& flow = run.jet.flow;
  std::vector<Array> state;
  const auto add = [&](const std::string& name, const char* unit, const char* meaning, int columns, Entity entity,
                       auto values) {
    state.push_back({{name, unit, meaning, columns, entity}, std::move(values)});
  };
  add("jet/steps", "-", "steps done, corrections so far", 1, Entity::run,
      std::vector<std::int64_t>{run.step, run.iterations});
  add("mesh/corner", "-", "vertices of the triangles", 3, Entity::triangle, corners(flow.mesh));
  add("mesh/position", "m", "places of the vertices", 2, Entity::vertex, flat(flow.mesh.position));
  add("flow/unknown", "-", "velocity and pressure", 3, Entity::vertex, flow.unknown);
  add("surface/height", "m", "height", 1, Entity::surface, run.jet.surface.height);
  add("past/levels", "-", "time levels", 1, Entity::run,
      std::vector<std::int64_t>{static_cast<std::int64_t>(run.past.level.size())});
  for (std::size_t k = 0; k < run.past.level.size(); ++k) {
    const fluid::TimeLevel& level = run.past.level[k];
    add(level_name(k, "unknown"), "-", "velocity and pressure", 3, Entity::vertex, level.unknown);
    add(level_name(k, "interstitial"), "m/s", "velocity between the grains", 2, Entity::vertex,
        flat(level.interstitial));
    add(level_name(k, "position"), "m", "places of the vertices", 2, Entity::vertex, flat(level.position));
    add(level_name(k, "porosity"), "-", "share of fluid", 1, Entity::vertex, level.porosity);
  }
  // The factors are made again from their matrix.
  const fluid::FlowSolver& solver = run.solver;
  add("factor/rate", "1/s", "rate of the scheme that it belongs to", 1, Entity::run,
      std::vector<double>{solver.factor_rate});
  add("factor/counts", "-", "iterations of the last step, factors made", 1, Entity::run,
      std::vector<std::int64_t>{solver.last_iterations, solver.refactorisations});
  if (!solver.factor.empty()) {
    const Eigen::SparseMatrix<double>& m = solver.factor.matrix();
    add("factor/outer", "-", "first entry of each column", 1, Entity::run,
        std::vector<std::int32_t>(m.outerIndexPtr(), m.outerIndexPtr() + m.outerSize() + 1));
    add("factor/inner", "-", "row of each entry", 1, Entity::run,
        std::vector<std::int32_t>(m.innerIndexPtr(), m.innerIndexPtr() + m.nonZeros()));
    add("factor/value", "-", "entries", 1, Entity::run, std::vector<double>(m.valuePtr(), m.valuePtr() + m.nonZeros()));
  }
  return state;
}

void restore(fluid::JetInTime& run, const std::vector<Array>& state) {
  fluid::Flow& flow = run.jet.flow;
  const auto vertices = static_cast<std::ptrdiff_t>(flow.mesh.vertices());
  if (array<std::int32_t>(state, "mesh/corner") != corners(flow.mesh))
    throw std::invalid_argument("the state of the jet is on another mesh: the mesher has changed");
  const auto& steps = array<std::int64_t>(state, "jet/steps", 2);
  run.step = steps[0];
  run.iterations = steps[1];
  flow.mesh.position = vectors(array<double>(state, "mesh/position", 2 * vertices));
  flow.unknown = array<double>(state, "flow/unknown", 3 * vertices);
  run.jet.surface.height =
      array<double>(state, "surface/height", static_cast<std::ptrdiff_t>(run.jet.surface.vertex.size()));

  const auto levels = static_cast<std::size_t>(array<std::int64_t>(state, "past/levels", 1)[0]);
  run.past.level.clear();
  for (std::size_t k = 0; k < levels; ++k)
    run.past.level.push_back({array<double>(state, level_name(k, "unknown"), 3 * vertices),
                              vectors(array<double>(state, level_name(k, "interstitial"), 2 * vertices)),
                              vectors(array<double>(state, level_name(k, "position"), 2 * vertices)),
                              array<double>(state, level_name(k, "porosity"), vertices)});

  run.solver.factor_rate = array<double>(state, "factor/rate", 1)[0];
  const auto& counts = array<std::int64_t>(state, "factor/counts", 2);
  run.solver.last_iterations = static_cast<int>(counts[0]);
  run.solver.refactorisations = counts[1];
  if (std::ranges::none_of(state, [](const Array& a) { return a.info.name == "factor/value"; })) return;
  const auto& outer = array<std::int32_t>(state, "factor/outer", 3 * vertices + 1);
  const auto& value = array<double>(state, "factor/value");
  const auto& inner = array<std::int32_t>(state, "factor/inner", static_cast<std::ptrdiff_t>(value.size()));
  run.solver.factor.factorise(Eigen::Map<const Eigen::SparseMatrix<double>>(
      3 * vertices, 3 * vertices, static_cast<Eigen::Index>(value.size()), outer.data(), inner.data(), value.data()));
}

}  // namespace seapile::simulation
