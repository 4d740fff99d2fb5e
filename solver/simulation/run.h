// The time loop, and everything a worker process needs to know of the solver.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solver/scene/analysis.h"
#include "solver/scene/spec.h"
#include "solver/simulation/array.h"
#include "solver/simulation/execution.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/flow_record.h"
#include "solver/simulation/frame.h"
#include "solver/simulation/record.h"

namespace seapile::simulation {

struct Simulation;

/// One integer per module, raised by hand in the change that moves its numbers.
struct NumericsVersion {
  std::string module;
  int version;
};
/// Those of the modules that a scene is computed by.
std::vector<NumericsVersion> numerics_versions(const scene::SceneSpec& scene);

/// A part of the solver, and whether this scene was built with it.
using Part = scene::Decision;
std::vector<Part> parts(const scene::SceneSpec& scene);

/// A named number that a finished case is known by.
struct Metric {
  std::string name;
  double value;
  std::string unit;
  std::string meaning;
};

/// What the time went into.
struct ProfileEntry {
  std::string part;
  double seconds;
  std::int64_t calls;
};

/// A settled bed: what every case that is built on it starts from.
struct Bed {
  std::vector<Array> grains;   ///< "grains/id", "grains/position", "grains/radius"; rows in the order of the ids
  std::vector<Metric> metrics; ///< solid_fraction, coordination_number, surface, settling_friction, settling_time, ...
  std::vector<double> porosity_profile;  ///< porosity of horizontal slices of `profile_spacing` from the base up [-]
  double profile_spacing = 0.1;          ///< [m]
  std::vector<Record> records;           ///< one per 10 ms of settling
  std::vector<ProfileEntry> profile;
};

/// How far a run is; called at each record.
struct Progress {
  double time = 0;      ///< simulated [s]
  double fraction = 0;  ///< of the whole, 0..1, by the case's own end
  double depth = 0;     ///< [m]; NaN for a bed
};

/// Prepares a bed: drops, settles, and where a solid fraction is asked for, searches the friction that gives it.
/// `given`: grains read from the bed's file ("grains/id", "grains/position", "grains/radius"; rows by rising id) to be
/// settled where they are; empty: the grains are drawn and dropped at random.
/// Throws std::runtime_error with one sentence when it cannot be settled or the target not be reached.
Bed prepare_bed(const scene::BedSpec& bed, const std::vector<Array>& given, const Execution& execution,
                const std::function<void(const Progress&)>& progress);

/// What a run hands out while it runs, and what it is asked. Records and frames are handed out when the stretch that
/// they are of is accepted.
struct RunHooks {
  std::function<void(const Record&)> record;
  std::function<void(const Frame&)> frame;
  /// Of the fluid, with each record and each frame; never called when the scene is dry.
  std::function<void(const FlowRecord&)> flow_record;
  std::function<void(const FlowFrame&)> flow_frame;
  std::function<void(const Progress&)> progress;
  /// Asked after each stretch that was accepted (simulation/stepping.h): true seals a checkpoint now.
  std::function<bool()> checkpoint_due;
  /// What is to be sealed: the state, from snapshot(), and what frames have measured (simulation/tip_measures.h). Writing
  /// it changes no bit of what follows.
  std::function<void(const std::vector<Array>&)> checkpoint;
  /// Asked after each stretch: true stops the run, which is then `stopped` and resumable from a last checkpoint. Asked
  /// also while the grains settle before the start, where there is none yet.
  std::function<bool()> stop;
  /// Of a run that has diverged, after its last checkpoint, which is the last accepted state: the state that was
  /// rejected last, and why. Where a step could not be done at all it is the state from which it was tried.
  std::function<void(const std::vector<Array>& rejected, const std::string& reason)> post_mortem;
};

enum class Outcome { completed, diverged, stopped };

struct RunResult {
  Outcome outcome = Outcome::completed;
  std::string reason;  ///< one sentence; empty when completed
  double time = 0;     ///< reached [s]
  double depth = 0;    ///< reached [m]
  std::uint64_t state_hash = 0;
  std::vector<Metric> metrics;  ///< headline q_c, fluctuation, depth bins, work, largest overlap, measures of the
                                ///< frames, steps, rebuilds, ...
  std::vector<ProfileEntry> profile;
};

/// The records before a checkpoint; those of the fluid are as many, or none when the scene is dry.
struct RecordsSoFar {
  std::vector<Record> records;
  std::vector<FlowRecord> flow_records;
};

/// Drives the pile of `scene` into `bed`. `resume_from`: what a checkpoint sealed, or empty to start. The records and frames
/// handed out after a resume are those after the checkpoint, bit for bit. `so_far`: the records before the checkpoint
/// (the metrics need them).
RunResult run(const scene::SceneSpec& scene, const scene::RecordSpec& record, const Bed& bed, const Execution& execution,
              const std::vector<Array>& resume_from, const RecordsSoFar& so_far, const RunHooks& hooks);

}  // namespace seapile::simulation
