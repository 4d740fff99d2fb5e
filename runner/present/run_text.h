#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/run_folder.h"
#include "solver/scene/analysis.h"

namespace seapile::present {

/// Everything that is known of one run, for people. `command` does it once more.
std::string run_text(const store::Manifest& manifest, const std::filesystem::path& run_folder,
                     const std::string& command);

/// "convection      left out  the Reynolds number is 2e-05, below 0.001; without it: at most 2e-05 of velocities ..."
std::string part_line(const scene::Decision& part);

/// The lines of what numbers or the study decided in these scenes, each once, with how many of them it is said of.
std::vector<std::string> decision_lines(const std::vector<scene::SceneSpec>& scenes);

/// The lines of what these scenes are too small for, each once, with how many of them it is said of.
std::vector<std::string> warning_lines(const std::vector<scene::SceneSpec>& scenes);

/// A study file whose only case is this run's.
std::string study_text(const store::Manifest& manifest);

}  // namespace seapile::present
