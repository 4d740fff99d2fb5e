#include "runner/study/expand.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "runner/study/draft.h"
#include "runner/study/grain_file.h"
#include "runner/study/idle.h"
#include "runner/study/scene_tree.h"
#include "solver/scene/analysis.h"
#include "solver/scene/validate.h"

namespace seapile::study {
namespace {

using base::Problems;

class Expander {
 public:
  Expander(const Grammar& grammar, const std::filesystem::path& folder, const std::vector<std::vector<double>>& probes,
           Problems& problems)
      : grammar_(grammar),
        folder_(folder),
        probes_(probes),
        collector_(problems),
        axis_indices_(grammar.axes.size(), 0) {
    tally_.excluded.resize(grammar.exclude.size());
    tally_.met.resize(grammar.when.size());
    result_.record = grammar.record;
  }

  Expansion run() {
    const auto total = static_cast<std::size_t>(combination_count(grammar_));
    const std::size_t variants = std::max<std::size_t>(1, grammar_.variants.size());
    for (std::size_t i = 0; i < total; ++i) {
      variant_ = grammar_.variants.empty() ? nullptr : &grammar_.variants[i / (total / variants)];
      combination_ = i;
      if (grammar_.edge)
        add_probes();
      else
        add_case();
      advance();
    }
    report_idle(grammar_, tally_, total, collector_);
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

  /// A case for each value of the edge.
  void add_probes() {
    const Edge& edge = *grammar_.edge;
    std::vector<double> values{edge.good, edge.bad};
    if (!probes_.empty()) values = combination_ < probes_.size() ? probes_[combination_] : std::vector<double>{};
    for (const double value : values) {
      probe_ = Assignment{edge.path, number_value(value, edge.place)};
      add_case();
    }
  }

  void add_case() {
    std::vector<const Assignment*> extra;
    if (probe_) extra.push_back(&*probe_);
    Draft draft = make_draft(grammar_, axis_indices_, variant_, extra, collector_);
    const ResolvedScene before = resolve_used(draft.scene);
    for (std::size_t i = 0; i < grammar_.when.size(); ++i) {
      if (!holds(grammar_.when[i].condition, before)) continue;
      ++tally_.met[i];
      for (const Assignment& assignment : grammar_.when[i].set) extra.push_back(&assignment);
    }
    if (extra.size() > (probe_ ? 1 : 0)) draft = make_draft(grammar_, axis_indices_, variant_, extra, collector_);

    const ResolvedScene used = resolve_used(draft.scene);
    bool excluded = false;
    for (std::size_t i = 0; i < grammar_.exclude.size(); ++i) {
      if (!holds(grammar_.exclude[i], used)) continue;
      ++tally_.excluded[i];
      excluded = true;
    }
    if (excluded) return;
    ++tally_.kept;

    const bool all_used = check_use(draft, used);
    for (const auto& problem : draft.problems) collector_.add(problem);
    std::optional<double> bed_height;
    const bool complete = take_grain_file(draft, bed_height);
    check_relations(draft, bed_height);
    if (complete && all_used && draft.problems.empty()) name_case(draft.scene);
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
      if (path.starts_with("model.")) return "the scene has no such part";
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
      if (!draft.problems.empty() || used.contains(join_path(assignment->path)))
        tally_.used_settings.insert(assignment);
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
    for (const std::string& member : scene_schema().child("model")->child_names())
      if (scene::has_choice(draft.scene, member)) tally_.choices.insert(member);
    std::set<std::string> unread;
    for (const auto& problem : draft.problems) unread.insert(problem.pointer);
    for (auto problem : scene::validate(draft.scene, bed_height)) {
      const Path inside = split_pointer(problem.pointer);
      const bool said = is_written(draft.tree, inside);
      problem.pointer = written_at(draft.tree, inside);
      if (unread.empty() || (said && !unread.contains(problem.pointer))) collector_.add_once_at(problem);
    }
    ++tally_.kinds[water_of(draft.scene)];
    if (!is_recorded(draft.scene)) return;
    ++(draft.scene.basin ? tally_.basins : tally_.drives);
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
      const bool by_a_case = found == record_problems_.end() || found->second.second < tally_.drives;
      if (by_a_case) reached.push_back(grammar_.record.frames[i]);
    }
    for (const auto& [inside, entry] : record_problems_) {
      const bool of_a_frame = inside.starts_with("/frames/"), of_a_time = inside.starts_with("/times/");
      if (of_a_frame && (default_frames || entry.second < tally_.drives)) continue;
      if (of_a_time && entry.second < tally_.basins) continue;
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
    Case one = case_of(scene);
    if (variant_) one.labels.emplace_back(kVariant, variant_->name);
    for (std::size_t axis = 0; axis < grammar_.axes.size(); ++axis) {
      for (const Column& column : grammar_.axes[axis].columns) {
        one.labels.emplace_back(join_path(column.path), value_text(column.values[axis_indices_[axis]], *column.node));
      }
    }
    one.combination = combination_;
    if (probe_) {
      one.probe = probe_->value.number;
      one.labels.emplace_back(join_path(probe_->path), value_text(probe_->value, *grammar_.edge->node));
    }
    const auto [known, first] = ids_.emplace(one.id, Combination{axis_indices_, variant_});
    if (first) {
      result_.cases.push_back(std::move(one));
      return;
    }
    const auto& [known_indices, known_variant] = known->second;
    if (known_variant != variant_) {
      collector_.add_once_at({pointer(variant_->place),
                              fmt::format("gives the same case as the variant \"{}\"", known_variant->name),
                              "variants that give different cases", ""});
      return;
    }
    if (grammar_.edge && known_indices == axis_indices_) {
      collector_.add_once_at({pointer(grammar_.edge->place), "gives the same case for two values of its path",
                              "a path that the cases use, and that --set does not say", ""});
      return;
    }
    for (std::size_t axis = axis_indices_.size(); axis-- > 0;) {
      if (axis_indices_[axis] == known_indices[axis]) continue;
      const Column& column = grammar_.axes[axis].columns.front();
      collector_.add_once_at({pointer(column.values[axis_indices_[axis]].place),
                              "gives the same case as " + pointer(column.values[known_indices[axis]].place),
                              "values that give different cases", ""});
      return;
    }
  }

  const Grammar& grammar_;
  const std::filesystem::path& folder_;
  const std::vector<std::vector<double>>& probes_;
  ProblemCollector collector_;
  Expansion result_;
  struct Combination {
    std::vector<std::size_t> axis_indices;
    const Variant* variant;
  };
  std::vector<std::size_t> axis_indices_;  ///< the combination at hand, an index into each axis
  const Variant* variant_ = nullptr;       ///< and its variant; null: the study has none
  std::size_t combination_ = 0;            ///< counted
  std::optional<Assignment> probe_;        ///< the value of the edge; absent: the study has none
  Tally tally_;
  std::map<std::tuple<std::string, double, double>, std::optional<GrainFile>> grain_files_;
  std::map<std::string, std::pair<base::Problem, std::size_t>> record_problems_;  ///< by pointer, with their cases
  std::map<std::string, Combination> ids_;                                        ///< of the cases
};

}  // namespace

Expansion expand(const Grammar& grammar, const std::filesystem::path& folder,
                 const std::vector<std::vector<double>>& probes, Problems& problems) {
  return Expander(grammar, folder, probes, problems).run();
}

}  // namespace seapile::study
