// Where the cases of a study stand, as a report shows it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/execute/standing.h"
#include "runner/present/report.h"
#include "runner/study/study.h"

namespace seapile::commands {

present::Tone tone(execute::Standing standing);

struct CaseState {
  execute::CaseStanding at;
  present::Labels labels;
  std::filesystem::path bed_folder;  ///< newest sealed run of its bed; empty when there is none
};

/// The cases of a study, in its order, and the beds that they are built on, each once; a case that is a bed alone is
/// not among those.
struct StudyStates {
  std::vector<CaseState> cases, beds;
};

/// Throws store::StoreError.
StudyStates study_states(const study::Study& study, const std::filesystem::path& root);

/// The reasons and the last lines of the logs of what failed, diverged, or was begun and is not done.
std::vector<present::ReportBlock> failure_logs(const std::vector<CaseState>& states);

}  // namespace seapile::commands
