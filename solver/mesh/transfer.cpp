#include "solver/mesh/transfer.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "solver/mesh/elements.h"

namespace seapile::mesh {
namespace {

double area_of(std::span<const Element> elements) {
  double area = 0;
  for (const Element& e : elements) area += e.area;
  return area;
}

/// The place in the triangle that is nearest to p.
base::Vec2 nearest_in(const Element& e, base::Vec2 p) {
  base::Vec2 nearest = p;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const base::Vec2 a = e.corner[k], along = e.corner[(k + 1) % 3] - a;
    const base::Vec2 q = a + std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0) * along;
    if (norm(q - p) < least) {
      least = norm(q - p);
      nearest = q;
    }
  }
  return nearest;
}

/// Vertices of the old mesh and their weights in a value.
struct Weights {
  std::array<std::int32_t, 3> vertex{};
  std::array<double, 3> weight{};
};

Weights weights_at(base::Vec2 p, std::span<const Element> elements, const Buckets& buckets) {
  for (const std::int32_t t : buckets.at(p)) {
    const Element& e = elements[t];
    // As quotients of areas: exactly 0 and 1 at a vertex.
    const std::array<double, 3> doubled = {doubled_area(p, e.corner[1], e.corner[2]),
                                           doubled_area(e.corner[0], p, e.corner[2]),
                                           doubled_area(e.corner[0], e.corner[1], p)};
    if (doubled[0] < 0 || doubled[1] < 0 || doubled[2] < 0) continue;
    const double all = 2 * e.area;
    return {e.vertex, {doubled[0] / all, doubled[1] / all, doubled[2] / all}};
  }
  const Element* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Element& e) {
    if (const double distance = norm(nearest_in(e, p) - p); distance < least) {
      least = distance;
      nearest = &e;
    }
  };
  for (const std::int32_t t : buckets.at(p)) look(elements[t]);
  // What is farther than a rounding may be nearer to a triangle of another cell.
  if (!nearest || least * least > 1e-18 * nearest->area)
    for (const Element& e : elements) look(e);
  std::array<double, 3> weight = nearest->at(nearest_in(*nearest, p));
  for (double& w : weight) w = std::clamp(w, 0.0, 1.0);
  const double sum = weight[0] + weight[1] + weight[2];
  for (double& w : weight) w /= sum;
  return {nearest->vertex, weight};
}

using Polygon = std::vector<base::Vec2>;

/// What of the polygon lies left of the line from a to b.
void clip(const Polygon& polygon, base::Vec2 a, base::Vec2 b, Polygon& left) {
  left.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const base::Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    const double at_p = doubled_area(a, b, p), at_q = doubled_area(a, b, q);
    if (at_p >= 0) left.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) left.push_back(p + (at_p / (at_p - at_q)) * (q - p));
  }
}

/// Where one old and one new triangle overlap: a convex polygon by its moments, which is all that products of linear
/// functions need.
struct Piece {
  std::int32_t from, to;  ///< old and new triangle
  double area;            ///< [m2]
  base::Vec2 centre;      ///< [m]
  double xx, xy, yy;      ///< second moments about the centre [m4]

  base::Vec2 times(base::Vec2 g) const { return {xx * g.x + xy * g.y, xy * g.x + yy * g.y}; }
};

Piece piece_of(std::int32_t from, std::int32_t to, const Polygon& polygon) {
  Piece piece{from, to, 0, {}, 0, 0, 0};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const base::Vec2 e = polygon[i] - polygon[0], f = polygon[i + 1] - polygon[0];
    const double doubled = e.x * f.y - e.y * f.x;
    piece.area += doubled / 2;
    piece.centre = piece.centre + (doubled / 6) * (e + f);
    piece.xx += doubled / 12 * (e.x * e.x + e.x * f.x + f.x * f.x);
    piece.xy += doubled / 24 * (2 * e.x * e.y + e.x * f.y + f.x * e.y + 2 * f.x * f.y);
    piece.yy += doubled / 12 * (e.y * e.y + e.y * f.y + f.y * f.y);
  }
  if (!(piece.area > 0)) return piece;
  const base::Vec2 c = (1 / piece.area) * piece.centre;
  piece.xx -= piece.area * c.x * c.x;
  piece.xy -= piece.area * c.x * c.y;
  piece.yy -= piece.area * c.y * c.y;
  piece.centre = polygon[0] + c;
  return piece;
}

