#include "runner/study/grain_file.h"

#include <gmock/gmock.h>

#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::HasSubstr;

const std::string kThree = "id,x,y,radius\n3,0.5,0.2,0.02\n1,-0.5,0.1,0.01\n2,0,0.3,0.015\n";

class GrainFileTest : public Scratch {
 protected:
  std::vector<GrainRow> good(const std::string& csv) const {
    base::Problems problems;
    auto rows = parse_grains(csv, {}, problems);
    EXPECT_TRUE(problems.empty()) << problems[0].what;
    return rows;
  }
  /// The sentences about a file's problems.
  std::string bad(const std::string& csv) const {
    base::Problems problems;
    parse_grains(csv, {}, problems);
    std::string text;
    for (const auto& problem : problems) text += sentence("f", problem) + "\n";
    return text;
  }
  std::string one_line(const std::string& row) const { return bad("id,x,y,radius\n" + row + "\n"); }
};

TEST_F(GrainFileTest, RowsAreSortedById) {
  const auto rows = good(kThree);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].id, 1);
  EXPECT_EQ(rows[0].x, -0.5);
  EXPECT_EQ(rows[2].radius, 0.02);
}

TEST_F(GrainFileTest, ContentIsTheSameInAnyOrderAndSpelling) {
  const std::string content = grains_content(good(kThree));
  EXPECT_EQ(grains_content(good("id,x,y,radius\n1,-0.5,0.1,0.01\n2,-0,0.3,0.015\n3,0.5,0.2,0.02\n")), content);
  EXPECT_EQ(grains_content(good("id,x,y,radius\r\n1, -5e-1, 0.10, 1e-2\r\n2,0.0,.3,0.015\r\n3,0.5,0.2,0.02")), content);
  EXPECT_NE(grains_content(good("id,x,y,radius\n1,-0.5,0.1,0.01\n2,0,0.3,0.015\n3,0.5,0.2,0.0200001\n")), content);
  EXPECT_NE(grains_content(good("id,x,y,radius\n1,-0.5,0.1,0.01\n2,0,0.3,0.015\n4,0.5,0.2,0.02\n")), content);
}

TEST_F(GrainFileTest, EachProblemNamesItsLine) {
  EXPECT_EQ(bad(""), "f: line 1: is missing; allowed: id,x,y,radius\n");
  EXPECT_THAT(bad("1,0,0.1,0.01\n"), HasSubstr("line 1: \"1,0,0.1,0.01\" is not the header"));
  EXPECT_THAT(bad("x,y,radius\n"), HasSubstr("is not the header"));
  EXPECT_THAT(bad("id,x,y,radius\n"), HasSubstr("the file has no grains"));
  EXPECT_THAT(one_line("1,0,0.1"), HasSubstr("line 2: has 3 fields; allowed: 4"));
  EXPECT_THAT(one_line("1,0,0.1,0.01,7"), HasSubstr("line 2: has 5 fields"));
  EXPECT_THAT(one_line("1.5,0,0.1,0.01"), HasSubstr("id \"1.5\" is no whole number"));
  EXPECT_THAT(one_line("-1,0,0.1,0.01"), HasSubstr("id \"-1\" is no whole number"));
  EXPECT_THAT(one_line("99999999999999999999,0,0.1,0.01"), HasSubstr("is no whole number"));
  EXPECT_THAT(one_line("1,nan,0.1,0.01"), HasSubstr("x \"nan\" is no finite number"));
  EXPECT_THAT(one_line("1,0,inf,0.01"), HasSubstr("y \"inf\" is no finite number"));
  EXPECT_THAT(one_line("1,0,0.1,"), HasSubstr("radius \"\" is no finite number"));
  EXPECT_THAT(one_line("1,0,0.1,1e999"), HasSubstr("radius \"1e999\" is no finite number"));
  EXPECT_THAT(one_line("1,0,0.1,0.01 m"), HasSubstr("is no finite number"));
  EXPECT_THAT(one_line("1,0,0.1,-0.01"), HasSubstr("radius -0.01 is out of range"));
  EXPECT_THAT(one_line("1,0,0.1,0"), HasSubstr("radius 0 is out of range"));
  EXPECT_THAT(bad("id,x,y,radius\n7,0,0.1,0.01\n8,0,0.5,0.01\n7,0,0.2,0.01\n"),
              HasSubstr("line 4: id 7 is already in line 2"));
  EXPECT_THAT(bad("id,x,y,radius\n\n1,0,0.1,0.01\n"), HasSubstr("line 2: has 1 fields"));
}

