#include "runner/present/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace seapile::present {
namespace {

using store::Cell;
using store::Table;
using testing::ElementsAre;

Table a_table() {
  return {{"case", "mean q_c", "max overlap", "steps"},
          {"", "Pa", "-", ""},
          {{std::string("1a2b"), 123456.789, 0.0123456, 40000.0},
           {std::string("flat, \"wide\""), 98765.4321, Cell{}, 7.0}}};
}

TEST(TextTable, AlignsColumnsAndChoosesDigitsAndPrefixForAColumnAsAWhole) {
  EXPECT_EQ(text(a_table(), Format::table),
            "case          mean q_c  max overlap  steps\n"
            "                   kPa            -\n"
            "------------  --------  -----------  -----\n"
            "1a2b             123.5      0.01235  40000\n"
            "flat, \"wide\"      98.8            -      7\n");
}

TEST(TextTable, ANameCannotMoveTheCursor) {
  const Table table{{"a\x1b[2J"}, {""}, {{std::string("b\nc\x07")}}};
  const std::string shown = text(table, Format::table);
  EXPECT_EQ(shown.find('\x1b'), std::string::npos);
  EXPECT_EQ(shown.find('\x07'), std::string::npos);
  EXPECT_EQ(std::ranges::count(shown, '\n'), 3);
}

TEST(TextTable, CountsCharactersNotBytes) {
  const Table table{{"x", "y"}, {"", ""}, {{std::string("café"), 1.0}, {std::string("cafe"), 2.0}}};
  const std::string shown = text(table, Format::table);
  EXPECT_NE(shown.find("café  1\ncafe  2\n"), std::string::npos) << shown;
}

TEST(TextTable, NumbersOfEverySizeStayReadable) {
  const auto shown = [](double value) {
    const std::string all = text({{"x"}, {""}, {{value}}}, Format::table);
    const auto last_line = all.rfind('\n', all.size() - 2) + 1;
    const std::string line = all.substr(last_line, all.size() - 1 - last_line);
    return line.substr(line.find_first_not_of(' '));
  };
  EXPECT_EQ(shown(0), "0");
  EXPECT_EQ(shown(3), "3");
  EXPECT_EQ(shown(-2.5), "-2.500");
  EXPECT_EQ(shown(1e-9), "1e-09");
  EXPECT_EQ(shown(0.827), "0.8270");
  EXPECT_EQ(shown(12.3456), "12.35");
  EXPECT_EQ(shown(1.5e12), "1.5e+12");
  EXPECT_EQ(shown(std::nan("")), "nan");
  EXPECT_EQ(shown(INFINITY), "inf");
}

TEST(CsvTable, SaysUnitsInTheHeaderAndEveryDigit) {
  EXPECT_EQ(text(a_table(), Format::csv),
            "case,mean q_c[Pa],max overlap[-],steps\n"
            "1a2b,123456.789,0.0123456,40000\n"
            "\"flat, \"\"wide\"\"\",98765.4321,,7\n");
  EXPECT_EQ(text({{"x"}, {"m"}, {{0.1 + 0.2}}}, Format::csv), "x[m]\n0.30000000000000004\n");
}

TEST(JsonTable, NamesItsSchemaAndHasNullForWhatIsAbsent) {
  const auto json = nlohmann::json::parse(text(a_table(), Format::json));
  EXPECT_EQ(json.at("schema"), "runner/table/1");
  EXPECT_EQ(json.at("columns").at(1).at("name"), "mean q_c");
  EXPECT_EQ(json.at("columns").at(1).at("unit"), "Pa");
  EXPECT_EQ(json.at("rows").at(0).at("mean q_c"), 123456.789);
  EXPECT_EQ(json.at("rows").at(1).at("case"), "flat, \"wide\"");
  EXPECT_TRUE(json.at("rows").at(1).at("max overlap").is_null());
}

TEST(NdjsonTable, HasAnObjectPerRowOnALineOfItsOwn) {
  EXPECT_EQ(text({{"x", "y"}, {"m", ""}, {{0.5, std::string("a\nb")}, {Cell{}, std::nan("")}}}, Format::ndjson),
            "{\"schema\":\"runner/row/1\",\"x\":0.5,\"y\":\"a\\nb\"}\n"
            "{\"schema\":\"runner/row/1\",\"x\":null,\"y\":null}\n");
}

TEST(JsonTable, WhatJsonCannotSayIsNull) {
  const auto json = nlohmann::json::parse(text({{"x"}, {""}, {{std::nan("")}}}, Format::json));
  EXPECT_TRUE(json.at("rows").at(0).at("x").is_null());
}

TEST(LabelTable, HasEveryPathAndNumbersWhereAllOfThemAre) {
  const Table table = label_table({{{"speed", "0.06 m/s"}, {"tip", "flat"}}, {{"speed", "0.2 m/s"}, {"seed", "3"}}});
  EXPECT_THAT(table.columns, ElementsAre("speed", "tip", "seed"));
  EXPECT_THAT(table.units, ElementsAre("m/s", "", ""));
  EXPECT_EQ(table.rows[0], (std::vector<Cell>{0.06, std::string("flat"), Cell{}}));
  EXPECT_EQ(table.rows[1], (std::vector<Cell>{0.2, Cell{}, 3.0}));
}

TEST(LabelTable, MixedUnitsOrWordsStayText) {
  const Table table = label_table({{{"x", "1 m"}, {"y", "1"}}, {{"x", "1 s"}, {"y", "null"}}});
  EXPECT_THAT(table.units, ElementsAre("", ""));
  EXPECT_EQ(table.rows[0], (std::vector<Cell>{std::string("1 m"), std::string("1")}));
}

TEST(Quantity, IsANumberAndOneUnit) {
  EXPECT_EQ(quantity("0.06 m/s"), std::pair(0.06, std::string("m/s")));
  EXPECT_EQ(quantity("0.001 Pa s"), std::pair(0.001, std::string("Pa s")));
  EXPECT_EQ(quantity("-3"), std::pair(-3.0, std::string()));
  for (const char* text : {"", "flat", "3m", "3 m s", "3 ", "nan", "inf", "0x10", "1 2 3"}) {
    EXPECT_FALSE(quantity(text)) << text;
  }
}

}  // namespace
}  // namespace seapile::present
