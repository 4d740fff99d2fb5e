// results_schema/ says what the writer writes, and the writer writes what results_schema/ says.
#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "runner/store/hdf5_file.h"
#include "tests/runner/store/sample_flow.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;

struct Row {
  std::string type, shape, unit, meaning, since;
};
using Rows = std::map<std::string, Row>;

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(' ');
  return first == text.npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The tables of result_file.md, by the title that they stand under.
std::map<std::string, Rows> tables() {
  std::ifstream page(SEAPILE_RESULTS_SCHEMA "/result_file.md");
  std::map<std::string, Rows> all;
  std::string title;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## ")) title = line.substr(3);
    if (title.empty() || !line.starts_with("| ") || line.starts_with("| path")) continue;
    std::vector<std::string> cells;
    std::istringstream parts(line.substr(1));
    for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(trimmed(cell));
    EXPECT_EQ(cells.size(), 6U) << line;
    EXPECT_TRUE(all[title].emplace(cells[0], Row{cells[1], cells[2], cells[3], cells[4], cells[5]}).second)
        << cells[0] << " is listed twice under " << title;
  }
  return all;
}

std::string replaced(const std::string& text, const char* what, const char* by) {
  return std::regex_replace(text, std::regex(what), by);
}

/// A path of a file as the page writes it.
std::string generic(std::string path) {
  path = replaced(path, "^/(steps|vertices|frame|flow_frame)/[0-9]{5}", "/$1/<frame>");
  path = replaced(path, "^/(frame|flow_frame)/<frame>/.*", "/$1/<frame>/<array>");
  path = replaced(path, "^/state/.*", "/state/<array>");
  path = replaced(path, "^/metrics/.*", "/metrics/<metric>");
  return replaced(path, "^/cost/[^/]*/", "/cost/<part>/");
}

std::vector<std::string> attribute_names(const Path& file) {
  struct Found {
    hid_t file;
    std::vector<std::string> names;
  } found{H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), {}};
  const auto visit = [](hid_t, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    auto& into = *static_cast<Found*>(data);
    if (info->type != H5O_TYPE_GROUP) return 0;
    for (hsize_t i = 0; i < info->num_attrs; ++i) {
      char attribute[100];
      H5Aget_name_by_idx(into.file, name, H5_INDEX_NAME, H5_ITER_INC, i, attribute, sizeof attribute, H5P_DEFAULT);
      const std::string group = std::string(name) == "." ? "/" : "/" + std::string(name);
      into.names.push_back(group + "@" + attribute);
    }
    return 0;
  };
  H5Ovisit2(found.file, H5_INDEX_NAME, H5_ITER_INC, visit, &found, H5O_INFO_BASIC | H5O_INFO_NUM_ATTRS);
  H5Fclose(found.file);
  return found.names;
}

/// "(records)" has one extent, "(frames, 5)" a second one of 5.
void expect_shape(const std::string& where, const std::string& shape, const hdf5::Extents& extents) {
  if (shape == "any") return;
  const auto comma = shape.find(',');
  const auto columns = comma == shape.npos ? 0 : std::stoul(shape.substr(comma + 1));
  EXPECT_EQ(columns, extents.columns) << where;
  const bool fixed = std::regex_match(shape, std::regex("\\([0-9]+\\)"));
  EXPECT_EQ(fixed ? std::stoul(shape.substr(1)) : extents.rows, extents.rows) << where;
}

/// Both directions: what is in the file is listed, as it is; what is listed is in the file.
void expect_file_as_listed(const Path& file, const std::string& title, Rows rows) {
  const std::map<std::string, std::map<std::string, Row>> pages = tables();
  for (const std::string group : {"/series/", "/flow_series/"}) {
    if (rows.erase(group + "<column>") == 0) continue;
    for (const auto& [path, row] : pages.at("series.h5")) {
      if (path.starts_with(group)) rows.emplace(path, row);
    }
  }
  std::set<std::string> seen;
  hdf5::FileReader reader(file);
  for (const std::string& path : reader.datasets("/")) {
    const std::string name = generic(path), where = title + " " + path;
    seen.insert(name);
    if (!rows.contains(name)) {
      ADD_FAILURE() << where << " is not listed";
      continue;
    }
    const Row& row = rows.at(name);
    EXPECT_TRUE(row.type == "any" || row.type == hdf5::name(reader.number(path))) << where;
    expect_shape(where, row.shape, reader.extents(path));
    std::string unit = row.unit;
    try {
      unit = reader.attribute<std::string>(path, "units");
    } catch (const StoreError&) {
      EXPECT_TRUE(path.starts_with("/VTKHDF") || path.starts_with("/vertices") || path.starts_with("/grid") ||
                  path.starts_with("/frames") || path.starts_with("/segments"))
          << where << " has no units";
    }
    EXPECT_TRUE(row.unit.starts_with("as ") || unit == row.unit) << where << " is in " << unit;
    const bool is_column = path.starts_with("/series/") || path.starts_with("/flow_series/");
    EXPECT_TRUE(!is_column || reader.attribute<std::string>(path, "meaning") == row.meaning) << where;
  }
  reader.close();
  for (const std::string& name : attribute_names(file)) {
    seen.insert(name);
    EXPECT_TRUE(rows.contains(name)) << title << " " << name << " is not listed";
  }
  for (const auto& [path, row] : rows) {
    EXPECT_TRUE(seen.contains(path)) << title << " has no " << path;
    EXPECT_EQ(row.since, "1");
  }
}

