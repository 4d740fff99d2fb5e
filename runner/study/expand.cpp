#include "runner/study/expand.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "runner/study/field_reader.h"
#include "runner/study/grain_file.h"
#include "runner/study/scene_tree.h"
#include "solver/scene/validate.h"

namespace seapile::study {
namespace {

using base::Problems;

/// Problems, each once.
class Collector {
 public:
  explicit Collector(Problems& problems) : problems_(problems) {
    for (const auto& problem : problems) seen_.insert(key(problem));
  }
  bool empty() const { return problems_.empty(); }
  void add(const base::Problem& problem) {
    if (seen_.insert(key(problem)).second) problems_.push_back(problem);
  }
  /// Of several problems at one place only the first is told.
  void add_once_at(const base::Problem& problem) {
    if (places_.insert(problem.pointer).second) add(problem);
  }

 private:
  using Key = std::tuple<std::string, std::string, std::string>;
  static Key key(const base::Problem& problem) { return {problem.pointer, problem.what, problem.allowed}; }

  Problems& problems_;
  std::set<Key> seen_;
  std::set<std::string> places_;
};

/// One combination of the axes on its way to a case.
struct Draft {
  Value tree;
  scene::SceneSpec scene;
  Problems problems;                                          ///< of reading the tree
  std::vector<std::pair<const Column*, std::string>> unused;  ///< columns, and why they have no place in this scene
  std::set<const Assignment*> used;                           ///< of the command line
};

class Expander {
 public:
  Expander(const Grammar& grammar, const std::filesystem::path& folder, Problems& problems)
      : grammar_(grammar),
        folder_(folder),
        collector_(problems),
        axis_indices_(grammar.axes.size(), 0),
        excluded_(grammar.exclude.size(), 0),
        met_(grammar.when.size(), 0) {
    result_.record = grammar.record;
  }

  Expansion run() {
    const auto total = static_cast<std::size_t>(combination_count(grammar_));
    for (std::size_t i = 0; i < total; ++i) {
      add_case();
      advance();
    }
    check_rules(total);
    check_record();
    return std::move(result_);
  }

 private:
  /// The last axis varies fastest.
  void advance() {
    for (std::size_t axis = axis_indices_.size(); axis-- > 0;) {
      if (++axis_indices_[axis] < grammar_.axes[axis].size()) return;
      axis_indices_[axis] = 0;
    }
  }

  void add_case() {
    Draft draft = make_draft({});
    std::vector<const Assignment*> extra;
    const ResolvedScene before = resolve_used(draft.scene);
    for (std::size_t i = 0; i < grammar_.when.size(); ++i) {
      if (!holds(grammar_.when[i].condition, before)) continue;
      ++met_[i];
      for (const Assignment& assignment : grammar_.when[i].set) extra.push_back(&assignment);
    }
    if (!extra.empty()) draft = make_draft(extra);

    const ResolvedScene used = resolve_used(draft.scene);
    bool excluded = false;
    for (std::size_t i = 0; i < grammar_.exclude.size(); ++i) {
      if (!holds(grammar_.exclude[i], used)) continue;
      ++excluded_[i];
      excluded = true;
    }
    if (excluded) return;
    ++kept_;

    const bool all_used = check_use(draft, used);
    for (const auto& problem : draft.problems) collector_.add(problem);
    std::optional<double> bed_height;
    const bool complete = take_grain_file(draft, bed_height);
    check_relations(draft, bed_height);
    if (complete && all_used && draft.problems.empty()) name_case(draft.scene);
  }

