#include "runner/study/problem_text.h"

#include <gtest/gtest.h>

namespace seapile::study {
namespace {

TEST(Sentence, NamesFilePlaceProblemRangeAndWhatWasMeant) {
  EXPECT_EQ(sentence("tip.json", {"/base/pile/raduis", "is an unknown key", "radius, tip", "radius"}),
            "tip.json: /base/pile/raduis: is an unknown key; allowed: radius, tip; did you mean \"radius\"?");
}

TEST(Sentence, LeavesOutWhatThereIsNot) {
  EXPECT_EQ(sentence("tip.json", {"", "is empty", "", ""}), "tip.json: is empty");
  EXPECT_EQ(sentence("tip.json", {"--set pile.depht", "is no path", "", "pile.depth"}),
            "tip.json: --set pile.depht: is no path; did you mean \"pile.depth\"?");
}

TEST(Sentence, IsOneLineThatCannotDisturbATerminal) {
  const std::string line = sentence("a\nb", {"/\x1b[2J", "has \r and \x07 and \xff and \xc2\x9b", "\x7f", ""});
  EXPECT_EQ(line, R"(a\x0ab: /\x1b[2J: has \x0d and \x07 and \xff and \xc2\x9b; allowed: \x7f)");
}

TEST(Sentence, KeepsOtherAlphabets) { EXPECT_EQ(sentence("Brücke.json", {"", "橋 😀", "", ""}), "Brücke.json: 橋 😀"); }

TEST(Sentence, CutsWhatIsOverlong) {
  EXPECT_LT(sentence("x", {std::string(1'000'000, 'p'), std::string(1'000'000, 'w'), "", ""}).size(), 1000u);
}

TEST(Printable, IsUtf8WithoutControlCharacters) {
  EXPECT_TRUE(is_printable("/daten/jürgen/studies"));
  EXPECT_TRUE(is_printable(""));
  for (const char* text : {"a\nb", "\xff", "\xc3(", "cut \xe2\x82", "\xc2\x85"})
    EXPECT_FALSE(is_printable(text)) << text;
}

}  // namespace
}  // namespace seapile::study
