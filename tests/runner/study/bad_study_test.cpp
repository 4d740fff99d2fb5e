#include <gmock/gmock.h>
#include <sys/stat.h>

#include <algorithm>
#include <random>

#include "runner/study/json_value.h"
#include "runner/study/problem_text.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::HasSubstr;

struct BadStudy {
  std::string pointer, fragment, bytes;
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// \xHH as the byte.
std::string with_bytes(const std::string& text) {
  std::string bytes;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text.compare(at, 2, "\\x") == 0) {
      bytes += static_cast<char>(std::stoi(text.substr(at + 2, 2), nullptr, 16));
      at += 3;
    } else {
      bytes += text[at];
    }
  }
  return bytes;
}

std::vector<BadStudy> catalogue() {
  std::ifstream file(SEAPILE_SOURCE_DIR "/tests/runner/study/bad/studies.txt");
  std::vector<BadStudy> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    const auto first = line.find(" |");
    const auto second = line.find(" |", first + 2);
    if (first == std::string::npos || second == std::string::npos) throw std::runtime_error("not a row: " + line);
    BadStudy row{line.substr(0, first), trimmed(line.substr(first + 2, second - first - 2)),
                 trimmed(line.substr(second + 2))};
    if (row.pointer == "-") row.pointer = "";
    if (row.bytes.compare(0, 4, "RAW ") == 0) {
      row.bytes = row.bytes.substr(4);
    } else if (row.bytes.compare(0, 1, "\"") == 0) {
      row.bytes = R"({"study": "bad", )" + row.bytes + "}";
    }
    row.bytes = with_bytes(row.bytes);
    rows.push_back(row);
  }
  return rows;
}

class BadStudyFile : public Scratch {
 protected:
  base::Problems problems_of(const std::string& bytes) const {
    try {
      read(write("bad.json", bytes));
    } catch (const BadInput& bad) {
      return bad.problems;
    }
    return {};
  }

  std::size_t file_count() const {
    const std::filesystem::recursive_directory_iterator files(folder_);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }
};

TEST_F(BadStudyFile, EachOfTheCatalogueHasItsOneProblemAtItsPlace) {
  const auto rows = catalogue();
  EXPECT_GE(rows.size(), 120u);
  for (const BadStudy& row : rows) {
    SCOPED_TRACE(row.bytes);
    const auto found = problems_of(row.bytes);
    ASSERT_FALSE(found.empty()) << "was accepted";
    EXPECT_EQ(found.front().pointer, row.pointer) << sentence("bad.json", found.front());
    EXPECT_THAT(sentence("bad.json", found.front()), HasSubstr(row.fragment));
    for (std::size_t i = 1; i < found.size(); ++i) ADD_FAILURE() << "one more: " << sentence("bad.json", found[i]);
    EXPECT_EQ(file_count(), 1u) << "something was written";
  }
}

TEST_F(BadStudyFile, TellsAllItsProblemsAtOnce) {
  const auto found = problems_of(R"({
    "study": "Bad", "axess": {},
    "base": {"pile": {"raduis": 0.1, "friction": 11, "radius": 3}, "bed": {"grains": {"count": 3.7}}},
    "axes": {"pile.tip": ["flatt", "conical"], "pile.depth": []},
    "record": {"travel": "1 s"},
    "fidelity": "theses"
  })");
  std::vector<std::string> pointers;
  for (const auto& problem : found) pointers.push_back(problem.pointer);
  EXPECT_THAT(pointers, testing::UnorderedElementsAre("/study", "/axess", "/base/pile/raduis", "/base/pile/friction",
                                                      "/base/pile/radius", "/base/bed/grains/count", "/axes/pile.tip/0",
                                                      "/axes/pile.depth", "/record/travel", "/fidelity"));
}

TEST_F(BadStudyFile, AProblemSharedByManyCasesIsToldOnce) {
  const auto found = problems(R"("base": {"pile": {"radius": 3}}, "replicates": {"seeds": 5000})");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].pointer, "/base/pile/radius");
}

TEST_F(BadStudyFile, AMillionOpenBracketsAreRefusedAtTheDepthThatIsTooMuch) {
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string bytes = R"({"study": "bad", "base": )";
    for (int i = 0; i < 1'000'000; ++i) bytes += bracket;
    const auto found = problems_of(bytes);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_THAT(found[0].what, HasSubstr("is nested deeper than 32 levels"));
    EXPECT_THAT(found[0].pointer, testing::StartsWith("/base/"));
  }
}

