#include "runner/execute/plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "runner/store/label_text.h"

namespace seapile::execute {
namespace {

using simulation::NumericsVersion;
using simulation::Outcome;

/// "numerics of grains 1 -> 2", for every module that moved; empty when none did.
std::string moved_numerics(const std::vector<NumericsVersion>& before, const std::vector<NumericsVersion>& now) {
  const std::string moved = store::moved_text(before, now);
  return moved.empty() ? "" : "numerics of " + moved;
}

std::string listed(const std::vector<NumericsVersion>& versions) {
  std::vector<std::string> words;
  for (const NumericsVersion& version : versions)
    words.push_back(fmt::format("{} {}", version.module, version.version));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Why a past run cannot stand for the case; empty when it can.
std::string staleness(const Asked& asked, const PastRun& past, const Equivalences& equivalences) {
  if (!past.damage.empty()) return past.damage;
  if (past.outcome == Outcome::diverged) return fmt::format("last run diverged: {}", past.reason);
  if (past.outcome == Outcome::stopped) return fmt::format("last run stopped: {}", past.reason);
  const std::string moved = moved_numerics(past.numerics, asked.numerics);
  if (!moved.empty() && !declared(equivalences, asked.kind, past.numerics, asked.numerics)) return moved;
  if (past.bed_run != asked.bed_run) return fmt::format("bed newly computed (run {})", asked.bed_run);
  if (!asked.record) return "";
  return past.record ? lacking(*past.record, *asked.record) : "nothing recorded";
}

/// Why a past run that is not stale can stand for the case.
std::string freshness(const Asked& asked, const PastRun& past, const Equivalences& equivalences) {
  if (moved_numerics(past.numerics, asked.numerics).empty())
    return fmt::format("completed with today's numerics ({})", listed(asked.numerics));
  return "equivalent: " + in_words(*declared(equivalences, asked.kind, past.numerics, asked.numerics));
}

bool continues(const Asked& asked, const InterruptedRun& run) {
  return run.checkpoint && run.bed_run == asked.bed_run && run.record == asked.record &&
         moved_numerics(run.numerics, asked.numerics).empty();
}

/// The number that a bed's run will have had once this plan is carried out.
std::string run_to_come(const History& bed, const Decision& decision) {
  if (!decision.run.empty()) return decision.run;
  return bed.past || bed.interrupted ? "" : "0001";  // "": some later number, which no drive can have been built on
}

std::string newest_of(const History& history) { return history.past ? history.past->run : ""; }

int most_threads(const scene::SceneSpec& scene) {
  return static_cast<int>(std::clamp<std::int64_t>(scene.bed.grains.count / kGrainsPerThread, 1, 1024));
}

}  // namespace

const char* name(Action action) {
  static constexpr const char* kNames[] = {"fresh", "resume", "run"};
  return kNames[static_cast<int>(action)];
}

const char* name(Kind kind) {
  static constexpr const char* kNames[] = {"bed", "drive", "flow"};
  return kNames[static_cast<int>(kind)];
}

Kind kind_of(const scene::SceneSpec& scene) {
  if (is_water(scene)) return Kind::flow;
  return scene.pile ? Kind::drive : Kind::bed;
}

std::string lacking(const scene::RecordSpec& have, const scene::RecordSpec& want) {
  const auto differs = [](const char* what, double recorded, double asked, const char* unit) {
    return fmt::format("{} of {} {} recorded, {} {} asked for", what, recorded, unit, asked, unit);
  };
  if (have.travel != want.travel) return differs("travel between records", have.travel, want.travel, "m");
  if (have.window != want.window) return differs("frame window", have.window, want.window, "s");
  if (have.spacing != want.spacing) return differs("grid spacing", have.spacing, want.spacing, "m");
  if (have.interval != want.interval) return differs("interval between records", have.interval, want.interval, "s");
  const auto first_missing = [](const std::vector<double>& kept, const std::vector<double>& wanted, const char* unit) {
    for (const double frame : wanted) {
      if (std::ranges::find(kept, frame) == kept.end()) return fmt::format("frame at {} {} not recorded", frame, unit);
    }
    return std::string();
  };
  const std::string missing = first_missing(have.frames, want.frames, "m");
  return missing.empty() ? first_missing(have.times, want.times, "s") : missing;
}

scene::SceneSpec bed_alone(const scene::SceneSpec& scene) {
  scene::SceneSpec bed = scene;
  bed.pile.reset();
  bed.fluid.reset();
  return bed;
}

std::optional<scene::RecordSpec> record_of_runs(const scene::RecordSpec& record, const scene::SceneSpec& scene) {
  if (!is_recorded(scene)) return std::nullopt;
  return study::record_of(record, scene);
}

const store::Equivalence* declared(const Equivalences& equivalences, const std::string& kind,
                                   const store::NumericsList& before, const store::NumericsList& now) {
  const auto found = std::ranges::find_if(
      equivalences, [&](const store::Equivalence& one) { return is_about(one, kind, before, now); });
  return found == equivalences.end() ? nullptr : &*found;
}

Decision decide(const Asked& asked, const History& history, const Equivalences& equivalences) {
  std::string reason = "never run";
  if (history.past) {
    reason = staleness(asked, *history.past, equivalences);
    if (reason.empty()) return {Action::fresh, freshness(asked, *history.past, equivalences), history.past->run};
  }
  if (history.interrupted) {
    const InterruptedRun& interrupted = *history.interrupted;
    if (continues(asked, interrupted)) {
      return {Action::resume, fmt::format("run {} was interrupted after a checkpoint", interrupted.run),
              interrupted.run};
    }
    if (!interrupted.checkpoint) {
      // Nothing in that folder is worth keeping: its number is used again.
      return {Action::run, history.past ? reason : "interrupted before its first checkpoint", interrupted.run};
    }
    if (!history.past) {
      const auto moved = moved_numerics(interrupted.numerics, asked.numerics);
      reason = moved.empty() ? "interrupted, with another bed or record" : "interrupted, since then " + moved;
    }
  }
  return {Action::run, reason, ""};
}

std::optional<Outdated> outdated(const Asked& asked, const History& history, const Equivalences& equivalences) {
  if (!history.past || staleness(asked, *history.past, equivalences).empty()) return {};
  Asked as_it_was = asked;
  as_it_was.numerics = history.past->numerics;
  if (!staleness(as_it_was, *history.past, equivalences).empty()) return {};
  return Outdated{history.past->numerics, asked.numerics};
}

Plan make_plan(const study::Study& study, const Numerics& numerics, const Disk& disk,
               const Equivalences& equivalences) {
  Plan plan;
  struct BedState {
    std::size_t task;
    History history;
    bool needed = false;
  };
  std::map<std::string, BedState> beds;  // by bed id

  // Every bed once, in the order in which the study first names it.
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const study::Case& c = study.cases[i];
    if (is_water(c.scene)) continue;
    const bool is_bed = c.id == c.bed_id;
    auto [bed, inserted] = beds.try_emplace(c.bed_id, BedState{plan.tasks.size(), {}, is_bed});
    bed->second.needed |= is_bed;
    if (!inserted) continue;
    const History& history = bed->second.history = disk(c.bed_id);
    const Asked asked{name(Kind::bed), numerics(bed_alone(c.scene)), std::nullopt, ""};
    plan.tasks.push_back({Kind::bed, c.bed_id, i, std::nullopt, "bed " + short_id(c.bed_id), most_threads(c.scene),
                          decide(asked, history, equivalences)});
    plan.tasks.back().newest = newest_of(history);
    plan.tasks.back().outdated = outdated(asked, history, equivalences);
  }
  // A drive by itself: a bed that has been run again since, or is lost, does not count yet.
  std::vector<History> histories(study.cases.size());
  for (std::size_t i = 0; i < study.cases.size(); ++i) {
    const study::Case& c = study.cases[i];
    if (c.id == c.bed_id) continue;
    histories[i] = disk(c.id);
    const std::string labels = label_line(c.labels), title = labels.empty() ? "case " + short_id(c.id) : labels;
    const Kind kind = kind_of(c.scene);
    Asked asked{name(kind), numerics(c.scene), record_of_runs(study.record, c.scene), ""};
    if (kind == Kind::flow) {
      plan.tasks.push_back({kind, c.id, i, std::nullopt, title, 1, decide(asked, histories[i], equivalences)});
      plan.tasks.back().newest = newest_of(histories[i]);
      plan.tasks.back().outdated = outdated(asked, histories[i], equivalences);
      continue;
    }
    BedState& bed = beds.at(c.bed_id);
    const Decision& of_bed = plan.tasks[bed.task].decision;
    asked.bed_run = of_bed.run;
    if (of_bed.action != Action::fresh) asked.bed_run = histories[i].past ? histories[i].past->bed_run : "";
    const Decision decision = decide(asked, histories[i], equivalences);
    bed.needed |= decision.action != Action::fresh;
    // A bed that is outdated itself would count again, once it is declared equivalent.
    if (plan.tasks[bed.task].outdated) asked.bed_run = newest_of(bed.history);
    plan.tasks.push_back({kind, c.id, i, bed.task, title, most_threads(c.scene), decision});
    plan.tasks.back().newest = newest_of(histories[i]);
    plan.tasks.back().outdated = outdated(asked, histories[i], equivalences);
  }
  // A bed that is run for one drive is new to all that are built on it.
  for (Task& task : plan.tasks) {
    if (task.kind != Kind::drive) continue;
    const study::Case& c = study.cases[task.study_case];
    const BedState& bed = beds.at(c.bed_id);
    const Decision& of_bed = plan.tasks[bed.task].decision;
    if (!bed.needed || of_bed.action == Action::fresh) continue;
    const std::string run = run_to_come(bed.history, of_bed);
    const bool was_fresh = task.decision.action == Action::fresh;
    const Asked asked{name(Kind::drive), numerics(c.scene), record_of_runs(study.record, c.scene), run};
    task.decision = decide(asked, histories[task.study_case], equivalences);
    if (was_fresh && task.decision.action != Action::fresh) task.decision.reason = "bed newly computed";
  }
  // Lost or outdated beds of fresh drives are nobody's concern.
  std::vector<std::optional<std::size_t>> kept(plan.tasks.size());
  Plan trimmed;
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    Task& task = plan.tasks[i];
    const bool idle = task.kind == Kind::bed && task.decision.action != Action::fresh && !beds.at(task.id).needed;
    if (idle) continue;
    if (task.bed) task.bed = kept[*task.bed];
    kept[i] = trimmed.tasks.size();
    trimmed.tasks.push_back(std::move(task));
  }
  return trimmed;
}