TEST(ResultSchema, ListsWhatIsInEveryFileOfARun) {
  const Scratch scratch;
  const sample::Written run = sample::write(scratch.fresh("complete"));
  const Path flow = sample::write_flow(scratch.fresh("flow"));
  // A record of the water that lacks nothing, and one of grains beside it.
  const simulation::FlowRecord full = sample::saturated_record(0);
  const Path both = scratch.path() / "both" / "0001";
  {
    RunWriter of_both(both, sample::drive_header());
    of_both.add(sample::record(0));
    of_both.add(full);
    of_both.finish(sample::drive_result(), sample::provenance(), nullptr);
  }
  RunWriter writer(scratch.path() / "running" / "0001", sample::drive_header());
  writer.add(sample::record(0));
  writer.add(full);
  writer.add(sample::frame(0));
  writer.add(sample::flow_frame(0));
  writer.checkpoint(sample::state(1));
  writer.post_mortem(sample::state(2), "a grain left the box");

  const std::map<std::string, Path> files = {
      {"series.h5", both / "series.h5"},
      {"bed.h5", run.bed / "bed.h5"},
      {"grains.vtkhdf", run.drive / "grains.vtkhdf"},
      {"contacts.vtkhdf", run.drive / "contacts.vtkhdf"},
      {"fields.vtkhdf", run.drive / "fields.vtkhdf"},
      {"flow.vtkhdf", flow / "flow.vtkhdf"},
      {"surface.h5", flow / "surface.h5"},
      {"segment/NNNNNN.h5", scratch.path() / "running" / "0001" / "segment" / "000001.h5"},
      {"checkpoint/a.h5 and checkpoint/b.h5", scratch.path() / "running" / "0001" / "checkpoint" / "a.h5"},
      {"post_mortem.h5", scratch.path() / "running" / "0001" / "post_mortem.h5"}};
  const auto pages = tables();
  for (const auto& [title, file] : files) {
    ASSERT_TRUE(pages.contains(title)) << title;
    expect_file_as_listed(file, title, pages.at(title));
  }
  for (const auto& [title, rows] : pages) EXPECT_TRUE(files.contains(title) || title == "manifest.json") << title;
}

using Json = nlohmann::ordered_json;

/// Every value of the manifest by its path; what is not ours to list is named as a whole.
void flatten(const std::string& path, const Json& json, std::map<std::string, std::string>& into) {
  const bool as_a_whole = path == "scene" || path == "record" || path == "bed";
  if (as_a_whole) into[path] = "object";
  if (path == "scene" || path == "record") return;
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) {
      flatten(path == "numerics" ? "numerics.<module>" : (path.empty() ? key : path + "." + key), value, into);
    }
  } else if (json.is_array()) {
    for (const Json& item : json) flatten(path + "[]", item, into);
  } else if (!as_a_whole) {
    const bool whole = json.is_number_integer();
    into.emplace(path, json.is_boolean() ? "boolean" : (whole ? "integer" : (json.is_number() ? "number" : "text")));
  }
}

TEST(ResultSchema, ListsWhatIsInTheManifest) {
  const Scratch scratch;
  std::ifstream in(sample::write(scratch.path()).drive / "manifest.json");
  std::map<std::string, std::string> found;
  flatten("", Json::parse(in), found);
  const Rows rows = tables().at("manifest.json");
  for (const auto& [path, type] : found) {
    ASSERT_TRUE(rows.contains(path)) << path << " is not listed";
    EXPECT_EQ(rows.at(path).type, type) << path;
  }
  for (const auto& [path, row] : rows) EXPECT_TRUE(found.contains(path)) << "the manifest has no " << path;
}

TEST(ResultSchema, SaysWhatEveryColumnOfTheCatalogueIs) {
  std::ifstream in(SEAPILE_RESULTS_SCHEMA "/catalogue.sql");
  std::size_t columns = 0;
  for (std::string line; std::getline(in, line);) {
    if (!std::regex_match(line, std::regex("  [a-z].*"))) continue;
    ++columns;
    EXPECT_TRUE(std::regex_match(line, std::regex(".*-- .+"))) << line;
  }
  EXPECT_GT(columns, 50U);
}

}  // namespace
}  // namespace seapile::store
