// A study on its way to results: planned against a store, carried out on this machine, ingested by this one writer.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "runner/execute/plan.h"
#include "runner/execute/pool.h"
#include "runner/execute/request.h"
#include "runner/store/catalogue.h"
#include "runner/study/study.h"

namespace seapile::execute {

struct CampaignOptions {
  std::string root = "results";  ///< of the store
  Sharing sharing;               ///< its cores are filled in here
  double checkpoint_every = 10;  ///< [s] of wall time
};

/// What became of one case of the study.
struct CaseOutcome {
  std::string case_id;
  std::vector<std::pair<std::string, std::string>> labels;
  std::string word;                  ///< "completed", "diverged", "failed", "not run", "interrupted"
  std::filesystem::path run_folder;  ///< its sealed run; empty when there is none to rely on
  std::filesystem::path bed_folder;  ///< the sealed run of its bed; empty when there is none
};

/// The wishes of a user with what this machine has: its cores and, where nothing else was wished, most of its memory.
Sharing on_this_machine(Sharing sharing);

/// What the catalogue knows of a study.
store::StudyEntry entry_of(const study::Study& study);

/// The numerics that a scene is computed with today.
std::vector<simulation::NumericsVersion> todays_numerics(const scene::SceneSpec& scene);

/// What a store declares equivalent, for everybody who decides what is fresh. A declaration that does not hold counts
/// for nothing and is named on standard error, once by a process.
Equivalences declared_equivalences(const std::filesystem::path& root);

/// Whether versions are today's of a scene.
bool are_of_today(const std::vector<simulation::NumericsVersion>& versions, const scene::SceneSpec& scene);

/// What a worker is asked for a task of the study's plan; a drive is built on its bed's newest run, if there is one
/// yet.
Request request_of(const study::Study& study, const Task& task, const CampaignOptions& options);

class Campaign {
 public:
  /// Plans; writes nothing. `study` must outlive it.
  Campaign(const study::Study& study, CampaignOptions options);

  const Sharing& sharing() const { return options_.sharing; }
  const Plan& plan() const { return plan_; }

  /// Runs what is not fresh, with progress on standard error. Returns the exit code of the command. Throws
  /// store::StoreError when the store cannot be used from the start.
  int carry_out();

  /// After carry_out(), in the order of the study's cases.
  std::vector<CaseOutcome> outcomes() const;

 private:
  void announce() const;
  void ingest(const std::string& case_id);
  void note_failure(std::size_t task, const std::string& why) const;
  void show_log(const std::string& case_id) const;

  const study::Study& study_;
  CampaignOptions options_;
  Numerics numerics_;
  Equivalences equivalences_;
  Plan plan_;
  Summary summary_;
  std::string ingest_trouble_;  ///< the first; the results are safe in their folders all the same
};

}  // namespace seapile::execute
