#include "runner/study/reference_file.h"

#include <gmock/gmock.h>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::HasSubstr;

const std::string kHead = "# source: Somebody (2024), table 2\n";
const std::string kHeader = "pile.tip, pile.driving.constant.speed [cm/s], q_c [kPa], tolerance, reason\n";

ReferenceFile good(const std::string& text, const std::string& metric = "q_c") {
  base::Problems problems;
  ReferenceFile file = parse_reference(text, metric, problems);
  EXPECT_TRUE(problems.empty()) << sentence("f", problems[0]);
  return file;
}

/// The sentences about a file's problems.
std::string bad(const std::string& text) {
  base::Problems problems;
  parse_reference(text, "q_c", problems);
  std::string all;
  for (const auto& problem : problems) all += sentence("f", problem) + "\n";
  return all;
}
std::string bad_row(const std::string& row) { return bad(kHead + kHeader + row + "\n"); }
std::string bad_header(const std::string& header) { return bad(kHead + header + "\n"); }

TEST(ReferenceFileText, ARowIsASourceConditionsAValueAToleranceAndItsReason) {
  const ReferenceFile file = good(kHead + kHeader + "flat, 6, 44.3, 1.5, \"read off a figure, twice\"\n");
  EXPECT_EQ(file.source, "Somebody (2024), table 2");
  ASSERT_EQ(file.rows.size(), 1u);
  const ReferenceRow& row = file.rows[0];
  EXPECT_EQ(row.line, 3u);
  EXPECT_EQ(row.value, 44.3);
  EXPECT_EQ(file.unit, "kPa");
  EXPECT_EQ(row.tolerance, 1.5);
  EXPECT_EQ(row.reason, "read off a figure, twice");
  EXPECT_EQ(row.which.conditions, (std::vector<std::pair<std::string, Resolved>>{
                                      {"pile.tip", std::string("flat")}, {"pile.driving.constant.speed", 0.06}}));
}

// The double of a cell has to be the one of the study, or a row would match nothing.
TEST(ReferenceFileText, ACellIsTheDoubleThatTheStudyWouldHave) {
  for (const char* cell : {"6", "6.0", "0.6e1"}) {
    const auto file = good(kHead + kHeader + "flat, " + cell + ", 1, 1, x\n");
    EXPECT_EQ(file.rows[0].which.conditions[1].second, Resolved(0.06)) << cell;
  }
  const auto angle = good(kHead + "pile.tip.conical.apex_angle [deg], q_c [-], tolerance, reason\n60, 1, 1, x\n");
  EXPECT_EQ(angle.rows[0].which.conditions[0].second, Resolved(std::acos(-1.0) / 3));
}

TEST(ReferenceFileText, AbsenceTruthAndPlainNumbersAreCellsToo) {
  const auto file =
      good(kHead + "fluid, bed.seed, contact.precision, q_c [-], tolerance, reason\nnull, 3, double, 1, 1, x\n");
  EXPECT_EQ(file.rows[0].which.conditions,
            (std::vector<std::pair<std::string, Resolved>>{
                {"fluid", nullptr}, {"bed.seed", 3.0}, {"contact.precision", std::string("double")}}));
}

TEST(ReferenceFileText, WithoutPathsItIsOfEveryCase) {
  const auto file = good(kHead + "q_c [-], tolerance, reason\n1, 1, x\n");
  EXPECT_TRUE(file.rows[0].which.conditions.empty());
}

TEST(ReferenceFileText, TheFirstLineNamesTheSource) {
  EXPECT_THAT(bad(kHeader + "flat, 6, 1, 1, x\n"), HasSubstr("f: line 1: does not name the source"));
  EXPECT_THAT(bad("# source: \n" + kHeader + "flat, 6, 1, 1, x\n"), HasSubstr("line 1: does not name the source"));
  EXPECT_THAT(bad(""), HasSubstr("line 1: does not name the source"));
  EXPECT_THAT(bad(kHead), HasSubstr("line 2: is missing: the file has no header"));
  EXPECT_THAT(bad(kHead + kHeader), HasSubstr("line 2: is the last: the file has no values"));
}

