#include "solver/simulation/flow_state.h"

#include <xxhash.h>

#include <algorithm>
#include <stdexcept>

namespace seapile::simulation {
namespace {

std::vector<std::int64_t> wide(const std::vector<std::int32_t>& values) { return {values.begin(), values.end()}; }

std::string level_name(std::size_t k, const char* what) { return "past/" + std::to_string(k) + "/" + what; }

const Array* find(const std::vector<Array>& state, const std::string& name) {
  const auto found = std::ranges::find(state, name, [](const Array& a) { return a.info.name; });
  return found == state.end() ? nullptr : &*found;
}

}  // namespace

std::vector<double> flat(const std::vector<base::Vec2>& vectors) {
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

std::vector<std::int32_t> corners_of(const mesh::TriangleMesh& mesh) {
  std::vector<std::int32_t> values;
  for (const auto& t : mesh.triangle) values.insert(values.end(), t.begin(), t.end());
  return values;
}

bool has_array(const std::vector<Array>& state, const std::string& name) { return find(state, name) != nullptr; }

template <class T>
const std::vector<T>& array_of(const std::vector<Array>& state, const std::string& name, std::ptrdiff_t count) {
  const Array* found = find(state, name);
  const auto* values = found ? std::get_if<std::vector<T>>(&found->values) : nullptr;
  if (!values || (count >= 0 && static_cast<std::ptrdiff_t>(values->size()) != count))
    throw std::invalid_argument("the state of the flow has no fitting array " + name);
  return *values;
}
template const std::vector<double>& array_of(const std::vector<Array>&, const std::string&, std::ptrdiff_t);
template const std::vector<std::int32_t>& array_of(const std::vector<Array>&, const std::string&, std::ptrdiff_t);
template const std::vector<std::int64_t>& array_of(const std::vector<Array>&, const std::string&, std::ptrdiff_t);

FlowFrame frame_of(const fluid::Flow& flow, const fluid::FreeSurface* surface, double time, const FrameScales& scales) {
  std::vector<double> pressure;
  std::vector<base::Vec2> v(flow.mesh.vertices());
  for (std::size_t i = 0; i < flow.mesh.vertices(); ++i) {
    v[i] = {flow.unknown[3 * i], flow.unknown[3 * i + 1]};
    pressure.push_back(flow.unknown[3 * i + 2]);
  }

  FlowFrame frame;
  frame.time = time;
  frame.vertices = {
      {{"vertices/position", "m", "place" + scales.length, 2, Entity::vertex}, flat(flow.mesh.position)},
      {{"vertices/velocity", "m/s", "superficial velocity" + scales.velocity, 2, Entity::vertex}, flat(v)},
      {{"vertices/pressure", "Pa", "pressure" + scales.pressure, 1, Entity::vertex}, pressure},
      {{"vertices/porosity", "-", "share of fluid", 1, Entity::vertex}, flow.porosity},
      {{"vertices/mesh_velocity", "m/s", "velocity of the mesh" + scales.velocity, 2, Entity::vertex},
       flat(flow.mesh_velocity)}};
  frame.triangles = {{{"triangles/corner", "-", "rows of its vertices, counterclockwise", 3, Entity::triangle},
                      wide(corners_of(flow.mesh))}};
  if (!surface) return frame;

  std::vector<double> across;
  for (std::size_t s = 0; s < surface->vertex.size(); ++s) {
    const std::size_t a = s == 0 || surface->gap == s - 1 ? s : s - 1,
                      b = s + 1 == surface->vertex.size() || surface->gap == s ? s : s + 1;
    const base::Vec2 along{surface->x[b] - surface->x[a], surface->height[b] - surface->height[a]};
    across.push_back(dot(v[surface->vertex[s]], base::perpendicular(along)) / norm(along));
  }
  frame.surface = {
      {{"surface/vertex", "-", "row of the vertex", 1, Entity::surface}, wide(surface->vertex)},
      {{"surface/x", "m", "place along the surface" + scales.length, 1, Entity::surface}, surface->x},
      {{"surface/height", "m", "height h" + scales.length, 1, Entity::surface}, surface->height},
      {{"surface/curvature", "1/m", "curvature kappa" + scales.curvature, 1, Entity::surface},
       fluid::curvature(*surface, flow.fluid.geometry)},
      {{"surface/normal_velocity", "m/s", "velocity across the surface" + scales.velocity, 1, Entity::surface},
       across}};
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

void add_flow(std::vector<Array>& state, const fluid::Flow& flow, const fluid::Past& past,
              const fluid::FlowSolver& solver) {
  const auto add = [&](const std::string& name, const char* unit, const char* meaning, int columns, Entity entity,
                       auto values) {
    state.push_back({{name, unit, meaning, columns, entity}, std::move(values)});
  };
  add("mesh/corner", "-", "vertices of the triangles", 3, Entity::triangle, corners_of(flow.mesh));
  add("mesh/position", "m", "places of the vertices", 2, Entity::vertex, flat(flow.mesh.position));
  add("flow/unknown", "-", "velocity and pressure", 3, Entity::vertex, flow.unknown);
  add("past/levels", "-", "time levels", 1, Entity::run,
      std::vector<std::int64_t>{static_cast<std::int64_t>(past.level.size())});
  for (std::size_t k = 0; k < past.level.size(); ++k) {
    const fluid::TimeLevel& level = past.level[k];
    add(level_name(k, "unknown"), "-", "velocity and pressure", 3, Entity::vertex, level.unknown);
    add(level_name(k, "interstitial"), "m/s", "velocity between the grains", 2, Entity::vertex,
        flat(level.interstitial));
    add(level_name(k, "position"), "m", "places of the vertices", 2, Entity::vertex, flat(level.position));
    add(level_name(k, "porosity"), "-", "share of fluid", 1, Entity::vertex, level.porosity);
  }
  // The factors are made again from their matrix.
  add("factor/rate", "1/s", "rate of the scheme that it belongs to", 1, Entity::run,
      std::vector<double>{solver.factor_rate});
  add("factor/counts", "-", "iterations of the last step, of the factor's first, beyond it since; factors made", 1,
      Entity::run,
      std::vector<std::int64_t>{solver.last_iterations, solver.first_iterations, solver.excess_iterations,
                                solver.refactorisations});
  if (!solver.factor.empty()) {
    const Eigen::SparseMatrix<double>& m = solver.factor.matrix();
    add("factor/outer", "-", "first entry of each column", 1, Entity::run,
        std::vector<std::int32_t>(m.outerIndexPtr(), m.outerIndexPtr() + m.outerSize() + 1));
    add("factor/inner", "-", "row of each entry", 1, Entity::run,
        std::vector<std::int32_t>(m.innerIndexPtr(), m.innerIndexPtr() + m.nonZeros()));
    add("factor/value", "-", "entries", 1, Entity::run, std::vector<double>(m.valuePtr(), m.valuePtr() + m.nonZeros()));
  }
}

void restore_flow(fluid::Flow& flow, fluid::Past& past, fluid::FlowSolver& solver, const std::vector<Array>& state) {
  const auto vertices = static_cast<std::ptrdiff_t>(flow.mesh.vertices());
  if (array_of<std::int32_t>(state, "mesh/corner") != corners_of(flow.mesh))
    throw std::invalid_argument("the state of the flow is on another mesh: the mesher has changed");
  flow.mesh.position = vectors(array_of<double>(state, "mesh/position", 2 * vertices));
  flow.unknown = array_of<double>(state, "flow/unknown", 3 * vertices);

  const auto levels = static_cast<std::size_t>(array_of<std::int64_t>(state, "past/levels", 1)[0]);
  past.level.clear();
  for (std::size_t k = 0; k < levels; ++k)
    past.level.push_back({array_of<double>(state, level_name(k, "unknown"), 3 * vertices),
                          vectors(array_of<double>(state, level_name(k, "interstitial"), 2 * vertices)),
                          vectors(array_of<double>(state, level_name(k, "position"), 2 * vertices)),
                          array_of<double>(state, level_name(k, "porosity"), vertices)});

  solver.factor_rate = array_of<double>(state, "factor/rate", 1)[0];
  const auto& counts = array_of<std::int64_t>(state, "factor/counts", 4);
  solver.last_iterations = static_cast<int>(counts[0]);
  solver.first_iterations = static_cast<int>(counts[1]);
  solver.excess_iterations = static_cast<int>(counts[2]);
  solver.refactorisations = counts[3];
  solver.factor = {};
  if (!has_array(state, "factor/value")) return;
  const auto& outer = array_of<std::int32_t>(state, "factor/outer", 3 * vertices + 1);
  const auto& value = array_of<double>(state, "factor/value");
  const auto& inner = array_of<std::int32_t>(state, "factor/inner", static_cast<std::ptrdiff_t>(value.size()));
  solver.factor.factorise(Eigen::Map<const Eigen::SparseMatrix<double>>(
      3 * vertices, 3 * vertices, static_cast<Eigen::Index>(value.size()), outer.data(), inner.data(), value.data()));
}

}  // namespace seapile::simulation
