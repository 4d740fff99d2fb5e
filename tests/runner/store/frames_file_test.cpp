#include "runner/store/frames_file.h"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "runner/store/durable.h"
#include "runner/store/vtk_file.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;

/// Three frames, the one in the middle without a contact.
class FramesFile : public testing::Test {
 protected:
  void SetUp() override {
    write_frames(scratch_.path(), stamp_, {3, [](std::size_t k) { return sample::frame(k, k == 1 ? 0 : 20 + k); }});
  }

  Path file(const std::string& name) const { return scratch_.path() / name; }

  Scratch scratch_;
  Stamp stamp_{std::string(64, 'a'), "0001"};
};

/// Rows [first, first + count) of a dataset.
template <class T>
std::vector<T> rows(const hdf5::FileReader& reader, const std::string& path, std::int64_t first, std::int64_t count) {
  const std::vector<T> all = reader.read<T>(path);
  const auto columns = static_cast<std::ptrdiff_t>(std::max<std::uint64_t>(reader.extents(path).columns, 1));
  return {all.begin() + first * columns, all.begin() + (first + count) * columns};
}

// What a reader of VTKHDF does, step by step: it finds the part, its points and its cells by their offsets.
TEST_F(FramesFile, IsVtkHdfThatLeadsToTheSameValues) {
  for (const std::string content : {"grains", "contacts"}) {
    const std::vector<std::size_t> drawn =
        content == "grains" ? std::vector<std::size_t>{0, 1, 2} : std::vector<std::size_t>{0, 2};
    const char* scalar = content == "grains" ? "radius" : "force";
    hdf5::FileReader reader(file(content + ".vtkhdf"));
    EXPECT_EQ(reader.attribute<std::string>("/VTKHDF", "Type"), "PolyData");
    EXPECT_EQ(reader.attribute<Integers>("/VTKHDF", "Version"), (Integers{2, 0}));
    ASSERT_EQ(reader.attribute<std::int64_t>("/VTKHDF/Steps", "NSteps"), static_cast<std::int64_t>(drawn.size()));
    for (std::size_t s = 0; s < drawn.size(); ++s) {
      const std::string window = step_path("steps", drawn[s]);
      const auto of_step = [&](const std::string& name) { return reader.read<std::int64_t>("/VTKHDF/Steps/" + name); };
      EXPECT_EQ(reader.read<double>("/VTKHDF/Steps/Values")[s], sample::frame(drawn[s]).time);
      EXPECT_EQ(of_step("NumberOfParts")[s], 1);
      const auto part = static_cast<std::size_t>(of_step("PartOffsets")[s]);
      const std::int64_t points = reader.read<std::int64_t>("/VTKHDF/NumberOfPoints")[part];
      EXPECT_EQ(rows<double>(reader, "/VTKHDF/Points", of_step("PointOffsets")[s], points),
                reader.read<double>(window + "/position"));
      EXPECT_EQ(rows<double>(reader, std::string("/VTKHDF/PointData/") + scalar,
                             of_step(std::string("PointDataOffsets/") + scalar)[s], points),
                reader.read<double>(window + "/" + scalar));
      // A part has one offset more than cells.
      const std::int64_t cells = reader.read<std::int64_t>("/VTKHDF/Vertices/NumberOfCells")[part];
      const std::int64_t first = of_step("CellOffsets")[4 * s];
      const Integers ends =
          rows<std::int64_t>(reader, "/VTKHDF/Vertices/Offsets", first + static_cast<std::int64_t>(part), cells + 1);
      const Integers connectivity =
          rows<std::int64_t>(reader, "/VTKHDF/Vertices/Connectivity", of_step("ConnectivityIdOffsets")[4 * s], cells);
      ASSERT_EQ(cells, points);
      for (std::int64_t i = 0; i < cells; ++i) {
        EXPECT_EQ(ends[i], i);
        EXPECT_EQ(connectivity[i], i);
      }
      EXPECT_EQ(ends.back(), cells);
    }
    reader.close();
  }
}

