// Tables of a report: what the runs cost and how steady they were, what sets the cases apart, how all was made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/report.h"
#include "runner/present/table.h"
#include "runner/store/parameters.h"
#include "runner/store/run_folder.h"

namespace seapile::present {

/// A sealed run of the study, or of a bed that its cases are built on.
struct ReportRun {
  Labels labels;
  std::string state;  ///< "done", "stale", "diverged", ...
  store::Manifest manifest;
};

/// A row per run: CPU, wall time and memory, and those of the monitors that some run has: steps and how many were
/// rejected, overlaps, errors of energy and volume, quality of the mesh.
ReportTable cost_table(const std::vector<ReportRun>& runs, const std::vector<ReportRun>& beds);

/// CPU time, a bar per run.
ReportBars cost_bars(const std::vector<ReportRun>& runs);

/// What a case of the study asks for, from its scene.
struct ReportScene {
  std::string case_id;
  std::vector<store::Parameter> parameters;
};

/// What all cases share, a row per parameter; and what sets them apart, a row per case.
ReportTable common_parameters(const std::vector<ReportScene>& scenes);
ReportTable differing_parameters(const std::vector<ReportScene>& scenes);

/// How the runs were made, a column for each way: program, compiler, libraries, processor, numerics.
ReportTable provenance_table(const std::vector<ReportRun>& runs);

/// The seal of every run.
ReportTable seal_table(const std::vector<ReportRun>& runs);

}  // namespace seapile::present
