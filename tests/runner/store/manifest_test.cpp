#include "runner/store/manifest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runner/store/sha256.h"
#include "tests/runner/store/sample_run.h"

namespace seapile::store {
namespace {

Manifest sample_manifest() {
  Manifest manifest;
  manifest.run = "0003";
  manifest.header = sample::drive_header();
  manifest.records = 20;
  manifest.frames = 2;
  manifest.flow_records = 7;
  manifest.flow_frames = 3;
  manifest.result = sample::drive_result();
  manifest.provenance = sample::provenance();
  manifest.files = {{"series.h5", 13819, std::string(64, '1')}, {"grains.xdmf", 0, std::string(64, '2')}};
  return manifest;
}

Manifest round_trip(const Manifest& manifest) { return parse_manifest(manifest_text(manifest), "manifest.json"); }

TEST(Manifest, GivesBackWhatWasSaid) {
  const Manifest in = sample_manifest(), out = round_trip(in);
  // Text for text: whatever is in one is in the other.
  EXPECT_EQ(manifest_text(out), manifest_text(in));
  EXPECT_EQ(out.run, "0003");
  EXPECT_EQ(out.flow_records, 7U);
  EXPECT_EQ(out.flow_frames, 3U);
  EXPECT_EQ(out.header.case_id, in.header.case_id);
  EXPECT_EQ(out.header.canonical, in.header.canonical);
  EXPECT_EQ(out.header.scene_json, in.header.scene_json);
  EXPECT_EQ(out.header.record_json, in.header.record_json);
  EXPECT_EQ(out.header.bed_run, "0001");
  EXPECT_EQ(out.header.parts.size(), 5U);
  EXPECT_FALSE(out.header.parts[3].built);
  EXPECT_EQ(out.header.parts[3].by, scene::By::asked);
  EXPECT_EQ(out.header.parts[3].criterion->number, 0.25);
  EXPECT_EQ(out.header.parts[3].criterion->answer, "mean");
  EXPECT_FALSE(out.header.parts[4].criterion);
  EXPECT_EQ(out.header.numerics[1].module, "pile");
  EXPECT_EQ(out.header.numerics[1].version, 2);
  EXPECT_EQ(out.result.state_hash, in.result.state_hash);
  EXPECT_EQ(out.result.metrics[0].value, 81234.5);
  EXPECT_EQ(out.result.profile[1].calls, 40000);
  EXPECT_EQ(out.provenance.cpu_seconds, 41.5);
  EXPECT_EQ(out.files[0].bytes, 13819U);
}

TEST(Manifest, KeepsEveryBitOfHashesAndEveryKindOfNumber) {
  Manifest manifest = sample_manifest();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::uint64_t hash : {std::uint64_t{0}, std::uint64_t{1}, 0xffffffffffffffffU, 0x8000000000000001U}) {
    manifest.result.state_hash = hash;
    EXPECT_EQ(round_trip(manifest).result.state_hash, hash);
  }
  for (const double value : {0.1, -0.0, 1e-300, 5e-324, 1.7976931348623157e308, infinity, -infinity}) {
    manifest.result.time = value;
    EXPECT_EQ(round_trip(manifest).result.time, value);
    EXPECT_EQ(std::signbit(round_trip(manifest).result.time), std::signbit(value));
  }
  manifest.result.depth = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(round_trip(manifest).result.depth));
}

TEST(Manifest, TakesAnyTextAsReason) {
  Manifest manifest = sample_manifest();
  manifest.result.outcome = simulation::Outcome::diverged;
  manifest.result.reason = "\"quoted\"\n\\ \xc3\xa9 ]]>";
  EXPECT_EQ(round_trip(manifest).result.reason, manifest.result.reason);
  EXPECT_EQ(round_trip(manifest).result.outcome, simulation::Outcome::diverged);
  manifest.result.reason = "not UTF-8: \xff";
  EXPECT_NO_THROW(round_trip(manifest));
}

TEST(Manifest, SealsItself) {
  const std::string text = manifest_text(sample_manifest());
  const std::string seal = round_trip(sample_manifest()).seal;
  EXPECT_EQ(text.substr(text.size() - 68), seal + "\"\n}\n");
  EXPECT_EQ(sha256(text.substr(0, text.rfind(",\n  \"seal\""))), seal);
  for (std::size_t i = 0; i < text.size(); i += 7) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_THROW(parse_manifest(damaged, "manifest.json"), StoreError) << "byte " << i;
  }
}

TEST(Manifest, OfANewerProgramIsRefusedByName) {
  Manifest manifest = sample_manifest();
  manifest.schema = 2;
  try {
    round_trip(manifest);
    FAIL();
  } catch (const StoreError& error) {
    EXPECT_EQ(error.kind, StoreError::Kind::damaged);
    EXPECT_NE(std::string(error.what()).find("schema 2; this program knows 1"), std::string::npos);
  }
}

}  // namespace
}  // namespace seapile::store