TEST_F(BadStudyFile, ThirtyTwoLevelsAreReadAndThirtyThreeAreNot) {
  const auto nested = [](int levels) { return std::string(levels, '[') + std::string(levels, ']'); };
  base::Problems found;
  EXPECT_EQ(read_json(nested(32), "", found).kind, Value::Kind::array);
  EXPECT_TRUE(found.empty());
  EXPECT_EQ(read_json(nested(33), "", found).kind, Value::Kind::unusable);
  EXPECT_EQ(found.size(), 1u);
}

TEST_F(BadStudyFile, SixteenMebibytesAreTheMost) {
  const std::string start = R"({"study": "bad", "question": ")";
  const std::string end = "\"}";
  const std::string most = start + std::string(kMostBytes - start.size() - end.size(), 'x') + end;
  EXPECT_TRUE(problems_of(most).empty());
  const auto found = problems_of(start + "x" + most.substr(start.size()));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].what, HasSubstr("is larger than 16 MiB"));
}

TEST_F(BadStudyFile, AMillionValuesAreRefused) {
  std::string bytes = R"({"study": "bad", "record": {"frames": [0)";
  for (int i = 0; i < 1'000'000; ++i) bytes += ",1";
  const auto found = problems_of(bytes + "]}}");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].what, HasSubstr("more than 200000"));
}

TEST_F(BadStudyFile, TenThousandFramesAreTheMost) {
  std::string frames = "0";
  for (int i = 1; i <= 10'000; ++i) frames += "," + std::to_string(i * 1e-4);
  const auto found = problems(R"("base": {"pile": {}}, "record": {"frames": [)" + frames + "]}");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(sentence("x", found[0]), "x: /record/frames: has 10001 depths; allowed: at most 10000");
}

TEST_F(BadStudyFile, AnythingThatIsNoFileIsSaidClearly) {
  const auto what_of = [](const std::filesystem::path& path) {
    try {
      read(path);
    } catch (const BadInput& bad) {
      EXPECT_EQ(bad.file, path.string());
      EXPECT_EQ(bad.problems.size(), 1u);
      return bad.problems[0].what;
    }
    return std::string("was accepted");
  };
  EXPECT_EQ(what_of(folder_ / "absent.json"), "cannot be read: No such file or directory");
  EXPECT_EQ(what_of(folder_), "is a directory, not a file");
  EXPECT_EQ(what_of("/dev/zero"), "is not a regular file");
  const auto fifo = folder_ / "fifo.json";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  EXPECT_EQ(what_of(fifo), "is not a regular file");
  std::filesystem::create_symlink("loop.json", folder_ / "loop.json");
  EXPECT_EQ(what_of(folder_ / "loop.json"), "cannot be read: Too many levels of symbolic links");
}

// Whatever stands in a file, reading it ends in a study or in BadInput with at least one problem.
TEST_F(BadStudyFile, AnyDamageEndsInAStudyOrInItsProblems) {
  const std::string good = R"({"study": "s", "base": {"pile": {"depth": "1.2 m", "tip": {"conical": {"apex_angle": 1}}},
    "fluid": null}, "axes": {"pile.radius": [0.1, "120 mm"], "pile.driving": ["vibratory", {"constant": {"speed": 0.2}}]},
    "zip": {"pile.friction": [0, 0.5], "bed.seed": [1, 2]}, "exclude": [{"pile.radius": 0.1, "bed.seed": 2}],
    "when": [{"if": {"pile.driving": "vibratory"}, "set": {"pile.depth": 1}}], "fidelity": "draft", "record": {"frames": [0]},
    "checks": [{"metric": "q", "value": "1 kPa", "tolerance": "5 Pa", "source": "x", "if": {"pile.radius": 0.1}, "drift": 0},
      {"claim": "c", "number": 1, "metric": "q", "of": {"pile.radius": 0.1}, "over": {"pile.radius": 0.12}, "at_most": 1, "margin": "5 %"}]})";
  ASSERT_TRUE(problems_of(good).empty()) << sentence("", problems_of(good)[0]);
  std::mt19937 random(7);
  const std::string letters = "{}[]\",:0123456789.eE-nulltrufasm/\\ \xff\x01";
  for (int round = 0; round < 1500; ++round) {
    std::string bytes = good;
    for (auto changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % bytes.size();
      switch (random() % 3) {
        case 0:
          bytes[at] = letters[random() % letters.size()];
          break;
        case 1:
          bytes.erase(at, 1 + random() % 4);
          break;
        default:
          bytes.insert(at, bytes.substr(random() % bytes.size(), random() % 12));
      }
    }
    try {
      EXPECT_FALSE(read(write("bad.json", bytes)).cases.empty());
    } catch (const BadInput& bad) {
      EXPECT_FALSE(bad.problems.empty());
      const std::string lines = bad.what();
      EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n') + 1, std::ssize(bad.problems)) << "a line for each";
    }
  }
}

}  // namespace
}  // namespace seapile::study
