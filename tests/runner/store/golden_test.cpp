// results_schema/golden/v<n> was written when the catalogue's schema was <n>, and is never written again. Whoever
// cannot read one any more, or reads other values, has broken the promise of results_schema/README.md.
#include <gtest/gtest.h>

#include <cmath>

#include "runner/store/catalogue.h"
#include "runner/store/migration.h"
#include "runner/store/sha256.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;

const std::string kBed = "c633d94908c5c0cabf5cb8e9f92263520d5d0ecf176f34fdfc69b064c1470fd1";
const std::string kDrive = "e7c3d0475798912a0f1b912e13d4114177037f4bafea20c44670ca9a264f3f43";

/// The stores hold the same runs; the schema is the parameter.
struct Golden : testing::TestWithParam<int> {
  const Path golden = Path(SEAPILE_RESULTS_SCHEMA "/golden") / ("v" + std::to_string(GetParam()));
  Path run(const std::string& id) const { return case_folder(golden, id) / "0001"; }
};

TEST_P(Golden, Verifies) {
  EXPECT_EQ(verify(run(kBed)), std::vector<std::string>{});
  EXPECT_EQ(verify(run(kDrive)), std::vector<std::string>{});
}

TEST_P(Golden, HasTheManifestThatWasWritten) {
  const Manifest manifest = read_manifest(run(kDrive));
  EXPECT_EQ(manifest.schema, 1);
  EXPECT_EQ(manifest.header.kind, "drive");
  EXPECT_EQ(manifest.header.case_id, kDrive);
  EXPECT_EQ(sha256(manifest.header.canonical), kDrive);
  EXPECT_EQ(manifest.header.bed_id, kBed);
  EXPECT_EQ(manifest.header.bed_run, "0001");
  EXPECT_EQ(manifest.records, 20U);
  EXPECT_EQ(manifest.frames, 2U);
  EXPECT_EQ(manifest.flow_records, 0U);  // The first one does not say.
  EXPECT_EQ(manifest.flow_frames, 0U);
  EXPECT_EQ(manifest.result.outcome, simulation::Outcome::completed);
  EXPECT_EQ(manifest.result.time, 20.01);
  EXPECT_EQ(manifest.result.depth, 1.2);
  EXPECT_EQ(manifest.result.state_hash, 0x0123456789abcdefU);
  ASSERT_EQ(manifest.result.metrics.size(), 4U);
  EXPECT_EQ(manifest.result.metrics[0].name, "tip_resistance_mean");
  EXPECT_EQ(manifest.result.metrics[0].value, 81234.5);
  EXPECT_EQ(manifest.result.metrics[0].unit, "Pa");
  EXPECT_TRUE(std::isnan(manifest.result.metrics[3].value));
  EXPECT_EQ(manifest.result.profile[1].calls, 40000);
  EXPECT_EQ(manifest.provenance.cpu_seconds, 41.5);
  EXPECT_EQ(manifest.header.parts[4].name, "fluid");
  EXPECT_FALSE(manifest.header.parts[4].built);
  EXPECT_EQ(manifest.header.numerics[1].version, 2);
  EXPECT_TRUE(std::isnan(read_manifest(run(kBed)).result.depth));
}

TEST_P(Golden, SaysWhatDecidedAboutAPartSinceItsManifestsDo) {
  const simulation::Part mesh = read_manifest(run(kDrive)).header.parts.at(3);
  EXPECT_EQ(mesh.name, "mesh");
  EXPECT_EQ(mesh.by, GetParam() < 2 ? scene::By::scene : scene::By::asked);
  EXPECT_EQ(mesh.criterion.has_value(), GetParam() >= 2);
  if (mesh.criterion) {
    EXPECT_EQ(mesh.criterion->threshold, 0.5);
  }
}

// The values as text, so that no change of the sample can hide a change of the reader.
TEST_P(Golden, HasTheLiteralValuesThatWereWritten) {
  const auto records = read_series(run(kDrive));
  ASSERT_EQ(records.size(), 20U);
  EXPECT_EQ(records[0].time, 0.05);
  EXPECT_EQ(records[19].depth, 0.01);
  EXPECT_EQ(records[7].tip_resistance, 1821.727824944852);
  EXPECT_EQ(records[19].dissipation, 5195.7969342853103);
  const simulation::Frame frame = read_frame(run(kDrive), 1);
  EXPECT_EQ(frame.asked, 0.2);
  EXPECT_EQ(frame.grid.nx, 10);
  EXPECT_EQ(std::get<std::vector<double>>(frame.grains[1].values)[99], 0.92494218165520925);
  EXPECT_EQ(std::get<std::vector<std::int64_t>>(frame.contacts[0].values)[5], 2);
  EXPECT_EQ(std::get<std::vector<double>>(frame.cells[1].values)[239], 56171.853658448657);
  const simulation::Bed bed = read_bed(run(kBed));
  EXPECT_EQ(bed.metrics[1].name, "coordination_number");
  EXPECT_EQ(bed.metrics[1].value, 3.62);
  EXPECT_EQ(bed.porosity_profile[11], 0.29771676070894304);
  EXPECT_EQ(std::get<std::vector<double>>(bed.grains[2].values)[49], 0.016963976717128324);
}

TEST_P(Golden, HasEveryValueThatWasWritten) {
  EXPECT_EQ(sample::difference(read_series(run(kDrive)), sample::records(0, 20)), "");
  for (const std::size_t k : {0, 1}) EXPECT_EQ(sample::difference(read_frame(run(kDrive), k), sample::frame(k)), "");
  EXPECT_EQ(sample::difference(read_bed(run(kBed)), sample::bed()), "");
}

TEST_P(Golden, HasACatalogueThatAnswersOnceItIsMigrated) {
  const Scratch scratch;
  std::filesystem::copy(golden, scratch.path(), std::filesystem::copy_options::recursive);
  EXPECT_EQ(migrate(scratch.path()).from, GetParam());
  const Catalogue catalogue = Catalogue::open_read_only(scratch.path());
  EXPECT_EQ(catalogue.studies(), std::vector<std::string>{"golden"});
  const Table table = catalogue.query("golden", {"outcome = completed"}, {"tip_resistance_mean", "bed.seed"});
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0],
            (std::vector<Cell>{kDrive.substr(0, 10), "0001", "drive", "completed", "flat", 81234.5, 7.0}));
  EXPECT_EQ(catalogue.find(kBed.substr(0, 10)), case_folder(scratch.path(), kBed) / "0001");
}

TEST_P(Golden, FillsACatalogue) {
  const Scratch scratch;
  std::filesystem::copy(golden, scratch.path(), std::filesystem::copy_options::recursive);
  std::filesystem::remove(scratch.path() / "catalogue.sqlite");
  Catalogue catalogue = Catalogue::open(scratch.path());
  EXPECT_EQ(catalogue.rebuild(), 2U);
  EXPECT_EQ(catalogue.studies(), std::vector<std::string>{"golden"});
  const Table table = catalogue.query("golden", {"pile.tip = flat", "tip_resistance_mean > 8e4"}, {"pile.radius"});
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0].back(), Cell{0.125});
}

TEST_P(Golden, IsSmall) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(golden)) {
    if (entry.is_regular_file()) bytes += entry.file_size();
  }
  EXPECT_LT(bytes, 300'000U);
}

INSTANTIATE_TEST_SUITE_P(Schema, Golden, testing::Values(1, 2));

}  // namespace
}  // namespace seapile::store
