#include "runner/present/cpt_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "runner/present/normalised.h"
#include "runner/present/scene_numbers.h"
#include "runner/store/run_folder.h"
#include "solver/pile/pile.h"

namespace seapile::present {
namespace {

constexpr int kVoid = -9999;
constexpr const char* kProject = "SEAPILE-SIMULATED";

/// Where on the pile the numbers are of, and what the fluid at rest adds.
struct Place {
  pile::PileSpec pile;
  double fluid_weight = 0;  ///< rho g [N/m3]; 0: dry
  double water_depth = 0;   ///< of its surface below the bed's [m]

  double shoulder(double depth) const { return depth - pile::tip_height(pile); }
  double width() const { return 2 * pile.radius; }

  std::optional<double> friction(const simulation::Record& record) const {
    const double length = shoulder(record.depth);
    if (length < width()) return {};
    return record.sleeve_force_y / (2 * length);
  }

  std::optional<double> pressure(double excess, double depth) const {
    if (depth < 0 || std::isnan(excess)) return {};
    return excess + fluid_weight * std::max(0.0, depth - water_depth);
  }

  std::array<std::optional<double>, 3> pressures(double depth, const simulation::FlowRecord& flow) const {
    return {pressure(flow.face_pressure, (depth + shoulder(depth)) / 2),
            pressure(flow.shoulder_pressure, shoulder(depth)),
            pressure(flow.sleeve_pressure, shoulder(depth) - width())};
  }
};

Place place_of(const CurveSource& source) {
  const SceneNumbers scene(source.run_folder);
  Place place;
  place.pile.radius = scene.at("pile.radius");
  place.pile.tip = pile::FlatTip{};
  const std::string angle = "pile.tip.conical.apex_angle";
  if (scene.has(angle)) place.pile.tip = pile::ConicalTip{scene.at(angle)};
  if (scene.has("fluid.density")) {
    place.fluid_weight = scene.at("fluid.density") * scene.at("bed.domain.gravity");
    place.water_depth = overburden_of(source.run_folder, source.bed_folder).water_depth;
  }
  return place;
}

/// A mean that is absent as soon as one of its values is.
struct Mean {
  double sum = 0;
  int count = 0;
  bool is_whole = true;
  void add(const std::optional<double>& value) {
    sum += value.value_or(0);
    ++count;
    is_whole = is_whole && value.has_value();
  }
  std::optional<double> value() const { return is_whole && count > 0 ? std::optional(sum / count) : std::nullopt; }
};

struct Reading {
  Mean resistance, friction;
  std::array<Mean, 3> pressure;
};

/// In whole pascals.
long pascals(double value) { return std::lround(value); }

/// R_f [%] of the values that are printed.
std::optional<double> friction_ratio(const CptRow& row) {
  const auto resistance = static_cast<double>(pascals(row.cone_resistance));
  if (!row.sleeve_friction || resistance <= 0) return {};
  return 100 * static_cast<double>(pascals(*row.sleeve_friction)) / resistance;
}

/// In units of 10^decimals Pa, every pascal printed.
std::string in_units(const std::optional<double>& value, int decimals, const std::string& absent) {
  if (!value) return absent;
  return fmt::format("{:.{}f}", static_cast<double>(pascals(*value)) / std::pow(10, decimals), decimals);
}

/// The cells of a row; `decimals`: 3 for friction and pore pressures in kPa, 6 in MPa.
std::vector<std::string> cells(const CptTable& table, const CptRow& row, int decimals, const std::string& absent) {
  const auto ratio = friction_ratio(row);
  std::vector<std::string> list = {fmt::format("{:.3f}", row.depth), in_units(row.cone_resistance, 6, absent),
                                   in_units(row.sleeve_friction, decimals, absent),
                                   ratio ? fmt::format("{:.3f}", *ratio) : absent};
  for (const auto& pressure : row.pore_pressure) {
    if (table.has_pore_pressure) list.push_back(in_units(pressure, decimals, absent));
  }
  return list;
}

}  // namespace

CptTable cpt_table(const CurveSource& source) {
  const Place place = place_of(source);
  const std::vector<simulation::Record> records = store::read_series(source.run_folder);
  const std::vector<simulation::FlowRecord> flow = store::read_flow_series(source.run_folder);
  CptTable table{source.case_id, source.run, place.width(), flow.size() == records.size() && !flow.empty(), {}};

  std::map<long, Reading> readings;
  double reached = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const simulation::Record& record = records[i];
    if (record.depth <= reached) continue;
    reached = record.depth;
    // A record that ends on an interval's lower end lies in it; the tolerance is for depths summed from many steps.
    Reading& reading = readings[std::lround(std::ceil(reached / kCptInterval - 1e-6)) - 1];
    reading.resistance.add(record.tip_resistance);
    reading.friction.add(place.friction(record));
    if (!table.has_pore_pressure) continue;
    const auto pressures = place.pressures(record.depth, flow[i]);
    for (std::size_t k = 0; k < 3; ++k) reading.pressure[k].add(pressures[k]);
  }
  for (const auto& [index, reading] : readings) {
    // Not full: the run ended inside it. A record may miss the end by its own length.
    if (static_cast<double>(index + 1) * kCptInterval > reached + 0.1 * kCptInterval) continue;
    CptRow row{(static_cast<double>(index) + 0.5) * kCptInterval, *reading.resistance.value(),
               reading.friction.value()};
    for (std::size_t k = 0; k < 3; ++k) row.pore_pressure[k] = reading.pressure[k].value();
    table.rows.push_back(row);
  }
  return table;
}

