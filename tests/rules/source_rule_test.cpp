// What no file of the project may contain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/rules/source_files.h"

namespace seapile::rules {
namespace {

struct Ban {
  std::string_view pattern;  ///< regular expression, matched against one line of code without comments and strings
  std::string_view why;
};

/// In the solver every bit of a result depends on the case alone (docs/reproducibility.md).
const std::vector<Ban> kBannedInTheSolver = {
    {R"(\w+_distribution\b)", "the standard's distributions differ between libraries"},
    {R"(\bstd::(shuffle|sample|random_device|default_random_engine|rand)\b)", "it differs between libraries or runs"},
    {R"(\bunordered_(map|set|multimap|multiset)\b)", "its order of iteration is nobody's promise"},
    {R"(\bstd::(reduce|transform_reduce)\b)", "its order of summation is not fixed"},
    {R"(\breduction\s*\(\s*[+*-])", "its order of summation depends on the number of threads"},
    {R"(\b_mm\d*_(mask_|maskz_)?(rcp|rsqrt))", "reciprocal approximations differ between processors"},
};

const std::vector<Ban> kBannedEverywhere = {
    {R"(\busing\s+namespace\s+std\s*;)", "names of the standard library are written in full"},
    {R"(#\s*pragma\s+(GCC|clang)\s+(optimize|float_control|fp\b))", "floating point is strict in every file"},
    {R"(__attribute__\s*\(\(\s*optimize)", "floating point is strict in every file"},
};

std::vector<std::string> banned(const std::string& file, const std::string& text, const std::vector<Ban>& bans) {
  std::vector<std::string> sentences;
  const std::vector<std::string> lines = split_lines(code_only(text));
  for (const Ban& ban : bans) {
    const std::regex pattern{std::string(ban.pattern)};
    for (std::size_t k = 0; k < lines.size(); ++k) {
      std::smatch match;
      if (!std::regex_search(lines[k], match, pattern)) continue;
      sentences.push_back(place(file, k) + " uses " + match.str() + ": " + std::string(ban.why) + ".");
    }
  }
  return sentences;
}

TEST(SourceRule, TheSolverUsesNothingThatDependsOnMoreThanTheCase) {
  for (const std::string& file : cpp_files("solver")) {
    for (const std::string& sentence : banned(file, read(file), kBannedInTheSolver)) ADD_FAILURE() << sentence;
  }
}

TEST(SourceRule, NoFileWidensNamesOrLoosensFloatingPoint) {
  for (const std::string_view folder : {"solver", "runner", "tests", "bench"}) {
    for (const std::string& file : cpp_files(folder)) {
      for (const std::string& sentence : banned(file, read(file), kBannedEverywhere)) ADD_FAILURE() << sentence;
    }
  }
}

TEST(SourceRule, EveryKindOfBannedCodeIsSeen) {
  const auto count = [](const std::string& line) {
    return banned("a.cpp", line, kBannedInTheSolver).size() + banned("a.cpp", line, kBannedEverywhere).size();
  };
  EXPECT_EQ(count("std::uniform_real_distribution<double> radius(0, 1);"), 1u);
  EXPECT_EQ(count("std::unordered_map<int, int> pairs;"), 1u);
  EXPECT_EQ(count("#pragma omp parallel for reduction(+ : sum)"), 1u);
  EXPECT_EQ(count("const auto x = _mm512_rcp14_ps(y);"), 1u);
  EXPECT_EQ(count("using namespace std;"), 1u);
  EXPECT_EQ(count("#pragma GCC optimize(\"fast-math\")"), 1u);
  EXPECT_EQ(count("const int count = 1; // std::unordered_map would not do"), 0u);
  EXPECT_EQ(count("const char* name = \"std::unordered_map\";"), 0u);
  EXPECT_EQ(count("#pragma omp parallel for reduction(max : overlap)"), 0u);
}

/// The first place of a text that names a path of one machine, or a package registry; npos when none does.
std::size_t private_name(const std::string& text) {
  static const std::vector<std::string_view> kRoots = {"work", "root", "home", "Users", "mnt", "scratch"};
  static const std::vector<std::string_view> kRegistries = {
      "pypi.org", "pythonhosted.org", "npmjs",           "crates.io", "proxy.golang", "artifactory", "jfrog", "nexus",
      "conan",    "deb.debian",       "snapshot.debian", "nodesource"};
  for (const std::string_view root : kRoots) {
    const std::string path = "/" + std::string(root) + "/";
    for (std::size_t at = text.find(path); at != std::string::npos; at = text.find(path, at + 1)) {
      // Only where the path begins: "a/home/b" and "${x}/home/b" are relative to something.
      if (at == 0 || (!std::isalnum(static_cast<unsigned char>(text[at - 1])) &&
                      std::string_view("_-.~*})>").find(text[at - 1]) == std::string_view::npos)) {
        return at;
      }
    }
  }
  for (const std::string_view registry : kRegistries) {
    for (const std::string_view before : {"://", ".", "@"}) {
      const std::size_t at = text.find(std::string(before) + std::string(registry));
      if (at != std::string::npos) return at;
    }
  }
  return std::string::npos;
}

TEST(SourceRule, NoFileNamesAMachinesPathOrAPackageRegistry) {
  const std::vector<std::string> files = versioned_files();
  EXPECT_GT(files.size(), 30u);
  for (const std::string& file : files) {
    const std::string text = read(file);
    const std::size_t at = private_name(text);
    if (at == std::string::npos) continue;
    const auto line = static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<long>(at), '\n'));
    ADD_FAILURE() << place(file, line) << " names a path of one machine or a package registry: "
                  << text.substr(at, text.find_first_of(" \n\"'", at + 1) - at);
  }
}

