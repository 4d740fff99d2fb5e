// A sealed result in which one bit has changed. verify() must see it wherever it is, and every reader must refuse the
// file that it is in before the HDF5 library opens it, which can crash on a damaged file.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>

#include "runner/store/durable.h"
#include "tests/runner/store/sample_flow.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store::fault {
namespace {

using Path = std::filesystem::path;

struct Content {
  Manifest manifest;
  std::vector<simulation::Record> records;
  std::vector<simulation::Frame> frames;
};

Content read_everything(const Path& run) {
  Content content{read_manifest(run), read_series(run), {}};
  for (std::size_t k = 0; k < content.manifest.frames; ++k) content.frames.push_back(read_frame(run, k));
  return content;
}

/// Whether a reader that met no error has the values that were written.
bool is_right(const Content& content) {
  if (!sample::difference(content.records, sample::records(0, 20)).empty() || content.frames.size() != 2) return false;
  return sample::difference(content.frames[0], sample::frame(0)).empty() &&
         sample::difference(content.frames[1], sample::frame(1)).empty();
}

constexpr std::size_t kFlips = 300;

/// The files of folders, and one flipped bit after the other: each second one anywhere, so that large files have
/// many, the others in one file after the other, so that every file has some.
class Flips {
 public:
  explicit Flips(const std::vector<Path>& folders) {
    for (const Path& folder : folders) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files_.emplace_back(entry.path(), read_text(entry.path()));
      }
    }
    std::ranges::sort(files_);
    for (const auto& file : files_) bytes_ += file.second.size();
  }

  /// Damages a file until `restore`, and names it.
  Path make(std::size_t i) {
    const double where = sample::uniform(31, i);
    std::size_t f = 0, at = 0;
    if (i % 2 == 0) {
      f = i / 2 % files_.size();
      at = static_cast<std::size_t>(where * static_cast<double>(files_[f].second.size()));
    } else {
      at = static_cast<std::size_t>(where * static_cast<double>(bytes_));
      while (at >= files_[f].second.size()) at -= files_[f++].second.size();
    }
    std::string damaged = files_[f].second;
    const auto bit = static_cast<std::size_t>(sample::uniform(32, i) * 8);
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << bit));
    std::ofstream(files_[f].first, std::ios::binary) << damaged;
    ++count_[files_[f].first.filename().string()];
    place_ = files_[f].first.string() + ", bit " + std::to_string(bit) + " of byte " + std::to_string(at);
    return files_[f].first;
  }

  void restore() const {
    for (const auto& [file, text] : files_) std::ofstream(file, std::ios::binary) << text;
  }

  const std::string& place() const { return place_; }

  void print_counts() const {
    for (const auto& [name, count] : count_) std::printf("  %zu in %s\n", count, name.c_str());
  }

 private:
  std::vector<std::pair<Path, std::string>> files_;
  std::size_t bytes_ = 0;
  std::map<std::string, std::size_t> count_;
  std::string place_;
};

/// A run that diverged after two checkpoints: these stay in its folder, sealed.
Path write_diverged(const Path& root) {
  const Path folder = case_folder(root, sample::drive_header().case_id) / "0002";
  RunWriter writer(folder, sample::drive_header());
  for (std::size_t i = 0; i < 20; ++i) {
    if (i % 10 == 0) writer.add(sample::frame(i / 10));
    writer.add(sample::record(i));
    if (i % 10 == 9) writer.checkpoint(sample::state(i));
  }
  simulation::RunResult result = sample::drive_result();
  result.outcome = simulation::Outcome::diverged;
  writer.finish(result, sample::provenance(), nullptr);
  return folder;
}

/// Sidecars are ParaView's, and what a diverged run keeps is there for whoever looks into it.
bool is_never_read(const Path& file) {
  const std::string folder = file.parent_path().filename();
  return file.extension() == ".xdmf" || folder == "segment" || folder == "checkpoint";
}

bool verify_sees(const Path& run) {
  try {
    return !verify(run).empty();
  } catch (const StoreError& error) {
    return error.kind == StoreError::Kind::damaged;
  }
}

