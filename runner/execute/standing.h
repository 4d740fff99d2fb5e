// Where cases stand, for those who look on: read from their folders, without touching them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runner/execute/notes.h"
#include "runner/execute/plan.h"
#include "runner/store/catalogue.h"
#include "runner/study/study.h"

namespace seapile::execute {

enum class Standing {
  completed,
  running,      ///< a live process of this machine has its claim
  interrupted,  ///< begun, and nobody is at it
  failed,       ///< its last attempt ended without a result
  diverged,     ///< sealed, with the reason
  stale,        ///< has a result that cannot stand for it
  missing,      ///< never begun
};

inline constexpr Standing kStandings[] = {Standing::completed, Standing::running,  Standing::interrupted,
                                          Standing::failed,    Standing::diverged, Standing::stale,
                                          Standing::missing};
const char* name(Standing standing);

struct CaseStanding {
  std::string case_id;
  std::string name;  ///< as in a plan
  Standing standing = Standing::missing;
  std::string reason;                   ///< in words; may be empty
  std::optional<RunProgress> progress;  ///< of a run that was begun
  std::filesystem::path run_folder;     ///< the run that this tells of; empty: none
  std::filesystem::path sealed_folder;  ///< the newest sealed run, where it can be used; empty: none
  bool completed = false;               ///< that sealed run came to its end
};

/// Of all tasks of a study's plan, beds included.
std::vector<CaseStanding> standings(const Plan& plan, const std::filesystem::path& root);

/// Of a study by what the catalogue knows: beds of drives are not among its cases, and none is called stale, for that
/// takes the study itself.
std::vector<CaseStanding> standings(const store::StudyEntry& study, const std::filesystem::path& root);

/// Wall time [s] that a running case still needs, by its own speed; absent while too little of it is done.
std::optional<double> seconds_left(const RunProgress& progress);

}  // namespace seapile::execute
