// A frame's arrays by their names.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "runner/store/store_error.h"
#include "solver/base/vec2.h"
#include "solver/simulation/frame.h"

namespace seapile::present {

/// The values of an array; throws store::StoreError when the frame lacks it.
template <class T>
const std::vector<T>& values(const std::vector<simulation::Array>& arrays, const char* name) {
  const auto found = std::ranges::find(arrays, name, [](const simulation::Array& array) { return array.info.name; });
  const auto* list = found == arrays.end() ? nullptr : std::get_if<std::vector<T>>(&found->values);
  if (list == nullptr) {
    throw store::StoreError(store::StoreError::Kind::damaged, fmt::format("the frame has no array {}", name));
  }
  return *list;
}

/// A row of an array of vectors.
inline base::Vec2 vec2(const std::vector<double>& list, std::size_t row) {
  return {list.at(2 * row), list.at(2 * row + 1)};
}

}  // namespace seapile::present
