// The one-line grammar of a query's conditions: path op value.
#pragma once

#include <string>
#include <variant>

namespace seapile::store {

/// A condition on a parameter, a metric, "outcome", "kind" or "study". A run that lacks what is asked about meets none
/// but
/// "= null".
struct Condition {
  enum class Op { equal, not_equal, less, less_equal, greater, greater_equal };

  std::string path;
  Op op = Op::equal;
  std::variant<std::monostate, double, std::string> value;  ///< monostate: null
  std::string written;                                      ///< a number as it was written: it may be an id's digits
};

/// "pile.tip = flat", "bed.seed<=3", "outcome != 'diverged'", "fluid = null". A value is a number, null, bare words or
/// a quoted text; texts and null know only = and !=, but for texts that begin as a number: "0.2 m/s". Throws
/// std::invalid_argument with one sentence.
Condition parse_condition(const std::string& text);

/// The operator as SQL writes it.
const char* sql(Condition::Op op);

}  // namespace seapile::store
