#include "runner/store/equivalence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "runner/store/durable.h"
#include "runner/store/layout.h"
#include "runner/store/run_folder.h"
#include "runner/store/sealed_text.h"
#include "runner/store/sha256.h"

namespace seapile::store {

namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

constexpr const char* kFolder = "equivalents";
constexpr const char* kSchemaName = "seapile/equivalence/1";
constexpr std::array kLikenesses = {"identical", "rounding", "tolerance"};
constexpr std::array kKinds = {"bed", "drive", "flow"};

std::optional<int> version_of(const NumericsList& numerics, const std::string& module) {
  const auto found = std::ranges::find(numerics, module, &simulation::NumericsVersion::module);
  return found == numerics.end() ? std::nullopt : std::optional(found->version);
}

std::string version_text(std::optional<int> version) { return version ? fmt::format("{}", *version) : "none"; }

Json from_numerics(const NumericsList& numerics) {
  Json json = Json::object();
  for (const auto& [module, version] : numerics) json[module] = version;
  return json;
}

NumericsList to_numerics(const Json& json) {
  NumericsList numerics;
  for (const auto& [module, version] : json.items()) numerics.push_back({module, version.get<int>()});
  return numerics;
}

std::string text_of(const Equivalence& one) {
  const Json json = {{"schema", kSchemaName},
                     {"kind", one.kind},
                     {"numerics_before", from_numerics(one.before)},
                     {"numerics_now", from_numerics(one.now)},
                     {"case", one.case_id},
                     {"run", one.run},
                     {"state_before", one.state_before},
                     {"state_now", one.state_now},
                     {"likeness", one.likeness},
                     {"largest", one.largest},
                     {"largest_of", one.largest_of},
                     {"tolerance", one.tolerance},
                     {"date", one.date},
                     {"version", one.version},
                     {"commit", one.commit},
                     {"dirty", one.dirty}};
  return with_seal(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

bool is_one_of(const auto& names, const std::string& name) { return std::ranges::find(names, name) != names.end(); }

/// What no probe would have declared; empty: nothing.
std::string objection(const Equivalence& one) {
  if (!is_one_of(kKinds, one.kind)) return "its kind is none";
  if (!is_one_of(kLikenesses, one.likeness)) return "its likeness is none";
  if (!is_case_id(one.case_id) || run_number(one.run) == 0) return "it names no run";
  if (one.before.empty() || one.now.empty() || same_numerics(one.before, one.now)) return "no numerics moved";
  if (one.likeness != kLikenesses[0] && !(one.largest >= 0 && one.largest <= one.tolerance))
    return "its distance is not within its tolerance";
  return "";
}

[[noreturn]] void damaged(const Path& file, const std::string& what) {
  throw StoreError(StoreError::Kind::damaged, file.string() + " is damaged: " + what);
}

/// Throws StoreError.
Equivalence read(const Path& file) {
  const std::string text = read_text(file);
  Equivalence one;
  one.seal = seal_of(text, file);
  one.file = file.filename().string();
  try {
    const Json json = Json::parse(unsealed(text, file));
    if (json.at("schema") != kSchemaName)
      damaged(file, fmt::format("it is of schema {}; this program knows {}", json.at("schema").dump(), kSchemaName));
    one.kind = json.at("kind");
    one.before = to_numerics(json.at("numerics_before"));
    one.now = to_numerics(json.at("numerics_now"));
    one.case_id = json.at("case");
    one.run = json.at("run");
    one.state_before = json.at("state_before");
    one.state_now = json.at("state_now");
    one.likeness = json.at("likeness");
    one.largest = json.at("largest");
    one.largest_of = json.at("largest_of");
    one.tolerance = json.at("tolerance");
    one.date = json.at("date");
    one.version = json.at("version");
    one.commit = json.at("commit");
    one.dirty = json.at("dirty");
  } catch (const Json::exception& error) {
    damaged(file, error.what());
  }
  if (const std::string why = objection(one); !why.empty()) damaged(file, why);
  return one;
}

/// Readable, and another one for every kind and pair of lists.
std::string file_name(const Equivalence& one) {
  std::string name = one.kind;
  for (const auto& [module, version] : one.now) {
    const auto before = version_of(one.before, module);
    if (before != version) name += fmt::format("_{}_{}_{}", module, version_text(before), version);
  }
  const std::string lists = one.kind + numerics_json(one.before) + numerics_json(one.now);
  return fmt::format("{}-{}.json", name.substr(0, 60), sha256(lists).substr(0, 8));
}

}  // namespace

bool same_numerics(const NumericsList& one, const NumericsList& other) {
  return std::ranges::is_permutation(
      one, other, [](const auto& a, const auto& b) { return a.module == b.module && a.version == b.version; });
}

std::string moved_text(const NumericsList& before, const NumericsList& now) {
  std::vector<std::string> moved;
  const auto compare = [&](const std::string& module) {
    const auto old_version = version_of(before, module), new_version = version_of(now, module);
    if (old_version != new_version)
      moved.push_back(fmt::format("{} {} -> {}", module, version_text(old_version), version_text(new_version)));
  };
  for (const auto& [module, version] : now) compare(module);
  for (const auto& [module, version] : before) {
    if (!version_of(now, module)) compare(module);
  }
  return fmt::format("{}", fmt::join(moved, ", "));
}

bool is_about(const Equivalence& equivalence, const std::string& kind, const NumericsList& before,
              const NumericsList& now) {
  return equivalence.kind == kind && same_numerics(equivalence.before, before) && same_numerics(equivalence.now, now);
}

std::string in_words(const Equivalence& one) {
  const std::string distance = one.likeness == kLikenesses[0]
                                   ? "identical to the last bit"
                                   : fmt::format("within {:.2g} (tolerance {:g})", one.largest, one.tolerance);
  return fmt::format("{}, probe of case {} {}", moved_text(one.before, one.now), one.case_id.substr(0, 10), distance);
}

Equivalences read_equivalences(const Path& root) {
  Equivalences all;
  std::vector<Path> files;
  try {
    files = entries(root / kFolder);
  } catch (const StoreError& error) {
    all.left_out.emplace_back(error.what());
  }
  for (const Path& file : files) {
    if (file.extension() != ".json") continue;
    try {
      Equivalence one = read(file);
      const bool known = std::ranges::any_of(
          all.declared, [&](const Equivalence& other) { return is_about(other, one.kind, one.before, one.now); });
      if (!known) all.declared.push_back(std::move(one));
    } catch (const StoreError& error) {
      all.left_out.emplace_back(error.what());
    }
  }
  return all;
}

bool declare(const Path& root, const Equivalence& equivalence) {
  if (const std::string why = objection(equivalence); !why.empty())
    throw std::logic_error("no such equivalence can be declared: " + why);
  for (const Equivalence& other : read_equivalences(root).declared) {
    if (is_about(other, equivalence.kind, equivalence.before, equivalence.now)) return false;
  }
  make_folder(root / kFolder);
  write_text(root / kFolder / file_name(equivalence), text_of(equivalence));
  return true;
}

std::string numerics_json(const NumericsList& numerics) {
  nlohmann::json sorted = nlohmann::json::object();
  for (const auto& [module, version] : numerics) sorted[module] = version;
  return sorted.dump();
}

}  // namespace seapile::store
