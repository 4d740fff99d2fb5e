#include "runner/store/bundle_index.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runner/store/bundle.h"
#include "runner/store/layout.h"
#include "runner/store/sealed_text.h"

namespace seapile::store {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kContent = "bundle";
constexpr std::size_t kDigest = 64;

[[noreturn]] void damaged(const std::filesystem::path& where, const std::string& what) {
  throw StoreError(StoreError::Kind::damaged, where.string() + " is damaged: " + what);
}

Json run_json(const std::string& case_id, const std::string& run) {
  return case_id.empty() ? Json(nullptr) : Json{{"case", case_id}, {"run", run}};
}

void read_run(const Json& json, std::string& case_id, std::string& run, const std::filesystem::path& where) {
  case_id = json.at("case");
  run = json.at("run");
  if (!is_case_id(case_id) || run_number(run) == 0) damaged(where, "it names no run");
}

bool is_below(const std::string& name, const std::string& folder) {
  return name.size() > folder.size() && name.starts_with(folder);
}

/// Only what a bundle is made of: nothing else of a store is written over by an unpacked one.
bool has_place(const BundleIndex& index, const std::string& name) {
  if (is_below(name, run_path(index.case_id, index.run))) return true;
  if (!index.bed_id.empty() && is_below(name, run_path(index.bed_id, index.bed_run))) return true;
  constexpr std::string_view kFolder = "grains/", kEnding = ".csv";
  return name.size() == kFolder.size() + kDigest + kEnding.size() && name.starts_with(kFolder) &&
         is_case_id(name.substr(kFolder.size(), kDigest)) && name.ends_with(kEnding);
}

}  // namespace

std::string index_text(const BundleIndex& index) {
  Json json = {{"schema", kBundleSchema},
               {"content", kContent},
               {"case", index.case_id},
               {"run", index.run},
               {"bed", run_json(index.bed_id, index.bed_run)},
               {"files", Json::array()}};
  for (const FileEntry& member : index.members)
    json["files"].push_back(Json{{"path", member.path}, {"bytes", member.bytes}, {"sha256", member.sha256}});
  return with_seal(json.dump(2));
}

BundleIndex parse_index(const std::string& text, const std::filesystem::path& where) {
  BundleIndex index;
  try {
    const Json json = Json::parse(unsealed(text, where));
    if (json.at("content") != kContent) damaged(where, "it is no index of a bundle");
    const int schema = json.at("schema");
    if (schema > kBundleSchema)
      throw StoreError(StoreError::Kind::damaged,
                       fmt::format("{} is of schema {}, newer than this program, which knows {}", where.string(),
                                   schema, kBundleSchema));
    read_run(json, index.case_id, index.run, where);
    if (!json.at("bed").is_null()) read_run(json.at("bed"), index.bed_id, index.bed_run, where);
    for (const Json& member : json.at("files"))
      index.members.push_back({member.at("path"), member.at("bytes"), member.at("sha256")});
  } catch (const Json::exception& error) {
    damaged(where, error.what());
  }
  for (std::size_t i = 0; i < index.members.size(); ++i) {
    const std::string& name = index.members[i].path;
    std::string objection = objection_to_name(name);
    if (objection.empty() && !has_place(index, name)) objection = "is of neither run";
    if (i > 0 && objection.empty() && index.members[i - 1].path >= name)
      objection = "does not come after the one before";
    if (!objection.empty()) damaged(where, fmt::format("its file {} {}", Json(name).dump(), objection));
  }
  return index;
}

std::string run_path(const std::string& case_id, const std::string& run) {
  return (case_folder("", case_id) / run / "").string();
}

std::string objection_to_name(const std::string& name) {
  if (name.starts_with("/")) return "has an absolute name";
  const std::filesystem::path path = name;
  const auto leads_out = [](const std::filesystem::path& part) { return part == ".." || part == "." || part.empty(); };
  if (name.empty() || std::ranges::any_of(path, leads_out)) return "has a name that leads out of the bundle";
  const auto is_control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  return std::ranges::any_of(name, is_control) ? "has a name with control characters" : "";
}

}  // namespace seapile::store
