// docs/tutorial.md, followed to the letter in an empty folder: what it shows is what a reader sees.
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "tests/runner/commands/program.h"
#include "tests/runner/commands/shell.h"

namespace seapile::commands {
namespace {

struct Block {
  std::string language, text;
  int line = 0;
};

/// The fenced blocks of a Markdown file.
std::vector<Block> blocks(const std::string& markdown) {
  std::vector<Block> found;
  std::istringstream lines(markdown);
  bool inside = false;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) found.push_back({line.substr(3), "", number});
    } else if (inside) {
      found.back().text += line + "\n";
    }
  }
  return found;
}

TEST(Tutorial, ShowsWhatItsCommandsSay) {
  const Workplace place;
  Finished last;
  int commands = 0, outputs = 0;
  for (const Block& block : blocks(content(SEAPILE_SOURCE_DIR "/docs/tutorial.md"))) {
    SCOPED_TRACE("docs/tutorial.md, line " + std::to_string(block.line));
    if (block.language == "json") place.write("pile_100.json", block.text);
    if (block.language == "sh") {
      last = shell(place, block.text);
      ASSERT_EQ(last.exit_code, 0) << last.error;
      ++commands;
    }
    if (block.language == "text") {
      // Of several commands the output of the last is shown.
      ASSERT_GE(last.out.size(), block.text.size()) << last.out;
      EXPECT_EQ(last.out.substr(last.out.size() - block.text.size()), block.text);
      ++outputs;
    }
  }
  EXPECT_EQ(commands, 9);
  EXPECT_EQ(outputs, 5);
  EXPECT_EQ(content(place.folder() / "tutorial.svg"), content(SEAPILE_SOURCE_DIR "/docs/tutorial.svg"));
  EXPECT_FALSE(content(place.folder() / "pile_100.html").empty());
}

}  // namespace
}  // namespace seapile::commands
