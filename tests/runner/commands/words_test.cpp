// What is said of a command line with a word that does not exist, and in which colours the answers are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/runner/commands/shell.h"

namespace seapile::commands {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kEscape = "\x1b[";

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

/// The commands that `runner --help` lists.
std::vector<std::string> listed_commands(const Workplace& place) {
  const std::string help = place.run({"--help"}).out;
  std::istringstream in(help.substr(help.find("Subcommands:")));
  std::vector<std::string> names;
  std::string line;
  for (std::getline(in, line); std::getline(in, line) && line.starts_with("  ");) {
    if (line[2] != ' ') names.push_back(line.substr(2, line.find(' ', 2) - 2));
  }
  return names;
}

TEST(Help, OfEveryCommandHasAnExampleThatCallsIt) {
  const Workplace place;
  const auto names = listed_commands(place);
  EXPECT_GE(names.size(), 11u);
  for (const std::string& name : names) {
    const Finished help = place.run({name, "--help"});
    EXPECT_EQ(help.exit_code, 0) << name;
    const auto example = help.out.find("\nExample");
    ASSERT_NE(example, std::string::npos) << name;
    EXPECT_THAT(help.out.substr(example), HasSubstr("runner " + name)) << name;
  }
}

struct Said {
  std::vector<std::string> words;
  const char* sentence;
};

TEST(DidYouMean, AWordThatDoesNotExistEndsWithTwoAndNamesTheNearest) {
  const Workplace place;
  std::filesystem::create_directory(place.folder() / "studies");
  place.write("studies/tip_shape.json", "{}");
  place.write("mine.json", "{}");
  const auto before = everything(place.folder());
  for (const Said& said : {
           Said{{"querry"}, "there is no command \"querry\"; did you mean \"query\"?"},
           Said{{"Reindex", "--store", "x"}, "there is no command \"Reindex\"; did you mean \"reindex\"?"},
           Said{{"query", "--colums", "a"}, "there is no option --colums; did you mean \"--columns\"?"},
           Said{{"query", "--fromat=csv"}, "there is no option --fromat; did you mean \"--format\"?"},
           Said{{"run", "--sedes", "3"}, "there is no option --sedes; did you mean \"--seeds\"?"},
           Said{{"--vresion"}, "there is no option --vresion; did you mean \"--version\"?"},
           Said{{"query", "--xyzzy"}, "there is no option --xyzzy; `runner query --help` names all"},
           Said{{"tip_shape"}, "there is no command \"tip_shape\"; did you mean \"studies/tip_shape.json\"?"},
           Said{{"tip_shap.json"}, "there is no file tip_shap.json; did you mean \"studies/tip_shape.json\"?"},
           Said{{"mien.json"}, "there is no file mien.json; did you mean \"mine.json\"?"},
           Said{{"no/such/file.json"}, "there is no file no/such/file.json"},
           Said{{"query", "--format", "jsno"}, "--format: \"jsno\" is unknown; allowed: table, csv, json, ndjson; did"},
           Said{{"run", "mine.json", "--jobs", "0"}, "--jobs: \"0\" is no number from 1 up"},
           Said{{"probe", "mine.json", "--tolerance", "-1"}, "--tolerance: \"-1\" is no number from 0 up"},
       }) {
    const Finished finished = place.run(said.words);
    EXPECT_EQ(finished.exit_code, 2) << said.sentence;
    EXPECT_THAT(finished.error, HasSubstr(said.sentence));
    EXPECT_EQ(finished.out, "");
  }
  const Finished unknown = place.run({"xyzzy"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.error, HasSubstr("there are run, plan, status"));
  EXPECT_THAT(unknown.error, Not(HasSubstr("did you mean")));
  auto after = everything(place.folder());
  std::erase_if(after, [&](const auto& file) { return !before.contains(file.first); });
  EXPECT_EQ(after, before);
}

TEST(DidYouMean, WhatFollowsTwoDashesIsNoOption) {
  const Workplace place;
  EXPECT_THAT(place.run({"query", "--store", "nowhere", "--", "--sedes"}).error, Not(HasSubstr("no option")));
}

/// One study that was run, for answers to look at.
struct Answers : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->run_study("small", small_study("small"));
  }
  static void TearDownTestSuite() { delete place; }
  static Workplace* place;
};
Workplace* Answers::place;

TEST_F(Answers, AStudyThatWasNotRunIsAnsweredWithTheNearest) {
  const Finished finished = place->run({"query", "smal"});
  EXPECT_EQ(finished.exit_code, 4);
  EXPECT_EQ(finished.error, "no study called \"smal\" was run here; did you mean \"small\"?\n");
}

TEST_F(Answers, EachLineOfNdjsonStandsAloneAndSaysWhatTheTableSays) {
  const auto table = nlohmann::json::parse(place->run({"query", "small", "--format", "json"}).out);
  const auto rows = lines(place->run({"query", "small", "--format", "ndjson"}).out);
  ASSERT_EQ(rows.size(), table.at("rows").size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto row = nlohmann::json::parse(rows[i]);
    EXPECT_EQ(row.at("schema"), "runner/row/1");
    row.erase("schema");
    EXPECT_EQ(row, table.at("rows").at(i));
  }
}

TEST_F(Answers, AreInColourOnATerminalAlone) {
  const std::string green = "\x1b[32mcompleted\x1b[0m";
  EXPECT_THAT(on_terminal(*place, "TERM=xterm runner query small").out, HasSubstr(green));
  EXPECT_THAT(on_terminal(*place, "TERM=xterm runner small.json --dry-run").out, HasSubstr("\x1b[32mfresh\x1b[0m"));
  for (const char* without :
       {"TERM=xterm runner query small | cat", "TERM=xterm runner query small --no-color",
        "TERM=xterm runner --no-color query small", "NO_COLOR=1 TERM=xterm runner query small",
        "TERM=dumb runner query small", "env -u TERM runner query small", "TERM=xterm runner query small --format csv",
        "TERM=xterm runner query small --format json", "TERM=xterm runner query small --format ndjson"}) {
    const Finished finished = on_terminal(*place, without);
    EXPECT_EQ(finished.exit_code, 0) << without;
    EXPECT_THAT(finished.out, HasSubstr("completed")) << without;
    EXPECT_THAT(finished.out, Not(HasSubstr(kEscape))) << without;
  }
  EXPECT_THAT(on_terminal(*place, "NO_COLOR= TERM=xterm runner query small").out, HasSubstr(green));
}

TEST_F(Answers, ColoursTakeNothingAwayAndMoveNoColumn) {
  std::string coloured = on_terminal(*place, "TERM=xterm runner query small").out;
  for (const char* code : {"\x1b[32m", "\x1b[0m", "\r"}) {
    for (auto at = coloured.find(code); at != std::string::npos; at = coloured.find(code))
      coloured.erase(at, std::string(code).size());
  }
  EXPECT_EQ(coloured, place->run({"query", "small"}).out);
}

}  // namespace
}  // namespace seapile::commands
