// A law: a small scene whose outcome is known, and rows of value against closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/verification/solver_under_test.h"

namespace seapile::verification {

enum class Relation { equals, at_most, at_least };

/// One quantity of one law, as one solver has it.
struct Row {
  std::string quantity;
  std::string unit;
  std::string where;  ///< the case, or the worst one of a sweep
  double value = 0;
  double expected = 0;  ///< closed form, or the bound
  double tolerance = 0;
  std::string why;  ///< this tolerance
  Relation relation = Relation::equals;

  double difference() const { return value - expected; }
  /// A value that is no number holds no law.
  bool holds() const {
    const double d = difference();
    if (relation == Relation::equals) return std::abs(d) <= tolerance;
    return relation == Relation::at_most ? d <= tolerance : d >= -tolerance;
  }
};

/// The case of a sweep that lies farthest from its closed form, measured in its tolerance.
class Worst {
 public:
  void add(const std::string& where, double value, double expected, double tolerance) {
    const double share = std::abs(value - expected) / tolerance;
    const bool worse = count_ == 0 || std::isnan(share) || share > share_;
    if (worse) row_.value = value, row_.expected = expected, row_.where = where, row_.tolerance = tolerance;
    if (worse) share_ = share;
    ++count_;
  }
  /// The row's place says how many cases there were.
  Row row(const std::string& quantity, const std::string& unit, const std::string& why) const {
    Row row = row_;
    row.quantity = quantity;
    row.unit = unit;
    row.where += ", worst of " + std::to_string(count_);
    row.why = why;
    return row;
  }

 private:
  Row row_;
  double share_ = 0;
  int count_ = 0;
};

/// How large the scenes are that have no closed form: in the tests, or in an occasional, longer look.
enum class Size { small, large };

struct Law {
  std::string name;  ///< a sentence in UpperCamel, a heading of docs/verification.md
  std::vector<Row> (*rows)(const Solver&, Size);
  bool many_grains = false;  ///< only for fast solvers

  bool concerns(const Solver& solver) const { return !many_grains || solver.fast; }
};

std::vector<Law> fall_laws();
std::vector<Law> impact_laws();
std::vector<Law> rolling_laws();
std::vector<Law> stack_laws();
std::vector<Law> heap_laws();
std::vector<Law> collapse_laws();
std::vector<Law> conservation_laws();
std::vector<Law> symmetry_laws();

/// All of them, in the order of docs/verification.md.
std::vector<Law> laws();

}  // namespace seapile::verification
