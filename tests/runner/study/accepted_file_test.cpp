#include "runner/study/accepted_file.h"

#include <gmock/gmock.h>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const std::string kHeader = "case,metric,value,unit,tolerance,run,numerics,note\n";
const std::string kA(64, 'a'), kB(64, 'b');

AcceptedValue value_of(const std::string& id, const std::string& metric, double value) {
  return {id, metric, value, "Pa", 1e-6, "0001", "grains=3 pile=1", "looked at, \"good\""};
}

class Accepted : public Scratch {
 protected:
  std::vector<AcceptedValue> read(const std::string& text) const {
    return read_accepted(write("accepted/s.csv", text));
  }
  std::string bad(const std::string& row) const {
    try {
      read(kHeader + row + "\n");
    } catch (const BadInput& bad) {
      std::string all;
      for (const auto& problem : bad.problems) all += sentence("f", problem) + "\n";
      return all;
    }
    return "";
  }
};

TEST_F(Accepted, WhatIsWrittenIsReadBackToTheLastBit) {
  const std::vector<AcceptedValue> values = {value_of(kA, "q_c", 0.1 + 0.2), value_of(kA, "q_d", -1e-300),
                                             value_of(kB, "q_c", 44312.123456789012)};
  EXPECT_EQ(read(accepted_text(values)), values);
  EXPECT_THAT(accepted_text(values), HasSubstr(",0.30000000000000004,Pa,1e-06,0001,"));
}

TEST_F(Accepted, RowsAreSortedSoThatAChangeIsOneLine) {
  EXPECT_EQ(accepted_text({value_of(kB, "q_c", 1), value_of(kA, "q_d", 2), value_of(kA, "q_c", 3)}),
            accepted_text({value_of(kA, "q_c", 3), value_of(kB, "q_c", 1), value_of(kA, "q_d", 2)}));
}

TEST_F(Accepted, AcceptingAgainReplacesTheRowOfThatCaseAndMetricAlone) {
  std::vector<AcceptedValue> values = {value_of(kA, "q_c", 1), value_of(kA, "q_d", 2), value_of(kB, "q_c", 3)};
  accept(values, value_of(kA, "q_c", 9));
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(find_accepted(values, kA, "q_c")->value, 9);
  EXPECT_EQ(find_accepted(values, kA, "q_d")->value, 2);
  EXPECT_EQ(find_accepted(values, kB, "q_c")->value, 3);
  EXPECT_EQ(find_accepted(values, kB, "q_d"), nullptr);
}

TEST_F(Accepted, NoFileIsNothingAccepted) { EXPECT_THAT(read_accepted(folder_ / "accepted" / "s.csv"), IsEmpty()); }

TEST_F(Accepted, LiesBesideItsStudyUnderItsName) {
  EXPECT_EQ(accepted_path(study("")), folder_ / "accepted" / "test.csv");
}

TEST_F(Accepted, EachWrongCellIsNamedWithItsLine) {
  const std::string rest = ",Pa,1e-6,0001,grains=3,good";
  EXPECT_EQ(bad(kA + ",q_c,1" + rest), "");
  EXPECT_THAT(bad(kA + ",q_c,1"), HasSubstr("line 2: has 3 fields; allowed: 8: case,metric,"));
  EXPECT_THAT(bad("abc,q_c,1" + rest), HasSubstr("line 2: case \"abc\" is no case id"));
  EXPECT_THAT(bad(kA + ",,1" + rest), HasSubstr("line 2: metric \"\" is no name"));
  EXPECT_THAT(bad(kA + ",q_c,one" + rest), HasSubstr("line 2: value \"one\" is no finite number"));
  EXPECT_THAT(bad(kA + ",q_c,inf" + rest), HasSubstr("value \"inf\" is no finite number"));
  EXPECT_THAT(bad(kA + ",q_c,1,Paa,1e-6,0001,g,good"), HasSubstr("unit \"Paa\" is no unit"));
  EXPECT_THAT(bad(kA + ",q_c,1,Pa,-1,0001,g,good"), HasSubstr("tolerance \"-1\" is no relative tolerance"));
  EXPECT_THAT(bad(kA + ",q_c,1,Pa,1e-6,0001,g,"), HasSubstr("note \"\" says nothing"));
  EXPECT_THAT(bad(kA + ",q_c,1" + rest + "\n" + kA + ",q_c,2" + rest), HasSubstr("line 3: is of the same case"));
  EXPECT_THROW(read("x\n"), BadInput);
  EXPECT_THROW(read(""), BadInput);
}

}  // namespace
}  // namespace seapile::study
