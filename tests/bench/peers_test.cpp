// The verdicts of the comparison with other codes (bench/peers/README.md): the programs, run as a user runs them.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace seapile {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

struct Finished {
  int exit_code = -1;
  std::string text;  ///< output and errors
};

Finished shell(const std::string& command) {
  std::FILE* pipe = popen(("(" + command + ") 2>&1").c_str(), "r");
  if (!pipe) throw std::runtime_error("no shell");
  Finished finished;
  std::array<char, 4096> buffer;
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
    finished.text.append(buffer.data(), count);
  const int status = pclose(pipe);
  finished.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return finished;
}

Finished judge(const std::string& pairs, const std::string& options = "") {
  return shell("printf '" + pairs + "' | '" SEAPILE_PEER_PAIRS "' " + options);
}

/// Ratios of 1.01 times 1.02 and 1 / 1.02, twice each: in the logarithm a mean of ln 1.01 and a standard error of
/// ln 1.02 / sqrt 3, with three degrees of freedom: t_0.975 = 3.182446, t_0.95 = 2.353363.
const std::string kPairs = "100 103.02\\n200 206.04\\n300 297.0588235294\\n400 396.0784313725\\n";
const double kError = std::log(1.02) / std::sqrt(3);

TEST(PeerPairs, JudgesAHandMadeExample) {
  const Finished finished = judge(kPairs);
  ASSERT_EQ(finished.exit_code, 0) << finished.text;
  EXPECT_EQ(std::ranges::count(finished.text, '\n'), 1);
  const auto found = nlohmann::json::parse(finished.text);
  EXPECT_EQ(found["n"], 4);
  EXPECT_NEAR(found["ratio"], 1.01, 1e-9);
  EXPECT_NEAR(found["low"], 1.01 * std::exp(-3.182446 * kError), 1e-6);
  EXPECT_NEAR(found["high"], 1.01 * std::exp(3.182446 * kError), 1e-6);
  EXPECT_EQ(found["verdict"], "equivalent");
  EXPECT_EQ(found["margin"], 0.05);
  EXPECT_NEAR(found["resolved_margin"], 1.01 * std::exp(2.353363 * kError) - 1, 1e-6);
  // Of 200,000 normal samples with this scatter 61 % are found equivalent with three pairs, 88 % with four.
  EXPECT_EQ(found["needed"], 4);
}

TEST(PeerPairs, TheMarginIsStatedAsARatio) {
  const double resolved = nlohmann::json::parse(judge(kPairs).text)["resolved_margin"];
  const auto verdict = [&](double margin) {
    return nlohmann::json::parse(judge(kPairs, "--margin " + std::to_string(margin)).text)["verdict"];
  };
  EXPECT_EQ(verdict(resolved + 1e-5), "equivalent");
  EXPECT_EQ(verdict(resolved - 1e-5), "not distinguishable");
}

TEST(PeerPairs, OnePairTellsNothing) {
  const auto found = nlohmann::json::parse(judge("2 3\\n").text);
  EXPECT_EQ(found["ratio"], 1.5);
  EXPECT_EQ(found["verdict"], "underpowered");
  for (const char* name : {"low", "high", "resolved_margin", "needed"}) EXPECT_TRUE(found[name].is_null()) << name;
}

TEST(PeerPairs, BadInputIsOneLineAndExitCodeTwo) {
  const std::vector<std::array<std::string, 3>> bad = {
      {"", "", "there are no pairs"},       {"1 2\\n1 0\\n", "", "line 2 "},
      {"1 2\\n-1 -2\\n", "", "line 2 "},    {"1\\n", "", "line 1 "},
      {"1 2 3\\n", "", "line 1 "},          {"1 2\\n\\n1 2\\n", "", "line 2 "},
      {"1 nan\\n", "", "line 1 "},          {"1e-300 1e300\\n", "", "line 1 "},
      {"1 2\\n", "--margin 0", "--margin"}, {"1 2\\n", "--margin 5", "--margin"},
      {"1 2\\n", "--margin nan", "margin"}, {"1 2\\n", "--margins 0.05", "--margins"}};
  for (const auto& [pairs, options, what] : bad) {
    const Finished finished = judge(pairs, options);
    EXPECT_EQ(finished.exit_code, 2) << pairs << options;
    EXPECT_THAT(finished.text, StartsWith("peer_pairs: "));
    EXPECT_THAT(finished.text, HasSubstr(what));
    EXPECT_THAT(finished.text, EndsWith("\n"));
    EXPECT_EQ(std::ranges::count(finished.text, '\n'), 1) << finished.text;
  }
}

