#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "runner/commands/findings.h"
#include "runner/execute/history.h"
#include "runner/execute/plan.h"
#include "runner/present/bytes.h"
#include "runner/store/catalogue.h"
#include "runner/store/database.h"
#include "runner/store/disk_use.h"
#include "runner/store/equivalence.h"
#include "runner/store/file_system.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kGibibyte = std::uint64_t{1} << 30;
constexpr std::uint64_t kLittleRoom = 10 * kGibibyte;  // frames of a study of full size take gigabytes
constexpr std::uint64_t kNoRoom = kGibibyte / 4;
constexpr std::size_t kMostNamed = 3;

Finding of_store(Health health, const std::string& what, const std::string& words) {
  return {health, "store", what, words};
}

void look_at_file_system(const fs::path& root, bool there, std::vector<Finding>& findings) {
  const store::FileSystem system = store::file_system_of(root);
  const std::string trouble = store::trial_of_writing(system.looked_from);
  findings.push_back(
      of_store(Health::ok, "folder",
               there ? root.string() : fmt::format("{} is not there yet; the first run makes it", root.string())));
  if (!trouble.empty()) {
    findings.push_back(of_store(Health::problem, "writing", trouble));
  } else {
    findings.push_back(of_store(Health::ok, "writing", "written, synced, renamed and locked a file"));
  }
  const bool forgets = system.name == "tmpfs";
  findings.push_back(of_store(
      system.is_local && !forgets ? Health::ok : Health::note, "file system",
      !system.is_local ? system.name + ", over a network: one machine at a time may write the catalogue, and locks are "
                                       "only as good as the server's"
      : forgets        ? system.name + ": in memory, gone when the machine is switched off"
                       : system.name + ", local"));
  const Health room = system.free_bytes < kNoRoom       ? Health::problem
                      : system.free_bytes < kLittleRoom ? Health::note
                                                        : Health::ok;
  findings.push_back(of_store(room, "free space",
                              present::bytes_text(system.free_bytes) +
                                  (room == Health::ok ? "" : "; `runner gc --dry-run` tells what can go")));
}

Finding look_at_catalogue(const fs::path& root) {
  try {
    const auto catalogue = store::Catalogue::open_read_only(root);
    const std::size_t missing = catalogue.missing().size();
    if (missing == 0)
      return of_store(Health::ok, "catalogue",
                      fmt::format("of schema {}, lists every complete run", store::kCatalogueVersion));
    return of_store(Health::note, "catalogue",
                    fmt::format("lacks {} complete run{}; `runner ingest` adds {}", missing, missing == 1 ? "" : "s",
                                missing == 1 ? "it" : "them"));
  } catch (const store::OlderSchema& error) {
    return of_store(Health::problem, "catalogue", error.what());
  } catch (const store::StoreError& error) {
    const bool damaged = error.kind == store::StoreError::Kind::damaged;
    return of_store(
        Health::problem, "catalogue",
        fmt::format("{}{}", error.what(), damaged ? "; `runner reindex` writes it anew from the run folders" : ""));
  }
}

/// "3 (1a2b3c4d5e/0001, ...)".
std::string counted(const std::vector<std::string>& names) {
  const auto shown = std::min(names.size(), kMostNamed);
  return fmt::format("{} ({}{})", names.size(),
                     fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < names.size() ? ", ..." : "");
}

void look_at_runs(const fs::path& root, std::vector<Finding>& findings) {
  const std::vector<store::StoredRun> runs = store::runs_in_store(root);
  std::size_t complete = 0;
  std::vector<std::string> running, interrupted, damaged, strange;
  for (const store::StoredRun& run : runs) {
    const std::string name = execute::short_id(run.case_id) + "/" + run.run;
    complete += run.complete ? 1 : 0;
    if (!run.trouble.empty()) damaged.push_back(name);
    if (!run.strange.empty()) strange.push_back(name);
    if (run.complete || !run.newest) continue;
    (execute::is_seen_claimed(root, run.case_id) ? running : interrupted).push_back(name);
  }
  findings.push_back(of_store(Health::ok, "runs", fmt::format("{} complete", complete)));
  if (!running.empty()) findings.push_back(of_store(Health::ok, "running", counted(running)));
  if (!interrupted.empty())
    findings.push_back(
        of_store(Health::note, "interrupted",
                 counted(interrupted) + "; running their study again continues them, `runner status` tells of each"));
  if (!damaged.empty())
    findings.push_back(of_store(
        Health::problem, "damaged",
        counted(damaged) + "; `runner verify` says what differs; take the files from a backup, or delete the folders"));
  if (!strange.empty())
    findings.push_back(of_store(Health::note, "strange", counted(strange) + " hold files that are none of ours"));
}

void look_at_declarations(const fs::path& root, std::vector<Finding>& findings) {
  const store::Equivalences equivalences = store::read_equivalences(root);
  if (!equivalences.declared.empty())
    findings.push_back(
        of_store(Health::ok, "declarations", fmt::format("{} of equivalence", equivalences.declared.size())));
  for (const std::string& sentence : equivalences.left_out)
    findings.push_back(
        of_store(Health::note, "declarations", sentence + "; it counts for nothing: delete it and probe again"));
}

/// Throws store::StoreError.
void look_at_store(const fs::path& root, std::vector<Finding>& findings) {
  std::error_code ignored;
  const bool there = fs::is_directory(root, ignored);
  if (!there && store::is_there(root)) {
    findings.push_back(of_store(Health::problem, "folder", root.string() + " is no folder"));
    return;
  }
  look_at_file_system(root, there, findings);
  if (!there) return;
  if (store::is_there(root / store::kCatalogueFile)) {
    findings.push_back(look_at_catalogue(root));
  } else {
    findings.push_back(of_store(fs::is_directory(root / "cases", ignored) ? Health::note : Health::ok, "catalogue",
                                "is not there; the next run or `runner reindex` makes it"));
  }
  look_at_runs(root, findings);
  look_at_declarations(root, findings);
}

}  // namespace

std::vector<Finding> findings_of_store(const fs::path& root) {
  std::vector<Finding> findings;
  try {
    look_at_store(root, findings);
  } catch (const store::StoreError& error) {
    findings.push_back(of_store(Health::problem, "reading", error.what()));
  }
  return findings;
}

}  // namespace seapile::commands