std::string cpt_csv(const CptTable& table) {
  std::string text = "depth[m],qc[MPa],fs[kPa],Rf[%],";
  if (table.has_pore_pressure) text += "u1[kPa],u2[kPa],u3[kPa],";
  text += "model\n";
  for (const CptRow& row : table.rows) text += fmt::format("{},{}\n", fmt::join(cells(table, row, 3, ""), ","), kModel);
  return text;
}

std::string cpt_gef(const CptTable& table, std::chrono::year_month_day day) {
  struct Column {
    const char *unit, *name;
    int quantity;
  };
  std::vector<Column> columns = {{"m", "depth of the tip", 1},
                                 {"MPa", "cone resistance qc", 2},
                                 {"MPa", "sleeve friction fs", 3},
                                 {"%", "friction ratio Rf", 4}};
  if (table.has_pore_pressure) {
    columns.insert(columns.end(),
                   {{"MPa", "pore pressure u1", 5}, {"MPa", "pore pressure u2", 6}, {"MPa", "pore pressure u3", 7}});
  }
  std::string text = "#GEFID= 1, 1, 0\n#FILEOWNER= Seapile\n";
  text += fmt::format("#FILEDATE= {}, {}, {}\n", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                      static_cast<unsigned>(day.day()));
  text += fmt::format("#PROJECTID= {}\n#TESTID= simulated-{}-{}\n", kProject, table.case_id.substr(0, 10), table.run);
  text += "#REPORTCODE= GEF-CPT-Report, 1, 1, 2\n";
  text += fmt::format("#COMMENT= simulated by Seapile: {}, no ground was tested; it lies at no place\n", kModel);
  text += fmt::format("#COMMENT= means over {} m of depth; qc is the grains' force alone, without fluid pressure\n",
                      kCptInterval);
  text += "#COMMENT= fs is the mean over the sleeve below the initial surface\n";
  if (table.has_pore_pressure) text += "#COMMENT= pore pressures are zero at the bed's surface, at rest\n";
  text += fmt::format("#MEASUREMENTVAR= 1, {:.0f}, mm2, projected area of the tip per metre of depth (plane strain)\n",
                      table.width * 1e6);
  text += fmt::format("#COLUMN= {}\n", columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    text += fmt::format("#COLUMNINFO= {}, {}, {}, {}\n", i + 1, columns[i].unit, columns[i].name, columns[i].quantity);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) text += fmt::format("#COLUMNVOID= {}, {}\n", i + 1, kVoid);
  text += fmt::format("#COLUMNSEPARATOR= ;\n#RECORDSEPARATOR= !\n#LASTSCAN= {}\n#EOH=\n", table.rows.size());
  for (const CptRow& row : table.rows)
    text += fmt::format("{};!\n", fmt::join(cells(table, row, 6, fmt::format("{}", kVoid)), ";"));
  return text;
}

}  // namespace seapile::present
