// The table of extremes, row by row through the real program: nothing crashes, hangs, or ends with a result that breaks
// its bounds without saying so.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kFolder = SEAPILE_EXTREMES;

struct Row {
  std::string name, scene;
  std::vector<std::string> settings;
  std::string expected;
  std::vector<std::string> details;  ///< bounds, or what is told
};

void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

std::vector<std::string> parts(const std::string& text, char between) {
  std::vector<std::string> all;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, between);) {
    const auto first = part.find_first_not_of(' ');
    all.push_back(first == std::string::npos ? "" : part.substr(first, part.find_last_not_of(' ') - first + 1));
  }
  return all;
}

std::vector<Row> matrix() {
  std::ifstream file(kFolder / "matrix.txt");
  std::vector<Row> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto cells = parts(line, '|');
    if (cells.size() != 5) throw std::runtime_error("not a row: " + line);
    rows.push_back({cells[0], cells[1], parts(cells[2], ';'), cells[3], parts(cells[4], ';')});
  }
  return rows;
}

/// Whether "metric <= 1e-3" or "metric >= 0" holds; a number that is none keeps no bound.
void expect_bound(const std::string& bound, const nlohmann::json& row) {
  const auto words = parts(bound, ' ');
  ASSERT_EQ(words.size(), 3u) << bound;
  ASSERT_TRUE(row.contains(words[0])) << "no metric " << words[0];
  ASSERT_TRUE(row.at(words[0]).is_number()) << words[0] << " is no number";
  const double value = row.at(words[0]), limit = std::stod(words[2]);
  EXPECT_TRUE(words[1] == "<=" ? value <= limit : words[1] == ">=" && value >= limit) << bound << ": it is " << value;
}

void expect_bounds(const Workplace& place, const Row& row) {
  std::string columns;
  for (const std::string& bound : row.details) columns += (columns.empty() ? "" : ",") + parts(bound, ' ').front();
  const Finished answer = place.run({"query", row.scene, "--columns", columns, "--format", "json"});
  ASSERT_EQ(answer.exit_code, 0) << answer.error;
  const auto table = nlohmann::json::parse(answer.out).at("rows");
  ASSERT_EQ(table.size(), 1u);
  for (const std::string& bound : row.details) expect_bound(bound, table.at(0));
}

class Extremes : public testing::TestWithParam<Row> {};

TEST_P(Extremes, DoWhatTheTableSays) {
  const Row& row = GetParam();
  const Workplace place;
  fs::copy(kFolder / "scenes", place.folder());
  std::vector<std::string> arguments{"run", row.scene + ".json", "--jobs", "1"};
  for (const std::string& setting : row.settings) arguments.insert(arguments.end(), {"--set", setting});
  const Finished run = place.run(arguments);
  if (row.expected == "runs") {
    ASSERT_EQ(run.exit_code, 0) << run.error;
    expect_bounds(place, row);
  } else if (row.expected == "tells") {
    EXPECT_EQ(run.exit_code, 0);
    EXPECT_THAT(run.error, HasSubstr(row.details.front()));
  } else if (row.expected == "stops") {
    EXPECT_EQ(run.exit_code, 1) << run.error;
    EXPECT_THAT(run.error, HasSubstr(row.details.front()));
    EXPECT_EQ(place.run({"verify"}).exit_code, 0) << "what there is of it is sealed";
  } else {
    ASSERT_EQ(row.expected, "refused");
    EXPECT_EQ(run.exit_code, 2) << run.error;
    EXPECT_THAT(run.error, HasSubstr(row.details.front()));
    EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1) << run.error;
    EXPECT_FALSE(fs::exists(place.results()));
  }
}

INSTANTIATE_TEST_SUITE_P(Matrix, Extremes, testing::ValuesIn(matrix()), [](const auto& one) {
  std::string name;
  for (const char c : one.param.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
});

}  // namespace
}  // namespace seapile::commands