TEST(BitFlip, IsNeverReadAsAResult) {
  const Scratch scratch;
  const sample::Written written = sample::write(scratch.path());
  const Path diverged = write_diverged(scratch.path());
  const std::string seal = read_manifest(written.drive).seal, other_seal = read_manifest(diverged).seal;
  const auto all_right = [&] {
    const Content content = read_everything(written.drive), other = read_everything(diverged);
    return is_right(content) && content.manifest.seal == seal && is_right(other) && other.manifest.seal == other_seal &&
           sample::difference(read_bed(written.bed), sample::bed()).empty();
  };
  ASSERT_TRUE(all_right());

  Flips flips({written.drive, written.bed, diverged});
  std::size_t verified = 0, refused = 0, harmless = 0;
  for (std::size_t i = 0; i < kFlips; ++i) {
    const Path file = flips.make(i);
    SCOPED_TRACE(flips.place());
    const bool found = verify_sees(written.drive) || verify_sees(written.bed) || verify_sees(diverged);
    EXPECT_TRUE(found) << "verify() sees nothing";
    verified += found ? 1 : 0;
    try {
      const bool right = all_right();
      EXPECT_TRUE(right) << "silently wrong";
      EXPECT_TRUE(is_never_read(file)) << "the library has opened a damaged file";
      harmless += right ? 1 : 0;
    } catch (const StoreError&) {
      ++refused;
    }
    flips.restore();
  }
  std::printf("%zu flips: verify() saw %zu; readers refused %zu and read %zu rightly\n", kFlips, verified, refused,
              harmless);
  flips.print_counts();
  EXPECT_EQ(verified, kFlips);
  EXPECT_EQ(refused + harmless, kFlips);
}

TEST(BitFlip, OfAFlowIsNeverReadAsAResult) {
  const Scratch scratch;
  const Path run = sample::write_flow(scratch.path());
  const auto all_right = [&] {
    for (std::size_t k = 0; k < sample::kFlowFrames; ++k) {
      if (!sample::difference(read_flow_frame(run, k), sample::flow_frame(k)).empty()) return false;
    }
    return read_series(run).empty() && flow_frame_count(run) == sample::kFlowFrames;
  };
  ASSERT_TRUE(all_right());

  Flips flips({run});
  std::size_t verified = 0, refused = 0;
  for (std::size_t i = 0; i < kFlips; ++i) {
    const Path file = flips.make(i);
    SCOPED_TRACE(flips.place());
    const bool found = verify_sees(run);
    EXPECT_TRUE(found) << "verify() sees nothing";
    verified += found ? 1 : 0;
    try {
      EXPECT_TRUE(all_right()) << "silently wrong";
      EXPECT_TRUE(is_never_read(file)) << "the library has opened a damaged file";
    } catch (const StoreError&) {
      ++refused;
    }
    flips.restore();
  }
  std::printf("%zu flips: verify() saw %zu; readers refused %zu\n", kFlips, verified, refused);
  flips.print_counts();
}

// A run that was interrupted has no manifest yet: its checkpoints say what its segments are, and hash themselves.
TEST(BitFlip, IsNeverGoneOnFrom) {
  const Scratch scratch;
  const Path folder = case_folder(scratch.path(), sample::drive_header().case_id) / "0001";
  {
    RunWriter writer(folder, sample::drive_header());
    for (std::size_t i = 0; i < 40; ++i) {
      if (i % 10 == 0) writer.add(sample::frame(i / 10));
      writer.add(sample::record(i));
      if (i % 10 == 9) writer.checkpoint(sample::state(i + 1));
    }
  }
  Flips flips({folder});
  std::map<std::size_t, std::size_t> from;  // How often it was gone on after so many records.
  for (std::size_t i = 0; i < kFlips; ++i) {
    flips.make(i);
    SCOPED_TRACE(flips.place());
    const RunWriter writer(folder, sample::drive_header());
    const Resumable& resumable = writer.resumable();
    const std::size_t records = resumable.records.size();
    ++from[records];
    EXPECT_TRUE(records == 0 || records == 30 || records == 40) << records;
    EXPECT_EQ(resumable.frames, records / 10);
    EXPECT_EQ(sample::difference(resumable.records, sample::records(0, records)), "");
    const auto state = records == 0 ? std::vector<simulation::Array>{} : sample::state(records);
    EXPECT_EQ(sample::difference(resumable.state, state), "");
    flips.restore();
  }
  std::printf("%zu flips: gone on", kFlips);
  for (const auto& [records, count] : from) std::printf(" %zu times after %zu records,", count, records);
  std::printf(" always with what was sealed\n");
  flips.print_counts();
}

}  // namespace
}  // namespace seapile::store::fault
