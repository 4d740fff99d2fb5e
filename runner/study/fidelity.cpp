#include "runner/study/fidelity.h"

#include <array>
#include <string_view>

namespace seapile::study {
namespace {

/// What a level of fidelity means for the contact solver while driving (decision 0012; errors: docs/accuracy.md),
struct Fidelity {
  const char* name;
  const char* method;
  double step;      ///< [s]
  double substeps;  ///< 0: the method has none
  const char* precision;
};
constexpr std::array kFidelities = {
    Fidelity{"thesis", "nonsmooth", 1e-4, 0, "double"},
    Fidelity{"draft", "soft", 4e-3, 10, "single"},
    Fidelity{"standard", "soft", 5e-4, 10, "single"},
    Fidelity{"reference", "soft", 5e-4, 20, "double"},
};

/// And for a jet: its mesh and, in the thesis, its scheme in time. Errors of the swell ratio: docs/die_swell.md.
struct JetFidelity {
  double lip_size, growth, largest_size;  ///< [H]
};
constexpr std::array kJetFidelities = {
    JetFidelity{0.05, 0.05, 0.1},
    JetFidelity{0.01, 0.2, 0.3},
    JetFidelity{0.001, 0.12, 0.12},
    JetFidelity{0.0002, 0.05, 0.06},
};
static_assert(kJetFidelities.size() == kFidelities.size());

/// And for a basin: its step, and in the thesis its scheme in time, as the step there is a question of its own.
constexpr std::array kBasinSteps = {0.0, 2e-3, 1e-3, 5e-4};  // [s]
static_assert(kBasinSteps.size() == kFidelities.size());

/// And for the fluid of a saturated bed: its step and how far its equations are solved; in the thesis also the
/// porosity that its law of drag has.
struct FluidFidelity {
  double step, tolerance;  ///< [s], [-]
};
constexpr std::array kFluidFidelities = {
    FluidFidelity{1e-4, 1e-5},
    FluidFidelity{8e-3, 1e-2},
    FluidFidelity{1e-3, 1e-5},
    FluidFidelity{5e-4, 1e-8},
};
static_assert(kFluidFidelities.size() == kFidelities.size());

}  // namespace

std::vector<std::string> fidelity_names() {
  std::vector<std::string> names;
  for (const Fidelity& fidelity : kFidelities) names.emplace_back(fidelity.name);
  return names;
}

std::vector<Assignment> filled_by_fidelity(std::size_t level, const PlacePtr& place) {
  const Fidelity& fidelity = kFidelities[level];
  std::vector<Assignment> filled = {{{"contact", "method"}, string_value(fidelity.method, place)},
                                    {{"contact", "step"}, number_value(fidelity.step, place)},
                                    {{"contact", "precision"}, string_value(fidelity.precision, place)}};
  if (fidelity.substeps > 0) filled.push_back({{"contact", "substeps"}, number_value(fidelity.substeps, place)});

  const auto fill = [&](const char* path, Value value) { filled.push_back({split_path(path), std::move(value)}); };
  const JetFidelity& jet = kJetFidelities[level];
  fill("jet.lip_size", number_value(jet.lip_size, place));
  fill("jet.growth", number_value(jet.growth, place));
  fill("jet.largest_size", number_value(jet.largest_size, place));
  fill("fluid.time.step", number_value(kFluidFidelities[level].step, place));
  fill("fluid.time.tolerance", number_value(kFluidFidelities[level].tolerance, place));
  if (std::string_view(fidelity.name) == "thesis") {
    fill("fluid.coupling.drag.porosity", string_value("plane", place));
    fill("fluid.coupling.porosity.kernel", string_value("hat", place));
    fill("jet.method.transient.kinematic", string_value("differences", place));
    fill("jet.method.transient.order", number_value(1, place));
    fill("basin.surface.scheme", string_value("galerkin", place));
    fill("basin.time.order", number_value(1, place));
    fill("basin.time.iterated", truth_value(false, place));
  } else {
    fill("basin.time.step", number_value(kBasinSteps[level], place));
  }
  return filled;
}

}  // namespace seapile::study
