// Files of cone penetration tests. All of them are synthetic: no ground was tested.
#include "runner/study/cpt.h"

#include <gmock/gmock.h>

#include <cmath>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

using Parse = Cpt (*)(std::string_view, base::Problems&);

Cpt good(Parse parse, const std::string& text) {
  base::Problems problems;
  Cpt cpt = parse(text, problems);
  EXPECT_TRUE(problems.empty()) << sentence("f", problems[0]);
  return cpt;
}

/// The sentences about a file's problems.
std::string bad(Parse parse, const std::string& text) {
  base::Problems problems;
  parse(text, problems);
  std::string all;
  for (const auto& problem : problems) all += sentence("f", problem) + "\n";
  return all;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

const std::string kGef =
    "#GEFID= 1, 1, 0\r\n"                                   // line 1
    "#FILEOWNER= synthetic, no ground was tested\r\n"       // 2
    "#FILEDATE= 2024, 1, 1\r\n"                             // 3
    "#PROJECTID= synthetic\r\n"                             // 4
    "#COLUMN= 5\r\n"                                        // 5
    "#COLUMNINFO= 1, m (metre), penetration length, 1\r\n"  // 6
    "#COLUMNINFO= 2, MPa, cone, with a comma, 2\r\n"        // 7
    "#COLUMNINFO= 3, MPa, friction, 3\r\n"                  // 8
    "#COLUMNINFO= 4, degrees, inclination, 8\r\n"           // 9
    "#COLUMNINFO= 5, kPa, pore pressure, 6\r\n"             // 10
    "#COLUMNVOID= 3, -9999\r\n"                             // 11
    "#MEASUREMENTVAR= 1, 1000, mm2, cone area\r\n"          // 12
    "#COLUMNSEPARATOR= ;\r\n"                               // 13
    "#RECORDSEPARATOR= !\r\n"                               // 14
    "#REPORTCODE= GEF-CPT-Report, 1, 1, 2\r\n"              // 15
    "#LASTSCAN= 2\r\n"                                      // 16
    "#EOH=\r\n"                                             // 17
    "0.02;1.5;0.0125;0.1;20;!\r\n"                          // 18
    "0.04;+2.5e+000;-9999;0.1;30;!\r\n";                    // 19

std::string bad_gef(const std::string& from, const std::string& to) { return bad(parse_gef, replaced(kGef, from, to)); }

TEST(Gef, QuantitiesAreReadInTheUnitsThatTheHeaderNames) {
  const Cpt cpt = good(parse_gef, kGef);
  EXPECT_THAT(cpt.depth, ElementsAre(0.02, 0.04));
  EXPECT_THAT(cpt.cone_resistance, ElementsAre(1.5e6, 2.5e6));
  ASSERT_EQ(cpt.sleeve_friction.size(), 2u);
  EXPECT_DOUBLE_EQ(cpt.sleeve_friction[0], 12.5e3);
  EXPECT_TRUE(std::isnan(cpt.sleeve_friction[1]));
  EXPECT_TRUE(cpt.friction_ratio.empty());
  EXPECT_THAT(cpt.pore_pressure[1], ElementsAre(20e3, 30e3));
  EXPECT_DOUBLE_EQ(cpt.cone_area.value(), 1e-3);
  EXPECT_FALSE(cpt.is_simulated);
}

TEST(Gef, ACorrectedDepthIsPreferredWhereItWasMeasured) {
  const std::string corrected = replaced(kGef, "4, degrees, inclination, 8", "4, m, corrected depth, 11");
  EXPECT_THAT(good(parse_gef, corrected).depth, ElementsAre(0.1, 0.1));
  EXPECT_THAT(good(parse_gef, replaced(corrected, "#COLUMNVOID=", "#COLUMNVOID= 4, 0.1\n#COLUMNVOID=")).depth,
              ElementsAre(0.02, 0.04));
}

TEST(Gef, WithoutSeparatorsBlanksAndLinesSeparate) {
  const Cpt cpt = good(parse_gef,
                       "#COLUMN= 2\n#COLUMNINFO= 1, m, length, 1\n#COLUMNINFO= 2, MN/m2, cone, 2\n#EOH=\n"
                       "  0.02   1.5\n\n  0.04\t2.5\n");
  EXPECT_THAT(cpt.depth, ElementsAre(0.02, 0.04));
  EXPECT_THAT(cpt.cone_resistance, ElementsAre(1.5e6, 2.5e6));
  EXPECT_FALSE(cpt.cone_area.has_value());
}

TEST(Gef, WordsInAnotherEncodingAndUnknownKeywordsAreNoProblem) {
  good(parse_gef, replaced(kGef, "#PROJECTID= synthetic", "#PROJECTID= caf\xe9\r\n#SURPRISE= 1"));
}

TEST(Gef, AWrongHeaderIsNamedWithItsLine) {
  EXPECT_THAT(bad_gef("GEF-CPT-Report", "GEF-BORE-Report"),
              HasSubstr("f: line 15: is of a GEF-BORE-Report; allowed: GEF-CPT-Report"));
  EXPECT_THAT(bad_gef("#COLUMN= 5", "#COLUMN= five"), HasSubstr("line 5: \"five\" is no number of columns"));
  EXPECT_THAT(bad_gef("#COLUMN= 5", "#COLUMN= 6"), HasSubstr("line 17: ends a header without #COLUMNINFO= 6"));
  EXPECT_THAT(bad_gef("#COLUMN= 5", "#COLUMN= 4"), HasSubstr("line 10: column 5 is one too many"));
  EXPECT_THAT(bad_gef("#COLUMN= 5\r\n", ""), HasSubstr("ends a header without #COLUMN="));
  EXPECT_THAT(bad_gef("friction, 3", "friction"), HasSubstr("line 8: does not describe a column"));
  EXPECT_THAT(bad_gef("#COLUMNINFO= 3", "#COLUMNINFO= 2"), HasSubstr("line 8: column 2 is there twice"));
  EXPECT_THAT(bad_gef("friction, 3", "friction, 2"), HasSubstr("line 8: quantity 2 is there twice"));
  EXPECT_THAT(bad_gef("2, MPa", "2, MPaa"), HasSubstr("line 7: column 2 has an unknown unit \"MPaa\""));
  EXPECT_THAT(bad_gef("2, MPa", "2, m"), HasSubstr("line 7: column 2 is in m, which is not a unit for Pa"));
  EXPECT_THAT(bad_gef("length, 1", "length, 99"), HasSubstr("line 17: ends a header without a depth"));
  EXPECT_THAT(bad_gef("comma, 2", "comma, 99"), HasSubstr("line 17: ends a header without a cone resistance"));
  EXPECT_THAT(bad_gef("-9999\r\n#MEAS", "none\r\n#MEAS"), HasSubstr("line 11: does not say what a missing value is"));
  EXPECT_THAT(bad_gef("1000, mm2", "1000, kg"), HasSubstr("line 12: the cone's area 1000 kg is none"));
  EXPECT_THAT(bad_gef("SEPARATOR= ;", "SEPARATOR= ;;"), HasSubstr("line 13: \";;\" is no separator"));
  EXPECT_THAT(bad_gef("#LASTSCAN= 2", "#DATAFORMAT= BINARY"), HasSubstr("line 16: says that the data are binary"));
  EXPECT_THAT(bad_gef("#EOH=\r\n", ""), HasSubstr("line 19: is the end, and the header has none"));
}

TEST(Gef, AWrongRecordIsNamedWithItsLine) {
  EXPECT_THAT(bad_gef("0.04;+2.5e+000;", "0.04;"),
              HasSubstr("f: line 19: has 4 numbers; allowed: 5, as #COLUMN= says"));
  EXPECT_THAT(bad_gef("+2.5e+000", "two"), HasSubstr("line 19: column 2 \"two\" is no finite number"));
  EXPECT_THAT(bad_gef("+2.5e+000", "nan"), HasSubstr("line 19: column 2 \"nan\" is no finite number"));
  EXPECT_THAT(bad_gef("0.02;", "-0.02;"), HasSubstr("line 18: depth -0.02 is above the ground"));
  EXPECT_THAT(bad_gef("#LASTSCAN= 2", "#LASTSCAN= 3"), HasSubstr("is the end after 2 records; allowed: 3"));
  const std::string header = kGef.substr(0, kGef.find("0.02;"));
  EXPECT_THAT(bad(parse_gef, header), HasSubstr("line 18: is missing: the file has no readings"));
}

TEST(CptCsv, ColumnsHaveTheirUnitsAndAnEmptyFieldIsMissing) {
  const Cpt cpt = good(parse_cpt_csv, "remark,depth[m],qc [MPa],fs[kPa],Rf[%],u2[kPa]\nsynthetic,0.02,1.5,,0.8,20\n");
  EXPECT_THAT(cpt.depth, ElementsAre(0.02));
  EXPECT_THAT(cpt.cone_resistance, ElementsAre(1.5e6));
  EXPECT_TRUE(std::isnan(cpt.sleeve_friction.at(0)));
  EXPECT_DOUBLE_EQ(cpt.friction_ratio.at(0), 0.008);
  EXPECT_THAT(cpt.pore_pressure[1], ElementsAre(20e3));
  EXPECT_TRUE(cpt.pore_pressure[0].empty());
  EXPECT_FALSE(cpt.cone_area.has_value());
}

TEST(CptCsv, EachProblemIsNamedWithItsLine) {
  EXPECT_THAT(bad(parse_cpt_csv, ""), HasSubstr("f: line 1: is missing: the file has no header"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],q[MPa]\n1,1\n"), HasSubstr("line 1: has no column qc"));
  EXPECT_THAT(bad(parse_cpt_csv, "dept[m],qc[MPa]\n1,1\n"), HasSubstr("did you mean \"dept\"?"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth,qc[MPa]\n1,1\n"), HasSubstr("depth has no unit; allowed: depth[m]"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[MPaa]\n1,1\n"), HasSubstr("did you mean \"MPa\"?"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[m]\n1,1\n"), HasSubstr("qc is in m, which is not a unit for Pa"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[MPa],qc[kPa]\n1,1,1\n"), HasSubstr("qc is there twice"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[MPa]\n"), HasSubstr("the file has no readings"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[MPa]\n1\n"),
              HasSubstr("line 2: has 1 fields; allowed: 2, as the header"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[MPa]\n1,one\n"), HasSubstr("line 2: qc \"one\" is no finite number"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[MPa]\n,1\n"), HasSubstr("line 2: has no depth"));
  EXPECT_THAT(bad(parse_cpt_csv, "depth[m],qc[MPa]\n-1,1\n"), HasSubstr("line 2: depth -1 is above the ground"));
}

struct CptFile : Scratch {};

TEST_F(CptFile, IsReadByItsEndingAndIsBadInputOtherwise) {
  EXPECT_EQ(read_cpt(write("a.GEF", kGef)).depth.size(), 2u);
  EXPECT_EQ(read_cpt(write("a.csv", "depth[m],qc[MPa]\n1,1\n")).depth.size(), 1u);
  EXPECT_THROW(read_cpt(write("a.txt", kGef)), BadInput);
  EXPECT_THROW(read_cpt(folder_ / "none.gef"), BadInput);
  EXPECT_THROW(read_cpt(write("b.gef", "depth[m],qc[MPa]\n1,1\n")), BadInput);
}

}  // namespace
}  // namespace seapile::study
