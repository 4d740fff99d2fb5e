// A sealed result in which one bit has changed. verify() must see it wherever it is, and every reader must refuse the
// file that it is in before the HDF5 library opens it, which can crash on a damaged file.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>

#include "runner/store/durable.h"
#include "tests/runner/store/sample_run.h"
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

TEST(BitFlip, IsNeverReadAsAResult) {
  constexpr std::size_t kFlips = 300;
  const Scratch scratch;
  const sample::Written written = sample::write(scratch.path());
  const std::string seal = read_manifest(written.drive).seal;
  std::vector<std::pair<Path, std::string>> files;
  std::size_t bytes = 0;
  for (const Path& run : {written.drive, written.bed}) {
    for (const auto& entry : std::filesystem::directory_iterator(run)) {
      files.emplace_back(entry.path(), read_text(entry.path()));
      bytes += files.back().second.size();
    }
  }
  ASSERT_TRUE(is_right(read_everything(written.drive)));

  std::size_t verified = 0, refused = 0, harmless = 0;
  for (std::size_t i = 0; i < kFlips; ++i) {
    auto at = static_cast<std::size_t>(sample::uniform(31, i) * static_cast<double>(bytes));
    std::size_t f = 0;
    while (at >= files[f].second.size()) at -= files[f++].second.size();
    const auto& [file, text] = files[f];
    std::string damaged = text;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << (i % 8)));
    std::ofstream(file, std::ios::binary) << damaged;
    SCOPED_TRACE(file.filename().string() + ", bit " + std::to_string(i % 8) + " of byte " + std::to_string(at));

    bool found = false;
    try {
      found = !verify(file.parent_path()).empty();
    } catch (const StoreError& error) {
      found = error.kind == StoreError::Kind::damaged;
    }
    EXPECT_TRUE(found) << "verify() sees nothing";
    verified += found ? 1 : 0;

    try {
      const Content content = read_everything(written.drive);
      const bool right = is_right(content) && content.manifest.seal == seal &&
                         sample::difference(read_bed(written.bed), sample::bed()).empty();
      EXPECT_TRUE(right) << "silently wrong";
      harmless += right ? 1 : 0;  // In a sidecar, which only ParaView reads.
    } catch (const StoreError&) {
      ++refused;
    }
    std::ofstream(file, std::ios::binary) << text;
  }
  std::printf("%zu flips: verify() saw %zu; readers refused %zu and read %zu rightly\n", kFlips, verified, refused,
              harmless);
  EXPECT_EQ(verified, kFlips);
  EXPECT_EQ(refused + harmless, kFlips);
}

}  // namespace
}  // namespace seapile::store::fault
