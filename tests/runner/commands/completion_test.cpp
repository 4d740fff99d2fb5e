// The completion of bash, in bash.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "tests/runner/commands/shell.h"

namespace seapile::commands {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Not;
using testing::UnorderedElementsAre;

/// What bash offers where the last of these words is being typed.
std::vector<std::string> offered(const Workplace& place, const std::string& words) {
  const Finished finished = shell(place, "source <(runner completion bash); COMP_WORDS=(" + words +
                                             "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _runner; "
                                             "printf '%s\\n' \"${COMPREPLY[@]}\"");
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  std::vector<std::string> lines;
  std::istringstream in(finished.out);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Completion, OffersCommandsOptionsAndTheirValues) {
  const Workplace place;
  EXPECT_THAT(offered(place, "runner qu"), ElementsAre("query"));
  EXPECT_THAT(offered(place, "runner ''"), Contains("status"));
  EXPECT_THAT(offered(place, "runner ''"), Not(Contains("exec"))) << "no command for people";
  EXPECT_THAT(offered(place, "runner run --see"), ElementsAre("--seeds"));
  EXPECT_THAT(offered(place, "runner query --format ''"), UnorderedElementsAre("table", "csv", "json", "ndjson"));
}

TEST(Completion, OffersStudyFilesStudiesAndCases) {
  const Workplace place;
  const auto ids = place.run_study("small", small_study("small"));
  EXPECT_THAT(offered(place, "runner run sm"), ElementsAre("small.json"));
  EXPECT_THAT(offered(place, "runner query sm"), Contains("small"));
  EXPECT_THAT(offered(place, "runner show " + ids.front().substr(0, 4)), Contains(ids.front()));
}

TEST(Completion, OfAnotherShellIsRefused) {
  const Workplace place;
  EXPECT_EQ(place.run({"completion", "fish"}).exit_code, 2);
}

}  // namespace
}  // namespace seapile::commands
