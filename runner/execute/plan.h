// What has to be run, and why. Pure functions of the study and of what is on disk: nothing is started here.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runner/store/equivalence.h"
#include "runner/study/study.h"
#include "solver/scene/spec.h"
#include "solver/simulation/run.h"

namespace seapile::execute {

/// The newest run of a case that came to an end.
struct PastRun {
  std::string run;  ///< "0001"
  simulation::Outcome outcome = simulation::Outcome::completed;
  std::string reason;  ///< why it did not complete
  std::vector<simulation::NumericsVersion> numerics;
  std::optional<scene::RecordSpec> record;  ///< absent where runs of the scene are not recorded
  std::string bed_run;                      ///< "" without a bed
  std::string damage;                       ///< one sentence when the run cannot be used; the rest then means nothing
};

/// A newer run that was started and did not come to an end.
struct InterruptedRun {
  std::string run;
  bool checkpoint = false;  ///< there is something to continue from
  std::vector<simulation::NumericsVersion> numerics;
  std::optional<scene::RecordSpec> record;
  std::string bed_run;
};

/// What is on disk of one case.
struct History {
  std::optional<PastRun> past;
  std::optional<InterruptedRun> interrupted;
};

/// Tells the history of a case id.
using Disk = std::function<History(const std::string& case_id)>;

/// What a run must have been made with to be used again.
struct Asked {
  std::string kind;  ///< "bed", "drive" or "flow"
  std::vector<simulation::NumericsVersion> numerics;
  std::optional<scene::RecordSpec> record;  ///< absent where runs of the scene are not recorded
  std::string bed_run;                      ///< the bed's newest run; "" without a bed
};

/// What of a record the runs of a scene heed; absent where they are not recorded.
std::optional<scene::RecordSpec> record_of_runs(const scene::RecordSpec& record, const scene::SceneSpec& scene);

enum class Action { fresh, resume, run };
const char* name(Action action);  ///< "fresh", "resume" or "run"

struct Decision {
  Action action = Action::run;
  std::string reason;  ///< in words
  std::string run;     ///< the run that is fresh, resumed, or begun again; "" for a new one
};

/// Declarations that runs of older numerics are as good as today's; they come from store::read_equivalences().
using Equivalences = std::vector<store::Equivalence>;

/// The declaration that lets runs of a kind with these numerics stand for today's; null: none. It has to be of the same
/// kind and of the same two lists as a whole, and chains of declarations are not joined.
const store::Equivalence* declared(const Equivalences& equivalences, const std::string& kind,
                                   const store::NumericsList& before, const store::NumericsList& now);

/// What to do about one case. A completed run whose numerics moved is fresh where they are declared equivalent; an
/// interrupted one goes on with the numerics that it was begun with alone, and a diverged one is run again.
Decision decide(const Asked& asked, const History& history, const Equivalences& equivalences);

/// The lists of numerics before and now of a completed run which they alone keep from being fresh.
struct Outdated {
  store::NumericsList before, now;
};
std::optional<Outdated> outdated(const Asked& asked, const History& history, const Equivalences& equivalences);

/// Why the case diverged with what is asked for, after `newest` was its newest run: somebody else has tried it
/// meanwhile, and it would diverge again. Absent when it did not.
std::optional<std::string> diverged_since(const std::string& newest, const Asked& asked, const History& history);

/// What `have` lacks of `want`, in words; empty when it covers it: the same rhythm and grid, and at least its frames.
std::string lacking(const scene::RecordSpec& have, const scene::RecordSpec& want);

enum class Kind { bed, drive, flow };
const char* name(Kind kind);  ///< "bed", "drive" or "flow", as requests and manifests have it
Kind kind_of(const scene::SceneSpec& scene);

/// One case to be considered: a bed, a drive that is built on one, or a flow of water alone.
struct Task {
  Kind kind = Kind::drive;
  std::string id;                  ///< case id
  std::size_t study_case = 0;      ///< its case in the study; for a bed the first that is built on it
  std::optional<std::size_t> bed;  ///< a drive's bed among the tasks; it stands before the drive
  std::string name;                ///< short and for people: "bed 3f2a90c1d4" or "pile.tip=flat"
  int most_threads = 1;            ///< with more its threads would mostly wait for each other
  Decision decision;
  std::string newest = {};                ///< its newest sealed run when it was planned; "": none
  std::optional<double> memory_mb = {};   ///< that it is thought to need [MB]; absent: no history
  std::optional<Outdated> outdated = {};  ///< its newest run could stand for it but for these
};

/// Grains that keep one thread busy: below it a second one makes a case slower, on a busy machine by orders of
/// magnitude.
inline constexpr std::int64_t kGrainsPerThread = 3000;

struct Plan {
  std::vector<Task> tasks;  ///< beds first, each once
};

/// The scene that a case's bed is prepared from. What is done to the bed, and what is poured on it, is no part of it.
scene::SceneSpec bed_alone(const scene::SceneSpec& scene);

/// Tells today's numerics of a scene.
using Numerics = std::function<std::vector<simulation::NumericsVersion>(const scene::SceneSpec&)>;

/// Decides about every case of the study. Beds that nothing needs any more are left out.
Plan make_plan(const study::Study& study, const Numerics& numerics, const Disk& disk, const Equivalences& equivalences);

/// The plan for people, one line per case; many cases with the same reason share a line.
std::vector<std::string> describe(const Plan& plan);

/// The first ten hex digits of a case id: what people see.
std::string short_id(const std::string& case_id);

/// The labels of a case in one line: "pile.tip=flat, fluid.density=1300 kg/m3, bed.seed=2".
std::string label_line(const std::vector<std::pair<std::string, std::string>>& labels);

}  // namespace seapile::execute