  /// Puts base, axes, conditions and command line over each other. Parts come before what is inside them, so that the
  /// order in which a study names its paths does not matter; on the same path the later in this sentence wins.
  Draft make_draft(const std::vector<const Assignment*>& extra) {
    struct Layer {
      const Path* path;
      const Value* value;
      const Column* column;
      const Assignment* command_line;
    };
    std::vector<Layer> layers;
    for (std::size_t axis = 0; axis < grammar_.axes.size(); ++axis) {
      for (const Column& column : grammar_.axes[axis].columns) {
        layers.push_back({&column.path, &column.values[axis_indices_[axis]], &column, nullptr});
      }
    }
    for (const Assignment* assignment : extra) {
      layers.push_back({&assignment->path, &assignment->value, nullptr, nullptr});
    }
    for (const Assignment& assignment : grammar_.set) {
      layers.push_back({&assignment.path, &assignment.value, nullptr, &assignment});
    }
    std::stable_sort(layers.begin(), layers.end(),
                     [](const Layer& a, const Layer& b) { return a.path->size() < b.path->size(); });

    Draft draft;
    draft.tree = grammar_.base;
    for (const Layer& layer : layers) {
      const std::string why_not = assign(draft.tree, scene_schema(), *layer.path, *layer.value);
      if (why_not.empty()) {
        if (layer.command_line) draft.used.insert(layer.command_line);
      } else if (layer.column) {
        draft.unused.emplace_back(layer.column, why_not);
      } else if (!layer.command_line) {
        collector_.add(
            {pointer(layer.value->place), "has no place where " + why_not, "a path of the cases that match", ""});
      }
    }
    const std::string water = water_in(draft.tree);
    for (const auto& [path, value] : grammar_.fidelity) {
      const bool of_water = path.front() == "jet" || path.front() == "basin";
      if ((of_water ? path.front() : "") != water) continue;
      if (path.front() == "fluid" && !is_saturated(draft.tree)) continue;
      if (!is_written(draft.tree, path)) assign(draft.tree, scene_schema(), path, value);
    }
    read_spec(draft.tree, draft.scene, draft.problems);
    return draft;
  }

  /// Whether a scene that is not read yet has a fluid between its grains.
  static bool is_saturated(const Value& tree) {
    const Value* fluid = tree.find("fluid");
    return fluid && fluid->kind != Value::Kind::null;
  }

  /// As water_of(), of a scene that is not read yet.
  static std::string water_in(const Value& tree) {
    for (const char* part : {"jet", "basin"}) {
      const Value* written = tree.find(part);
      if (written && written->kind != Value::Kind::null) return part;
    }
    return "";
  }

  /// An axis that changes nothing would make equal cases under different names: false, and told.
  bool check_use(const Draft& draft, const ResolvedScene& used) {
    bool all_used = true;
    const auto report = [&](const Column& column, const std::string& why_not) {
      all_used = false;
      collector_.add_once_at({pointer(column.place),
                              fmt::format("{} is not used where {}", join_path(column.path), why_not),
                              "exclude such cases, or write it into the values of the other axis", ""});
    };
    const auto why_not_used = [&](const std::string& path) -> std::string {
      if (is_water(draft.scene)) return fmt::format("the scene is a {}", water_of(draft.scene));
      if (path.starts_with("bed.preparation.contact") || (path.starts_with("contact") && draft.scene.pile))
        return "the contact solver has no such member";
      return draft.scene.pile ? "the grains come from bed.file" : "there is no pile";
    };
    for (const auto& [column, why_not] : draft.unused) report(*column, why_not);
    if (draft.problems.empty() && draft.unused.empty()) {
      for (const Axis& axis : grammar_.axes) {
        for (const Column& column : axis.columns) {
          if (!used.contains(join_path(column.path))) report(column, why_not_used(join_path(column.path)));
        }
      }
    }
    for (const Assignment* assignment : draft.used) {
      if (!draft.problems.empty() || used.contains(join_path(assignment->path))) used_settings_.insert(assignment);
    }
    return all_used;
  }

  /// Fills the bed from its file, if it has one, and tells the top of the highest grain. False after a problem.
  bool take_grain_file(Draft& draft, std::optional<double>& bed_height) {
    scene::BedSpec& bed = draft.scene.bed;
    if (bed.file.empty()) return true;
    bool good = true;
    for (const char* path : kDecidedByFile) {
      if (!is_written(draft.tree, split_path(path))) continue;
      collector_.add({written_at(draft.tree, split_path(path)), fmt::format("{} is decided by bed.file", path),
                      "nothing here", ""});
      good = false;
    }

    const auto key = std::tuple(bed.file, bed.domain.width, bed.domain.height);
    auto found = grain_files_.find(key);
    if (found == grain_files_.end()) found = grain_files_.emplace(key, read_file(draft)).first;
    if (!good || !found->second) return false;
    const GrainFile& file = *found->second;
    bed.file = file.path.string();
    bed.file_content = file.content;
    bed.grains.count = file.count;
    bed.grains.radius = {file.smallest, file.largest};
    bed_height = file.top;
    return true;
  }

