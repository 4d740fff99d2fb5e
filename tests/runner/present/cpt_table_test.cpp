#include "runner/present/cpt_table.h"

#include <gmock/gmock.h>

#include <sstream>

namespace seapile::present {
namespace {

using testing::HasSubstr;
using testing::Not;

CptTable table() {
  return {std::string(64, 'a'),
          "0001",
          0.25,
          true,
          {{0.01, 44'321, {}, {1000, {}, {}}}, {0.03, 0, 123.6, {1000, 2000, 3000}}, {0.05, 50'000, 500, {1, 2, 3}}}};
}

/// The numbers of a line.
std::vector<std::string> fields(std::string line, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(line);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

std::vector<std::string> lines(const std::string& text) { return fields(text, '\n'); }

TEST(CptTable, InCsvHasUnitsInTheHeaderAndEmptyFieldsForWhatIsMissing) {
  const auto csv = lines(cpt_csv(table()));
  EXPECT_EQ(csv.at(0), "depth[m],qc[MPa],fs[kPa],Rf[%],u1[kPa],u2[kPa],u3[kPa],model");
  EXPECT_EQ(csv.at(1), "0.010,0.044321,,,1.000,,,plane strain discs");
  EXPECT_EQ(csv.at(2), "0.030,0.000000,0.124,,1.000,2.000,3.000,plane strain discs") << "Rf of qc = 0 is no number";
  EXPECT_EQ(csv.at(3), "0.050,0.050000,0.500,1.000,0.001,0.002,0.003,plane strain discs");
}

TEST(CptTable, ADryBedHasNoColumnOfPorePressure) {
  CptTable dry = table();
  dry.has_pore_pressure = false;
  EXPECT_EQ(lines(cpt_csv(dry)).at(0), "depth[m],qc[MPa],fs[kPa],Rf[%],model");
  EXPECT_THAT(cpt_gef(dry, {}), HasSubstr("#COLUMN= 4\n"));
  EXPECT_THAT(cpt_gef(dry, {}), Not(HasSubstr("pore pressure")));
}

// GEF has sleeve friction in MPa where tables for people have kPa: files with a factor of 1000 too much are common.
TEST(CptTable, FrictionAndPorePressureInGefAreAThousandthOfThoseInCsv) {
  const auto csv = lines(cpt_csv(table()));
  const std::string gef = cpt_gef(table(), {});
  const auto records = lines(gef.substr(gef.find("#EOH=\n") + 6));
  ASSERT_EQ(records.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto a = fields(csv.at(i + 1), ','), b = fields(records[i], ';');
    EXPECT_EQ(a.at(0), b.at(0));
    EXPECT_EQ(a.at(1), b.at(1)) << "q_c is in MPa in both";
    for (const std::size_t column : {2u, 4u, 5u, 6u}) {
      if (a.at(column).empty()) {
        EXPECT_EQ(b.at(column), "-9999");
      } else {
        EXPECT_EQ(std::lround(std::stod(a.at(column)) * 1e3), std::lround(std::stod(b.at(column)) * 1e6));
        EXPECT_EQ(b.at(column).size() - b.at(column).find('.'), 7u) << b.at(column);
      }
    }
  }
}

TEST(CptTable, InGefSaysThatItIsSimulated) {
  const std::string gef = cpt_gef(table(), std::chrono::year{2024} / 2 / 29);
  EXPECT_THAT(gef, HasSubstr("#GEFID= 1, 1, 0\n"));
  EXPECT_THAT(gef, HasSubstr("#FILEDATE= 2024, 2, 29\n"));
  EXPECT_THAT(gef, HasSubstr("#PROJECTID= SEAPILE-SIMULATED\n"));
  EXPECT_THAT(gef, HasSubstr("#TESTID= simulated-aaaaaaaaaa-0001\n"));
  EXPECT_THAT(gef, HasSubstr("#COMMENT= simulated by Seapile: plane strain discs"));
  EXPECT_THAT(gef, HasSubstr("#REPORTCODE= GEF-CPT-Report,"));
  EXPECT_THAT(gef, HasSubstr("#COLUMNINFO= 3, MPa, sleeve friction fs, 3\n"));
  EXPECT_THAT(gef, HasSubstr("#MEASUREMENTVAR= 1, 250000, mm2, projected area of the tip per metre"));
  EXPECT_THAT(gef, HasSubstr("#LASTSCAN= 3\n#EOH=\n"));
}

}  // namespace
}  // namespace seapile::present
