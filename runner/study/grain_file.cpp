#include "runner/study/grain_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "runner/study/csv.h"
#include "runner/study/problem_text.h"
#include "runner/study/sha256.h"
#include "runner/study/study.h"
#include "runner/study/text_file.h"
#include "runner/study/unit.h"
#include "solver/grains/neighbours.h"

namespace seapile::study {
namespace {

constexpr std::size_t kMostFileBytes = std::size_t{1} << 30;
constexpr std::size_t kMostRows = 10'000'000;  // As many as GrainsSpec::count allows.
constexpr double kLargestRadius = 10;          // [m], as RadiusSpec allows.
// Soft contacts let a settled grain pass a wall by a share of its radius that is well below this one.
constexpr double kWallOverlap = 0.05;
// What is deeper is pushed apart by steps that mean nothing; solver/simulation/bounds.h lets no step leave more.
constexpr double kGrainOverlap = 0.5;
constexpr std::string_view kHeader = "id,x,y,radius";

/// Takes one line apart; absent after a report.
class RowReader {
 public:
  RowReader(const scene::DomainSpec& box, base::Problems& problems) : box_(box), problems_(problems) {}

  std::optional<GrainRow> read(std::string_view line, std::size_t line_number) {
    std::array<std::string_view, 4> fields;
    std::size_t count = 0;
    for (std::size_t start = 0; start <= line.size();) {
      const std::size_t comma = std::min(line.find(',', start), line.size());
      if (count < fields.size()) fields[count] = trimmed(line.substr(start, comma - start));
      ++count;
      start = comma + 1;
    }
    if (count != fields.size()) return refuse(line_number, fmt::format("has {} fields", count), "4: id,x,y,radius");

    const auto id = csv_number<std::int64_t>(fields[0]);
    if (!id || *id < 0 || *id > (std::int64_t{1} << 53)) {
      return refuse(line_number, fmt::format("id \"{}\" is no whole number", fields[0].substr(0, 40)),
                    "from 0 to 2^53");
    }
    std::array<double, 3> lengths{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto value = csv_number<double>(fields[i + 1]);
      if (!value) {
        constexpr std::array kNames = {"x", "y", "radius"};
        return refuse(line_number, fmt::format("{} \"{}\" is no finite number", kNames[i], fields[i + 1].substr(0, 40)),
                      "a number in m");
      }
      lengths[i] = *value == 0 ? 0.0 : *value;
    }
    const GrainRow row{*id, lengths[0], lengths[1], lengths[2]};
    if (!(row.radius > 0) || row.radius > kLargestRadius) {
      return refuse(line_number, fmt::format("radius {} is out of range", number_text(row.radius)),
                    "more than 0 m, at most 10 m");
    }
    const double reach = (1 - kWallOverlap) * row.radius;
    if (std::abs(row.x) + reach > box_.width / 2 || row.y - reach < 0 || row.y + reach > box_.height) {
      return refuse(line_number,
                    fmt::format("the grain at ({}, {}) is outside the box", number_text(row.x), number_text(row.y)),
                    fmt::format("x within {} m of the middle, y from 0 to {} m", number_text(box_.width / 2),
                                number_text(box_.height)));
    }
    return row;
  }

  std::nullopt_t refuse(std::size_t line_number, const std::string& what, std::string allowed) {
    problems_.refuse(line_number, what, std::move(allowed));
    return std::nullopt;
  }

  /// Says how many problems were left out.
  void finish() { problems_.finish(); }

