#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace seapile::simulation {

/// What one row of an array belongs to.
enum class Entity { run, grain, contact, cell, vertex, triangle, surface };

/// What is said of an array wherever it goes: file, frame, comparison.
struct ArrayInfo {
  std::string name;     ///< path-like: "grains/position"
  std::string unit;     ///< SI; "-" for numbers without
  std::string meaning;  ///< one line
  int columns = 1;      ///< 1 scalar, 2 vector; arrays are row-major, (rows, columns)
  Entity entity = Entity::run;
};

/// A read-only look at an array.
using ArrayView = std::variant<std::span<const double>, std::span<const float>, std::span<const std::int32_t>,
                               std::span<const std::int64_t>, std::span<const std::uint64_t>>;

/// An array that owns its values: what is read back from a file or taken as a snapshot.
using ArrayValues = std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>,
                                 std::vector<std::int64_t>, std::vector<std::uint64_t>>;

struct Array {
  ArrayInfo info;
  ArrayValues values;
};

}  // namespace seapile::simulation
