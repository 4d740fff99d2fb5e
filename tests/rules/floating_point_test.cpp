// The promise of equal bits and every guard against bad numbers stand on strict floating point.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/rules/source_files.h"

namespace seapile::rules {
namespace {

// Volatile, so that the arithmetic is done when the test runs and not by the compiler.
volatile double zero = 0;

TEST(FloatingPoint, NanIsSeen) {
  const double nan = zero / zero;
  EXPECT_TRUE(std::isnan(nan));
  EXPECT_FALSE(std::isfinite(1 / zero));
  EXPECT_FALSE(nan == nan);
  EXPECT_FALSE(nan < 1);
}

TEST(FloatingPoint, SubnormalsAreKept) {
  volatile double smallest = std::numeric_limits<double>::min();
  volatile float smallest_single = std::numeric_limits<float>::min();
  EXPECT_GT(smallest / 2, 0);
  EXPECT_GT(smallest_single / 2, 0);
}

#ifdef __x86_64__
[[gnu::target("fma")]]
#endif
[[gnu::noinline]] double
product_and_sum(double a, double b, double c) {
  return a * b + c;
}

TEST(FloatingPoint, AProductIsRoundedBeforeItIsAdded) {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this processor has no fused operations";
#endif
  // (1 + e)(1 - e) = 1 - e^2 rounds to 1; fused with the subtraction it would give -e^2.
  volatile double e = std::ldexp(1.0, -30);
  EXPECT_EQ(product_and_sum(1 + e, 1 - e, -1), 0);
}

TEST(FloatingPoint, SumsAreNotRearranged) {
  const double large = 1e16 + zero, one = 1 + zero;
  EXPECT_EQ((large + one) - large, 0);
}

/// What loosens floating point in a compiler's command line; empty when it is strict.
std::string looseness(const std::string& command) {
  static const std::vector<std::string> kLoose = {"-ffast-math",       "-Ofast",
                                                  "-funsafe-math",     "-fassociative-math",
                                                  "-freciprocal-math", "-ffinite-math-only",
                                                  "-fno-signed-zeros", "-ffp-contract=fast",
                                                  "-ffp-contract=on",  "-ffp-model=fast"};
  std::istringstream words(command);
  bool uncontracted = false;
  for (std::string word; words >> word;) {
    for (const std::string& loose : kLoose) {
      if (word.starts_with(loose)) return "has " + word;
    }
    uncontracted |= word == "-ffp-contract=off";
  }
  return uncontracted ? "" : "lacks -ffp-contract=off (its target does not use seapile_strict)";
}

TEST(FloatingPoint, EveryFileIsCompiledStrictly) {
  std::ifstream stream(build_root() / "compile_commands.json");
  ASSERT_TRUE(stream) << "the build wrote no compile_commands.json";
  std::size_t files = 0;
  for (const auto& entry : nlohmann::json::parse(stream)) {
    ++files;
    const std::string loose = looseness(entry.at("command"));
    EXPECT_TRUE(loose.empty()) << entry.at("file").get<std::string>() << ": its command line " << loose;
  }
  EXPECT_GT(files, 0u);
}

TEST(FloatingPoint, NoBuildFileAsksForLooseArithmetic) {
  std::size_t files = 0;
  for (const std::string& file : versioned_files()) {
    const bool builds = file.ends_with("CMakeLists.txt") || file.ends_with(".cmake") || file == "CMakePresets.json";
    if (!builds) continue;
    ++files;
    const std::vector<std::string> lines = split_lines(read(file));
    for (std::size_t k = 0; k < lines.size(); ++k) {
      // A line that matches or reports flags refuses them.
      if (lines[k].find("MATCHES") != std::string::npos || lines[k].find("message(") != std::string::npos) continue;
      EXPECT_EQ(lines[k].find("-ffast-math"), std::string::npos) << place(file, k) << " asks for -ffast-math";
      EXPECT_EQ(lines[k].find("-Ofast"), std::string::npos) << place(file, k) << " asks for -Ofast";
    }
  }
  EXPECT_GT(files, 5u);
}

TEST(FloatingPoint, ALooseCommandLineIsSeen) {
  EXPECT_EQ(looseness("g++ -O3 -ffp-contract=off -c a.cpp"), "");
  EXPECT_EQ(looseness("g++ -O3 -ffp-contract=off -ffast-math -c a.cpp"), "has -ffast-math");
  EXPECT_EQ(looseness("g++ -Ofast -ffp-contract=off -c a.cpp"), "has -Ofast");
  EXPECT_NE(looseness("g++ -O3 -c a.cpp"), "");
}

}  // namespace
}  // namespace seapile::rules
