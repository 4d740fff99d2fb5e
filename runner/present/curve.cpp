#include "runner/present/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "runner/present/figure.h"
#include "runner/present/replicates.h"
#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

std::string cell_text(const store::Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return fmt::format("{}", *value);
  if (const auto* words = std::get_if<std::string>(&cell)) return csv_field(*words);
  return "";
}

void write(std::FILE* out, const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), out) != text.size()) {
    throw store::StoreError(store::StoreError::Kind::io,
                            fmt::format("the curves cannot be written: {}", std::strerror(errno)));
  }
}

}  // namespace

void write_curves(const std::vector<CurveSource>& sources, std::FILE* out) {
  std::vector<Labels> labels;
  for (const CurveSource& source : sources) labels.push_back(source.labels);
  const store::Table parameters = label_table(labels);

  std::string header = "case,run";
  for (std::size_t i = 0; i < parameters.columns.size(); ++i) {
    header += "," + csv_heading(parameters.columns[i], parameters.units[i]);
  }
  simulation::Record any;
  simulation::columns(
      [&](const char* name, const char* unit, const char*, double&) { header += "," + csv_heading(name, unit); }, any);
  write(out, header + "\n");

  for (std::size_t k = 0; k < sources.size(); ++k) {
    std::string prefix = sources[k].case_id.substr(0, 10) + "," + sources[k].run;
    for (const store::Cell& cell : parameters.rows[k]) prefix += "," + cell_text(cell);
    std::string lines;
    for (const simulation::Record& record : store::read_series(sources[k].run_folder)) {
      lines += prefix;
      simulation::columns(
          [&](const char*, const char*, const char*, double value) { lines += fmt::format(",{}", value); }, record);
      lines += "\n";
    }
    write(out, lines);
  }
  if (std::fflush(out) != 0) write(out, "");
}

void write_bands(const std::vector<CurveSource>& sources, std::FILE* out, double level) {
  std::vector<Labels> cases;
  std::vector<CurveGroup> groups;
  for (const CurveSource& source : sources) {
    Labels labels = source.labels;
    std::erase_if(labels, [](const auto& label) { return label.first == kSeed; });
    const auto found = static_cast<std::size_t>(std::ranges::find(cases, labels) - cases.begin());
    if (found == cases.size()) {
      cases.push_back(std::move(labels));
      groups.emplace_back();
    }
    groups[found].packings.push_back(read_resistance(source.run_folder));
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