  std::optional<GrainFile> read_file(const Draft& draft) {
    Problems problems;
    const GrainFile file = find_grains(folder_, draft.scene.bed.file, draft.scene.bed.domain, problems);
    for (auto& problem : problems) {
      problem.pointer = written_at(draft.tree, {"bed", "file"});
      collector_.add(problem);
    }
    if (!problems.empty()) return {};
    return file;
  }

  /// Where some values could not be read, their defaults stand in for them. Then only what the study itself says is
  /// blamed: a problem of defaults alone would be a consequence of one that is told already.
  void check_relations(const Draft& draft, std::optional<double> bed_height) {
    std::set<std::string> unread;
    for (const auto& problem : draft.problems) unread.insert(problem.pointer);
    for (auto problem : scene::validate(draft.scene, bed_height)) {
      const Path inside = split_pointer(problem.pointer);
      const bool said = is_written(draft.tree, inside);
      problem.pointer = written_at(draft.tree, inside);
      if (unread.empty() || (said && !unread.contains(problem.pointer))) collector_.add_once_at(problem);
    }
    ++kinds_[water_of(draft.scene)];
    if (!is_recorded(draft.scene)) return;
    ++(draft.scene.basin ? basins_ : drives_);
    for (const auto& problem : scene::validate(grammar_.record, draft.scene)) {
      auto& entry = record_problems_.try_emplace(problem.pointer, problem, 0).first->second;
      ++entry.second;
    }
  }

  /// A frame is fine when one case reaches its depth or its time. Of the default frames only those are asked for. The
  /// command line may end all cases before a frame of the study.
  void check_record() {
    const bool default_frames = !is_written(grammar_.record_text, {"frames"});
    std::vector<double> reached;
    for (std::size_t i = 0; i < grammar_.record.frames.size(); ++i) {
      const auto found = record_problems_.find(fmt::format("/frames/{}", i));
      const bool by_a_case = found == record_problems_.end() || found->second.second < drives_;
      if (by_a_case) reached.push_back(grammar_.record.frames[i]);
    }
    for (const auto& [inside, entry] : record_problems_) {
      const bool of_a_frame = inside.starts_with("/frames/"), of_a_time = inside.starts_with("/times/");
      if (of_a_frame && (default_frames || entry.second < drives_)) continue;
      if (of_a_time && entry.second < basins_) continue;
      auto problem = entry.first;
      problem.pointer = written_at(grammar_.record_text, split_pointer(inside));
      const bool out_of_reach = (of_a_frame || of_a_time) && problem.what != scene::kTwice;
      if (out_of_reach && !grammar_.set.empty() && !problem.pointer.starts_with("--set")) continue;
      collector_.add(problem);
    }
    if (default_frames) result_.record.frames = reached;
  }

  /// Gives the case its names, and refuses it when it has those of another.
  void name_case(const scene::SceneSpec& scene) {
    Case one;
    one.scene = scene;
    if (!is_water(scene)) {
      one.bed_canonical = canonical_text(scene.bed);
      one.bed_id = case_id(one.bed_canonical);
    }
    one.canonical = canonical_text(scene, one.bed_id);
    one.id = case_id(one.canonical);
    for (std::size_t axis = 0; axis < grammar_.axes.size(); ++axis) {
      for (const Column& column : grammar_.axes[axis].columns) {
        one.labels.emplace_back(join_path(column.path), value_text(column.values[axis_indices_[axis]], *column.node));
      }
    }
    const auto [known, first] = ids_.emplace(one.id, axis_indices_);
    if (first) {
      result_.cases.push_back(std::move(one));
      return;
    }
    for (std::size_t axis = axis_indices_.size(); axis-- > 0;) {
      if (axis_indices_[axis] == known->second[axis]) continue;
      const Column& column = grammar_.axes[axis].columns.front();
      collector_.add_once_at({pointer(column.values[axis_indices_[axis]].place),
                              "gives the same case as " + pointer(column.values[known->second[axis]].place),
                              "values that give different cases", ""});
      return;
    }
  }

