#include "runner/study/json_schema.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "runner/study/fidelity.h"
#include "runner/study/field_reader.h"
#include "runner/study/schema.h"
#include "runner/study/study.h"
#include "runner/study/unit.h"

namespace seapile::study {
namespace {

using Json = nlohmann::ordered_json;
using Kind = SchemaNode::Kind;

// A number with what may be a unit behind it. Of which dimension the unit has to be, a pattern cannot say.
constexpr const char* kQuantity = R"(^ *-?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)? *[^0-9eE.+ -].*$)";
constexpr const char* kPercentage = R"(^ *-?[0-9]+(\.[0-9]+)?([eE][-+]?[0-9]+)? *%[ ]*$)";

Json described(Json schema, const std::string& description) {
  schema["description"] = description;
  return schema;
}

Json reference(const std::string& path) { return {{"$ref", "#/definitions/" + path}}; }

Json any_of(const std::vector<Json>& schemas) { return {{"anyOf", schemas}}; }

/// An object of these members and no others.
Json closed(Json properties, const std::vector<std::string>& required = {}) {
  Json schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", std::move(properties)}};
  if (!required.empty()) schema["required"] = required;
  return schema;
}

Json array_of(Json items, int least = 0) {
  Json schema = {{"type", "array"}, {"items", std::move(items)}};
  if (least > 0) schema["minItems"] = least;
  return schema;
}

Json number_within(const char* type, const base::Range& range) {
  Json schema = {{"type", type}};
  if (std::isfinite(range.min)) schema[range.open_min ? "exclusiveMinimum" : "minimum"] = range.min;
  if (std::isfinite(range.max)) schema[range.open_max ? "exclusiveMaximum" : "maximum"] = range.max;
  return schema;
}

Json number_with_unit(const base::Field& field) {
  return any_of({number_within("number", field.range),
                 {{"type", "string"}, {"pattern", field.unit == "-" ? kPercentage : kQuantity}}});
}

Json share(const base::Range& range) { return number_with_unit({"", "-", range, ""}); }

Json whole(double least, double most) { return number_within("integer", base::between(least, most)); }

const Json& any_quantity() {
  static const Json schema = {{"anyOf", {{{"type", "number"}}, {{"type", "string"}, {"pattern", kQuantity}}}}};
  return schema;
}

const Json& words() {
  static const Json schema = {{"type", "string"}, {"pattern", "[^ ]"}};
  return schema;
}

/// "metric", or "metric_bin_*" for all that begin like this.
const Json& metric() {
  static const Json schema = {{"type", "string"}, {"pattern", "^[^*]*[^* ][^*]*\\*?$|^\\*$"}};
  return schema;
}

/// What is said of a field beside its type: meaning and what it may be, and its default.
void annotate(Json& schema, const SchemaNode& node) {
  std::string text(node.field.meaning);
  if (node.kind == Kind::number || node.kind == Kind::integer || node.kind == Kind::numbers)
    text += fmt::format("{}{}", text.empty() ? "" : "; ", range_text(node.field));
  if (!text.empty()) schema["description"] = text;
  if (!node.fallback.empty()) schema["default"] = Json::parse(node.fallback);
}

/// A choice as its name, or as {name: members}.
Json alternatives(const SchemaNode& node, const std::string& path) {
  Json members = Json::object();
  for (const SchemaNode& child : node.children) {
    const std::string key(child.field.key);
    members[key] = reference(path + "." + key);
  }
  Json one = closed(std::move(members));
  one["minProperties"] = one["maxProperties"] = 1;
  return any_of({{{"enum", node.child_names()}}, std::move(one)});
}

/// The schema of a node, in which those below it are referred to.
Json schema_of(const SchemaNode& node, const std::string& path) {
  switch (node.kind) {
    case Kind::number:
      return number_with_unit(node.field);
    case Kind::integer:
      return number_within("integer", node.field.range);
    case Kind::boolean:
      return {{"type", "boolean"}};
    case Kind::string:
      return {{"type", "string"}};
    case Kind::choice:
      return {{"enum", node.names}};
    case Kind::numbers:
      return array_of(number_with_unit(node.field));
    case Kind::variant:
      return alternatives(node, path);
    case Kind::spec:
      break;
  }
  Json members = Json::object();
  for (const SchemaNode& child : node.children) {
    const std::string key(child.field.key);
    members[key] = reference(path + "." + key);
  }
  return closed(std::move(members));
}

/// Adds a node and all below it, each under its path.
void define(const SchemaNode& node, const std::string& path, Json& definitions) {
  Json schema = schema_of(node, path);
  if (node.nullable) schema = any_of({std::move(schema), {{"type", "null"}}});
  annotate(schema, node);
  definitions[path] = std::move(schema);
  for (const SchemaNode& child : node.children) define(child, path + "." + std::string(child.field.key), definitions);
}

/// An object whose keys are dotted paths into the scene, with a value of its place under each, or an array of them.
Json by_path(bool arrays) {
  Json properties = Json::object();
  for (const std::string& path : all_paths(scene_schema())) {
    const Json value = reference("scene." + path);
    properties[path] = arrays ? array_of(value, 1) : value;
  }
  return closed(std::move(properties));
}

Json replicates() {
  const auto most = static_cast<double>(kMostCases);
  return any_of({described(closed({{"seed", array_of(reference("scene.bed.seed"), 1)}}, {"seed"}), "these packings"),
                 described(closed({{"seeds", whole(1, most)}}, {"seeds"}), "as many packings"),
                 described(closed({{"at_least", whole(2, most)},
                                   {"at_most", whole(2, most)},
                                   {"metric", metric()},
                                   {"half_width", share(base::positive(1))}},
                                  {"at_least", "at_most", "metric", "half_width"}),
                           "packings until the 95 % interval of the metric's mean is as narrow")});
}

/// A published value or bounds of a metric.
Json check() {
  Json schema = closed({{"metric", words()},
                        {"reference", described(words(), "a CSV file of published values, beside the study")},
                        {"value", any_quantity()},
                        {"tolerance", any_quantity()},
                        {"source", described(words(), "where the value is published")},
                        {"at_least", any_quantity()},
                        {"at_most", any_quantity()},
                        {"if", reference("match")},
                        {"drift", share(base::between(0, 1))}},
                       {"metric"});
  const auto form = [](Json needs, const std::vector<const char*>& without) {
    std::vector<Json> others;
    for (const char* key : without) others.push_back({{"required", Json::array({key})}});
    needs["not"] = any_of(others);
    return needs;
  };
  const Json in_file = {{"required", Json::array({"reference"})}},
             here = {{"required", {"value", "tolerance", "source"}}},
             bounds = any_of({{{"required", Json::array({"at_least"})}}, {{"required", Json::array({"at_most"})}}});
  schema["oneOf"] = Json::array({form(in_file, {"value", "tolerance", "source", "at_least", "at_most"}),
                                 form(here, {"reference", "at_least", "at_most"}),
                                 form(bounds, {"reference", "value", "tolerance"})});
  return described(std::move(schema), "a published value, or bounds, that results are compared with");
}

/// A sentence about one or two groups of cases.
Json claim() {
  const std::vector<std::string> verdicts = {"confirmed", "refuted", "not distinguishable"};
  Json schema = closed({{"claim", described(words(), "the sentence that is judged")},
                        {"number", whole(1, 1e6)},
                        {"metric", words()},
                        {"of", described(reference("match"), "the cases that it is about")},
                        {"over", described(reference("match"), "the cases that they are compared with")},
                        {"as", {{"enum", {"ratio", "difference"}}}},
                        {"at_least", any_quantity()},
                        {"at_most", any_quantity()},
                        {"margin", any_quantity()},
                        {"if", reference("match")},
                        {"deterministic", {{"type", "boolean"}}},
                        {"expect", {{"enum", verdicts}}}},
                       {"claim", "metric"});
  schema["oneOf"] = Json::array({Json{{"required", {"at_least"}}}, Json{{"required", {"at_most"}}}});
  schema["dependencies"] = {{"over", {"of"}}, {"as", {"over"}}};
  const Json decides = {{"properties", {{"deterministic", {{"const", true}}}}}, {"required", {"deterministic"}}};
  schema["if"] = decides;
  schema["then"] = {{"not", {{"required", {"margin"}}}},
                    {"properties", {{"expect", {{"enum", {verdicts[0], verdicts[1]}}}}}}};
  schema["else"] = {{"required", {"margin"}}};
  return described(std::move(schema), "a sentence about cases that `runner check` judges");
}

Json edge() {
  const Json bounds = closed({{"metric", words()},
                              {"at_least", any_quantity()},
                              {"at_most", any_quantity()},
                              {"source", words()},
                              {"if", reference("match")},
                              {"drift", share(base::between(0, 1))}},
                             {"metric"});
  return closed({{"path", {{"enum", all_paths(scene_schema())}}},
                 {"good", any_quantity()},
                 {"bad", any_quantity()},
                 {"within", share(base::between(1e-6, 10))},
                 {"invariants", array_of(bounds)}},
                {"path", "good", "bad"});
}

Json trade(const char* against, bool required) {
  Json members = {{against, words()}, {"of", array_of(metric(), 1)}};
  if (!required) members["coarser"] = words();
  return closed(std::move(members),
                required ? std::vector<std::string>{against, "of"} : std::vector<std::string>{"of"});
}

Json variants() {
  const Json name = {{"type", "string"}, {"minLength", 1}, {"maxLength", 64}};
  return array_of(closed({{"name", name}, {"set", reference("set")}, {"fidelity", reference("fidelity")}}, {"name"}));
}

Json when() { return array_of(closed({{"if", reference("match")}, {"set", reference("match")}}, {"if", "set"})); }

}  // namespace

std::string study_json_schema() {
  Json definitions = Json::object();
  define(scene_schema(), "scene", definitions);
  define(record_schema(), "record", definitions);
  definitions["fidelity"] = {{"enum", fidelity_names()}};
  definitions["set"] = by_path(false);
  definitions["match"] = by_path(false);
  definitions["match"]["minProperties"] = 1;
  definitions["axes"] = by_path(true);

  Json members = {
      {"study", described({{"type", "string"}, {"pattern", "^[a-z0-9_]{1,64}$"}}, "the name: a-z, 0-9 and _")},
      {"question",
       described({{"type", "string"}, {"pattern", "^[^\\u0000-\\u001f\\u007f-\\u009f]*$"}}, "one line for people")},
      {"base", described(reference("scene"), "the scene that all cases share")},
      {"axes", described(reference("axes"), "every combination is a case; the last axis varies fastest")},
      {"zip", described(reference("axes"), "arrays of one length that advance together, as one axis after axes")},
      {"variants", described(variants(), "ways to compute the same scenes, each with all combinations")},
      {"frontier", described(trade("reference", false), "compares every variant with one: what accuracy costs")},
      {"ablate", described(trade("whole", true), "compares every variant with the whole: what a part does")},
      {"edge", described(edge(), "where a value stops holding")},
      {"replicates", described(replicates(), "packings of every case: the last axis, over bed.seed")},
      {"when", described(when(), "what is set in the cases that match")},
      {"exclude", described(array_of(reference("match")), "cases left out, as they are after when")},
      {"fidelity", described(reference("fidelity"), "fills in what the study does not set of the numerics")},
      {"record", described(reference("record"), "what is kept of each run; changes no result")},
      {"checks", described(array_of(any_of({check(), claim()})), "what `runner check` compares results with")}};
  Json schema = {
      {"$schema", "http://json-schema.org/draft-07/schema#"},
      {"title", "A study of Seapile"},
      {"description", "Numbers are SI, or strings with a unit (\"12 mm\"). docs/study.md explains every key."}};
  schema.update(closed(std::move(members), {"study"}));
  schema["not"] = {{"required", {"frontier", "ablate"}}};
  schema["definitions"] = std::move(definitions);
  return schema.dump(1) + "\n";
}

}  // namespace seapile::study
