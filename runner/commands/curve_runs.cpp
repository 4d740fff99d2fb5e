#include "runner/commands/curve_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "runner/commands/command.h"
#include "runner/store/durable.h"

namespace seapile::commands {

namespace fs = std::filesystem;

CurveRuns curve_runs(const store::Catalogue& catalogue, const fs::path& root, const std::string& study,
                     const std::vector<std::string>& where, bool only_completed) {
  CurveRuns drives, basins;
  basins.series = present::Series::water;
  for (const auto& [folder, labels] : usage_checked([&] { return catalogue.runs(study, where); })) {
    const store::Manifest manifest = store::read_manifest(folder);
    if (only_completed && manifest.result.outcome != simulation::Outcome::completed) continue;
    const bool is_drive = manifest.header.kind == "drive", has_fluid = manifest.flow_records > 0;
    const bool is_basin = has_fluid && !is_drive;
    if (!is_drive && !is_basin) continue;
    if (is_drive && has_fluid) drives.series = present::Series::both;
    fs::path bed;
    if (is_drive) bed = store::bed_run_folder(root, manifest.header);
    (is_drive ? drives : basins).sources.push_back({manifest.header.case_id, manifest.run, labels, folder, bed});
    const auto pile = std::ranges::find(manifest.header.parts, "pile", &simulation::Part::name);
    const bool has_pile = pile != manifest.header.parts.end() && pile->built;
    (has_pile ? basins.with_pile : basins.without_pile) |= is_basin;
  }
  if (drives.sources.empty()) return basins;
  if (basins.sources.empty()) return drives;
  throw UsageError("drives and basins have no columns in common: --where \"kind = drive\" or \"kind = flow\"");
}

void write_file(const fs::path& file, const std::function<void(std::FILE*)>& write) {
  std::error_code ignored;
  const bool in_place = fs::exists(file, ignored) && !fs::is_regular_file(file, ignored);
  const fs::path draft = in_place ? file : store::temporary_name(file);
  const auto fail = [&] {
    throw UsageError(fmt::format("{} cannot be written: {}", file.string(), std::strerror(errno)));
  };
  std::FILE* stream = std::fopen(draft.c_str(), "w");
  if (stream == nullptr) fail();
  try {
    write(stream);
  } catch (...) {
    std::fclose(stream);
    if (!in_place) fs::remove(draft, ignored);
    throw;
  }
  if (std::fclose(stream) != 0 || (!in_place && std::rename(draft.c_str(), file.c_str()) != 0)) {
    const int reason = errno;
    if (!in_place) fs::remove(draft, ignored);
    errno = reason;
    fail();
  }
}

}  // namespace seapile::commands
