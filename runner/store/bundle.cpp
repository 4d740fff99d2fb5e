#include "runner/store/bundle.h"

#include <fmt/format.h>

#include <map>
#include <utility>
#include <vector>

#include "runner/store/archive.h"
#include "runner/store/bundle_index.h"
#include "runner/store/disk_use.h"
#include "runner/store/dropped.h"
#include "runner/store/durable.h"
#include "runner/store/layout.h"
#include "runner/store/manifest.h"
#include "runner/store/sha256.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;

/// A member to be written: a text, or a file of the store.
struct Source {
  std::string text;
  Path file;  ///< empty: the text
};

using Sources = std::map<std::string, std::pair<FileEntry, Source>>;  // by name, in the order of the members

void put_text(Sources& sources, const std::string& name, std::string text) {
  const FileEntry entry{name, text.size(), sha256(text)};
  sources[name] = {entry, {std::move(text), {}}};
}

void put_run(Sources& sources, const BundledRun& run, bool with_fields) {
  const std::string folder = run_path(run.manifest.header.case_id, run.manifest.run);
  std::vector<std::string> left_out;
  for (const FileEntry& file : run.manifest.files) {
    if (!with_fields && purpose_of(file.path) == Purpose::fields) {
      left_out.push_back(file.path);
    } else {
      const std::string name = folder + file.path;
      sources[name] = {{name, file.bytes, file.sha256}, {"", run.folder / file.path}};
    }
  }
  put_text(sources, folder + kManifestFile, read_text(run.folder / kManifestFile));
  if (!left_out.empty() || !run.manifest.dropped.empty())
    put_text(sources, folder + kDroppedFile, dropped_text(run.manifest, left_out));
}

[[noreturn]] void differs(const Path& file, const std::string& what) {
  throw StoreError(StoreError::Kind::damaged, file.string() + what);
}

/// Hashed on its way: what was sealed is what is sent.
void copy(const Path& file, const FileEntry& entry, TarWriter& tar) {
  if (!is_there(file)) differs(file, " is missing");
  std::uint64_t bytes = 0;
  Sha256 hash;
  read_pieces(file, [&](std::string_view piece) {
    bytes += piece.size();
    if (bytes > entry.bytes) differs(file, fmt::format(" has more than its {} bytes", entry.bytes));
    hash.add(piece);
    tar.write(piece);
  });
  if (bytes != entry.bytes) differs(file, fmt::format(" has {} bytes instead of {}", bytes, entry.bytes));
  if (hash.hex() != entry.sha256) differs(file, " has another SHA-256 than was sealed");
}

}  // namespace

std::string grains_path(const std::string& content) { return "grains/" + content + ".csv"; }

void write_bundle(const Path& file, const Bundle& bundle, bool with_fields) {
  Sources sources;
  put_run(sources, bundle.run, with_fields);
  if (bundle.bed) put_run(sources, *bundle.bed, with_fields);
  if (bundle.grains) put_text(sources, grains_path(bundle.grains->content), read_text(bundle.grains->file));

  const RunHeader& header = bundle.run.manifest.header;
  BundleIndex index{header.case_id, bundle.run.manifest.run, header.bed_id, header.bed_run, {}};
  for (const auto& [name, source] : sources) index.members.push_back(source.first);
  const std::string text = index_text(index);

  TarWriter tar(file);
  tar.begin(kBundleFile, text.size());
  tar.write(text);
  for (const auto& [name, source] : sources) {
    const auto& [entry, from] = source;
    tar.begin(name, entry.bytes);
    if (from.file.empty()) {
      tar.write(from.text);
    } else {
      copy(from.file, entry, tar);
    }
  }
  tar.publish();
}

}  // namespace seapile::store