std::optional<std::string> diverged_since(const std::string& newest, const Asked& asked, const History& history) {
  if (!history.past || history.past->run == newest || !history.past->damage.empty()) return {};
  const PastRun& past = *history.past;
  const bool same = past.bed_run == asked.bed_run && moved_numerics(past.numerics, asked.numerics).empty();
  if (past.outcome != Outcome::diverged || !same) return {};
  return past.reason;
}

std::vector<std::string> describe(const Plan& plan) {
  constexpr std::size_t kMostLines = 16;
  std::vector<std::string> lines;
  if (plan.tasks.size() <= kMostLines) {
    for (const Task& task : plan.tasks) {
      lines.push_back(fmt::format("{:<6}  {}: {}", name(task.decision.action), task.name, task.decision.reason));
    }
    return lines;
  }
  std::map<std::pair<Action, std::string>, std::size_t> counts;
  for (const Task& task : plan.tasks) ++counts[{task.decision.action, task.decision.reason}];
  for (const auto& [key, count] : counts) {
    lines.push_back(fmt::format("{:<6}  {} cases: {}", name(key.first), count, key.second));
  }
  return lines;
}

std::string short_id(const std::string& case_id) { return case_id.substr(0, 10); }

std::string label_line(const std::vector<std::pair<std::string, std::string>>& labels) {
  std::vector<std::string> words;
  for (const auto& [path, value] : labels) words.push_back(store::label_text(path, value));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace seapile::execute
