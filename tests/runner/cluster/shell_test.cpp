// Words that a shell reads back as they are: asked of the shell itself.
#include <gtest/gtest.h>

#include "runner/cluster/scheduler.h"
#include "runner/cluster/shell.h"

namespace seapile::cluster {
namespace {

TEST(Shell, ReadsEveryWordBackAsItWas) {
  std::vector<std::string> words = {"",    "plain",     "two words", "it's",  "\"quoted\"", "$HOME",        "`id`",
                                    "a;b", "a\nb",      "*",         "~",     "\\",         "-n",           "!x",
                                    "#no", "a&&b>file", "''",        "\ttab", "ü±",         "pile.tip=flat"};
  std::string bytes;
  for (int c = 1; c < 256; ++c) bytes += static_cast<char>(c);
  words.push_back(bytes);
  std::string expected;
  for (const std::string& word : words) expected += word + "\x1f";
  const Answer answer = ask("sh", {"-c", "for word in " + shell_line(words) + "; do printf '%s\\037' \"$word\"; done"});
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  EXPECT_EQ(answer.out, expected);
}

TEST(Shell, LeavesPlainWordsReadable) {
  EXPECT_EQ(shell_line({"runner", "run", "a.json", "--set", "pile.depth=0.3"}),
            "runner run a.json --set pile.depth=0.3");
}

}  // namespace
}  // namespace seapile::cluster
