#include "solver/mesh/elements.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace seapile::mesh {
namespace {

std::int32_t index(double share, std::int32_t count) {
  return static_cast<std::int32_t>(std::clamp(share, 0.0, count - 1.0));
}

}  // namespace

std::vector<Element> elements_of(const TriangleMesh& mesh) {
  std::vector<Element> elements;
  elements.reserve(mesh.triangles());
  for (const auto& t : mesh.triangle) {
    Element e{t, {mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]}, {}, 0};
    const double doubled = doubled_area(e.corner[0], e.corner[1], e.corner[2]);
    if (!(doubled > 0) || !std::isfinite(doubled))
      throw std::logic_error("mesh: values cannot be carried over from or to a flat triangle");
    e.area = 0.5 * doubled;
    for (int k = 0; k < 3; ++k)
      e.gradient[k] = (1 / doubled) * perpendicular(e.corner[(k + 2) % 3] - e.corner[(k + 1) % 3]);
    elements.push_back(e);
  }
  return elements;
}

Box box_of(const Element& e) {
  const auto [x_low, x_high] = std::minmax({e.corner[0].x, e.corner[1].x, e.corner[2].x});
  const auto [y_low, y_high] = std::minmax({e.corner[0].y, e.corner[1].y, e.corner[2].y});
  return {{x_low, y_low}, {x_high, y_high}};
}

Buckets::Buckets(std::span<const Element> elements) {
  Box all = box_of(elements[0]);
  for (const Element& e : elements) {
    const Box box = box_of(e);
    all.low = {std::min(all.low.x, box.low.x), std::min(all.low.y, box.low.y)};
    all.high = {std::max(all.high.x, box.high.x), std::max(all.high.y, box.high.y)};
  }
  const base::Vec2 extent = all.high - all.low;
  low_ = all.low;
  cell_ = std::sqrt(extent.x * extent.y / static_cast<double>(elements.size()));
  columns_ = 1 + static_cast<std::int32_t>(extent.x / cell_);
  rows_ = 1 + static_cast<std::int32_t>(extent.y / cell_);
  in_cell_.resize(static_cast<std::size_t>(columns_) * rows_);
  for (std::size_t t = 0; t < elements.size(); ++t)
    for (const std::size_t cell : cells(box_of(elements[t]))) in_cell_[cell].push_back(static_cast<std::int32_t>(t));
}

const std::vector<std::int32_t>& Buckets::at(base::Vec2 p) const {
  return in_cell_[static_cast<std::size_t>(row(p.y)) * columns_ + column(p.x)];
}

std::vector<std::int32_t> Buckets::near(const Box& box) const {
  std::vector<std::int32_t> found;
  for (const std::size_t cell : cells(box)) found.insert(found.end(), in_cell_[cell].begin(), in_cell_[cell].end());
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::vector<std::size_t> Buckets::cells(const Box& box) const {
  const double margin = 1e-9 * cell_;
  std::vector<std::size_t> cells;
  for (std::int32_t j = row(box.low.y - margin); j <= row(box.high.y + margin); ++j)
    for (std::int32_t i = column(box.low.x - margin); i <= column(box.high.x + margin); ++i)
      cells.push_back(static_cast<std::size_t>(j) * columns_ + i);
  return cells;
}

std::int32_t Buckets::column(double x) const { return index((x - low_.x) / cell_, columns_); }
std::int32_t Buckets::row(double y) const { return index((y - low_.y) / cell_, rows_); }

}  // namespace seapile::mesh
