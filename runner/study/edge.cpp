#include "runner/study/edge.h"

#include <fmt/format.h>

#include <cmath>

#include "runner/study/any_quantity.h"
#include "runner/study/assignment.h"
#include "runner/study/check_grammar.h"
#include "runner/study/field_reader.h"

namespace seapile::study {
namespace {

constexpr const char* kForm =
    R"({"path": path, "good": value, "bad": value, "invariants": [{"metric": name, "at_most": 1}]})";

/// A positive value of the path; absent after a problem.
std::optional<double> read_end(const Value& written, const Edge& edge, base::Problems& problems) {
  const std::size_t before = problems.size();
  double value = 0;
  if (edge.node->kind == SchemaNode::Kind::integer) {
    std::int64_t whole = 0;
    read_integer(written, edge.node->field, whole, problems);
    value = static_cast<double>(whole);
  } else {
    read_number(written, edge.node->field, value, problems);
  }
  if (problems.size() == before && !(value > 0))
    problems.push_back({pointer(written.place), "is not positive: the search goes by ratios", "more than 0", ""});
  if (problems.size() > before) return {};
  return value;
}

void read_invariants(const Value& list, Edge& edge, base::Problems& problems) {
  if (list.kind != Value::Kind::array) {
    problems.push_back(
        {pointer(list.place), fmt::format("is {}, not an array", kind_name(list)), "an array [...]", ""});
    return;
  }
  for (const CheckText& text : read_checks(list.items, problems)) {
    const bool bounds = text.at_least || text.at_most;
    if (!bounds || !text.unit.empty())
      problems.push_back({pointer(text.place), bounds ? "has a unit" : "is no bound",
                          "at_least or at_most, a number in the metric's own unit", ""});
    edge.invariants.push_back({text.metric, text.at_least, text.at_most});
  }
}

}  // namespace

std::optional<Edge> read_edge(const Value& document, base::Problems& problems) {
  const Value* written = document.find("edge");
  if (!written || written->kind == Value::Kind::unusable) return {};
  const std::size_t before = problems.size();
  if (!is_object(*written, problems)) return {};
  report_unknown_keys(*written, {"path", "good", "bad", "within", "invariants"}, problems);
  for (const char* key : {"path", "good", "bad"})
    if (!written->find(key)) problems.push_back({pointer(written->place), fmt::format("lacks \"{}\"", key), kForm, ""});
  if (problems.size() > before) return {};

  Edge edge;
  edge.place = written->place;
  std::string dotted;
  read_string(*written->find("path"), dotted, problems);
  if (problems.size() > before) return {};
  edge.node = node_at(dotted, written->find("path")->place, scene_schema(), problems);
  if (!edge.node) return {};
  edge.path = split_path(dotted);
  if (edge.node->kind != SchemaNode::Kind::number && edge.node->kind != SchemaNode::Kind::integer) {
    problems.push_back(
        {pointer(written->find("path")->place), fmt::format("{} is no number", dotted), "the path of a number", ""});
    return {};
  }
  const auto good = read_end(*written->find("good"), edge, problems),
             bad = read_end(*written->find("bad"), edge, problems);
  if (good && bad && *good == *bad)
    problems.push_back({pointer(written->find("bad")->place), "is as good", "another value than good", ""});
  if (const Value* within = written->find("within"))
    read_number(*within, {"within", "-", base::between(1e-6, 10), "ratio of the ends, less 1"}, edge.within, problems);
  if (const Value* invariants = written->find("invariants")) read_invariants(*invariants, edge, problems);
  if (problems.size() > before) return {};
  edge.good = *good;
  edge.bad = *bad;
  return edge;
}

}  // namespace seapile::study
