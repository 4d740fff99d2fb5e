#include "solver/mesh/motion.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace seapile::mesh {
namespace {

/// dy = left surface[from] + right surface[from + 1] + pile times the pile.
struct Weights {
  std::int32_t from = 0;
  double left = 0, right = 0, pile = 0;
};

/// A line whose x rises, through vertices of the mesh.
struct Line {
  std::vector<base::Vec2> point;

  /// The piece over x, and the weight of its right end.
  std::pair<std::int32_t, double> piece(double x) const {
    const auto above = std::ranges::upper_bound(point, x, {}, &base::Vec2::x);
    const auto from =
        std::clamp<std::ptrdiff_t>(above - point.begin() - 1, 0, static_cast<std::ptrdiff_t>(point.size()) - 2);
    const double weight = (x - point[from].x) / (point[from + 1].x - point[from].x);
    return {static_cast<std::int32_t>(from), std::clamp(weight, 0.0, 1.0)};
  }
  double height(double x) const {
    const auto [from, weight] = piece(x);
    return (1 - weight) * point[from].y + weight * point[from + 1].y;
  }
};

Line line_through(const TriangleMesh& mesh, std::span<const std::int32_t> vertices) {
  Line line;
  for (const std::int32_t vertex : vertices) {
    const base::Vec2 p = mesh.position.at(vertex);
    if (!line.point.empty() && !(p.x > line.point.back().x))
      throw std::logic_error("mesh: a boundary whose x does not rise cannot move up and down");
    line.point.push_back(p);
  }
  if (line.point.size() < 2) throw std::logic_error("mesh: a boundary of one vertex cannot move a mesh");
  return line;
}

/// The boundary at its reference places.
struct Shape {
  Line surface;
  std::optional<Line> tip;
  double bottom = 0, lowest = 0;  ///< heights of the bottom and of the tip's lowest point [m]

  Shape(const TriangleMesh& mesh, const MovingBoundary& boundary)
      : surface(line_through(mesh, boundary.surface)), bottom(boundary.bottom) {
    if (boundary.tip.empty()) return;
    tip = line_through(mesh, boundary.tip);
    const auto right = std::ranges::upper_bound(surface.point, left_side(), {}, &base::Vec2::x);
    if (right == surface.point.begin() || right == surface.point.end() || right->x != right_side() ||
        std::prev(right)->x != left_side())
      throw std::logic_error("mesh: the surface has no gap where the pile is");
    lowest = std::ranges::min(tip->point, {}, &base::Vec2::y).y;
  }

  double left_side() const { return tip->point.front().x; }
  double right_side() const { return tip->point.back().x; }
  /// Distance from the pile's nearer side; 0 under the pile [m].
  double beside(base::Vec2 p) const { return std::max({0.0, left_side() - p.x, p.x - right_side()}); }
  /// Height of the nearer shoulder [m].
  double shoulder(base::Vec2 p) const {
    return p.x - left_side() < right_side() - p.x ? tip->point.front().y : tip->point.back().y;
  }
  bool on_sleeve(base::Vec2 p) const { return tip && (p.x == left_side() || p.x == right_side()) && p.y > shoulder(p); }
};

/// `with_surface` times the surface over p and `with_pile` times the pile.
Weights weights(const Shape& shape, base::Vec2 p, double with_surface, double with_pile) {
  const auto [from, weight] = shape.surface.piece(p.x);
  return {from, with_surface * (1 - weight), with_surface * weight, with_pile};
}

/// Share of the height over `low` that p has under the surface [-].
double share_over(const Shape& shape, double low, base::Vec2 p) {
  return (p.y - low) / (shape.surface.height(p.x) - low);
}

/// On the sleeve, with its ends.
Weights sliding(const Shape& shape, base::Vec2 p) {
  const double share = share_over(shape, shape.shoulder(p), p);
  return weights(shape, p, share, 1 - share);
}

Weights vertical(const Shape& shape, base::Vec2 p) {
  if (shape.tip && shape.beside(p) == 0)
    return weights(shape, p, 0, (p.y - shape.bottom) / (shape.tip->height(p.x) - shape.bottom));
  return weights(shape, p, share_over(shape, shape.bottom, p), 0);
}

Weights zones(const Shape& shape, base::Vec2 p, double reach) {
  const double free_surface = share_over(shape, shape.bottom, p);
  if (!shape.tip) return weights(shape, p, free_surface, 0);
  const double a = std::min(1.0, shape.beside(p) / reach);
  const double b = p.y < shape.lowest ? (shape.lowest - p.y) / (shape.lowest - shape.bottom) : 0;
  const double alpha = std::max(a, b);
  const double slid = std::max(0.0, share_over(shape, shape.shoulder(p), p));
  return weights(shape, p, alpha * free_surface + (1 - alpha) * slid, (1 - alpha) * (1 - slid));
}

/// Linear elements with some vertices given.
class Laplace {
 public:
  /// `given`: (vertices).
  Laplace(const TriangleMesh& mesh, const std::vector<bool>& given, double stiffening) : unknown_(mesh.vertices(), -1) {
    for (std::size_t v = 0; v < mesh.vertices(); ++v)
      if (!given[v]) {
        unknown_[v] = static_cast<std::int32_t>(vertex_.size());
        vertex_.push_back(static_cast<std::int32_t>(v));
      }
    double doubled_sum = 0;
    for (const auto& t : mesh.triangle)
      doubled_sum += doubled_area(mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]);
    const double mean = doubled_sum / static_cast<double>(mesh.triangles());
    std::vector<Eigen::Triplet<double>> inner;
    for (const auto& t : mesh.triangle) {
      const base::Vec2 a = mesh.position[t[0]], b = mesh.position[t[1]], c = mesh.position[t[2]];
      const base::Vec2 edge[3] = {c - b, a - c, b - a};
      const double doubled = doubled_area(a, b, c);
      const double k = stiffening == 0 ? 1 : std::pow(mean / doubled, stiffening);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const double entry = k * dot(edge[i], edge[j]) / (2 * doubled);
          if (unknown_[t[i]] < 0) continue;
          if (unknown_[t[j]] < 0)
            load_.push_back({unknown_[t[i]], t[j], -entry});
          else
            inner.emplace_back(unknown_[t[i]], unknown_[t[j]], entry);
        }
    }
    if (vertex_.empty()) return;
    const auto size = static_cast<Eigen::Index>(vertex_.size());
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(inner.begin(), inner.end());
    factor_.compute(matrix);
    if (factor_.info() != Eigen::Success) throw std::logic_error("mesh: the motion's matrix has no factors");
  }

  /// Fills in the values that are not given.
  void solve(std::vector<double>& value) const {
    if (vertex_.empty()) return;
    Eigen::VectorXd load = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(vertex_.size()));
    for (const auto& [row, vertex, entry] : load_) load[row] += entry * value[vertex];
    const Eigen::VectorXd solution = factor_.solve(load);
    for (std::size_t i = 0; i < vertex_.size(); ++i) value[vertex_[i]] = solution[static_cast<Eigen::Index>(i)];
  }

 private:
  struct Load {
    std::int32_t row, vertex;
    double entry;
  };
  std::vector<std::int32_t> unknown_, vertex_;  ///< of a vertex (-1: given), of an unknown
  std::vector<Load> load_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace

