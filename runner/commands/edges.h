// What the store holds of the searches of a study's edge.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/edge.h"
#include "runner/study/study.h"

namespace seapile::commands {

/// One search for each combination of the axes, with what was tried so far. A run that diverged or that breaks an
/// invariant has tripped. Throws store::StoreError, and study::BadInput when a completed run has no metric that an
/// invariant names.
std::vector<present::EdgeSearch> edge_searches(const study::Study& study, const std::filesystem::path& root);

/// Values that have no result yet, by combination; empty: all have one.
std::vector<std::vector<double>> untried_probes(const study::Study& study,
                                                const std::vector<present::EdgeSearch>& searches);

/// All values that were tried and those to try next, by combination; empty: nothing is left to try.
std::vector<std::vector<double>> next_probes(const study::Study& study,
                                             const std::vector<present::EdgeSearch>& searches);

/// The study of a file with every value as a case that its searches have come to in the store, tried or to be tried
/// next. They go on from `options.probes`, which then holds these values. Throws as edge_searches() does.
study::Study searched(const std::string& file, study::Options& options, const std::filesystem::path& root);

}  // namespace seapile::commands
