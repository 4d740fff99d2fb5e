// Conditions joined by "and", "or", "not" and brackets.
#pragma once

#include <string>
#include <vector>

#include "runner/store/condition.h"

namespace seapile::store {

/// What a run has to meet. Without parts, as by default, every run meets it.
struct Expression {
  enum class Kind { condition, all, any, negation };

  Kind kind = Kind::all;
  Condition condition = {};            ///< of the first kind
  std::vector<Expression> parts = {};  ///< of the others; one of a negation
};

/// "pile.tip = conical and (bed.seed <= 3 or not outcome = diverged)": "not" binds closest, then "and". A text that has
/// one of these words or a bracket in it stands between quotes. Throws std::invalid_argument with one sentence.
Expression parse_expression(const std::string& text);

/// All of several expressions.
Expression parse_all(const std::vector<std::string>& texts);

/// Whether a text is meant as an expression: it has an operator outside of quotes.
bool has_operator(const std::string& text);

}  // namespace seapile::store