struct MeshMotion::Impl {
  MovingBoundary boundary;
  std::vector<std::pair<std::int32_t, Weights>> weights;  ///< by vertices; the others are the equation's
  std::optional<Laplace> equation;
  std::size_t vertices = 0;
};

MeshMotion::MeshMotion(const TriangleMesh& mesh, MovingBoundary boundary, const MotionKind& kind) {
  const Shape shape(mesh, boundary);
  std::vector<std::optional<Weights>> weights_of(mesh.vertices());
  for (std::size_t s = 0; s < boundary.surface.size(); ++s) {
    const bool last = s + 1 == boundary.surface.size();
    const auto from = static_cast<std::int32_t>(last ? s - 1 : s);
    weights_of[boundary.surface[s]] = last ? Weights{from, 0, 1, 0} : Weights{from, 1, 0, 0};
  }
  for (const std::int32_t vertex : boundary.tip) weights_of[vertex] = Weights{0, 0, 0, 1};
  const auto* reach = std::get_if<Zones>(&kind);
  const auto* elliptic = std::get_if<Elliptic>(&kind);
  if (reach && !(reach->reach > 0)) throw std::logic_error("mesh: zones need a reach above 0");
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    const base::Vec2 p = mesh.position[v];
    if (weights_of[v]) continue;
    if (p.y == shape.bottom)
      weights_of[v] = Weights{};
    else if (shape.on_sleeve(p))
      weights_of[v] = sliding(shape, p);
    else if (reach)
      weights_of[v] = zones(shape, p, reach->reach);
    else if (!elliptic)
      weights_of[v] = vertical(shape, p);
  }

  auto impl = std::make_shared<Impl>();
  impl->boundary = std::move(boundary);
  impl->vertices = mesh.vertices();
  std::vector<bool> given;
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    given.push_back(weights_of[v].has_value());
    if (weights_of[v]) impl->weights.emplace_back(static_cast<std::int32_t>(v), *weights_of[v]);
  }
  if (elliptic) impl->equation.emplace(mesh, given, elliptic->stiffening);
  impl_ = std::move(impl);
}

std::vector<double> MeshMotion::displacements(std::span<const double> surface, double pile) const {
  if (surface.size() != impl_->boundary.surface.size())
    throw std::logic_error("mesh: a displacement for every vertex of the surface is needed");
  std::vector<double> dy(impl_->vertices, 0);
  for (const auto& [vertex, w] : impl_->weights)
    dy[vertex] = w.left * surface[w.from] + w.right * surface[w.from + 1] + w.pile * pile;
  if (impl_->equation) impl_->equation->solve(dy);
  return dy;
}

const MovingBoundary& MeshMotion::boundary() const { return impl_->boundary; }

}  // namespace seapile::mesh