/// A force.csv, and what `compare.py table` says of it.
class PeerTable : public testing::Test {
 protected:
  void SetUp() override {
    if (shell("python3 --version").exit_code != 0) GTEST_SKIP() << "python3 is not installed";
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  Finished table(const std::vector<std::string>& lines) const {
    std::ofstream file(folder / "force.csv");
    for (const std::string& line : lines) file << line << '\n';
    file.close();
    return shell("python3 -B '" SEAPILE_SOURCE_DIR "/bench/peers/compare.py' table '" + folder.string() +
                 "' --peer-pairs '" SEAPILE_PEER_PAIRS "'");
  }

  /// Four beds. Non-smooth over ours is kPairs at 200 sweeps and 1.1 times that at 100; LAMMPS is 1.2 times ours, and
  /// has three beds.
  static std::vector<std::string> rows() {
    const double ours[] = {100, 200, 300, 400}, sweeps_200[] = {103.02, 206.04, 297.0588235294, 396.0784313725};
    std::vector<std::string> lines;
    for (int k = 0; k < 4; ++k) {
      const auto add = [&](const std::string& code, const std::string& how, double force, const std::string& residual) {
        lines.push_back(fmt::format("{},1234567,{},0.80{},conical,0.06,{},0.6,0.8,{:.10f},1,0.01,{},5,11596", code,
                                    k + 1, k, how, force, residual));
      };
      add("ours", "10,,5e-05", ours[k], "0.001");
      add("nonsmooth", "200,,0.0001", sweeps_200[k], "0.0002");
      add("nonsmooth", "100,,0.0001", 1.1 * sweeps_200[k], "0.0004");
      if (k < 3) add("lammps", ",1e+08,2e-05", 1.2 * ours[k], "");
    }
    return lines;
  }

  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("seapile_peers_" + std::to_string(::getpid()));
  const std::string head =
      "code,version,seed,solid_fraction,tip,speed,solves,kn,dt,from,end,force_mean,force_se,overlap_p999,residual,"
      "cpu_per_s,grains";
};

/// Without the spaces that fill columns.
std::string narrow(std::string text) {
  text.erase(std::unique(text.begin(), text.end(), [](char a, char b) { return a == ' ' && b == ' '; }), text.end());
  return text;
}

TEST_F(PeerTable, JudgesEveryMethodBedByBed) {
  std::vector<std::string> lines = rows();
  lines.insert(lines.begin(), head);
  const Finished finished = table(lines);
  ASSERT_EQ(finished.exit_code, 0) << finished.text;
  const std::string text = narrow(finished.text);
  EXPECT_THAT(text,
              HasSubstr("| beds | ratio | 95 % interval | verdict at 5 % | resolved margin | beds needed for 5 % |"));
  EXPECT_THAT(text, HasSubstr("| nonsmooth | 200 | 0.0001 | 4 | 1.010 | 0.974 - 1.047 | equivalent | 3.75 % | 4 |"));
  EXPECT_THAT(text, HasSubstr("| nonsmooth | 100 | 0.0001 | 4 | 1.111 | 1.071 - 1.152 | different | 14.13 % | 4 |"));
  EXPECT_THAT(text, HasSubstr("| lammps | 1e+08 | 2e-05 | 3 | 1.200 | 1.200 - 1.200 | different | 20.00 % | 2 |"));
  // Fewest sweeps against most, with the residuals of both.
  EXPECT_THAT(text, HasSubstr("| 100 | 0.0004 | 200 | 0.0002 | 4 | 1.100 | 1.100 - 1.100 | different | 10.00 % | 2 |"));
}

TEST_F(PeerTable, DoesNotMindTheOrderOfRowsNorTablesOneAfterTheOther) {
  std::vector<std::string> lines = rows();
  lines.insert(lines.begin(), head);
  const std::string expected = table(lines).text;
  lines = rows();
  std::ranges::reverse(lines);
  lines.insert(lines.begin() + 7, head);
  lines.insert(lines.begin(), head);
  EXPECT_EQ(table(lines).text, expected);
}

TEST_F(PeerTable, RefusesRowsThatContradictEachOther) {
  const std::string other_force = "ours,1234567,1,0.800,conical,0.06,10,,5e-05,0.6,0.8,101,1,0.01,0.001,5,11596";
  const std::string other_bed = "liggghts,3.8.0,1,0.810,conical,0.06,,1e+08,2e-05,0.6,0.8,101,1,0.01,,5,11596";
  const std::string other_speed = "liggghts,3.8.0,1,0.800,conical,0.4,,1e+08,2e-05,0.6,0.8,101,1,0.01,,5,11596";
  for (const std::string& line : {other_force, other_bed, other_speed}) {
    std::vector<std::string> lines = rows();
    lines.insert(lines.begin(), head);
    lines.push_back(line);
    const Finished finished = table(lines);
    EXPECT_EQ(finished.exit_code, 1) << line;
    EXPECT_THAT(finished.text, StartsWith("compare.py: force.csv "));
    EXPECT_EQ(std::ranges::count(finished.text, '\n'), 1) << finished.text;
  }
}

/// Stands for peer_scene: notes what it is asked for, and says that every force is 100 N/m; by another name, has
/// another bed or force.
constexpr const char* kFakeScene = R"(#!/usr/bin/env python3
import json, sys
from pathlib import Path
asked = dict(word.split("=", 1) for word in sys.argv[2:])
seed, out = float(asked["--seed"]), Path(asked["--out"])
with open(Path(__file__).parent / "asked", "a") as file:
    print(f"{seed:g}:", asked["--substeps"], asked.get("--sweeps", ""), file=file)
bed = 0.81 if Path(__file__).name == "other_bed" else 0.8
newtons = 101 if Path(__file__).name == "other_force" else 100
(out / "state.json").write_text(json.dumps({"seed": seed, "solid_fraction": bed + 1e-8 * seed, "start": 0.55, "from": 0.6, "end": 0.8}))
rows = ["method,solves,dt,simulated,cpu,wall,overlap_p999,recorded_p999,residual"]
for method, option in ("soft", "--substeps"), ("nonsmooth", "--sweeps"):
    for n in asked.get(option, "").split(","):
        if n:
            rows.append(f"{method},{n},1e-4,1,1,1,0.01,0.01,0.001")
            force = "".join(f"{0.6 + 0.01 * k},1,{newtons}\n" for k in range(20))
            (out / f"force_{method}_{n}.csv").write_text("depth,span,force\n" + force)
(out / "ours.csv").write_text("\n".join(rows) + "\n")
)";