TEST_F(GrainFileTest, GrainsLieInTheBox) {
  for (const char* row : {"1,2.6,1,0.01", "1,-2.5,1,0.01", "1,0,-0.1,0.01", "1,0,0.005,0.01", "1,0,4.1,0.01"}) {
    EXPECT_THAT(one_line(row), HasSubstr("line 2: the grain at")) << row;
  }
}

TEST_F(GrainFileTest, GrainsAtOnePlaceOrTooDeepInOneAnotherAreRefused) {
  EXPECT_EQ(bad("id,x,y,radius\n7,0,0.1,0.01\n8,0.3,0.1,0.01\n5,0,0.1,0.02\n"),
            "f: line 4: the grain overlaps that of line 2 by 3 radii of the smaller; allowed: at most 0.5\n");
  EXPECT_THAT(bad("id,x,y,radius\n7,0,0.1,0.01\n8,0.014,0.1,0.01\n"), HasSubstr("by 0.6 radii of the smaller"));
  EXPECT_EQ(good("id,x,y,radius\n7,0,0.1,0.01\n8,0.016,0.1,0.01\n").size(), 2u);
}

TEST_F(GrainFileTest, AGrainMayPressIntoAWallAsASettledOneDoes) {
  EXPECT_EQ(good("id,x,y,radius\n1,0,0.0098,0.01\n2,-2.4902,1,0.01\n").size(), 2u);
}

TEST_F(GrainFileTest, AFileOfAnotherKindDoesNotFloodTheScreen) {
  std::string csv = "id,x,y,radius\n";
  for (int i = 0; i < 1000; ++i) csv += "nonsense\n";
  const std::string text = bad(csv);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 21);
  EXPECT_THAT(text, HasSubstr("and 980 more lines with problems"));
}

TEST_F(GrainFileTest, TheBedTakesCountRadiiAndContentFromTheFile) {
  write("beds/three.csv", kThree);
  const Case one = study(R"("base": {"bed": {"file": "beds/three.csv"}})").cases[0];
  EXPECT_EQ(one.scene.bed.grains.count, 3);
  EXPECT_EQ(one.scene.bed.grains.radius, (grains::RadiusSpec{0.01, 0.02}));
  EXPECT_EQ(one.scene.bed.file_content, grains_content(good(kThree)));
  EXPECT_TRUE(std::filesystem::path(one.scene.bed.file).is_absolute()) << "a worker reads it from anywhere";
}

TEST_F(GrainFileTest, TheIdIsThatOfTheGrains) {
  write("three.csv", kThree);
  write("moved/same.csv", "id,x,y,radius\n2,0,0.3,0.015\n1,-0.5,0.1,0.01\n3,0.5,0.2,0.02\n");
  write("other.csv", "id,x,y,radius\n2,0,0.3,0.016\n1,-0.5,0.1,0.01\n3,0.5,0.2,0.02\n");
  const auto id = [&](const std::string& file) {
    return study("\"base\": {\"bed\": {\"file\": \"" + file + "\"}}").cases[0].id;
  };
  EXPECT_EQ(id("three.csv"), id("moved/same.csv"));
  EXPECT_NE(id("three.csv"), id("other.csv"));
}

