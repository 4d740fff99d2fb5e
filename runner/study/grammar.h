// What a study file says, taken apart by its grammar and checked piece by piece; nothing is expanded yet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/study/assignment.h"
#include "runner/study/check_grammar.h"
#include "runner/study/claim_grammar.h"
#include "runner/study/edge.h"
#include "runner/study/json_value.h"
#include "runner/study/packing_rule.h"
#include "runner/study/schema.h"
#include "runner/study/study.h"
#include "runner/study/trade.h"

namespace seapile::study {

/// One path that takes several values.
struct Column {
  Path path;
  const SchemaNode* node = nullptr;
  PlacePtr place;
  std::vector<Value> values;
};

/// Columns that advance together: one of "axes" or of the replicates, or all of "zip".
struct Axis {
  std::vector<Column> columns;
  std::size_t size() const { return columns.front().values.size(); }
};

/// A way to compute the study's scenes, by its name.
struct Variant {
  std::string name;
  PlacePtr place;
  std::vector<Assignment> set;
  std::string level;                                ///< of fidelity, of its own; "": the study's
  std::optional<std::vector<Assignment>> fidelity;  ///< what that fills in
};

struct When {
  Match condition;
  std::vector<Assignment> set;
};

struct Grammar {
  std::string name, question;
  Value base;         ///< an object
  Value record_text;  ///< an object, what is said of the record
  scene::RecordSpec record;
  std::vector<Axis> axes;                   ///< the first varies slowest; zip after the axes, replicates last
  std::optional<Trade> trade;               ///< what the variants are compared for
  std::optional<Edge> edge;                 ///< which value is bisected in each combination
  std::vector<Variant> variants;            ///< each with all combinations of the axes; none: one without a name
  std::optional<PackingRule> packing_rule;  ///< decides how many values the last axis has
  std::vector<Match> exclude;
  std::vector<When> when;
  std::vector<CheckText> checks;
  std::vector<ClaimText> claims;     ///< of the same list
  std::vector<Assignment> fidelity;  ///< what it fills in where the study says nothing
  std::vector<Assignment> set;       ///< of the command line, for scenes
};

/// Takes the document apart. The grammar is complete as far as it is free of problems.
Grammar read_grammar(const Value& document, const Options& options, base::Problems& problems);

/// Number of combinations of the axes, before any is excluded; as a double because it may be any product.
double combination_count(const Grammar& grammar);
/// The same with as many packings as a rule may come to.
double most_combinations(const Grammar& grammar);

}  // namespace seapile::study
