#include "runner/store/recovery.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include "runner/store/durable.h"
#include "runner/store/sha256.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;

bool verifies(const Path& run_folder, const Checkpoint& checkpoint) {
  if (checkpoint.generation < 1 || checkpoint.segments.size() != static_cast<std::size_t>(checkpoint.generation)) {
    return false;
  }
  for (std::int64_t g = 1; g <= checkpoint.generation; ++g) {
    const Path file = segment_file(run_folder, g);
    if (!is_there(file) || sha256_of_file(file) != checkpoint.segments[static_cast<std::size_t>(g) - 1]) {
      return false;
    }
  }
  return true;
}

/// Absent when the file is missing, damaged, or of another run or version.
std::optional<Checkpoint> good_checkpoint(const Path& run_folder, const Path& file, const Stamp& stamp) {
  if (!is_there(file)) return std::nullopt;
  try {
    Checkpoint checkpoint = read_checkpoint(file, stamp);
    if (verifies(run_folder, checkpoint)) return checkpoint;
  } catch (const StoreError& error) {
    // A disk that cannot be read at the moment is no reason to give up what lies on it.
    if (error.kind != StoreError::Kind::damaged) throw;
  }
  return std::nullopt;
}

void set_aside(const Path& file) { publish(file, file.string() + ".aside"); }

}  // namespace

Path segment_file(const Path& run_folder, std::int64_t generation) {
  char name[32];
  std::snprintf(name, sizeof name, "%06lld.h5", static_cast<long long>(generation));
  return run_folder / "segment" / name;
}

Path checkpoint_file(const Path& run_folder, std::int64_t generation) {
  return run_folder / "checkpoint" / (generation % 2 == 1 ? "a.h5" : "b.h5");
}

Recovered recover(const Path& run_folder, const Stamp& stamp) {
  const std::array slots = {checkpoint_file(run_folder, 1), checkpoint_file(run_folder, 2)};
  std::array<std::optional<Checkpoint>, 2> found;
  for (std::size_t i = 0; i < slots.size(); ++i) found[i] = good_checkpoint(run_folder, slots[i], stamp);
  const auto generation = [&](std::size_t i) { return found[i] ? found[i]->generation : 0; };
  const std::size_t newest = generation(1) > generation(0) ? 1 : 0;

  // A checkpoint that does not hold goes before the segments that only it builds on.
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (!found[i] && is_there(slots[i])) set_aside(slots[i]);
  }
  Recovered recovered;
  if (found[newest]) recovered.checkpoint = *std::move(found[newest]);
  for (std::int64_t g = 1; g <= recovered.checkpoint.generation; ++g) {
    recovered.segments.push_back(segment_file(run_folder, g));
  }
  for (const Path& file : entries(run_folder / "segment")) {
    const bool is_used = std::ranges::find(recovered.segments, file) != recovered.segments.end();
    if (!is_used && file.extension() == ".h5") set_aside(file);
  }
  return recovered;
}

}  // namespace seapile::store