TEST_F(GrainFileTest, AWorkerReadsTheGrainsOfTheScene) {
  write("three.csv", kThree);
  const Case one = study(R"("base": {"bed": {"file": "three.csv"}})").cases[0];
  const auto arrays = read_grain_file(scene_from_json(to_json(one.scene)).bed);
  ASSERT_EQ(arrays.size(), 3u);
  EXPECT_EQ(arrays[0].info.name, "grains/id");
  EXPECT_EQ(std::get<std::vector<std::int64_t>>(arrays[0].values), (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(arrays[1].info.columns, 2);
  EXPECT_EQ(std::get<std::vector<double>>(arrays[1].values), (std::vector<double>{-0.5, 0.1, 0, 0.3, 0.5, 0.2}));
  EXPECT_EQ(std::get<std::vector<double>>(arrays[2].values), (std::vector<double>{0.01, 0.015, 0.02}));
}

TEST_F(GrainFileTest, GrainsThatChangedSinceTheStudyWasReadAreRefused) {
  write("three.csv", kThree);
  const Case one = study(R"("base": {"bed": {"file": "three.csv"}})").cases[0];
  write("three.csv", "id,x,y,radius\n1,0,0.1,0.01\n");
  EXPECT_THROW(read_grain_file(one.scene.bed), BadInput);
  std::filesystem::remove(folder_ / "three.csv");
  EXPECT_THROW(read_grain_file(one.scene.bed), BadInput);
}

TEST_F(GrainFileTest, AProblemInTheFileIsToldAtThePathThatNamesIt) {
  write("bad.csv", "id,x,y,radius\n1,0,0.1,-0.01\n");
  const auto found = problems(R"("axes": {"bed.file": ["", "bad.csv"]})");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(
      sentence("s", found[0]),
      "s: /axes/bed.file/1: \"bad.csv\" line 2: radius -0.01 is out of range; allowed: more than 0 m, at most 10 m");
}

TEST_F(GrainFileTest, ALinkThatLeavesTheFolderIsRefused) {
  std::filesystem::create_directories(folder_ / "study");
  write("outside.csv", kThree);
  write("study/inside.csv", kThree);
  std::filesystem::create_symlink("../outside.csv", folder_ / "study/escape.csv");
  std::filesystem::create_directory_symlink("..", folder_ / "study/up");
  std::filesystem::create_symlink("inside.csv", folder_ / "study/link.csv");
  const auto found = [&](const std::string& file) -> std::string {
    try {
      read(write("study/s.json", R"({"study": "s", "base": {"bed": {"file": ")" + file + "\"}}}"));
    } catch (const BadInput& bad) {
      return bad.problems[0].what;
    }
    return "good";
  };
  EXPECT_THAT(found("escape.csv"), HasSubstr("leaves the study's folder through a symbolic link"));
  EXPECT_THAT(found("up/outside.csv"), HasSubstr("leaves the study's folder through a symbolic link"));
  EXPECT_EQ(found("link.csv"), "good");
  EXPECT_EQ(found("inside.csv"), "good");
}

TEST_F(GrainFileTest, WhatTheFileDecidesTheStudyLeavesAlone) {
  write("three.csv", kThree);
  const auto pointer = [&](const std::string& members) {
    const auto found = problems(members);
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? "" : found[0].pointer;
  };
  EXPECT_EQ(pointer(R"("base": {"bed": {"file": "three.csv", "grains": {"count": 3}}})"), "/base/bed/grains/count");
  EXPECT_EQ(pointer(R"("base": {"bed": {"file": "three.csv", "grains": {"radius": {"min": 0.01}}}})"),
            "/base/bed/grains/radius");
  EXPECT_EQ(pointer(R"("base": {"bed": {"file": "three.csv", "seed": 2}})"), "/base/bed/seed");
}

TEST_F(GrainFileTest, SeedsOfABedFromAFileWouldBeEqualCases) {
  write("three.csv", kThree);
  const auto found = problems(R"("base": {"bed": {"file": "three.csv"}}, "replicates": {"seeds": 3})");
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(sentence("s", found[0]), HasSubstr("/replicates/seeds: bed.seed is"));
}

TEST_F(GrainFileTest, ThePileStaysInTheBedThatTheFileHolds) {
  write("three.csv", kThree);
  const auto found = problems(R"("base": {"bed": {"file": "three.csv"}, "pile": {"depth": 0.4}})");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].what, HasSubstr("is deeper than the bed, about 0.315 m high"));
}

}  // namespace
}  // namespace seapile::study
