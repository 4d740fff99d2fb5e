#include "runner/store/well_formed.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

#include "runner/store/arrays.h"

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::FlowFrame;
using simulation::Frame;

void require_list(const std::vector<Array>& arrays, const std::string& prefix, const std::string& needed) {
  std::set<std::string> names;
  for (const Array& array : arrays) {
    const std::string& name = array.info.name;
    if (!name.starts_with(prefix) || name.size() == prefix.size() || name.find('/', prefix.size()) != name.npos) {
      throw std::logic_error("a frame's array \"" + name + "\" should be named " + prefix + "...");
    }
    if (!names.insert(name).second) throw std::logic_error("a frame has two arrays " + name);
    if (row_count(array) != row_count(arrays.front())) throw std::logic_error(name + " has another number of rows");
  }
  if (!needed.empty() && !arrays.empty() && !names.contains(needed)) {
    throw std::logic_error("a frame has no " + needed);
  }
}

const Array& named(const std::vector<Array>& arrays, const std::string& name) {
  return *std::ranges::find(arrays, name, [](const Array& array) { return array.info.name; });
}

/// Rows of vertices, so many in each row.
void require_vertices(const Array& array, int columns, std::size_t vertices) {
  const auto* rows = std::get_if<std::vector<std::int64_t>>(&array.values);
  if (rows == nullptr || array.info.columns != columns) {
    throw std::logic_error(array.info.name + " is not of " + std::to_string(columns) + " whole numbers of 64 bits");
  }
  const auto is_there = [&](std::int64_t row) { return row >= 0 && static_cast<std::size_t>(row) < vertices; };
  if (!std::ranges::all_of(*rows, is_there)) throw std::logic_error(array.info.name + " names a vertex that is none");
}

}  // namespace

void require_well_formed(const Frame& frame) {
  require_list(frame.grains, "grains/", "grains/position");
  require_list(frame.contacts, "contacts/", "contacts/position");
  require_list(frame.cells, "cells/", "");
  const auto cells = static_cast<std::size_t>(frame.grid.nx) * static_cast<std::size_t>(frame.grid.ny);
  if (frame.grid.nx < 0 || frame.grid.ny < 0 || (!frame.cells.empty() && row_count(frame.cells.front()) != cells)) {
    throw std::logic_error("a frame's cells are not those of its grid");
  }
}

void require_well_formed(const FlowFrame& frame) {
  require_list(frame.vertices, "vertices/", "vertices/position");
  require_list(frame.triangles, "triangles/", "triangles/corner");
  require_list(frame.surface, "surface/", "surface/vertex");
  // Of triangles a file holds the corners alone, beside the vertices' arrays.
  const bool is_mesh = !frame.vertices.empty() && frame.triangles.size() == 1 && row_count(frame.triangles[0]) > 0;
  if (!is_mesh) throw std::logic_error("a frame of the water has no mesh of triangles alone");
  if (std::ranges::count(frame.vertices, "vertices/corner", [](const Array& array) { return array.info.name; }) > 0) {
    throw std::logic_error("vertices/corner has the name of the triangles' corners");
  }
  if (named(frame.vertices, "vertices/position").info.columns != 2) {
    throw std::logic_error("vertices/position is not in the plane");
  }
  const std::size_t vertices = row_count(frame.vertices[0]);
  require_vertices(frame.triangles[0], 3, vertices);
  if (!frame.surface.empty()) require_vertices(named(frame.surface, "surface/vertex"), 1, vertices);
}

}  // namespace seapile::store
