#include "bench/pile_box.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include "solver/mesh/generate.h"

namespace seapile::bench {
namespace {

using base::Vec2;

constexpr double kFirstCount = 1950;   // vertices that the lengths of PileBox give
constexpr double kGrowth = 0.085;      // of an edge's length, by the distance from the pile
constexpr double kGrainSize = 0.02;    // [m]
constexpr double kBedPorosity = 0.42;  // mean of the bed

/// Distance to the pile's outline, its tip taken for flat.
double distance(const PileBox& box, Vec2 at) {
  const double x = std::max(0.0, std::abs(at.x) - box.radius), y = std::max(0.0, -box.depth - at.y);
  return std::hypot(x, y);
}

mesh::TriangleMesh generated(const PileBox& box, double scale) {
  const double half = box.width / 2, r = box.radius, shoulder = box.shoulder();
  std::vector<mesh::Corner> corners = {{{-half, -box.height}, kBottom},
                                       {{half, -box.height}, kWall},
                                       {{half, 0}, kTop},
                                       {{r, 0}, kPileSide},
                                       {{r, -shoulder}, kPileTip}};
  if (box.cone > 0) corners.push_back({{0, -box.depth}, kPileTip});
  corners.push_back({{-r, -shoulder}, kPileSide});
  corners.push_back({{-r, 0}, kTop});
  corners.push_back({{-half, 0}, kWall});
  return mesh::generate(corners,
                        [&](Vec2 at) { return scale * std::min(box.far, box.near + kGrowth * distance(box, at)); });
}

double porosity(Vec2 at) {
  const double bed = kBedPorosity + 0.04 * std::sin(5 * at.x) * std::cos(4 * at.y);
  const double share = 0.5 * (1 - std::tanh((at.y + 2) / 0.2));  // the bed's surface, at half the height
  return 1 - share * (1 - bed);
}

/// Of Carman and Kozeny: phi grad p = -beta u.
double drag(const fluid::Properties& fluid, double porosity) {
  const double solid = (1 - porosity) / (porosity * kGrainSize);
  return 150 * fluid.viscosity * solid * solid;
}

}  // namespace

double PileBox::shoulder() const {
  return cone > 0 ? depth - radius / std::tan(cone / 2 * std::numbers::pi / 180) : depth;
}

mesh::TriangleMesh mesh_of(const PileBox& box, int vertices) {
  double scale = std::sqrt(kFirstCount / vertices);
  mesh::TriangleMesh mesh = generated(box, scale);
  // Once more when the count is off by more than 1 %.
  const double ratio = static_cast<double>(mesh.vertices()) / vertices;
  if (std::abs(ratio - 1) > 0.01) mesh = generated(box, scale * std::sqrt(ratio));
  return mesh;
}

fluid::Flow flow_of(const PileBox& box, mesh::TriangleMesh mesh) {
  fluid::Flow flow = fluid::at_rest(std::move(mesh), {.density = 1000, .viscosity = 1e-3});
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    for (const std::int32_t v : {e.from, e.to}) {
      if (e.tag == kWall) hold(flow, v, fluid::kVelocityX, 0);
      if (e.tag == kBottom) hold(flow, v, fluid::kVelocityY, 0);
    }
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    if (e.tag == kPileSide || e.tag == kPileTip)
      for (const std::int32_t v : {e.from, e.to}) {
        hold(flow, v, fluid::kVelocityX, 0);
        hold(flow, v, fluid::kVelocityY, -box.speed);
      }
  fill_bed(box, flow);
  return flow;
}

std::vector<double> shares(const PileBox& box, const mesh::TriangleMesh& at_first) {
  const double shoulder = -box.shoulder(), tip = -box.depth, half = box.width / 2;
  std::vector<double> share;
  for (const Vec2 at : at_first.position) {
    const double down = at.y > shoulder ? at.y / shoulder : at.y < tip ? (at.y + box.height) / (tip + box.height) : 1;
    share.push_back(down * std::min(1.0, (half - std::abs(at.x)) / (half - box.radius)));
  }
  return share;
}

void move(const mesh::TriangleMesh& at_first, const std::vector<double>& share, double travel,
          mesh::TriangleMesh& mesh) {
  for (std::size_t v = 0; v < at_first.vertices(); ++v) mesh.position[v].y = at_first.position[v].y - travel * share[v];
}

void fill_bed(const PileBox& box, fluid::Flow& flow) {
  if (!box.bed) return;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    flow.porosity[v] = porosity(flow.mesh.position[v]);
    flow.drag[v] = drag(flow.fluid, flow.porosity[v]);
  }
}

BoxState state_of(const PileBox& box, const fluid::Flow& flow) {
  const auto u = [&](std::int32_t v) { return Vec2{flow.u(v, fluid::kVelocityX), flow.u(v, fluid::kVelocityY)}; };
  BoxState state;
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary) {
    const double dx = flow.mesh.position[e.from].x - flow.mesh.position[e.to].x;
    if (e.tag == kTop) state.outflow += dx * (u(e.from).y + u(e.to).y) / 2 / (2 * box.radius * box.speed);
    if (e.tag == kPileSide || e.tag == kPileTip)
      for (const std::int32_t v : {e.from, e.to})
        state.tip_error = std::max(state.tip_error, norm(u(v) - Vec2{0, -box.speed}) / box.speed);
  }
  for (const auto& t : flow.mesh.triangle) {
    const double doubled =
        mesh::doubled_area(flow.mesh.position[t[0]], flow.mesh.position[t[1]], flow.mesh.position[t[2]]);
    Vec2 sum, middle;
    double squares = 0, phi = 0;
    for (const std::int32_t v : t) {
      const Vec2 interstitial = 1 / flow.porosity[v] * u(v);
      sum = sum + interstitial;
      middle = middle + 1.0 / 3 * flow.mesh.position[v];
      squares += dot(interstitial, interstitial);
      phi += flow.porosity[v] / 3;
      state.largest_speed = std::max(state.largest_speed, norm(u(v)) / box.speed);
    }
    // Exact for linear v and one porosity.
    const double energy = 0.5 * flow.fluid.density * phi * doubled / 24 * (squares + dot(sum, sum));
    state.kinetic_energy += energy;
    if (std::abs(middle.x) > 0.5 || middle.y < -1) state.far_energy += energy;
  }
  return state;
}

void write_mesh(const mesh::TriangleMesh& mesh, const std::filesystem::path& path) {
  std::ofstream file(path);
  file.precision(17);
  file << mesh.vertices() << ' ' << mesh.triangles() << ' ' << mesh.boundary.size() << '\n';
  std::vector<std::int32_t> label(mesh.vertices(), 0);
  for (const mesh::BoundaryEdge& e : mesh.boundary) label[e.from] = e.tag;
  for (std::size_t v = 0; v < mesh.vertices(); ++v)
    file << mesh.position[v].x << ' ' << mesh.position[v].y << ' ' << label[v] << '\n';
  for (const auto& t : mesh.triangle) file << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << " 0\n";
  for (const mesh::BoundaryEdge& e : mesh.boundary) file << e.from + 1 << ' ' << e.to + 1 << ' ' << e.tag << '\n';
  if (!file.flush()) throw std::runtime_error(path.string() + " could not be written");
}

}  // namespace seapile::bench