TEST(SourceRule, AMachinesPathIsSeenAndARelativeOneIsNot) {
  const std::string root = "/";
  EXPECT_EQ(private_name("see " + root + "home/me/x"), 4u);
  EXPECT_EQ(private_name(root + "work/main"), 0u);
  EXPECT_NE(private_name("url = https://" + std::string("pypi") + ".org/simple"), std::string::npos);
  EXPECT_EQ(private_name("solver/work/x and ${here}/home/x"), std::string::npos);
}

/// The files of the project that a text refers to, relative to the root: in a document, names in backquotes and links;
/// in source, documents. Names with a placeholder are left out.
std::vector<std::string> references(const std::string& file, const std::string& text) {
  static const std::regex kName(
      R"re(`((solver|runner|studies|results_schema|tests|bench|docs|cmake|\.ci)/[A-Za-z0-9_./-]*)`)re");
  static const std::regex kLink(R"re(\]\(([A-Za-z0-9_./-]+)\))re");
  static const std::regex kDocument(R"re(\b((docs|results_schema)/[A-Za-z0-9_/-]+\.(md|sql)|[A-Z]+\.md)\b)re");

  std::vector<std::string> files;
  const auto collect = [&](const std::regex& pattern, const std::filesystem::path& base) {
    for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
      files.push_back((base / (*match)[1].str()).lexically_normal().generic_string());
    }
  };
  if (file.ends_with(".md")) {
    collect(kName, "");
    collect(kLink, std::filesystem::path(file).parent_path());
  } else {
    collect(kDocument, "");
  }
  return files;
}

TEST(SourceRule, WhatIsReferredToExists) {
  std::size_t count = 0;
  for (const std::string& file : versioned_files()) {
    const bool document = file.ends_with(".md") && file != "CHANGELOG.md";  // The changelog may name what has gone.
    const bool source = file.ends_with(".h") || file.ends_with(".cpp") || file.ends_with("CMakeLists.txt");
    if (!(document || source) || file.starts_with("tests/rules/")) continue;
    for (const std::string& name : references(file, read(file))) {
      ++count;
      if (std::filesystem::exists(source_root() / name)) continue;
      ADD_FAILURE() << file << " refers to " << name << ", which is not there.";
    }
  }
  EXPECT_GT(count, 20u);
}

TEST(SourceRule, AReferenceIsFoundInDocumentsAndInComments) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(references("docs/a.md", "see `solver/base/vec2.h`, `solver/<part>/x.h` and [this](decisions/0001.md)"),
            (Names{"solver/base/vec2.h", "docs/decisions/0001.md"}));
  EXPECT_EQ(references("README.md", "![curve](docs/curve.svg) [home](https://example.org/)"), Names{"docs/curve.svg"});
  EXPECT_EQ(references("solver/a.h", "// See docs/formulation.md 3.2 and CONTRIBUTING.md."),
            (Names{"docs/formulation.md", "CONTRIBUTING.md"}));
}

}  // namespace
}  // namespace seapile::rules