 private:
  const scene::DomainSpec& box_;
  LineProblems problems_;
};

std::string shortest(double number) {
  std::array<char, 32> buffer;
  return std::string(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr);
}

/// Refuses each grain that lies too deep in an earlier one, as a contact's normal there points to the wrong side, and
/// of two grains at one place nowhere. `lines`: (id, line) of each row.
void refuse_overlaps(const std::vector<GrainRow>& rows, const std::vector<std::pair<std::int64_t, std::size_t>>& lines,
                     RowReader& reader) {
  constexpr std::int32_t kAtOnce = 1024;  // so that a file of one grain over and over does not fill the memory
  std::vector<grains::Disc> discs;
  for (const GrainRow& row : rows) discs.push_back({row.x, row.y, row.radius});
  const grains::CellGrid grid(discs, 0);
  std::vector<bool> refused(rows.size(), false);
  std::vector<grains::Pair> touching;
  const auto count = static_cast<std::int32_t>(rows.size());
  for (std::int32_t first = 0; first < count; first += kAtOnce) {
    touching.clear();
    grid.find_pairs(first, std::min(first + kAtOnce, count), touching);
    for (const auto [i, j] : touching) {
      const grains::Disc &a = discs[i], &b = discs[j];
      const double overlap = (a.radius + b.radius - std::hypot(a.x - b.x, a.y - b.y)) / std::min(a.radius, b.radius);
      if (overlap <= kGrainOverlap || refused[j]) continue;
      refused[j] = true;
      reader.refuse(
          lines[j].second,
          fmt::format("the grain overlaps that of line {} by {:.2g} radii of the smaller", lines[i].second, overlap),
          fmt::format("at most {}", number_text(kGrainOverlap)));
    }
  }
}

}  // namespace

std::vector<GrainRow> parse_grains(std::string_view csv, const scene::DomainSpec& box, base::Problems& problems) {
  std::vector<GrainRow> rows;
  std::vector<std::pair<std::int64_t, std::size_t>> lines;  // (id, line), to tell which lines share an id.
  RowReader reader(box, problems);
  std::size_t line_number = 0;
  for (std::size_t start = 0; start < csv.size();) {
    const std::size_t end = std::min(csv.find('\n', start), csv.size());
    const std::string_view line = trimmed(csv.substr(start, end - start));
    start = end + 1;
    ++line_number;
    if (line_number == 1) {
      if (line == kHeader) continue;
      reader.refuse(1, fmt::format("\"{}\" is not the header", line.substr(0, 60)), std::string(kHeader));
      return {};
    }
    if (line.empty() && start >= csv.size()) break;
    if (rows.size() == kMostRows) {
      reader.refuse(line_number, "is one grain too many", "at most 10000000 grains");
      break;
    }
    if (const auto row = reader.read(line, line_number)) {
      rows.push_back(*row);
      lines.emplace_back(row->id, line_number);
    }
  }
  if (line_number == 0) reader.refuse(1, "is missing", std::string(kHeader));

  if (problems.empty()) refuse_overlaps(rows, lines, reader);
  std::sort(lines.begin(), lines.end());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].first != lines[i - 1].first) continue;
    reader.refuse(lines[i].second, fmt::format("id {} is already in line {}", lines[i].first, lines[i - 1].second),
                  "each id once");
  }
  if (rows.empty() && problems.empty())
    reader.refuse(line_number, "is the last: the file has no grains", "at least 1 grain");
  reader.finish();
  std::sort(rows.begin(), rows.end(), [](const GrainRow& a, const GrainRow& b) { return a.id < b.id; });
  return rows;
}

std::string grains_content(const std::vector<GrainRow>& rows) {
  std::string text(kHeader);
  for (const GrainRow& row : rows) {
    text += '\n' + std::to_string(row.id) + ',' + shortest(row.x) + ',' + shortest(row.y) + ',' + shortest(row.radius);
  }
  return sha256(text);
}

namespace {

std::vector<GrainRow> rows_of(const std::filesystem::path& path, const scene::DomainSpec& box,
                              base::Problems& problems) {
  std::string trouble;
  const auto csv = read_text(path, kMostFileBytes, trouble);
  if (csv) return parse_grains(*csv, box, problems);
  problems.push_back({"", trouble, "", ""});
  return {};
}

}  // namespace

GrainFile find_grains(const std::filesystem::path& folder, const std::string& name, const scene::DomainSpec& box,
                      base::Problems& problems) {
  GrainFile file;
  std::string trouble;
  const auto path = path_below(folder, name, trouble);
  if (path && !is_printable(path->string())) trouble = "lies in a folder whose name is not plain UTF-8 text";
  if (!trouble.empty()) {
    problems.push_back({"", fmt::format("\"{}\" {}", name, trouble), "a file in the study's folder", ""});
    return file;
  }
  base::Problems in_file;
  const std::vector<GrainRow> rows = rows_of(*path, box, in_file);
  for (auto& problem : in_file) {
    problem.what = fmt::format("\"{}\" {}", name, problem.what);
    problems.push_back(std::move(problem));
  }
  if (rows.empty() || !in_file.empty()) return file;

  file.path = *path;
  file.content = grains_content(rows);
  file.count = static_cast<std::int64_t>(rows.size());
  const auto by_radius = [](const GrainRow& a, const GrainRow& b) { return a.radius < b.radius; };
  const auto [smallest, largest] = std::minmax_element(rows.begin(), rows.end(), by_radius);
  file.smallest = smallest->radius;
  file.largest = largest->radius;
  for (const GrainRow& row : rows) file.top = std::max(file.top, row.y + row.radius);
  return file;
}

std::vector<simulation::Array> read_grain_file(const scene::BedSpec& bed) {
  base::Problems problems;
  const std::vector<GrainRow> rows = rows_of(bed.file, bed.domain, problems);
  if (problems.empty() && grains_content(rows) != bed.file_content) {
    problems.push_back(
        {"", "holds other grains than when the study was read", "the grains with content " + bed.file_content, ""});
  }
  if (!problems.empty()) throw BadInput(bed.file, std::move(problems));

  std::vector<std::int64_t> ids;
  std::vector<double> positions, radii;
  for (const GrainRow& row : rows) {
    ids.push_back(row.id);
    positions.insert(positions.end(), {row.x, row.y});
    radii.push_back(row.radius);
  }
  using simulation::Entity;
  return {{{"grains/id", "-", "identity of the grain", 1, Entity::grain}, std::move(ids)},
          {{"grains/position", "m", "centre of the grain", 2, Entity::grain}, std::move(positions)},
          {{"grains/radius", "m", "radius of the grain", 1, Entity::grain}, std::move(radii)}};
}

}  // namespace seapile::study
