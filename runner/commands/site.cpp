#include "runner/commands/site.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>

#include "runner/study/cpt.h"
#include "runner/study/study.h"
#include "runner/study/unit.h"

namespace seapile::commands {
namespace {

constexpr double kWaterWeight = 9.81;  // [kN/m3]

/// An option's number in its unit; absent where it was not given.
std::optional<double> read_option(const char* option, const std::string& text, const char* unit, double least,
                                  double most) {
  if (text.empty()) return {};
  const study::UnitResult result = study::read_quantity(text, unit);
  const std::string allowed = fmt::format("{} to {} {}", least, most, unit);
  if (!result.problem.empty()) {
    throw UsageError(fmt::format("{}: \"{}\" {}; allowed: {}{}", option, text, result.problem, allowed,
                                 result.nearest.empty() ? "" : fmt::format("; did you mean \"{}\"?", result.nearest)));
  }
  if (result.value < least || result.value > most)
    throw UsageError(fmt::format("{}: {} is out of range; allowed: {}", option, text, allowed));
  return result.value;
}

}  // namespace

void add_site_options(CLI::App& command, SiteArguments& site) {
  CLI::Option* overlay =
      command
          .add_option("--overlay", site.files,
                      "Measured cone penetration test, GEF-CPT or CSV (depth[m],qc[MPa]), to lie over "
                      "normalised curves; may be repeated")
          ->type_name("FILE")
          ->take_all()
          ->expected(1)
          ->allow_extra_args(false);
  const auto add = [&](const char* name, std::string& text, const char* what) {
    command.add_option(name, text, what)->type_name("QUANTITY")->needs(overlay);
  };
  add("--site-unit-weight", site.unit_weight, "Of the ground of the test, with its water, such as \"18 kN/m3\"");
  add("--site-water-depth", site.water_depth, "Of the water table below the ground; \"0 m\" below the sea");
  add("--site-cone-diameter", site.cone_diameter, "Where the file does not say the cone's area, such as \"35.7 mm\"");
}

std::vector<present::SiteCurve> read_sites(const SiteArguments& site) {
  const auto unit_weight = read_option("--site-unit-weight", site.unit_weight, "kN/m3", 10, 40);
  const auto water_depth = read_option("--site-water-depth", site.water_depth, "m", 0, 1000);
  const auto given_diameter = read_option("--site-cone-diameter", site.cone_diameter, "mm", 1, 1000);
  std::vector<present::SiteCurve> curves;
  for (const std::string& file : site.files) {
    const study::Cpt cpt = study::read_cpt(file);
    base::Problems problems;
    const auto missing = [&](const char* what, const char* option) {
      problems.push_back({"", fmt::format("does not say {}", what), option, ""});
    };
    if (cpt.is_simulated)
      problems.push_back({"", "is a simulated test, and --overlay is for measured ones", "a test in the field", ""});
    if (!unit_weight) missing("the unit weight of the ground", "--site-unit-weight, such as \"18 kN/m3\"");
    if (!water_depth) missing("how deep the water table is", "--site-water-depth, such as \"0 m\"");
    double diameter = given_diameter.value_or(0) / 1000;
    if (cpt.cone_area) {
      diameter = std::sqrt(4 * *cpt.cone_area / std::numbers::pi);
      if (given_diameter) fmt::print(stderr, "{} says the cone's area: --site-cone-diameter is not used\n", file);
    } else if (!given_diameter) {
      missing("the cone's area or diameter", "--site-cone-diameter, such as \"35.7 mm\"");
    }
    if (!problems.empty()) throw study::BadInput(file, std::move(problems));

    present::SiteCurve curve{std::filesystem::path(file).filename().string(), {}};
    curve.curve.over = present::Overburden{*unit_weight * 1000, kWaterWeight * 1000, *water_depth, diameter};
    for (std::size_t i = 0; i < cpt.depth.size(); ++i) {
      if (std::isnan(cpt.depth[i]) || std::isnan(cpt.cone_resistance[i])) continue;
      curve.curve.depth.push_back(cpt.depth[i]);
      curve.curve.resistance.push_back(cpt.cone_resistance[i]);
    }
    if (curve.curve.depth.empty())
      throw study::BadInput(file, {{"", "has no reading with a depth and a resistance", "at least 1", ""}});
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace seapile::commands
