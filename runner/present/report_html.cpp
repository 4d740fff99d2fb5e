#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "runner/present/gnuplot.h"
#include "runner/present/report.h"
#include "runner/present/report_files.h"

namespace seapile::present {
namespace {

using nlohmann::ordered_json;

const char* name_of(Tone tone) {
  constexpr std::array kNames = {"plain", "good", "bad", "open", "finding"};
  return kNames.at(static_cast<std::size_t>(tone));
}

const char* name_of(LineKind kind) {
  constexpr std::array kNames = {"record", "mean", "band", "reference"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::string base64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int written =
      ::EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                        reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(written));
  return text;
}

/// Numbers, null where one is none: JSON knows no other word for a gap.
ordered_json numbers(const std::vector<double>& values) {
  ordered_json list = ordered_json::array();
  for (const double value : values) list.push_back(std::isfinite(value) ? ordered_json(value) : ordered_json());
  return list;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

ordered_json json_of(const ReportAxis& axis) { return {{"name", axis.name}, {"unit", axis.unit}}; }

ordered_json json_of(const ReportText& words) { return {{"type", "text"}, {"paragraphs", words.paragraphs}}; }

ordered_json json_of(const ReportTable& table) {
  ordered_json columns = ordered_json::array(), tones = ordered_json::array();
  for (const ShownColumn& column : shown_columns(table.table, table.means)) {
    const bool empty = std::ranges::all_of(column.cells, [](const std::string& cell) { return trimmed(cell) == "-"; });
    if (empty && !column.cells.empty()) continue;
    const bool toned = !table.toned.empty() && column.name == table.toned;
    ordered_json cells = ordered_json::array();
    for (const std::string& cell : column.cells) cells.push_back(trimmed(cell));
    // A verdict comes first: on a narrow screen it would be out of sight at the end.
    columns.insert(toned ? columns.begin() : columns.end(),
                   ordered_json{{"name", column.name},
                                {"unit", column.unit == "-" ? "" : column.unit},
                                {"numbers", column.numbers},
                                {"toned", toned},
                                {"cells", std::move(cells)}});
  }
  for (const Tone tone : table.tones) tones.push_back(name_of(tone));
  return {{"type", "table"},
          {"caption", table.caption},
          {"rows", table.table.rows.size()},
          {"columns", columns},
          {"tones", tones},
          {"notes", table.notes},
          {"folded", table.folded},
          {"csv", text(table.full.value_or(table.table), Format::csv)}};
}

ordered_json json_of(const ReportChart& chart) {
  ordered_json groups = ordered_json::array(), lines = ordered_json::array();
  for (std::size_t g = 0; g < chart.groups.size(); ++g) {
    const auto [colour, dash] = style_of(g);
    groups.push_back({{"label", chart.groups[g]}, {"colour", colour}, {"dash", dash}});
  }
  for (const ReportLine& line : chart.lines) {
    lines.push_back({{"kind", name_of(line.kind)},
                     {"group", line.group},
                     {"label", line.label},
                     {"x", numbers(line.x)},
                     {"y", numbers(line.y)},
                     {"tolerance", numbers(line.tolerance)}});
  }
  return {{"type", "chart"},           {"title", chart.title},
          {"note", chart.note},        {"x", json_of(chart.x)},
          {"y", json_of(chart.y)},     {"downwards", chart.downwards},
          {"records", chart.records},  {"groups", std::move(groups)},
          {"lines", std::move(lines)}, {"values", json_of(chart.values)}};
}

ordered_json json_of(const ReportBars& bars) {
  return {{"type", "bars"},
          {"title", bars.title},
          {"x", json_of(bars.x)},
          {"labels", bars.labels},
          {"values", numbers(bars.values)}};
}

ordered_json json_of(const ReportPicture& picture) {
  return {{"type", "picture"}, {"name", picture.name}, {"svg", base64(picture.svg)}};
}

ordered_json json_of(const ReportLog& log) {
  return {{"type", "log"},        {"title", log.title}, {"outcome", log.outcome},
          {"reason", log.reason}, {"where", log.where}, {"log", log.log}};
}

ordered_json json_of(const Report& report) {
  ordered_json counts = ordered_json::array(), sections = ordered_json::array();
  for (const ReportCount& count : report.counts)
    counts.push_back({{"words", count.words}, {"tone", name_of(count.tone)}});
  for (const ReportSection& section : report.sections) {
    ordered_json blocks = ordered_json::array();
    for (const ReportBlock& block : section.blocks)
      blocks.push_back(std::visit([](const auto& one) { return json_of(one); }, block));
    sections.push_back({{"id", section.id}, {"title", section.title}, {"blocks", std::move(blocks)}});
  }
  return {{"schema", "seapile/report/1"}, {"study", report.study}, {"question", report.question},
          {"made", report.made},          {"counts", counts},      {"sections", sections}};
}

/// The data as text that cannot end the element it stands in: no "<" is left, and what is no UTF-8 is replaced.
std::string island(const Report& report) {
  const std::string text = json_of(report).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  std::string safe;
  for (const char c : text) c == '<' ? safe += "\\u003c" : safe += c;
  return safe;
}

/// The page with each "{{name}}" replaced; what is put in is not looked through again.
std::string filled(std::string_view page, const std::vector<std::pair<std::string_view, std::string_view>>& parts) {
  std::string result;
  while (true) {
    const auto open = page.find("{{"), close = page.find("}}");
    if (open == std::string_view::npos) return result += page;
    const std::string_view name = page.substr(open + 2, close - open - 2);
    const auto part = std::ranges::find(parts, name, &std::pair<std::string_view, std::string_view>::first);
    if (part == parts.end()) throw std::logic_error(fmt::format("the report's page asks for \"{}\"", name));
    result += page.substr(0, open);
    result += part->second;
    page.remove_prefix(close + 2);
  }
}

}  // namespace

std::string report_html(const Report& report) {
  return filled(kReportPage, {{"style", kReportStyle},
                              {"data", island(report)},
                              {"library", kChartLibrary},
                              {"charts", kReportCharts},
                              {"script", kReportScript}});
}

}  // namespace seapile::present
