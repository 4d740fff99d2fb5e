#include "runner/store/garbage.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "runner/store/dropped.h"
#include "runner/store/durable.h"
#include "runner/store/layout.h"
#include "runner/store/run_folder.h"

namespace seapile::store {

namespace {

namespace fs = std::filesystem;
using Path = fs::path;
using Name = std::pair<std::string, std::string>;  // (case, run)

Name name_of(const StoredRun& run) { return {run.case_id, run.run}; }

bool is_left_alone(const StoredRun& run) { return !run.strange.empty() || !run.trouble.empty(); }

/// The newest complete runs of every case, as many as asked for, and the newest one that did not diverge: it is the
/// last result that the case has. Then the beds that those were built on.
std::set<Name> kept_runs(const std::vector<StoredRun>& runs, const GarbageRules& rules) {
  std::set<Name> kept;
  std::map<std::string, std::size_t> newer;  // complete runs of the case that were seen already
  std::set<std::string> has_result;
  const auto is_used_bed = [&](const StoredRun& run) {
    return rules.bed_runs_in_use.contains(run.run) &&
           std::ranges::find(run.files, "bed.h5", &StoredFile::path) != run.files.end();
  };
  for (auto run = runs.rbegin(); run != runs.rend(); ++run) {
    if (!run->complete) continue;
    const bool result = run->completed && has_result.insert(run->case_id).second;
    if (newer[run->case_id]++ < rules.keep || result || is_left_alone(*run) || is_used_bed(*run))
      kept.insert(name_of(*run));
  }
  for (const StoredRun& run : runs) {
    if (!run.bed_run.empty() && kept.contains(name_of(run))) kept.insert({run.bed_id, run.bed_run});
  }
  return kept;
}

Removal whole(const StoredRun& run, Purpose purpose, const std::string& reason) {
  Removal removal{&run, true, purpose, {}, bytes_of(run), reason};
  for (const StoredFile& file : run.files) removal.paths.push_back(file.path);
  return removal;
}

/// Files of one purpose, of a run that stays.
void add_files(const StoredRun& run, Purpose purpose, const std::string& reason, std::vector<Removal>& all) {
  Removal removal{&run, false, purpose, {}, 0, reason};
  for (const StoredFile& file : run.files) {
    if (file.purpose != purpose) continue;
    removal.paths.push_back(file.path);
    removal.bytes += file.bytes;
  }
  if (!removal.paths.empty()) all.push_back(std::move(removal));
}

int rank(const Removal& removal) {
  if (removal.purpose == Purpose::leftover) return 0;
  if (removal.whole) return 1;
  return removal.purpose == Purpose::checkpoint ? 2 : removal.purpose == Purpose::fields ? 3 : 4;
}

void remove_file(const Path& file) {
  std::error_code error;
  fs::remove(file, error);  // never what a link points to
  if (error) throw StoreError(StoreError::Kind::io, "cannot remove " + file.string() + ": " + error.message());
}

void remove_whole(const Removal& removal) {
  const Path& folder = removal.run->folder;
  remove_file(folder / kManifestFile);
  sync_folder(folder);
  for (const std::string& path : removal.paths) remove_file(folder / path);
  for (const char* running : {"checkpoint", "segment"}) remove_file(folder / running);
  remove_file(folder);
  sync_folder(folder.parent_path());
}

/// The run as it is now; null: it is gone.
const StoredRun* as_it_is(const std::vector<StoredRun>& now, const StoredRun& before) {
  const auto found = std::ranges::find(now, before.run, &StoredRun::run);
  return found == now.end() ? nullptr : &*found;
}

/// Whether everything that is to go is still there as it was planned.
bool still_holds(const Removal& removal, const StoredRun& found) {
  const auto is_there_still = [&](const std::string& path) {
    const auto file = std::ranges::find(found.files, path, &StoredFile::path);
    return file != found.files.end() && (removal.whole || file->purpose == removal.purpose);
  };
  return found.complete == removal.run->complete && found.newest == removal.run->newest &&
         std::ranges::all_of(removal.paths, is_there_still) &&
         (!removal.whole || found.files.size() == removal.paths.size());
}

}  // namespace

std::vector<Removal> plan_removals(const std::vector<StoredRun>& runs, std::uint64_t total, const GarbageRules& rules) {
  const std::set<Name> kept = kept_runs(runs, rules);
  std::vector<Removal> all;
  for (const StoredRun& run : runs) {
    if (is_left_alone(run)) continue;
    if (!run.complete && !run.newest) {
      all.push_back(whole(run, Purpose::leftover, "interrupted, and never resumed: there is a newer run"));
      continue;
    }
    if (run.complete && !kept.contains(name_of(run))) {
      all.push_back(whole(run, Purpose::record, "no longer the newest run of its case"));
      continue;
    }
    add_files(run, Purpose::leftover, "no part of the run", all);
    for (const Purpose purpose : {Purpose::checkpoint, Purpose::fields, Purpose::series}) {
      if (run.complete && rules.drop.contains(purpose)) add_files(run, purpose, "asked for by --drop", all);
    }
  }
  std::ranges::stable_sort(all, [](const Removal& a, const Removal& b) {
    return std::tuple(rank(a), b.bytes, a.run->modified) < std::tuple(rank(b), a.bytes, b.run->modified);
  });
  if (!rules.budget) return all;
  std::size_t count = 0;
  while (count < all.size() && total > *rules.budget) total -= std::min(total, all[count++].bytes);
  all.resize(count);
  return all;
}

Removed remove(const Removal& removal) {
  const StoredRun& run = *removal.run;
  const Path case_folder = run.folder.parent_path();
  const auto claim = Claim::take(case_folder);
  if (!claim) return Removed::claimed;
  // Decided under the claim: the case may have been worked on since the plan was made.
  const std::vector<StoredRun> now = runs_on_disk(case_folder);
  const StoredRun* found = as_it_is(now, run);
  if (found == nullptr || is_left_alone(*found) || !still_holds(removal, *found)) return Removed::changed;
  if (removal.whole) {
    remove_whole(removal);
    return Removed::yes;
  }
  if (removal.purpose != Purpose::leftover) write_dropped(run.folder, read_manifest(run.folder), removal.paths);
  for (const std::string& path : removal.paths) remove_file(run.folder / path);
  sync_folder(run.folder);
  return Removed::yes;
}

}  // namespace seapile::store
