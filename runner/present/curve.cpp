#include "runner/present/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "runner/present/figure.h"
#include "runner/present/replicates.h"
#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

void write(std::FILE* out, const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), out) != text.size()) {
    throw store::StoreError(store::StoreError::Kind::io,
                            fmt::format("the curves cannot be written: {}", std::strerror(errno)));
  }
}

/// What is said of a column.
struct Column {
  std::string name, unit;
};

template <class R>
std::vector<Column> all_columns() {
  std::vector<Column> list;
  const R any;
  columns([&](const char* name, const char* unit, const char*, double) { list.push_back({name, unit}); }, any);
  return list;
}

std::vector<Column> all_columns(Series series) {
  if (series == Series::grains) return all_columns<simulation::Record>();
  if (series == Series::water) return all_columns<simulation::FlowRecord>();
  std::vector<Column> both = all_columns<simulation::Record>();
  const std::size_t of_grains = both.size();
  for (Column& column : all_columns<simulation::FlowRecord>()) {
    const auto end = both.begin() + static_cast<std::ptrdiff_t>(of_grains);
    const bool shared = std::find_if(both.begin(), end, [&](const Column& c) { return c.name == column.name; }) != end;
    both.push_back({(shared ? "fluid:" : "") + column.name, column.unit});
  }
  return both;
}

/// Where a column stands among all of them.
std::size_t place_of(Series series, const std::string& name) {
  const std::vector<Column> known = all_columns(series);
  const auto found = std::ranges::find(known, name, &Column::name);
  if (found == known.end()) throw std::logic_error("a series has no column " + name);
  return static_cast<std::size_t>(found - known.begin());
}

template <class R>
std::vector<std::vector<double>> chosen(const std::vector<R>& records, const std::vector<std::size_t>& places) {
  std::vector<std::vector<double>> values(places.size());
  std::vector<double> row;
  for (const R& record : records) {
    row.clear();
    columns([&](const char*, const char*, const char*, double value) { row.push_back(value); }, record);
    for (std::size_t c = 0; c < places.size(); ++c) values[c].push_back(row[places[c]]);
  }
  return values;
}

/// The same of both series of a run. What is at least the number of the grains' columns is a place among the fluid's.
std::vector<std::vector<double>> chosen_of_both(const CurveSource& source, const std::vector<std::size_t>& places) {
  const std::size_t of_grains = all_columns(Series::grains).size();
  std::vector<std::size_t> grains, fluid;
  for (const std::size_t place : places) {
    if (place < of_grains) {
      grains.push_back(place);
    } else {
      fluid.push_back(place - of_grains);
    }
  }
  const std::vector<simulation::Record> records = store::read_series(source.run_folder);
  const std::vector<simulation::FlowRecord> flow_records = store::read_flow_series(source.run_folder);
  auto of_records = chosen(records, grains), of_flow = chosen(flow_records, fluid);
  if (flow_records.empty()) {
    for (auto& column : of_flow) column.assign(records.size(), std::numeric_limits<double>::quiet_NaN());
  } else if (flow_records.size() != records.size()) {
    throw store::StoreError(store::StoreError::Kind::damaged,
                            fmt::format("{}: {} records of the grains and {} of the fluid, which belong together",
                                        source.run_folder.string(), records.size(), flow_records.size()));
  }
  std::vector<std::vector<double>> values;
  auto next_of_records = of_records.begin(), next_of_flow = of_flow.begin();
  for (const std::size_t place : places) {
    values.push_back(std::move(place < of_grains ? *next_of_records++ : *next_of_flow++));
  }
  return values;
}

}  // namespace

std::vector<PackedCase> packed(const std::vector<CurveSource>& sources) {
  std::vector<PackedCase> cases;
  for (const CurveSource& source : sources) {
    Labels labels = source.labels;
    std::erase_if(labels, [](const auto& label) { return label.first == kSeed; });
    auto found = std::ranges::find(cases, labels, &PackedCase::labels);
    if (found == cases.end()) found = cases.insert(cases.end(), {std::move(labels), {}});
    found->packings.push_back(source);
  }
  return cases;
}

