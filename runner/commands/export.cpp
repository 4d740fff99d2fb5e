#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/commands/named_run.h"
#include "runner/execute/exit_codes.h"
#include "runner/store/bundle.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string id, out, root = "results";
  bool with_fields = false, force = false;
};

bool has_file(const store::Manifest& manifest, const std::string& path) {
  return std::ranges::find(manifest.files, path, &store::FileEntry::path) != manifest.files.end();
}

/// Why a repetition could not be compared with the run; empty: it can.
std::string objection(const store::Manifest& manifest) {
  if (std::ranges::find(manifest.dropped, "series.h5") != manifest.dropped.end())
    return "its series was dropped to save space; run it again first";
  if (manifest.header.kind == "bed" && !has_file(manifest, "bed.h5"))
    return "its bed did not settle, so that there is no state to compare";
  return "";
}

/// The file of the scene's grains, in its place or in the store's keeping; absent where they are drawn.
std::optional<store::BundledGrains> grains_of(const store::Manifest& manifest, const fs::path& root) {
  scene::BedSpec bed = study::scene_from_json(manifest.header.scene_json).bed;
  if (manifest.header.kind == "flow" || bed.file.empty()) return std::nullopt;
  const fs::path kept = root / store::grains_path(bed.file_content);
  if (fs::is_regular_file(kept)) bed.file = kept.string();
  study::read_grain_file(bed);  // They are still those that the case is named by.
  return store::BundledGrains{bed.file_content, bed.file};
}

/// Only a plain file is ever replaced: a rename over a device or a link would take its place.
void require_free(const std::string& out, bool force) {
  const fs::file_status status = fs::symlink_status(out);
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) throw UsageError(fmt::format("{} is there already, and is no plain file", out));
  if (!force) throw UsageError(fmt::format("{} is there already; --force writes over it", out));
}

int export_bundle(const ExportArguments& arguments) {
  require_free(arguments.out, arguments.force);
  const auto found = find_run(arguments.root, arguments.id);
  if (!found) return execute::kNothingMatched;
  if (const auto why = objection(found->manifest); !why.empty())
    throw UsageError(fmt::format("{} cannot be bundled: {}", arguments.id, why));
  try {
    store::Bundle bundle{{found->folder, found->manifest}, {}, grains_of(found->manifest, arguments.root)};
    if (!found->manifest.header.bed_id.empty()) {
      const fs::path folder = store::bed_run_folder(arguments.root, found->manifest.header);
      bundle.bed = store::BundledRun{folder, store::read_manifest(folder)};
    }
    store::write_bundle(arguments.out, bundle, arguments.with_fields);
  } catch (const store::StoreError& error) {
    if (error.kind != store::StoreError::Kind::damaged) throw UsageError(error.what());
    fmt::print(stderr, "{}\n", error.what());
    return execute::kCheckFailed;
  }
  fmt::print("{}\n", arguments.out);
  return execute::kDone;
}

}  // namespace

void add_export(CLI::App& app, Call& call) {
  static ExportArguments arguments;
  CLI::App* command = app.add_subcommand("export", "Write a run as one file, from which it can be repeated");
  command->add_option("--bundle", arguments.id, "Case id, or how it begins; ID/2: its run 0002 instead of the newest")
      ->type_name("ID")
      ->required();
  command->add_option("-o,--out", arguments.out, "File to write, a tar")->type_name("FILE.tar")->required();
  command->add_flag("--with-fields", arguments.with_fields, "Take the frames along, most of a run's bytes");
  command->add_flag("--force", arguments.force, "Write over a file that is there");
  add_store_option(*command, arguments.root);
  command->footer(
      "The file holds the run as it was sealed, the run of its bed, the grains that were read from a file, and an "
      "index\n"
      "with the SHA-256 of each. It needs no study. The same run gives the same bytes.\n\n"
      "Examples:\n"
      "  runner export --bundle 1a2b3c4d5e -o drive.tar\n"
      "  runner export --bundle 1a2b3c4d5e/2 -o drive.tar --with-fields --force\n"
      "  runner run --from drive.tar                       repeat it, and say whether the bits are the same");
  command->callback([&call] { call = [] { return export_bundle(arguments); }; });
}

}  // namespace seapile::commands