TEST_F(FramesFile, HasTheGridsCellsAsQuadrilaterals) {
  hdf5::FileReader reader(file("fields.vtkhdf"));
  EXPECT_EQ(reader.attribute<std::string>("/VTKHDF", "Type"), "UnstructuredGrid");
  const auto points = reader.read<double>("/VTKHDF/Points");
  const auto corners = reader.read<std::int64_t>("/VTKHDF/Connectivity");
  ASSERT_EQ(points.size(), 3U * 11 * 9);
  ASSERT_EQ(corners.size(), 4U * 10 * 8);
  // The cell in column 3 of row 2, from its lower left corner counter-clockwise.
  const std::vector<std::pair<double, double>> expected = {{-0.1, 0.1}, {-0.05, 0.1}, {-0.05, 0.15}, {-0.1, 0.15}};
  for (std::size_t c = 0; c < 4; ++c) {
    const auto point = static_cast<std::size_t>(corners[4 * 23 + c]);
    EXPECT_NEAR(points[3 * point], expected[c].first, 1e-15);
    EXPECT_NEAR(points[3 * point + 1], expected[c].second, 1e-15);
  }
  const Integers first = reader.read<std::int64_t>("/VTKHDF/Steps/CellDataOffsets/porosity");
  EXPECT_EQ(first, (Integers{0, 80, 160}));
  EXPECT_EQ(rows<double>(reader, "/VTKHDF/CellData/stress", first[2], 80),
            std::get<std::vector<double>>(sample::frame(2).cells[1].values));
  reader.close();
}

TEST_F(FramesFile, HasSidecarsWhoseReferencesHold) {
  const std::regex reference(R"(Dimensions="([0-9 ]+)\">(\w+\.vtkhdf):(/[^<]+)<)");
  for (const std::string content : {"grains", "contacts", "fields"}) {
    const std::string text = read_text(file(content + ".xdmf"));
    std::size_t references = 0;
    hdf5::FileReader reader(file(content + ".vtkhdf"));
    for (std::sregex_iterator found(text.begin(), text.end(), reference), end; found != end; ++found, ++references) {
      EXPECT_EQ((*found)[2], content + ".vtkhdf");
      std::istringstream dimensions((*found)[1]);
      hdf5::Extents extents;
      dimensions >> extents.rows >> extents.columns;
      EXPECT_EQ(reader.extents((*found)[3]), extents) << (*found)[3];
    }
    reader.close();
    EXPECT_GE(references, 10U);
    // A step without a point would stop a reader.
    EXPECT_EQ(text.find("Dimensions=\"0"), text.npos);
    const auto steps = std::regex_replace(text, std::regex("<Time"), "\x01");
    EXPECT_EQ(std::count(steps.begin(), steps.end(), '\x01'), content == "contacts" ? 2 : 3);
  }
}

TEST_F(FramesFile, GivesVectorsInSpaceAThirdComponentAndTakesItAway) {
  hdf5::FileReader reader(file("grains.vtkhdf"));
  EXPECT_EQ(reader.extents("/steps/00000/velocity"), (hdf5::Extents{sample::kGrains, 3}));
  const auto velocity = reader.read<double>("/steps/00000/velocity");
  for (std::size_t i = 2; i < velocity.size(); i += 3) EXPECT_EQ(velocity[i], 0);
  reader.close();
  EXPECT_EQ(sample::difference(read_frame(scratch_.path(), stamp_, 2), sample::frame(2, 22)), "");
}

TEST_F(FramesFile, IsRefusedToAnotherRun) {
  EXPECT_THROW(read_frame(scratch_.path(), {std::string(64, 'b'), "0001"}, 0), StoreError);
  EXPECT_THROW(read_frame(scratch_.path(), {std::string(64, 'a'), "0002"}, 0), StoreError);
}

TEST(Frames, OfOneRunMustBeAlike) {
  const Scratch scratch;
  const auto write = [&](const auto& change) {
    const auto load = [&](std::size_t k) {
      simulation::Frame frame = sample::frame(k);
      if (k == 1) change(frame);
      return frame;
    };
    write_frames(scratch.fresh("run"), {std::string(64, 'a'), "0001"}, {2, load});
  };
  EXPECT_NO_THROW(write([](auto&) {}));
  EXPECT_THROW(write([](auto& frame) { frame.grid.spacing = 0.1; }), std::logic_error);
  EXPECT_THROW(write([](auto& frame) { frame.grains.pop_back(); }), std::logic_error);
  EXPECT_THROW(write([](auto& frame) { frame.cells[0].info.name = "cells/other"; }), std::logic_error);
}

}  // namespace
}  // namespace seapile::store