std::string cell_text(const store::Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return fmt::format("{}", *value);
  if (const auto* words = std::get_if<std::string>(&cell)) return csv_field(*words);
  return "";
}

std::vector<std::string> column_names(Series series) {
  std::vector<std::string> names;
  for (const Column& column : all_columns(series)) names.push_back(column.name);
  return names;
}

std::vector<std::string> held_columns(const std::vector<CurveSource>& sources, Series series) {
  const std::vector<std::string> names = column_names(series);
  if (series == Series::grains) return names;
  const std::size_t of_grains = series == Series::both ? all_columns(Series::grains).size() : 0;
  std::vector<bool> held(names.size());
  std::fill_n(held.begin(), of_grains, true);
  for (const CurveSource& source : sources) {
    const auto values = read_columns(source, series, names);
    for (std::size_t c = 0; c < names.size(); ++c) {
      held[c] = held[c] || std::ranges::any_of(values[c], [](double value) { return !std::isnan(value); });
    }
  }
  std::vector<std::string> kept;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (held[c]) kept.push_back(names[c]);
  }
  return kept;
}

std::string unit_of(Series series, const std::string& column) {
  return all_columns(series)[place_of(series, column)].unit;
}

std::vector<std::vector<double>> read_columns(const CurveSource& source, Series series,
                                              const std::vector<std::string>& columns) {
  std::vector<std::size_t> places;
  for (const std::string& name : columns) places.push_back(place_of(series, name));
  if (series == Series::both) return chosen_of_both(source, places);
  return series == Series::grains ? chosen(store::read_series(source.run_folder), places)
                                  : chosen(store::read_flow_series(source.run_folder), places);
}

void write_curves(const std::vector<CurveSource>& sources, Series series, const std::vector<std::string>& columns,
                  std::FILE* out) {
  std::vector<Labels> labels;
  for (const CurveSource& source : sources) labels.push_back(source.labels);
  const store::Table parameters = label_table(labels);

  std::string header = "case,run";
  for (std::size_t i = 0; i < parameters.columns.size(); ++i) {
    header += "," + csv_heading(parameters.columns[i], parameters.units[i]);
  }
  for (const std::string& name : columns) header += "," + csv_heading(name, unit_of(series, name));
  write(out, header + "\n");

  for (std::size_t k = 0; k < sources.size(); ++k) {
    std::string prefix = sources[k].case_id.substr(0, 10) + "," + sources[k].run;
    for (const store::Cell& cell : parameters.rows[k]) prefix += "," + cell_text(cell);
    const std::vector<std::vector<double>> values = read_columns(sources[k], series, columns);
    std::string lines;
    for (std::size_t i = 0; i < values.front().size(); ++i) {
      lines += prefix;
      for (const auto& column : values) lines += fmt::format(",{}", column[i]);
      lines += "\n";
    }
    write(out, lines);
  }
  if (std::fflush(out) != 0) write(out, "");
}

void write_bands(const std::vector<CurveSource>& sources, std::FILE* out, double level) {
  std::vector<Labels> cases;
  std::vector<CurveGroup> groups;
  for (const PackedCase& one : packed(sources)) {
    cases.push_back(one.labels);
    groups.emplace_back();
    for (const CurveSource& source : one.packings) groups.back().packings.push_back(read_resistance(source.run_folder));
  }
  const store::Table parameters = label_table(cases);
  std::string text;
  for (std::size_t i = 0; i < parameters.columns.size(); ++i) {
    text += csv_heading(parameters.columns[i], parameters.units[i]) + ",";
  }
  text += "depth[m],n,mean[Pa],low[Pa],high[Pa]\n";
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (const auto& [depth, mean] : band_of_packings(groups[k], level)) {
      for (const store::Cell& cell : parameters.rows[k]) text += cell_text(cell) + ",";
      text += fmt::format("{:.6g},{},{}", depth, mean.n, mean.mean);
      text += mean.n > 1 ? fmt::format(",{},{}\n", mean.low, mean.high) : ",,\n";
    }
  }
  write(out, text);
  if (std::fflush(out) != 0) write(out, "");
}

}  // namespace seapile::present
