#include "runner/present/run_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "runner/present/curve.h"
#include "runner/store/build_values.h"
#include "runner/store/final_state.h"
#include "runner/store/manifest.h"
#include "runner/store/parameters.h"
#include "solver/scene/spec.h"

namespace seapile::present {
namespace {

using nlohmann::ordered_json;

/// What is below it in SI units is what rounding leaves of zero, such as an asymmetry: it has no relative difference.
constexpr double kNothing = 1e-12;

using Values = std::vector<std::pair<std::string, std::string>>;  // in their order

const std::string* find(const Values& values, const std::string& name) {
  const auto found = std::ranges::find(values, name, &std::pair<std::string, std::string>::first);
  return found == values.end() ? nullptr : &found->second;
}

/// What is not the same on both sides, in the order of A; what only B has comes last.
std::vector<Difference> differences(const Values& a, const Values& b,
                                    const std::map<std::string, std::string>& units = {}) {
  std::vector<Difference> all;
  const auto add = [&](const std::string& name, const std::string& of_a, const std::string& of_b) {
    const auto unit = units.find(name);
    all.push_back({name, of_a, of_b, unit == units.end() || unit->second == "-" ? "" : unit->second});
  };
  for (const auto& [name, value] : a) {
    const std::string* other = find(b, name);
    if (other == nullptr || *other != value) add(name, value, other ? *other : "");
  }
  for (const auto& [name, value] : b) {
    if (find(a, name) == nullptr) add(name, "", value);
  }
  return all;
}

/// Units of what a record asks for, under the paths of a study.
std::map<std::string, std::string> record_units() {
  std::map<std::string, std::string> units;
  const scene::RecordSpec record;
  const auto note = [&](const base::Field& field, const auto&) {
    units["record." + std::string(field.key)] = std::string(field.unit);
  };
  fields(note, record);
  return units;
}

Values parameter_values(const store::RunHeader& header) {
  Values values;
  for (const store::Parameter& parameter : store::parameters(header.scene_json, header.kind)) {
    if (parameter.path == "bed.file" && !parameter.text.value_or("").empty()) continue;  // its content is what counts
    values.emplace_back(parameter.path,
                        parameter.number ? fmt::format("{}", *parameter.number) : parameter.text.value_or("none"));
  }
  if (header.record_json.empty()) return values;
  const ordered_json record = ordered_json::parse(header.record_json);
  for (const auto& [key, value] : record.items()) values.emplace_back("record." + key, value.dump());
  return values;
}

Values numerics_values(const store::RunHeader& header) {
  Values values;
  for (const auto& [module, version] : header.numerics) values.emplace_back(module, fmt::format("{}", version));
  return values;
}

Values environment_values(const store::Provenance& made) {
  return {{"processor", made.host_cpu},
          {"cores", fmt::format("{}", made.cores)},
          {"threads", fmt::format("{}", made.threads)},
          {"simd", made.simd}};
}

double relative_difference(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double scale = std::max(std::abs(a), std::abs(b));
  return scale < kNothing ? 0 : std::abs(b - a) / scale;
}

std::vector<MetricDistance> metric_distances(const simulation::RunResult& a, const simulation::RunResult& b) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<MetricDistance> all;
  for (const simulation::Metric& metric : a.metrics) {
    const auto other = std::ranges::find(b.metrics, metric.name, &simulation::Metric::name);
    const bool shared = other != b.metrics.end() && other->unit == metric.unit;
    const double relative = shared ? relative_difference(metric.value, other->value) : kNone;
    all.push_back({metric.name, metric.unit, metric.value, shared ? other->value : kNone, relative});
  }
  for (const simulation::Metric& metric : b.metrics) {
    if (std::ranges::find(a.metrics, metric.name, &simulation::Metric::name) == a.metrics.end())
      all.push_back({metric.name, metric.unit, kNone, metric.value, kNone});
  }
  return all;
}

/// The columns by which runs of a kind are compared, and the series that they are of.
struct Compared {
  Series series;
  std::vector<std::string> over;  ///< the first that rises in both
  std::vector<std::string> columns;
};

Compared compared_of(const std::string& kind) {
  if (kind == "bed") return {Series::grains, {"time"}, {"potential_energy", "contacts"}};
  if (kind == "flow")
    return {Series::water,
            {"time"},
            {"volume", "rise", "wave", "lowest", "highest", "left", "middle", "right", "kinetic_energy",
             "potential_energy", "pile_depth", "pile_force_x", "pile_force_y"}};
  return {Series::both,
          {"depth", "travel", "time"},
          {"tip_resistance", "sleeve_force_y", "pile_work", "fluid:tip_force_y", "face_pressure", "shoulder_pressure",
           "sleeve_pressure", "grain_force_y"}};
}

/// Whether a column says anything: that of a part which a scene has not is NaN throughout.
bool is_held(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

/// `uncompared` receives the columns that one of them lacks, or that are no numbers over what both cover.
std::vector<SeriesDistance> series_distances(const FinishedRun& a, const FinishedRun& b,
                                             std::vector<std::string>& uncompared) {
  const std::string& kind = a.manifest.header.kind;
  if (kind != b.manifest.header.kind) return {};
  const Compared compared = compared_of(kind);
  std::vector<std::string> names = compared.over;
  names.insert(names.end(), compared.columns.begin(), compared.columns.end());
  const auto read = [&](const FinishedRun& run) {
    return read_columns({run.manifest.header.case_id, run.manifest.run, {}, run.folder}, compared.series, names);
  };
  const auto of_a = read(a), of_b = read(b);
  std::size_t over = 0;
  while (over < compared.over.size() && !(rises(of_a[over]) && rises(of_b[over]))) ++over;
  if (over == compared.over.size()) {
    uncompared = compared.over;
    return {};
  }
  std::vector<SeriesDistance> all;
  for (std::size_t i = compared.over.size(); i < names.size(); ++i) {
    const bool held_by_a = is_held(of_a[i]), held_by_b = is_held(of_b[i]);
    if (!held_by_a && !held_by_b) continue;
    const auto found = held_by_a && held_by_b ? distance({of_a[over], of_a[i]}, {of_b[over], of_b[i]}) : std::nullopt;
    if (found) {
      all.push_back(
          {names[i], unit_of(compared.series, names[i]), names[over], unit_of(compared.series, names[over]), *found});
    } else {
      uncompared.push_back(names[i]);
    }
  }
  return all;
}

std::string names_of(const std::vector<Difference>& differences) {
  constexpr std::size_t kMost = 4;
  std::string names;
  for (std::size_t i = 0; i < std::min(kMost, differences.size()); ++i)
    names += (i > 0 ? ", " : "") + differences[i].name;
  return differences.size() > kMost ? fmt::format("{} and {} more", names, differences.size() - kMost) : names;
}

std::string moved(const std::vector<Difference>& numerics) {
  std::string text;
  for (const Difference& one : numerics)
    text += fmt::format("{}{} {} and {}", text.empty() ? "" : ", ", one.name, one.a.empty() ? "none" : one.a,
                        one.b.empty() ? "none" : one.b);
  return text;
}

/// "3.2 %", or with an exponent where a percentage would be all zeros.
std::string percent(double relative) {
  return relative >= 1e-4 ? fmt::format("{:.3g} %", 100 * relative) : fmt::format("{:.2g} of it", relative);
}

}  // namespace

RunComparison compare(const FinishedRun& a, const FinishedRun& b) {
  const store::RunHeader &of_a = a.manifest.header, &of_b = b.manifest.header;
  RunComparison result;
  result.case_a = of_a.case_id, result.case_b = of_b.case_id;
  result.run_a = a.manifest.run, result.run_b = b.manifest.run;
  result.state_a = store::final_state(a.folder, a.manifest), result.state_b = store::final_state(b.folder, b.manifest);
  std::map<std::string, std::string> units = store::parameter_units();
  units.merge(record_units());
  result.parameters = differences(parameter_values(of_a), parameter_values(of_b), units);
  result.numerics = differences(numerics_values(of_a), numerics_values(of_b));
  result.code = differences(store::build_values(a.manifest.provenance), store::build_values(b.manifest.provenance));
  result.environment =
      differences(environment_values(a.manifest.provenance), environment_values(b.manifest.provenance));
  result.metrics = metric_distances(a.manifest.result, b.manifest.result);
  result.curves = series_distances(a, b, result.uncompared);

  if (of_a.kind != of_b.kind) result.differ_alone.push_back(fmt::format("a {} and a {}", of_a.kind, of_b.kind));
  if (a.manifest.result.outcome != b.manifest.result.outcome)
    result.differ_alone.push_back(
        fmt::format("{} and {}", store::name(a.manifest.result.outcome), store::name(b.manifest.result.outcome)));
  if (of_a.case_id != of_b.case_id && result.parameters.empty())
    result.differ_alone.emplace_back("grains of other files");

  const auto count = [&](double relative, const std::string& name) {
    if (!(relative > result.largest)) return;
    result.largest = relative;
    result.largest_of = name;
  };
  for (const SeriesDistance& curve : result.curves) count(curve.distance.relative, curve.column);
  const bool curves_alike = result.largest == 0;
  for (const MetricDistance& metric : result.metrics) {
    count(metric.relative, metric.name);
    if (std::isnan(metric.relative)) ++result.unshared;
  }
  const bool same_metrics = std::ranges::all_of(result.metrics, [](const MetricDistance& metric) {
    return metric.a == metric.b || (std::isnan(metric.a) && std::isnan(metric.b));
  });
  const bool same_state = !result.state_a.empty() && result.state_a == result.state_b;
  const bool same_kind = of_a.kind == of_b.kind && a.manifest.result.outcome == b.manifest.result.outcome;
  if (same_kind && same_state && same_metrics && curves_alike) {
    result.likeness = Likeness::identical;
  } else if (same_kind && !result.metrics.empty() && result.unshared == 0 && result.largest <= kRounding) {
    result.likeness = Likeness::rounding;
  }
  return result;
}

bool are_packings(const RunComparison& comparison) {
  return comparison.parameters.size() == 1 && comparison.parameters.front().name == "bed.seed";
}

std::string inequality(const RunComparison& comparison, double tolerance) {
  if (!comparison.differ_alone.empty()) return fmt::format("{}", fmt::join(comparison.differ_alone, "; "));
  if (comparison.metrics.empty() && comparison.curves.empty()) return "they have nothing that could be compared";
  for (const MetricDistance& metric : comparison.metrics) {
    if (std::isnan(metric.relative)) return fmt::format("{} is a number in one alone", metric.name);
  }
  if (!comparison.uncompared.empty())
    return fmt::format("{} cannot be compared over what both cover", comparison.uncompared.front());
  if (comparison.likeness == Likeness::identical) return "";
  if (tolerance > 0 && comparison.largest <= tolerance) return "";
  if (comparison.largest == 0) return "their final states differ";
  return fmt::format("{} differs by {:.3g}", comparison.largest_of, comparison.largest);
}

std::string explanation(const RunComparison& comparison) {
  std::vector<std::string> reasons = comparison.differ_alone;
  if (are_packings(comparison)) {
    reasons.emplace_back("two packings of one scene, so the scatter of packings is in it");
  } else if (!comparison.parameters.empty()) {
    const bool seeds =
        std::ranges::find(comparison.parameters, "bed.seed", &Difference::name) != comparison.parameters.end();
    reasons.push_back("other parameters (" + names_of(comparison.parameters) + ")" +
                      (seeds ? ", among them the packing, whose scatter is in it" : ""));
  }
  if (!comparison.numerics.empty()) reasons.push_back("other numerics (" + moved(comparison.numerics) + ")");
  if (!comparison.code.empty()) reasons.push_back("another build (" + names_of(comparison.code) + ")");
  // Threads and the width of registers change no bit (docs/reproducibility.md): they explain nothing.
  std::vector<Difference> machine = comparison.environment;
  std::erase_if(machine, [](const Difference& one) { return one.name != "processor"; });
  if (!machine.empty()) reasons.emplace_back("another processor");
  return reasons.empty() ? "nothing known: all that is recorded of their making is the same"
                         : fmt::format("{}", fmt::join(reasons, "; "));
}

std::string verdict(const RunComparison& comparison) {
  const bool same_state = !comparison.state_a.empty() && comparison.state_a == comparison.state_b;
  if (comparison.likeness == Likeness::identical)
    return fmt::format("identical to the last bit (state {})", comparison.state_a);
  const std::string state = same_state ? "the final state is identical to the last bit, but " : "";
  const std::string because = "; explained by: " + explanation(comparison);
  if (comparison.likeness == Likeness::rounding)
    return fmt::format("{}equal within rounding (largest relative difference {:.2g}){}", state, comparison.largest,
                       because);
  std::string by;
  for (const SeriesDistance& curve : comparison.curves) {
    if (by.empty() && curve.distance.relative > 0)
      by = fmt::format("{} over {} by {}", curve.column, curve.over, percent(curve.distance.relative));
  }
  const auto add = [&](const std::string& text) { by += (by.empty() ? "" : ", ") + text; };
  if (comparison.largest > 0)
    add(fmt::format("most of all {} by {}", comparison.largest_of, percent(comparison.largest)));
  if (comparison.unshared > 0)
    add(fmt::format("{} of one alone",
                    comparison.unshared == 1 ? "1 metric is" : fmt::format("{} metrics are", comparison.unshared)));
  if (by.empty()) by = "their final states";
  return fmt::format("{}they differ: {}{}", state, by, because);
}

}  // namespace seapile::present
