// A folder of its own for each test, and studies written into it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "runner/study/study.h"

namespace seapile::study {

class Scratch : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "study_test_XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  /// Reads a study of the members given: {"study": "test", <members>}.
  Study study(const std::string& members, const Options& options = {}) const {
    return read(write("test.json", R"({"study": "test")" + (members.empty() ? "" : ", " + members) + "}"), options);
  }

  /// The problems of such a study; none when it is good.
  base::Problems problems(const std::string& members, const Options& options = {}) const {
    try {
      study(members, options);
    } catch (const BadInput& bad) {
      return bad.problems;
    }
    return {};
  }

  std::filesystem::path folder_;
};

}  // namespace seapile::study
