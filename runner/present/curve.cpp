#include "runner/present/curve.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

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

}  // namespace seapile::present
