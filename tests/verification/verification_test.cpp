// One test for every law and solver; docs/verification.md tells of the same laws, with values that were measured.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/verification/document.h"
#include "tests/verification/law.h"

namespace seapile::verification {
namespace {

const std::string kRegenerate = "; regenerate the tables: verification_table --update docs/verification.md";

std::string document() { return read_document(std::string(SEAPILE_SOURCE_DIR) + "/docs/verification.md"); }

struct Case {
  Law law;
  Solver solver;
};
// GoogleTest prints a case by this, and not by its bytes.
void PrintTo(const Case& c, std::ostream* stream) { *stream << c.law.name << ", " << c.solver.name; }

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const Law& law : laws())
    for (const Solver& solver : solvers())
      if (law.concerns(solver)) all.push_back({law, solver});
  return all;
}

struct Verification : testing::TestWithParam<Case> {};

TEST_P(Verification, Holds) {
  const auto& [law, solver] = GetParam();
  const std::string documented = tables_of(document())[law.name];
  const std::vector<Row> rows = law.rows(solver, Size::small);
  EXPECT_FALSE(rows.empty());
  for (const Row& row : rows) {
    EXPECT_TRUE(row.holds()) << row.quantity << " [" << row.unit << "], " << row.where << ": " << row.value
                             << (row.relation == Relation::equals    ? ", closed form "
                                 : row.relation == Relation::at_most ? ", at most "
                                                                     : ", at least ")
                             << row.expected << ", difference " << row.difference() << ", tolerance " << row.tolerance
                             << " (" << row.why << ")";
    EXPECT_NE(documented.find(row_head(row, solver.name)), std::string::npos)
        << "docs/verification.md lacks " << law.name << ": " << row.quantity << " of " << solver.name << kRegenerate;
  }
  // No row of the document that is no longer measured.
  std::size_t lines = 0;
  std::istringstream text(documented);
  for (std::string line; std::getline(text, line);) lines += line.find("| " + solver.name + " |") != std::string::npos;
  EXPECT_EQ(lines, rows.size()) << "rows of " << law.name << " in docs/verification.md" << kRegenerate;
}

INSTANTIATE_TEST_SUITE_P(Laws, Verification, testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.law.name + "_" + one.param.solver.name; });

TEST(VerificationDocument, HasAHeadingAndATableForEveryLawAndForNothingElse) {
  std::vector<std::string> names;
  for (const Law& law : laws()) names.push_back(law.name);
  EXPECT_EQ(headings_of(document()), names);
  std::set<std::string> tables;
  for (const auto& [name, rows] : tables_of(document())) tables.insert(name);
  EXPECT_EQ(tables, std::set<std::string>(names.begin(), names.end()));
}

TEST(VerificationDocument, TellsOfNothingThatDoesNotHold) {
  EXPECT_EQ(document().find("does not hold"), std::string::npos);
}

// The rows themselves: what they call right and wrong.
TEST(VerificationRow, HoldsWithinItsToleranceAndOnItsSideOfABound) {
  const auto row = [](double value, double expected, double tolerance, Relation relation) {
    return Row{"", "", "", value, expected, tolerance, "", relation}.holds();
  };
  EXPECT_TRUE(row(1.1, 1, 0.2, Relation::equals));
  EXPECT_FALSE(row(1.3, 1, 0.2, Relation::equals));
  EXPECT_FALSE(row(0.7, 1, 0.2, Relation::equals));
  EXPECT_TRUE(row(-5, 1, 0, Relation::at_most));
  EXPECT_FALSE(row(1.3, 1, 0.2, Relation::at_most));
  EXPECT_TRUE(row(5, 1, 0, Relation::at_least));
  EXPECT_FALSE(row(0.7, 1, 0.2, Relation::at_least));
  for (const Relation relation : {Relation::equals, Relation::at_most, Relation::at_least})
    EXPECT_FALSE(row(std::nan(""), 1, 1e9, relation));
}

TEST(VerificationRow, TheWorstOfASweepIsTheFarthestInItsTolerance) {
  Worst worst;
  worst.add("a", 1.1, 1, 1);
  worst.add("b", 1.01, 1, 0.001);
  worst.add("c", 2, 1, 100);
  EXPECT_EQ(worst.row("", "", "").where, "b, worst of 3");
  worst.add("d", std::nan(""), 1, 1);
  EXPECT_EQ(worst.row("", "", "").where, "d, worst of 4");
}

}  // namespace
}  // namespace seapile::verification
