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

Box box_of(std::span<const base::Vec2, 3> corner) {
  const base::Vec2 a = corner[0], b = corner[1], c = corner[2];
  return {{std::min(std::min(a.x, b.x), c.x), std::min(std::min(a.y, b.y), c.y)},
          {std::max(std::max(a.x, b.x), c.x), std::max(std::max(a.y, b.y), c.y)}};
}

Buckets::Buckets(const TriangleMesh& mesh) {
  std::vector<Box> box;
  box.reserve(mesh.triangles());
  for (const auto& t : mesh.triangle)
    box.push_back(box_of(std::array{mesh.position[t[0]], mesh.position[t[1]], mesh.position[t[2]]}));
  Box all = box[0];
  for (const Box& b : box) {
    all.low = {std::min(all.low.x, b.low.x), std::min(all.low.y, b.low.y)};
    all.high = {std::max(all.high.x, b.high.x), std::max(all.high.y, b.high.y)};
  }
  const base::Vec2 extent = all.high - all.low;
  low_ = all.low;
  cell_ = 1.5 * std::sqrt(extent.x * extent.y / static_cast<double>(box.size()));  // about a mean triangle's edge
  per_length_ = 1 / cell_;
  columns_ = 1 + static_cast<std::int32_t>(extent.x / cell_);
  rows_ = 1 + static_cast<std::int32_t>(extent.y / cell_);

  std::vector<Cells> reach;
  reach.reserve(box.size());
  first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (const Box& b : box) {
    reach.push_back(cells(b));
    for (std::int32_t j = reach.back().bottom; j <= reach.back().top; ++j)
      for (std::int32_t i = reach.back().left; i <= reach.back().right; ++i) ++first_[cell(i, j) + 1];
  }
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  in_cell_.resize(first_.back());
  std::vector<std::int32_t> next = first_;
  for (std::size_t t = 0; t < reach.size(); ++t)
    for (std::int32_t j = reach[t].bottom; j <= reach[t].top; ++j)
      for (std::int32_t i = reach[t].left; i <= reach[t].right; ++i)
        in_cell_[next[cell(i, j)]++] = static_cast<std::int32_t>(t);
}

std::span<const std::int32_t> Buckets::at(base::Vec2 p) const { return in(cell(column(p.x), row(p.y))); }

void Buckets::near(const Box& box, std::vector<std::int32_t>& found) const {
  found.clear();
  const Cells reach = cells(box);
  for (std::int32_t j = reach.bottom; j <= reach.top; ++j)
    for (std::int32_t i = reach.left; i <= reach.right; ++i) {
      const auto here = in(cell(i, j));
      found.insert(found.end(), here.begin(), here.end());
    }
  if (reach.left == reach.right && reach.bottom == reach.top) return;
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

Buckets::Cells Buckets::cells(const Box& box) const {
  const double margin = 1e-9 * cell_;
  return {column(box.low.x - margin), column(box.high.x + margin), row(box.low.y - margin), row(box.high.y + margin)};
}

std::int32_t Buckets::column(double x) const { return index((x - low_.x) * per_length_, columns_); }
std::int32_t Buckets::row(double y) const { return index((y - low_.y) * per_length_, rows_); }

}  // namespace seapile::mesh
