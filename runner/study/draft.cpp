#include "runner/study/draft.h"

#include <algorithm>

#include "runner/study/field_reader.h"
#include "runner/study/scene_tree.h"

namespace seapile::study {
namespace {

/// As water_of(), of a scene that is not read yet.
std::string water_in(const Value& tree) {
  for (const char* part : {"jet", "basin"}) {
    const Value* written = tree.find(part);
    if (written && written->kind != Value::Kind::null) return part;
  }
  return "";
}

/// Whether a scene that is not read yet has a fluid between its grains.
bool is_saturated(const Value& tree) {
  const Value* fluid = tree.find("fluid");
  return fluid && fluid->kind != Value::Kind::null;
}

}  // namespace

Draft make_draft(const Grammar& grammar, const std::vector<std::size_t>& axis_indices, const Variant* variant,
                 const std::vector<const Assignment*>& extra, ProblemCollector& collector) {
  struct Layer {
    const Path* path;
    const Value* value;
    const Column* column;
    const Assignment* command_line;
  };
  std::vector<Layer> layers;
  for (std::size_t axis = 0; axis < grammar.axes.size(); ++axis) {
    for (const Column& column : grammar.axes[axis].columns) {
      layers.push_back({&column.path, &column.values[axis_indices[axis]], &column, nullptr});
    }
  }
  if (variant)
    for (const Assignment& assignment : variant->set)
      layers.push_back({&assignment.path, &assignment.value, nullptr, nullptr});
  for (const Assignment* assignment : extra) {
    layers.push_back({&assignment->path, &assignment->value, nullptr, nullptr});
  }
  for (const Assignment& assignment : grammar.set) {
    layers.push_back({&assignment.path, &assignment.value, nullptr, &assignment});
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const Layer& a, const Layer& b) { return a.path->size() < b.path->size(); });

  Draft draft;
  draft.tree = grammar.base;
  for (const Layer& layer : layers) {
    const std::string why_not = assign(draft.tree, scene_schema(), *layer.path, *layer.value);
    if (why_not.empty()) {
      if (layer.command_line) draft.used.insert(layer.command_line);
    } else if (layer.column) {
      draft.unused.emplace_back(layer.column, why_not);
    } else if (!layer.command_line) {
      collector.add(
          {pointer(layer.value->place), "has no place where " + why_not, "a path of the cases that match", ""});
    }
  }
  const std::string water = water_in(draft.tree);
  for (const auto& [path, value] : variant && variant->fidelity ? *variant->fidelity : grammar.fidelity) {
    const bool of_water = path.front() == "jet" || path.front() == "basin";
    if ((of_water ? path.front() : "") != water) continue;
    if (path.front() == "fluid" && !is_saturated(draft.tree)) continue;
    if (!is_written(draft.tree, path)) assign(draft.tree, scene_schema(), path, value);
  }
  read_spec(draft.tree, draft.scene, draft.problems);
  return draft;
}

}  // namespace seapile::study
