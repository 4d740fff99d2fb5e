#include "runner/store/frame_layout.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "runner/store/arrays.h"

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::Frame;

bool alike(const Array& a, const Array& b) {
  return a.info.name == b.info.name && a.info.columns == b.info.columns && number_of(a) == number_of(b);
}

bool same_grid(const Frame::Grid& a, const Frame::Grid& b) {
  return a.x0 == b.x0 && a.y0 == b.y0 && a.spacing == b.spacing && a.nx == b.nx && a.ny == b.ny;
}

}  // namespace

void ListLayout::add(std::vector<Array> list) {
  const std::size_t count = list.empty() ? 0 : row_count(list.front());
  rows.push_back(count);
  first_row.push_back(total_rows);
  total_rows += count;
  for (Array& array : list) std::visit([](auto& values) { values.clear(); }, array.values);
  if (!arrays.empty() && !list.empty() && !std::ranges::equal(arrays, list, alike)) {
    throw std::logic_error("the frames of a run have different arrays");
  }
  if (arrays.empty()) arrays = std::move(list);
}

FrameLayout layout_of(const FrameSource& frames, FrameList list) {
  FrameLayout layout;
  for (std::size_t k = 0; k < frames.count; ++k) {
    Frame frame = frames.load(k);
    layout.time.push_back(frame.time);
    layout.depth.push_back(frame.depth);
    layout.asked.push_back(frame.asked);
    if (k == 0) layout.grid = frame.grid;
    if (!same_grid(layout.grid, frame.grid)) throw std::logic_error("the frames of a run have different grids");
    layout.add(std::move(frame.*list));
  }
  return layout;
}

std::string leaf(const Array& array) { return array.info.name.substr(array.info.name.find('/') + 1); }

bool is_vector_in_space(const Array& array) {
  static const std::set<std::string> kVectors = {"position", "velocity", "mesh_velocity", "displacement", "normal"};
  return array.info.columns == 2 && kVectors.contains(leaf(array));
}

Array in_space(const Array& array) {
  Array padded{array.info, {}};
  std::visit(
      [&]<class T>(const std::vector<T>& values) {
        auto& wide = padded.values.emplace<std::vector<T>>();
        wide.reserve(values.size() / 2 * 3);
        for (std::size_t i = 0; i + 1 < values.size(); i += 2) {
          wide.insert(wide.end(), {values[i], values[i + 1], T{0}});
        }
      },
      array.values);
  return padded;
}

void to_plane(Array& array) {
  std::visit(
      [](auto& values) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
          if (i % 3 != 2) values[kept++] = values[i];
        }
        values.resize(kept);
      },
      array.values);
}

hdf5::Extents extents_in_file(const Array& array, std::size_t rows) {
  const auto columns = static_cast<std::uint64_t>(is_vector_in_space(array) ? 3 : array.info.columns);
  return {rows, columns == 1 ? 0 : columns};
}

}  // namespace seapile::store
