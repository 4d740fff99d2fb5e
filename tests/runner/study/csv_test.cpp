#include "runner/study/csv.h"

#include <gmock/gmock.h>

namespace seapile::study {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Fields = std::vector<std::string>;

std::vector<CsvRecord> good(const std::string& text) {
  base::Problems found;
  LineProblems problems(found);
  auto records = read_csv(text, 1, problems);
  EXPECT_TRUE(found.empty()) << found[0].what;
  return records;
}

std::string bad(const std::string& text) {
  base::Problems found;
  LineProblems problems(found);
  read_csv(text, 1, problems);
  problems.finish();
  std::string all;
  for (const auto& problem : found) all += problem.what + "\n";
  return all;
}

TEST(Csv, FieldsAreTrimmedAndEmptyLinesKeepTheCount) {
  const auto records = good("a, b ,\r\n\n  \n 1,,\"2\"\n");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].fields, (Fields{"a", "b", ""}));
  EXPECT_EQ(records[1].line, 4u);
  EXPECT_EQ(records[1].fields, (Fields{"1", "", "2"}));
}

TEST(Csv, AQuotedFieldHoldsCommasAndQuotes) {
  EXPECT_EQ(good(R"("a, b" , "say ""c""", " d ")")[0].fields, (Fields{"a, b", "say \"c\"", " d "}));
}

TEST(Csv, ABrokenQuoteIsNamedWithItsLine) {
  EXPECT_EQ(bad("a\n\"b\n"), "line 2: has a quote that is not closed\n");
  EXPECT_EQ(bad("\"a\"b\n"), "line 1: has text behind a closing quote\n");
}

TEST(Csv, ControlCharactersAndOtherEncodingsAreRefused) {
  EXPECT_THAT(bad("a\x1b[2J\n"), HasSubstr("line 1: has control characters or is not UTF-8"));
  EXPECT_THAT(bad("caf\xe9\n"), HasSubstr("line 1"));
}

TEST(Csv, AFileOfAnotherKindGivesTwentyLinesAndACount) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "\"\n";
  const std::string found = bad(text);
  EXPECT_EQ(std::ranges::count(found, '\n'), 21);
  EXPECT_THAT(found, HasSubstr("and 30 more lines with problems"));
}

TEST(Csv, WhatIsWrittenIsReadBack) {
  const Fields fields = {"plain", "", "a, b", "say \"c\"", " d ", "ü"};
  const auto records = good(csv_line(fields));
  ASSERT_EQ(records.size(), 1u);
  EXPECT_EQ(records[0].fields, fields);
}

}  // namespace
}  // namespace seapile::study
