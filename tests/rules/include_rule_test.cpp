// The dependency rule: who may include whom. CONTRIBUTING.md draws it.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

#include "tests/rules/source_files.h"

namespace seapile::rules {
namespace {

/// A folder, and what its files may include besides the folder itself: a folder ("solver/base/"), a single header, or
/// every header of the solver with an ending ("*_spec.h").
struct Room {
  std::string_view folder;
  std::vector<std::string_view> may_include;
};

const std::vector<Room> kRooms = {
    {"solver/base/", {}},
    {"solver/grains/", {"solver/base/"}},
    {"solver/pile/", {"solver/base/"}},
    {"solver/mesh/", {"solver/base/"}},
    {"solver/fluid/", {"solver/base/", "solver/mesh/"}},
    {"solver/basin/", {"solver/base/", "solver/fluid/", "solver/mesh/", "solver/pile/"}},
    {"solver/coupling/", {"solver/base/", "solver/fluid/", "solver/grains/", "solver/mesh/"}},
    {"solver/scene/", {"solver/base/", "*_spec.h"}},
    {"solver/simulation/",
     {"solver/base/", "solver/basin/", "solver/coupling/", "solver/fluid/", "solver/grains/", "solver/mesh/",
      "solver/pile/", "solver/scene/"}},

    {"runner/study/",
     {"solver/base/", "solver/scene/", "*_spec.h", "solver/grains/neighbours.h", "solver/simulation/array.h"}},
    {"runner/store/",
     {"solver/base/", "solver/scene/", "solver/simulation/array.h", "solver/simulation/execution.h",
      "solver/simulation/flow_frame.h", "solver/simulation/flow_record.h", "solver/simulation/frame.h",
      "solver/simulation/record.h", "solver/simulation/run.h", "solver/simulation/state.h"}},
    {"runner/execute/",
     {"runner/store/", "runner/study/", "solver/mesh/generate.h", "solver/simulation/", "solver/scene/"}},
    {"runner/cluster/", {"runner/execute/", "runner/store/", "runner/study/", "solver/base/", "solver/simulation/"}},
    {"runner/present/",
     {"runner/store/", "solver/base/", "solver/scene/", "solver/pile/pile.h", "solver/mesh/quality.h",
      "solver/mesh/triangle_mesh.h", "solver/simulation/flow_frame.h", "solver/simulation/flow_record.h",
      "solver/simulation/frame.h", "solver/simulation/record.h"}},
    {"runner/commands/", {"runner/present/", "runner/cluster/", "runner/execute/", "runner/store/", "runner/study/"}},
};

/// Headers from outside that the files of a folder may not use: the beginning of the name, and why.
struct Ban {
  std::string_view folder;
  std::string_view header;
  std::string_view why;
};

const std::vector<Ban> kBans = {
    {"solver/", "iostream", "the solver prints nothing"},
    {"solver/", "cstdio", "the solver prints nothing"},
    {"solver/", "stdio.h", "the solver prints nothing"},
    {"solver/", "fstream", "the solver touches no file"},
    {"solver/", "filesystem", "the solver touches no file"},
    {"solver/", "nlohmann/", "the solver knows no JSON"},
    {"solver/", "hdf5", "the solver knows no HDF5"},
    {"solver/", "H5", "the solver knows no HDF5"},
    {"solver/", "sqlite3", "the solver knows no SQLite"},
    {"solver/", "SQLiteCpp/", "the solver knows no SQLite"},
    {"runner/study/", "hdf5", "a study knows no store"},
    {"runner/study/", "H5", "a study knows no store"},
    {"runner/study/", "sqlite3", "a study knows no database"},
    {"runner/study/", "SQLiteCpp/", "a study knows no database"},
};

std::string folder_of(std::string_view path) { return std::string(path.substr(0, path.rfind('/') + 1)); }

bool allows(std::string_view entry, std::string_view header) {
  if (entry.starts_with("*")) return header.starts_with("solver/") && header.ends_with(entry.substr(1));
  return entry.ends_with("/") ? header.starts_with(entry) : header == entry;
}

std::string joined(const std::vector<std::string_view>& entries) {
  std::string text;
  for (const auto entry : entries) text += (text.empty() ? "" : ", ") + std::string(entry);
  return text.empty() ? "nothing" : text;
}

const Room* room_of(std::string_view file) {
  const auto room =
      std::find_if(kRooms.begin(), kRooms.end(), [&](const Room& r) { return file.starts_with(r.folder); });
  return room == kRooms.end() ? nullptr : &*room;
}

/// What is wrong with one include, as the end of a sentence; absent when it is right.
std::optional<std::string> objection(std::string_view file, const Room& room, const std::string& header, bool quoted) {
  if (header.starts_with("solver/") || header.starts_with("runner/")) {
    const bool own = header.starts_with(room.folder);
    const bool allowed = own || std::any_of(room.may_include.begin(), room.may_include.end(),
                                            [&](auto entry) { return allows(entry, header); });
    if (allowed) return {};
    return "there is no arrow from " + std::string(room.folder) + " to " + folder_of(header) + "; it may include " +
           joined(room.may_include);
  }
  for (const Ban& ban : kBans) {
    if (file.starts_with(ban.folder) && header.starts_with(ban.header)) return std::string(ban.why);
  }
  if (quoted) return "an include of our own starts at the repository's root, with solver/ or runner/";
  return {};
}

/// One sentence for each wrong include of a file.
std::vector<std::string> wrong_includes(const std::string& file, const std::string& text) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  const Room* room = room_of(file);
  if (!room) return {file + " lies in no folder of the dependency rule; name its arrows in tests/rules."};