  /// What never takes effect was meant otherwise. The command line may make a study's conditions idle, and a study with
  /// other problems is not judged.
  void check_rules(std::size_t total) {
    if (!collector_.empty()) return;
    if (kept_ == 0) {
      collector_.add({"/exclude", fmt::format("leaves none of {} cases", total), "at least one case", ""});
      return;
    }
    report_unused_beside_water();
    for (const Assignment& assignment : grammar_.set) {
      if (used_settings_.contains(&assignment)) continue;
      collector_.add(
          {pointer(assignment.value.place), "has no place in any case of this study", "a path that a case uses", ""});
    }
    if (!grammar_.set.empty()) return;
    const auto report_idle = [&](const Match& match) {
      collector_.add({pointer(match.place), "matches no case", "values that a case has", ""});
    };
    if (drives_ == 0) report_unused_without_pile();
    report_unused_record();
    for (std::size_t i = 0; i < met_.size(); ++i) {
      if (met_[i] == 0) report_idle(grammar_.when[i].condition);
    }
    for (std::size_t i = 0; i < excluded_.size(); ++i) {
      if (excluded_[i] == 0) report_idle(grammar_.exclude[i]);
    }
  }

  /// Where every case is water alone, what the base says of beds and piles is lost, and so is one water beside another.
  void report_unused_beside_water() {
    if (kinds_.contains("")) return;
    const std::string_view first = kinds_.begin()->first;
    const std::string all = kinds_.size() == 1 ? fmt::format("the scene is a {}", first) : "every scene is water alone";
    for (const std::string& part : scene_schema().child_names()) {
      const Value* written = grammar_.base.find(part);
      if (kinds_.contains(part) || !written || written->kind == Value::Kind::null) continue;
      collector_.add({pointer(written->place), fmt::format("is not used: {}", all),
                      fmt::format("nothing here, or {} null", first), ""});
    }
  }

  /// Beds are prepared by their own solver.
  void report_unused_without_pile() {
    if (kinds_.size() > 1 || !kinds_.contains("")) return;
    const auto report = [&](const PlacePtr& place) {
      collector_.add({pointer(place), kNoPile, "a pile in the base", ""});
    };
    if (const Value* contact = grammar_.base.find("contact")) report(contact->place);
    if (!grammar_.fidelity.empty()) report(grammar_.fidelity.front().value.place);
  }

  /// Nothing is recorded where nothing is driven and no basin moves.
  void report_unused_record() {
    const Value& written = grammar_.record_text;
    if (written.items.empty()) return;
    if (drives_ == 0 && basins_ == 0) {
      collector_.add({pointer(written.place), kNoPile, "a pile in the base", ""});
      return;
    }
    for (std::size_t i = 0; i < written.items.size(); ++i) {
      const bool of_basin = std::ranges::find(kRecordOfABasin, written.keys[i]) != kRecordOfABasin.end();
      if ((of_basin ? basins_ : drives_) > 0) continue;
      collector_.add({pointer(written.items[i].place),
                      of_basin ? "is not used: no case of this study is a basin" : kNoPile,
                      of_basin ? "a basin in the base" : "a pile in the base", ""});
    }
  }

  static constexpr const char* kNoPile = "is not used: no case of this study has a pile";

  const Grammar& grammar_;
  const std::filesystem::path& folder_;
  Collector collector_;
  Expansion result_;
  std::vector<std::size_t> axis_indices_;           ///< the combination at hand, an index into each axis
  std::vector<std::size_t> excluded_, met_;         ///< cases that each exclude and each when matched
  std::size_t kept_ = 0, drives_ = 0, basins_ = 0;  ///< cases that are not excluded; of them those that are recorded
  std::map<std::string_view, std::size_t> kinds_;   ///< of those cases, by water_of()
  std::set<const Assignment*> used_settings_;
  std::map<std::tuple<std::string, double, double>, std::optional<GrainFile>> grain_files_;
  std::map<std::string, std::pair<base::Problem, std::size_t>> record_problems_;  ///< by pointer, with their cases
  std::map<std::string, std::vector<std::size_t>> ids_;                           ///< with the combination of each
};

}  // namespace

Expansion expand(const Grammar& grammar, const std::filesystem::path& folder, Problems& problems) {
  return Expander(grammar, folder, problems).run();
}

}  // namespace seapile::study