/// All pieces, by rising new triangle and rising old one.
std::vector<Piece> refinement(std::span<const Element> from, std::span<const Element> to, const Buckets& buckets) {
  std::vector<Piece> pieces;
  Polygon polygon, left;
  std::vector<std::int32_t> near;
  for (std::size_t n = 0; n < to.size(); ++n) {
    buckets.near(box_of(to[n].corner), near);
    for (const std::int32_t o : near) {
      polygon.assign(to[n].corner.begin(), to[n].corner.end());
      for (int k = 0; k < 3 && !polygon.empty(); ++k) {
        clip(polygon, from[o].corner[k], from[o].corner[(k + 1) % 3], left);
        std::swap(polygon, left);
      }
      const Piece piece = piece_of(o, static_cast<std::int32_t>(n), polygon);
      if (piece.area > 0) pieces.push_back(piece);
    }
  }
  return pieces;
}

double integral(std::span<const Element> elements, std::span<const double> f) {
  double sum = 0;
  for (const Element& e : elements) sum += e.area / 3 * (f[e.vertex[0]] + f[e.vertex[1]] + f[e.vertex[2]]);
  return sum;
}

}  // namespace

struct Transfer::Impl {
  std::vector<Element> from, to;
  std::size_t old_vertices = 0, new_vertices = 0;
  std::vector<Weights> weights;  ///< (new vertices)
  std::vector<Piece> pieces;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> mass;

  void expect(std::span<const double> values, std::size_t count) const {
    if (values.size() != count) throw std::logic_error("mesh: a value for every vertex is needed");
  }
};

Transfer::Transfer(const TriangleMesh& old_mesh, const TriangleMesh& new_mesh) {
  auto impl = std::make_shared<Impl>();
  impl->from = elements_of(old_mesh);
  impl->to = elements_of(new_mesh);
  impl->old_vertices = old_mesh.vertices();
  impl->new_vertices = new_mesh.vertices();
  const double before = area_of(impl->from), after = area_of(impl->to);
  if (!(before > 0 && std::abs(after - before) <= 1e-6 * before))
    throw std::logic_error("mesh: values cannot be carried over to a mesh of another area");
  const Buckets buckets(old_mesh);
  for (const base::Vec2 p : new_mesh.position) impl->weights.push_back(weights_at(p, impl->from, buckets));
  impl->pieces = refinement(impl->from, impl->to, buckets);

  std::vector<Eigen::Triplet<double>> mass;
  for (const Element& e : impl->to)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) mass.emplace_back(e.vertex[i], e.vertex[j], e.area / (i == j ? 6 : 12));
  const auto size = static_cast<Eigen::Index>(new_mesh.vertices());
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(mass.begin(), mass.end());
  impl->mass.compute(matrix);
  if (impl->mass.info() != Eigen::Success) throw std::logic_error("mesh: the mass matrix has no factors");
  impl_ = std::move(impl);
}

std::vector<double> Transfer::interpolated(std::span<const double> values) const {
  impl_->expect(values, impl_->old_vertices);
  std::vector<double> result;
  result.reserve(impl_->new_vertices);
  for (const auto& [vertex, weight] : impl_->weights)
    result.push_back(weight[0] * values[vertex[0]] + weight[1] * values[vertex[1]] + weight[2] * values[vertex[2]]);
  return result;
}

std::vector<double> Transfer::projected(std::span<const double> values) const {
  impl_->expect(values, impl_->old_vertices);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(impl_->new_vertices));
  for (const Piece& piece : impl_->pieces) {
    const Element &from = impl_->from[piece.from], &to = impl_->to[piece.to];
    const double mean = piece.area * from.value(values, piece.centre);
    const base::Vec2 moment = piece.times(from.slope(values));
    const std::array<double, 3> shape = to.at(piece.centre);
    for (int k = 0; k < 3; ++k) load[to.vertex[k]] += shape[k] * mean + dot(to.gradient[k], moment);
  }
  const Eigen::VectorXd solution = impl_->mass.solve(load);
  return {solution.begin(), solution.end()};
}

TransferError Transfer::error(std::span<const double> before, std::span<const double> after) const {
  impl_->expect(before, impl_->old_vertices);
  impl_->expect(after, impl_->new_vertices);
  double difference = 0, norm = 0;
  for (const Piece& piece : impl_->pieces) {
    const Element &from = impl_->from[piece.from], &to = impl_->to[piece.to];
    const double centre = to.value(after, piece.centre) - from.value(before, piece.centre);
    const base::Vec2 slope = to.slope(after) - from.slope(before);
    difference += piece.area * centre * centre + dot(slope, piece.times(slope));
  }
  for (const Element& e : impl_->from) {
    const double a = before[e.vertex[0]], b = before[e.vertex[1]], c = before[e.vertex[2]];
    norm += e.area / 12 * (a * a + b * b + c * c + (a + b + c) * (a + b + c));
  }
  return {integral(impl_->from, before), integral(impl_->to, after), std::sqrt(std::max(0.0, difference)),
          std::sqrt(norm)};
}

}  // namespace seapile::mesh