TEST(ReferenceFileText, AWrongHeaderIsNamedWithWhatIsAllowed) {
  EXPECT_THAT(bad_header("q_c [kPa], tolerance"),
              HasSubstr("line 2: is not the header; allowed: [path [unit],]... q_c"));
  EXPECT_THAT(bad_header("q_d [kPa], tolerance, reason"), HasSubstr("\"q_d\" is not the metric of the check"));
  EXPECT_THAT(bad_header("q_c, tolerance, reason"), HasSubstr("q_c has no unit; allowed: q_c [Pa], or q_c [-]"));
  EXPECT_THAT(bad_header("q_c [kPaa], tolerance, reason"), HasSubstr("unknown unit \"kPaa\""));
  EXPECT_THAT(bad_header("q_c [kPaa], tolerance, reason"), HasSubstr("did you mean \"kPa\"?"));
  EXPECT_THAT(bad_header("pile.depht [m], q_c [-], tolerance, reason"), HasSubstr("did you mean \"pile.depth\"?"));
  EXPECT_THAT(bad_header("pile.depth, q_c [-], tolerance, reason"), HasSubstr("allowed: pile.depth [m]"));
  EXPECT_THAT(bad_header("pile.depth [s], q_c [-], tolerance, reason"), HasSubstr("allowed: pile.depth [m]"));
  EXPECT_THAT(bad_header("pile.tip [m], q_c [-], tolerance, reason"), HasSubstr("pile.tip has no unit, not m"));
  EXPECT_THAT(bad_header("pile.tip, pile.tip, q_c [-], tolerance, reason"), HasSubstr("pile.tip is there twice"));
}

TEST(ReferenceFileText, EachWrongCellIsNamedWithItsLine) {
  EXPECT_EQ(bad_row("flat, 6, 1, 1, x"), "");
  EXPECT_THAT(bad_row("flat, 6, 1, 1"), HasSubstr("f: line 3: has 4 fields; allowed: 5, as the header"));
  EXPECT_THAT(bad_row("flatt, 6, 1, 1, x"), HasSubstr("line 3: pile.tip: \"flatt\" is unknown"));
  EXPECT_THAT(bad_row("flatt, 6, 1, 1, x"), HasSubstr("did you mean \"flat\"?"));
  EXPECT_THAT(bad_row("flat, fast, 1, 1, x"), HasSubstr("line 3: pile.driving.constant.speed: "));
  EXPECT_THAT(bad_row("flat, 6000, 1, 1, x"), HasSubstr("is out of range"));
  EXPECT_THAT(bad_row("flat, , 1, 1, x"), HasSubstr("line 3: has no pile.driving.constant.speed"));
  EXPECT_THAT(bad_row("flat, 6, one, 1, x"),
              HasSubstr("line 3: q_c \"one\" is no finite number; allowed: a number in kPa"));
  EXPECT_THAT(bad_row("flat, 6, nan, 1, x"), HasSubstr("q_c \"nan\" is no finite number"));
  EXPECT_THAT(bad_row("flat, 6, , 1, x"), HasSubstr("line 3: has no q_c"));
  EXPECT_THAT(bad_row("flat, 6, 1, , x"), HasSubstr("line 3: has no tolerance; allowed: a number in kPa, more than 0"));
  EXPECT_THAT(bad_row("flat, 6, 1, 10 %, x"), HasSubstr("tolerance \"10 %\" is no finite number"));
  EXPECT_THAT(bad_row("flat, 6, 1, 0, x"), HasSubstr("line 3: tolerance 0 is out of range; allowed: more than 0"));
  EXPECT_THAT(bad_row("flat, 6, 1, -2, x"), HasSubstr("tolerance -2 is out of range"));
  EXPECT_THAT(bad_row("flat, 6, 1, 1, "), HasSubstr("line 3: has no reason for its tolerance"));
  EXPECT_THAT(bad_row("flat, 6, 1, 1, x\nflat, 6.0, 2, 1, y"), HasSubstr("line 4: is of the same cases as line 3"));
}

TEST(ReferenceFileText, AllProblemsAreToldAtOnce) {
  const std::string found = bad("source\n" + kHeader + "flat, 6, one, 0, \ncone, 6, 1, 1, x\n");
  EXPECT_EQ(std::ranges::count(found, '\n'), 4) << found;
}

TEST(ReferenceFileText, AThousandRowsAreTheMost) {
  std::string rows;
  for (int i = 1; i <= 1001; ++i) rows += std::to_string(i) + ", 1, 1, x\n";
  EXPECT_THAT(bad(kHead + "bed.seed, q_c [-], tolerance, reason\n" + rows),
              HasSubstr("line 1003: is one row too many"));
}

}  // namespace
}  // namespace seapile::study
