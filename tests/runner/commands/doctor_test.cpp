// `runner doctor`: what it says of a healthy place, and that it says what is wrong where something is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

/// State and words by "area what".
std::map<std::string, std::pair<std::string, std::string>> findings(const Finished& answer) {
  std::map<std::string, std::pair<std::string, std::string>> found;
  const json answered = json::parse(answer.out);
  for (const json& row : answered.at("rows"))
    found[row.at("area").get<std::string>() + " " + row.at("what").get<std::string>()] = {row.at("state"),
                                                                                          row.at("words")};
  return found;
}

Finished examine(const Workplace& place) { return place.run({"doctor", "--format", "json"}); }

class Doctor : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    place = std::make_unique<Workplace>();
    place->run_study("two_tips", small_study("two_tips"));
  }
  static void TearDownTestSuite() { place.reset(); }
  static inline std::unique_ptr<Workplace> place;
};

TEST_F(Doctor, WhereNothingWasRunYetAllIsWellAndNothingIsLeftBehind) {
  const Workplace empty;
  fs::create_directory(empty.folder() / "disk");
  const Finished answer = empty.run({"doctor", "--store", "disk/results", "--format", "json"});
  EXPECT_EQ(answer.exit_code, 0) << answer.out << answer.error;
  const auto found = findings(answer);
  EXPECT_EQ(found.at("program mesher").first, "ok") << found.at("program mesher").second;
  EXPECT_EQ(found.at("store writing").first, "ok");
  EXPECT_THAT(found.at("store folder").second, HasSubstr("not there yet"));
  EXPECT_TRUE(fs::is_empty(empty.folder() / "disk"));
}

TEST_F(Doctor, AStoreThatIsWellIsLeftAsItWas) {
  const auto before = everything(place->results());
  const Finished answer = examine(*place);
  EXPECT_EQ(answer.exit_code, 0) << answer.out << answer.error;
  const auto found = findings(answer);
  EXPECT_EQ(found.at("store catalogue").first, "ok") << found.at("store catalogue").second;
  EXPECT_EQ(found.at("store runs").second, "3 complete");  // two drives and their bed
  EXPECT_EQ(found.count("store interrupted"), 0U);
  EXPECT_EQ(everything(place->results()), before);
}

TEST_F(Doctor, RunsThatTheCatalogueLacksAreCounted) {
  const fs::path catalogue = place->results() / "catalogue.sqlite", kept = place->folder() / "kept.sqlite";
  fs::rename(catalogue, kept);
  EXPECT_THAT(findings(examine(*place)).at("store catalogue").second, HasSubstr("is not there"));
  ASSERT_EQ(place->run({"reindex"}).exit_code, 0);
  const fs::path some_case = fs::directory_iterator(place->results() / "cases")->path();
  fs::rename(some_case, place->folder() / "elsewhere");
  ASSERT_EQ(place->run({"reindex"}).exit_code, 0);
  fs::rename(place->folder() / "elsewhere", some_case);
  const Finished answer = examine(*place);
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(findings(answer).at("store catalogue").first, "note");
  EXPECT_THAT(findings(answer).at("store catalogue").second, HasSubstr("lacks 1 complete run;"));
  fs::rename(kept, catalogue);
}

TEST_F(Doctor, ACatalogueThatIsNoneIsAProblem) {
  const fs::path catalogue = place->results() / "catalogue.sqlite", kept = place->folder() / "kept.sqlite";
  fs::rename(catalogue, kept);
  place->write("results/catalogue.sqlite", "this is no database, whatever its name says\n");
  const Finished answer = examine(*place);
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_EQ(findings(answer).at("store catalogue").first, "problem");
  EXPECT_THAT(findings(answer).at("store catalogue").second, HasSubstr("runner reindex"));
  EXPECT_THAT(answer.error, HasSubstr("1 problem,"));
  fs::rename(kept, catalogue);
}

TEST_F(Doctor, ARunThatCameToNoEndIsNamed) {
  const fs::path begun = fs::directory_iterator(place->results() / "cases")->path() / "0002";
  fs::create_directory(begun);
  const auto found = findings(examine(*place));
  fs::remove(begun);
  EXPECT_EQ(found.at("store interrupted").first, "note");
  EXPECT_THAT(found.at("store interrupted").second, HasSubstr("1 ("));
  EXPECT_THAT(found.at("store interrupted").second, HasSubstr("/0002)"));
}

TEST_F(Doctor, AManifestThatWasChangedIsAProblem) {
  const fs::path manifest = fs::directory_iterator(place->results() / "cases")->path() / "0001" / "manifest.json";
  const std::string text = content(manifest);
  std::string changed = text;
  changed.replace(changed.find("\"seal\": \"") + 9, 4, "0000");
  std::ofstream(manifest) << changed;
  const Finished answer = examine(*place);
  std::ofstream(manifest) << text;
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_EQ(findings(answer).at("store damaged").first, "problem");
}

TEST_F(Doctor, ADeclarationThatDoesNotHoldIsNamed) {
  fs::create_directory(place->results() / "equivalents");
  place->write("results/equivalents/bed.json", "{}");
  const Finished answer = examine(*place);
  fs::remove_all(place->results() / "equivalents");
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(findings(answer).at("store declarations").first, "note");
  EXPECT_THAT(findings(answer).at("store declarations").second, HasSubstr("bed.json"));
}

TEST_F(Doctor, WhereThereIsNoGnuplotAPictureIsMissedAndNothingElse) {
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const Finished answer = examine(*place);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(answer.exit_code, 0);
  EXPECT_EQ(findings(answer).at("program gnuplot").first, "note");
  EXPECT_THAT(findings(answer).at("cluster Slurm").second, HasSubstr("is not here"));
}

TEST_F(Doctor, AFileInTheStoresPlaceIsAProblem) {
  const Workplace other;
  other.write("results", "no folder");
  const Finished answer = examine(other);
  EXPECT_EQ(answer.exit_code, 3);
  EXPECT_THAT(findings(answer).at("store folder").second, HasSubstr("is no folder"));
}

}  // namespace
}  // namespace seapile::commands
