// How far each case of a study is, from its run folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/report.h"
#include "runner/study/study.h"

namespace seapile::commands {

enum class State {
  done,        ///< its newest run is what the study asks for today
  failed,      ///< its newest run diverged, or is damaged
  missing,     ///< it was never begun
  unfinished,  ///< begun and not sealed: failed, stopped, or still running
  stale,       ///< its newest run completed, and is not what the study asks for today
};

/// "done", "failed", "missing", "unfinished", "stale".
std::string words(State state);
present::Tone tone(State state);

struct CaseState {
  std::string case_id;
  present::Labels labels;
  State state = State::missing;
  std::string why;                   ///< in words
  bool completed = false;            ///< the newest sealed run came to its end
  std::filesystem::path run_folder;  ///< of the newest sealed run that can be read; empty when there is none
  std::filesystem::path bed_folder;  ///< of its bed's; empty when there is none
  std::filesystem::path log_folder;  ///< of the run whose log tells more, where a case is failed or unfinished
};

/// In the order of the study's cases. Throws store::StoreError.
std::vector<CaseState> case_states(const study::Study& study, const std::filesystem::path& root);

/// The beds that those are built on, each once; cases that are beds alone are not among them.
std::vector<CaseState> bed_states(const study::Study& study, const std::filesystem::path& root);

/// The reasons and the last lines of the logs of what is failed or unfinished.
std::vector<present::ReportBlock> failure_logs(const std::vector<CaseState>& states);

}  // namespace seapile::commands
