// Unpacks a bundle that anybody may have made: nothing is written under a name, or past a size, that the index does not
// allow, and nothing of a run is believed that its manifest does not say.
#include <fcntl.h>
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "runner/store/archive.h"
#include "runner/store/bundle.h"
#include "runner/store/bundle_index.h"
#include "runner/store/dropped.h"
#include "runner/store/durable.h"
#include "runner/store/layout.h"
#include "runner/store/manifest.h"
#include "runner/store/sha256.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;

constexpr std::uint64_t kMostIndexBytes = 16 << 20;

/// The bundle's own name for a member in a sentence, whatever characters it has.
std::string quoted(const std::string& name) {
  return nlohmann::json(name).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

class Unpacker {
 public:
  Unpacker(const Path& file, const Path& folder) : file_(file), folder_(folder), tar_(file) {}

  Bundle run() {
    read_index();
    while (const auto member = tar_.next()) unpack(*member);
    for (const auto& [name, entry] : entries_)
      if (!seen_.contains(name)) refuse(quoted(name) + " is missing: the file is cut off, or was changed");
    Bundle bundle;
    bundle.run = {folder_ / run_path(index_.case_id, index_.run), checked(index_.case_id, index_.run)};
    const RunHeader& header = bundle.run.manifest.header;
    if (header.bed_id != index_.bed_id || header.bed_run != index_.bed_run)
      refuse("its index names another bed than the run's manifest");
    if (!index_.bed_id.empty()) {
      bundle.bed = {folder_ / run_path(index_.bed_id, index_.bed_run), checked(index_.bed_id, index_.bed_run)};
      if (bundle.bed->manifest.header.kind != "bed") refuse("the run of its bed is none of a bed");
    }
    for (const FileEntry& member : index_.members) {
      if (member.path.starts_with("grains/"))
        bundle.grains = {Path(member.path).stem().string(), folder_ / member.path};
    }
    return bundle;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw std::invalid_argument(fmt::format("{}: {}", file_.string(), what));
  }

  void read_index() {
    const auto first = tar_.next();
    if (!first || first->name != kBundleFile || !first->kind.empty())
      refuse(fmt::format("is no bundle: its first member is not {}", kBundleFile));
    if (first->bytes > kMostIndexBytes) refuse(fmt::format("{} is larger than 16 MiB", kBundleFile));
    std::string text;
    tar_.read([&](std::string_view piece) { text += piece; });
    index_ = parse_index(text, fmt::format("{}: {}", file_.string(), kBundleFile));
    std::uint64_t room = tar_.file_bytes();
    for (const FileEntry& entry : index_.members) {
      if (entry.bytes > room)
        refuse(fmt::format("{} lists more bytes than the file has: it is cut off, or was changed", kBundleFile));
      room -= entry.bytes;
      entries_[entry.path] = entry;
    }
  }

  void unpack(const TarMember& member) {
    const std::string name = quoted(member.name);
    if (!member.kind.empty()) refuse(fmt::format("{} is {}; a bundle has plain files only", name, member.kind));
    if (const auto objection = objection_to_name(member.name); !objection.empty()) refuse(name + " " + objection);
    const auto listed = entries_.find(member.name);
    if (!seen_.insert(member.name).second || member.name == kBundleFile) refuse(name + " is there twice");
    if (listed == entries_.end()) refuse(fmt::format("{} is not in {}", name, kBundleFile));
    const FileEntry& entry = listed->second;
    if (member.bytes != entry.bytes)
      refuse(fmt::format("{} has {} bytes instead of {}", name, member.bytes, entry.bytes));

    const Path to = folder_ / member.name;
    std::error_code ignored;  // where the folder cannot be made, neither can the file
    std::filesystem::create_directories(to.parent_path(), ignored);
    Descriptor out(to, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, "create");
    Sha256 hash;
    std::uint64_t left = entry.bytes;
    tar_.read([&](std::string_view piece) {
      if (piece.size() > left) refuse(fmt::format("{} has more than its {} bytes", name, entry.bytes));
      left -= piece.size();
      hash.add(piece);
      out.write(piece);
    });
    out.close();
    if (left > 0) refuse(fmt::format("{} is {} bytes short", name, left));
    if (hash.hex() != entry.sha256) refuse(fmt::format("{} has another SHA-256 than {} says", name, kBundleFile));
  }

  /// The run's manifest, whose files are exactly those that were unpacked.
  Manifest checked(const std::string& case_id, const std::string& run) const {
    const std::string folder = run_path(case_id, run);
    if (!entries_.contains(folder + kManifestFile))
      refuse(fmt::format("{} is missing", quoted(folder + kManifestFile)));
    Manifest manifest = read_manifest(folder_ / folder);
    std::set<std::string> named = {folder + kManifestFile, folder + kDroppedFile};
    for (const FileEntry& file : manifest.files) {
      const std::string name = folder + file.path;
      const auto entry = entries_.find(name);
      if (entry == entries_.end()) refuse(fmt::format("{} is missing, which its manifest lists", quoted(name)));
      if (entry->second.bytes != file.bytes || entry->second.sha256 != file.sha256)
        refuse(fmt::format("{} is not what its manifest says", quoted(name)));
      named.insert(name);
    }
    for (const auto& [name, entry] : entries_) {
      if (name.starts_with(folder) && !named.contains(name)) refuse(fmt::format("{} is in no manifest", quoted(name)));
    }
    if (sha256(manifest.header.canonical) != case_id)
      refuse(fmt::format("{} is of a case with another id", quoted(folder + kManifestFile)));
    return manifest;
  }

  Path file_, folder_;
  TarReader tar_;
  BundleIndex index_;
  std::map<std::string, FileEntry> entries_;  ///< of the index, by name
  std::set<std::string> seen_;                ///< members that were unpacked
};

}  // namespace

Bundle read_bundle(const Path& file, const Path& folder) {
  try {
    return Unpacker(file, folder).run();
  } catch (const StoreError& error) {
    if (error.kind != StoreError::Kind::damaged) throw;
    throw std::invalid_argument(said_of_bundle(error.what(), file, folder));
  }
}

std::string said_of_bundle(std::string sentence, const Path& file, const Path& folder) {
  const std::string place = folder.string() + "/";
  for (std::size_t at = 0; (at = sentence.find(place, at)) != std::string::npos;)
    sentence.replace(at, place.size(), file.string() + ": ");
  return sentence;
}

}  // namespace seapile::store