TEST_F(PeerTable, KeepRunsOnlyWhatIsLackingAndRefusesAnotherBedOrProgram) {
  for (const char* name : {"scene", "other_bed", "other_force"}) {
    std::ofstream(folder / name) << kFakeScene;
    std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
  }
  const auto force = [&](const std::string& options, const std::string& program = "scene") {
    return shell("python3 -B '" SEAPILE_SOURCE_DIR "/bench/peers/compare.py' force '" + folder.string() +
                 "' --codes none --peer-pairs '" SEAPILE_PEER_PAIRS "' --peer-scene '" + (folder / program).string() +
                 "' " + options);
  };
  const auto content = [&](const char* name) { return shell("cat '" + (folder / name).string() + "'").text; };
  for (const char* options : {"--seeds 1 --sweeps 100", "--keep --seeds 2 --sweeps 100,200", "--keep --seeds 2"}) {
    const Finished finished = force(options);
    ASSERT_EQ(finished.exit_code, 0) << finished.text;
  }
  EXPECT_EQ(content("asked"), "1: 10 100\n1: 10 200\n2: 10 100,200\n");
  const std::string kept = content("force.csv");
  EXPECT_EQ(std::ranges::count(kept, '\n'), 1 + 2 * 3) << kept;

  for (const char* program : {"other_bed", "other_force"}) {
    const Finished refused = force("--keep --seeds 2 --sweeps 400", program);
    EXPECT_EQ(refused.exit_code, 1) << program;
    EXPECT_THAT(refused.text, HasSubstr("another bed or run of seed 1"));
  }
  EXPECT_EQ(force("--keep --seeds 2 --speed 0.4").exit_code, 1);
  EXPECT_EQ(force("--first 3 --seeds 2").exit_code, 2);
  EXPECT_EQ(content("force.csv"), kept);
}

}  // namespace
}  // namespace seapile
