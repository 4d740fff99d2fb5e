// What the program advises from frontiers that are recorded beside a study.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string waves(const std::string& name, const std::string& more) {
  return R"({"study": ")" + name + R"(", "base": {"basin": {"surface": {"initial": {"cosine": {}}},
    "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"duration": 2}}}, )" +
         more + "}";
}

struct Advise : testing::Test {
  Advise() {
    fs::create_directories(place.folder() / "measured");
    place.write("fine.json", waves("fine", R"("variants": [{"name": "short", "set": {"basin.time.step": "1 ms"}},
      {"name": "long", "set": {"basin.time.step": "10 ms"}}], "frontier": {"of": ["frequency_error"]})"));
    place.write("measured/fine.csv",
                "variant,runs[-],asked[-],cpu[s],error:frequency_error.mean[%],bound:frequency_error[%]\n"
                "short,1,1,20,0.01,0.02\nlong,1,1,2,1,1.5\nshort,1,1,30,0.03,0.04\nlong,1,1,3,0.5,0.6\n");
    place.write("mine.json", waves("mine", R"("axes": {"basin.viscosity": [0.1, 0.2]})"));
  }
  Workplace place;
};

TEST_F(Advise, NamesTheCheapestLevelThatHoldsWithItsPriceAndHowToRunIt) {
  const Finished two = place.run({"advise", "mine.json", "--tol", "frequency=2%"});
  EXPECT_EQ(two.exit_code, 0) << two.error;
  EXPECT_THAT(two.out, HasSubstr("wave, 2 cases: frequency_error within 2 %"));
  EXPECT_THAT(two.out, HasSubstr("\"long\": error +1 %, at most 1.5 % (95 %), 2 runs of fine"));
  EXPECT_THAT(two.out, HasSubstr("about 6 CPU s in all"));
  EXPECT_THAT(two.out, HasSubstr("--set \"basin.time.step=10 ms\""));
  EXPECT_THAT(two.out, HasSubstr("not measured: other values of basin.viscosity"));
  EXPECT_THAT(place.run({"advise", "mine.json", "--tol", "frequency_error=0.001"}).out, HasSubstr("\"short\""));
}

TEST_F(Advise, SaysThatNoneHoldsOrThatNothingIsKnown) {
  const Finished none = place.run({"advise", "mine.json", "--tol", "frequency=0.01%"});
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_THAT(none.out,
              HasSubstr("none of those measured holds (fine); the closest, \"short\", is known within 0.04 %"));
  const Finished unknown = place.run({"advise", "mine.json", "--tol", "qc=5%"});
  EXPECT_EQ(unknown.exit_code, 4);
  EXPECT_THAT(unknown.out, HasSubstr("nothing is known"));
}

// Whichever of a frontier's scenes lacks the number.
TEST_F(Advise, ALevelOfWhichNothingIsKnownInOneSceneIsNotAdvised) {
  const std::string head = "variant,runs[-],asked[-],cpu[s],error:frequency_error.mean[%],bound:frequency_error[%]\n";
  const std::string known = "long,1,1,2,1,1.5\n", unknown = "long,1,1,3,,\n", other = "short,1,1,20,0.01,0.02\n";
  for (const std::string& rows : {known + unknown, unknown + known}) {
    place.write("measured/fine.csv", head + rows + other);
    EXPECT_THAT(place.run({"advise", "mine.json", "--tol", "frequency=2%"}).out, HasSubstr("\"short\"")) << rows;
  }
}

TEST_F(Advise, DoesNotGoByAblations) {
  place.write("fine.json", waves("fine", R"("variants": [{"name": "short", "set": {"basin.time.step": "1 ms"}},
      {"name": "long", "set": {"basin.time.step": "10 ms"}}], "ablate": {"whole": "short", "of": ["frequency_error"]})"));
  EXPECT_THAT(place.run({"advise", "mine.json", "--tol", "frequency=2%"}).out, HasSubstr("nothing is known"));
}

// V^2 = g d at 0.55 m/s.
TEST_F(Advise, DoesNotTellOfASlowPileWhatWasMeasuredOfAFastOne) {
  const auto drive = [](const std::string& name, const std::string& speed, const std::string& more) {
    return R"({"study": ")" + name + R"(", "base": {"pile": {"driving": {"constant": {"speed": ")" + speed +
           R"("}}, "depth": "0.3 m"}})" + more + "}";
  };
  place.write("fine.json", drive("fine", "2 m/s", R"(, "variants": [{"name": "short", "set": {"contact.step": "1 ms"}},
      {"name": "long", "set": {"contact.step": "2 ms"}}], "frontier": {"reference": "short", "of": ["tip_resistance_mean"]})"));
  place.write("measured/fine.csv",
              "variant,runs[-],asked[-],cpu[s],error:tip_resistance_mean.mean[%],bound:tip_resistance_mean[%]\n"
              "short,8,8,20,,\nlong,8,8,2,1,1.5\n");
  place.write("slow.json", drive("slow", "0.5 m/s", ""));
  place.write("fast.json", drive("fast", "0.6 m/s", ""));
  EXPECT_THAT(place.run({"advise", "slow.json", "--tol", "qc=5%"}).out,
              HasSubstr("dry drive, 1 case: tip_resistance_mean within 5 %\n  no frontier"));
  EXPECT_THAT(place.run({"advise", "fast.json", "--tol", "qc=5%"}).out,
              HasSubstr("fast dry drive, 1 case: tip_resistance_mean within 5 %\n  \"long\""));
}

TEST_F(Advise, RefusesWhatIsNoToleranceAndRecordsThatAreNone) {
  for (const char* tolerance : {"qc", "=5%", "qc=-5%", "qc=five", "qc=5%x"}) {
    const Finished bad = place.run({"advise", "mine.json", "--tol", tolerance});
    EXPECT_EQ(bad.exit_code, 2) << tolerance;
    EXPECT_THAT(bad.error, HasSubstr("--tol")) << tolerance;
  }
  place.write("measured/fine.csv", "name,runs\nshort,1\n");
  const Finished bad = place.run({"advise", "mine.json", "--tol", "qc=5%"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_THAT(bad.error, HasSubstr("has no column \"variant\""));
}

}  // namespace
}  // namespace seapile::commands
