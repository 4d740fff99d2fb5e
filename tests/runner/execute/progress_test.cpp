#include "runner/execute/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <memory>

#include "tests/runner/execute/fake_study.h"

namespace seapile::execute {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(SecondsLeft, OneCaseByItsOwnSpeed) {
  EXPECT_DOUBLE_EQ(*seconds_left({{{Kind::drive, 0, 0.25, 10}}, 0, 0, {}, {}, 1}), 30);
}

TEST(SecondsLeft, AResumedCaseIsNotCreditedWithWhatItDidBefore) {
  EXPECT_DOUBLE_EQ(*seconds_left({{{Kind::drive, 0.5, 0.75, 10}}, 0, 0, {}, {}, 1}), 10);
}

TEST(SecondsLeft, WaitingCasesCostWhatTheirKindHasCost) {
  EXPECT_DOUBLE_EQ(*seconds_left({{{Kind::drive, 0, 0.5, 10}}, 1, 2, {4}, {}, 1}), 10 + 4 + 2 * 20);
  EXPECT_DOUBLE_EQ(*seconds_left({{}, 0, 3, {}, {10, 20}, 1}), 45);
}

TEST(SecondsLeft, CasesAtATimeShareTheWork) {
  const Going half{Kind::drive, 0, 0.5, 10};
  EXPECT_DOUBLE_EQ(*seconds_left({{half, half}, 0, 2, {}, {}, 2}), 30);
  EXPECT_DOUBLE_EQ(*seconds_left({{half, {Kind::drive, 0, 0.99, 10}}, 0, 0, {}, {}, 2}), 10);  // never before the last
}

TEST(SecondsLeft, NothingIsGuessed) {
  EXPECT_FALSE(seconds_left({{{Kind::drive, 0, 0, 10}}, 0, 0, {}, {}, 1}));  // nothing computed yet
  EXPECT_FALSE(seconds_left({{}, 0, 1, {5}, {}, 1}));                        // no drive has been seen
}

TEST(ClockText, ReadsLikeAClock) {
  EXPECT_EQ(clock_text(0), "0:00");
  EXPECT_EQ(clock_text(41.2), "0:42");
  EXPECT_EQ(clock_text(723), "12:03");
  EXPECT_EQ(clock_text(3723), "1:02:03");
}

TEST(DurationText, IsExactWhileItIsShort) {
  EXPECT_EQ(duration_text(6.54), "6.5 s");
  EXPECT_EQ(duration_text(123.4), "2:04");
}

/// What a display writes.
std::string shown(bool terminal, const std::function<void(Watch&)>& happens) {
  FILE* stream = std::tmpfile();
  const Plan plan =
      make_plan(fake::make_study({{"flat", "bed"}, {"cone", "bed"}}), fake::numerics, fake::FakeDisk().look(), {});
  {
    Display display(plan, stream, terminal);
    Watch watch = display.watch();
    happens(watch);
  }
  std::string text(static_cast<std::size_t>(std::ftell(stream)), ' ');
  std::rewind(stream);
  EXPECT_EQ(std::fread(text.data(), 1, text.size(), stream), text.size());
  std::fclose(stream);
  return text;
}

void a_short_study(Watch& watch) {
  watch.started(0, 2);
  watch.advanced(0, 0.5);
  watch.started(1, 1);
  watch.changed(0, State::completed, "");
  watch.changed(1, State::failed, "killed by SIGSEGV");
}

TEST(Display, WithoutATerminalItWritesPlainLinesOnePerEvent) {
  const std::string text = shown(false, a_short_study);
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\r'), std::string::npos);
  EXPECT_EQ(std::ranges::count(text, '\n'), 4);
  EXPECT_THAT(text, HasSubstr("started    bed bed (2 threads): never run\n"));
  EXPECT_THAT(text, HasSubstr("FAILED     case=flat: killed by SIGSEGV\n"));
}

TEST(Display, OnATerminalTheLastLineCountsAndIsClearedAtTheEnd) {
  const std::string text = shown(true, a_short_study);
  EXPECT_THAT(text, HasSubstr("bed bed 50 %"));
  EXPECT_THAT(text, HasSubstr("2 of 3 done"));
  EXPECT_THAT(text, HasSubstr("1 waiting"));
  EXPECT_TRUE(text.ends_with("\r\x1b[K"));
}

}  // namespace
}  // namespace seapile::execute
