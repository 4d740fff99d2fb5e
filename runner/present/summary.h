// What a study has come to, case by case.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "runner/present/figure.h"
#include "runner/present/replicates.h"
#include "runner/present/surface_figure.h"
#include "runner/present/table.h"
#include "runner/store/catalogue.h"
#include "solver/scene/spec.h"

namespace seapile::present {

/// A scene is a bed or a drive, a jet, or a basin of water. Only what has grains has a packing.
enum class SceneKind { grains, jet, basin };

SceneKind kind_of(const scene::SceneSpec& scene);

/// One case of a study, done or not.
struct CaseResult {
  std::string case_id;
  Labels labels;
  std::string outcome;               ///< "completed", "diverged", "failed", ...
  std::filesystem::path run_folder;  ///< its sealed run; empty when there is none
  std::filesystem::path bed_folder;  ///< the sealed run of its bed; empty when there is none
  SceneKind kind = SceneKind::grains;
};

/// Whether a case has a run of that kind, "drive" or "flow", that came to its end. Throws store::StoreError.
bool is_completed(const CaseResult& result, std::string_view kind);

/// Labels, outcome, and the numbers that each kind of scene is known by. Throws store::StoreError.
store::Table summary(const std::vector<CaseResult>& cases);

/// The completed drives as a figure, packings of the same case together. Throws store::StoreError.
Figure resistance_figure(const std::string& title, const std::vector<CaseResult>& cases);

/// The free surfaces of the completed jets as a figure, one curve per case. Throws store::StoreError.
SurfaceFigure surface_figure(const std::string& title, const std::vector<CaseResult>& cases);

/// What a study ends with: case by case, or, when the cases have replicates, packings put together.
struct Closing {
  store::Table table;
  std::vector<std::size_t> means;  ///< as text() takes them
  std::string remark;              ///< how far the numbers carry, in whole lines; may be empty
};

/// Throws store::StoreError.
Closing closing(const std::vector<CaseResult>& cases);

/// The same for people. Throws store::StoreError.
std::string closing_text(const std::vector<CaseResult>& cases);

}  // namespace seapile::present
