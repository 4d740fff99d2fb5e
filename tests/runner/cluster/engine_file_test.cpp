// A site's engine file: every problem of it in a line of its own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "runner/cluster/engine_file.h"
#include "runner/study/study.h"

namespace seapile::cluster {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;

class EngineFile : public testing::Test {
 protected:
  void SetUp() override {
    file_ = fs::path(testing::TempDir()) /
            (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".json");
  }
  void TearDown() override { fs::remove(file_); }

  Engine read(const std::string& text) const {
    std::ofstream(file_) << text;
    return read_engine(file_);
  }

  /// "POINTER what" of each problem.
  std::vector<std::string> problems(const std::string& text) const {
    std::vector<std::string> lines;
    try {
      read(text);
    } catch (const study::BadInput& error) {
      for (const base::Problem& problem : error.problems) lines.push_back(problem.pointer + " " + problem.what);
    }
    return lines;
  }

  fs::path file_;
};

TEST_F(EngineFile, ItsMembersBecomeWordsForSbatchBeforeThoseOfTheSite) {
  const Engine engine =
      read(R"({"engine": "slurm", "account": "sand", "partition": "long", "qos": "low", "modules": ["hdf5"],
               "setup": ["ulimit -c 0"], "sbatch": ["--constraint=avx2"]})");
  EXPECT_THAT(sbatch_words(engine),
              ElementsAre("--account=sand", "--partition=long", "--qos=low", "--constraint=avx2"));
  EXPECT_THAT(engine.modules, ElementsAre("hdf5"));
  EXPECT_THAT(engine.setup, ElementsAre("ulimit -c 0"));
}

TEST_F(EngineFile, OneThatSaysNothingAsksForNothing) { EXPECT_TRUE(sbatch_words(read("{}")).empty()); }

TEST_F(EngineFile, EveryProblemIsNamed) {
  EXPECT_THAT(problems(R"({"engine": "pbs", "acount": "sand", "modules": "hdf5", "setup": ["two\nlines"], "qos": 3})"),
              testing::UnorderedElementsAre(testing::StartsWith("/acount is an unknown key"),
                                            testing::StartsWith("/qos "), "/modules is a string",
                                            "/setup/0 has a control character in its text", "/engine is no engine"));
  EXPECT_EQ(problems("{").size(), 1U);
  EXPECT_EQ(problems("[]").size(), 1U);
}

TEST_F(EngineFile, OneThatIsNotThereIsBadInput) { EXPECT_THROW(read_engine("no/such/file.json"), study::BadInput); }

}  // namespace
}  // namespace seapile::cluster