  std::vector<std::string> sentences;
  const std::vector<std::string> lines = split_lines(text);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    std::smatch match;
    if (!std::regex_search(lines[k], match, kInclude)) continue;
    if (const auto why = objection(file, *room, match[2], match[1] == "\"")) {
      sentences.push_back(place(file, k) + " includes " + match[2].str() + ": " + *why + ".");
    }
  }
  return sentences;
}

TEST(IncludeRule, EveryArrowExists) {
  std::size_t files = 0;
  for (const std::string_view folder : {"solver", "runner"}) {
    for (const std::string& file : cpp_files(folder)) {
      ++files;
      for (const std::string& sentence : wrong_includes(file, read(file))) ADD_FAILURE() << sentence;
    }
  }
  EXPECT_GT(files, 10u) << "the source tree was not found below " << source_root();
}

TEST(IncludeRule, AWrongArrowIsNamedWithFileLineAndBothEnds) {
  const auto sentences = wrong_includes("solver/grains/grains.h", "#pragma once\n#include \"solver/pile/pile.h\"\n");
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(sentences[0],
            "solver/grains/grains.h:2 includes solver/pile/pile.h: there is no arrow from solver/grains/ to "
            "solver/pile/; it may include solver/base/.");
}

TEST(IncludeRule, EveryKindOfWrongIncludeIsSeen) {
  const auto count = [](const std::string& file, const std::string& line) { return wrong_includes(file, line).size(); };
  EXPECT_EQ(count("solver/base/vec2.h", "#include \"solver/scene/spec.h\""), 1u);
  EXPECT_EQ(count("solver/scene/spec.h", "#include \"solver/grains/grains.h\""), 1u);
  EXPECT_EQ(count("solver/simulation/run.cpp", "#include \"runner/store/run_folder.h\""), 1u);
  EXPECT_EQ(count("solver/simulation/run.cpp", "#  include <iostream>"), 1u);
  EXPECT_EQ(count("solver/grains/bed.cpp", "#include <nlohmann/json.hpp>"), 1u);
  EXPECT_EQ(count("runner/store/catalogue.cpp", "#include \"runner/study/study.h\""), 1u);
  EXPECT_EQ(count("runner/store/catalogue.cpp", "#include \"solver/simulation/step.h\""), 1u);
  EXPECT_EQ(count("runner/study/study.cpp", "#include <SQLiteCpp/SQLiteCpp.h>"), 1u);
  EXPECT_EQ(count("runner/present/table.cpp", "#include \"runner/execute/plan.h\""), 1u);
  EXPECT_EQ(count("runner/commands/run.cpp", "#include \"run.h\""), 1u);
  EXPECT_EQ(count("runner/other/file.h", ""), 1u);
}

TEST(IncludeRule, ARightIncludeIsLeftAlone) {
  EXPECT_TRUE(wrong_includes("solver/scene/spec.h", "#include \"solver/pile/pile_spec.h\"").empty());
  EXPECT_TRUE(
      wrong_includes("solver/simulation/run.cpp", "#include <vector>\n#include \"solver/pile/pile.h\"").empty());
  EXPECT_TRUE(wrong_includes("runner/execute/job.cpp", "#include \"runner/store/catalogue.h\"").empty());
  EXPECT_TRUE(wrong_includes("solver/base/vec2.h", "// #include <iostream>").empty());
}

}  // namespace
}  // namespace seapile::rules
