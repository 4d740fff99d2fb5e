#include "runner/store/flow_file.h"

#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "runner/store/durable.h"
#include "runner/store/vtk_file.h"
#include "tests/runner/store/sample_flow.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;

/// Four frames of four meshes, the second without a free surface.
class FlowFile : public testing::Test {
 protected:
  static constexpr std::size_t kCount = 4;

  void SetUp() override { write_flow_frames(scratch_.path(), stamp_, {kCount, &sample::flow_frame}); }

  Path file(const std::string& name) const { return scratch_.path() / name; }

  Scratch scratch_;
  Stamp stamp_{std::string(64, 'a'), "0001"};
};

/// Values [first, first + count) of a dataset with so many columns.
template <class T>
std::vector<T> part(const hdf5::FileReader& reader, const std::string& path, std::int64_t first, std::int64_t count,
                    std::int64_t columns = 1) {
  const std::vector<T> all = reader.read<T>(path);
  return {all.begin() + first * columns, all.begin() + (first + count) * columns};
}

std::vector<double> values(const simulation::Array& array) { return std::get<std::vector<double>>(array.values); }

// What a reader of VTKHDF does, step by step: it finds the part, its points and its cells by their offsets.
TEST_F(FlowFile, IsVtkHdfThatLeadsToTheMeshOfEachStep) {
  hdf5::FileReader reader(file("flow.vtkhdf"));
  EXPECT_EQ(reader.attribute<std::string>("/VTKHDF", "Type"), "UnstructuredGrid");
  EXPECT_EQ(reader.attribute<Integers>("/VTKHDF", "Version"), (Integers{2, 0}));
  ASSERT_EQ(reader.attribute<std::int64_t>("/VTKHDF/Steps", "NSteps"), std::int64_t{kCount});
  const auto of_step = [&](const std::string& name, std::size_t step) {
    return reader.read<std::int64_t>("/VTKHDF/Steps/" + name).at(step);
  };
  for (std::size_t k = 0; k < kCount; ++k) {
    const simulation::FlowFrame frame = sample::flow_frame(k);
    EXPECT_EQ(reader.read<double>("/VTKHDF/Steps/Values")[k], frame.time);
    EXPECT_EQ(of_step("NumberOfParts", k), 1);
    const std::int64_t part_number = of_step("PartOffsets", k);
    const auto of_part = [&](const char* name) {
      return reader.read<std::int64_t>(std::string("/VTKHDF/") + name).at(static_cast<std::size_t>(part_number));
    };
    const std::int64_t points = of_part("NumberOfPoints"), cells = of_part("NumberOfCells");
    EXPECT_EQ(part<double>(reader, "/VTKHDF/Points", of_step("PointOffsets", k), points, 3),
              values(in_space(frame.vertices[0])));
    EXPECT_EQ(part<double>(reader, "/VTKHDF/PointData/pressure", of_step("PointDataOffsets/pressure", k), points),
              values(frame.vertices[2]));
    EXPECT_EQ(part<double>(reader, "/VTKHDF/PointData/mesh_velocity", of_step("PointDataOffsets/mesh_velocity", k),
                           points, 3),
              values(in_space(frame.vertices[4])));
    EXPECT_EQ(part<std::int64_t>(reader, "/VTKHDF/Connectivity", of_step("ConnectivityIdOffsets", k),
                                 of_part("NumberOfConnectivityIds")),
              std::get<Integers>(frame.triangles[0].values));
    // A part has one offset more than cells.
    const std::int64_t first = of_step("CellOffsets", k);
    const Integers ends = part<std::int64_t>(reader, "/VTKHDF/Offsets", first + part_number, cells + 1);
    for (std::int64_t i = 0; i <= cells; ++i) EXPECT_EQ(ends[static_cast<std::size_t>(i)], 3 * i);
    EXPECT_EQ(part<std::uint8_t>(reader, "/VTKHDF/Types", first, cells),
              std::vector<std::uint8_t>(static_cast<std::size_t>(cells), 5));
  }
  reader.close();
}

TEST_F(FlowFile, HasTheSameBytesInWindowsAndInTheSidecar) {
  const std::string text = read_text(file("flow.xdmf"));
  const std::regex reference(R"(Dimensions="([0-9 ]+)\">flow\.vtkhdf:/steps/([0-9]+)/(\w+)<)");
  std::size_t references = 0;
  hdf5::FileReader reader(file("flow.vtkhdf"));
  for (std::sregex_iterator found(text.begin(), text.end(), reference), end; found != end; ++found, ++references) {
    const std::string path = "/steps/" + (*found)[2].str() + "/" + (*found)[3].str();
    std::istringstream dimensions((*found)[1]);
    hdf5::Extents extents;
    dimensions >> extents.rows >> extents.columns;
    EXPECT_EQ(reader.extents(path), extents) << path;
  }
  EXPECT_EQ(references, 6 * kCount);
  for (std::size_t k = 0; k < kCount; ++k) {
    const std::size_t triangles = std::get<Integers>(sample::flow_frame(k).triangles[0].values).size() / 3;
    EXPECT_NE(text.find("TopologyType=\"Triangle\" NumberOfElements=\"" + std::to_string(triangles) + "\""), text.npos);
    EXPECT_EQ(reader.read<std::int64_t>(step_path("steps", k) + "/corner"),
              std::get<Integers>(sample::flow_frame(k).triangles[0].values));
  }
  reader.close();
  EXPECT_NE(text.find(R"(Name="velocity" AttributeType="Vector" Center="Node")"), text.npos);
  EXPECT_NE(text.find(R"(Name="pressure" AttributeType="Scalar" Center="Node")"), text.npos);
  EXPECT_EQ(text.find("Center=\"Cell\""), text.npos);
}

TEST_F(FlowFile, GivesEveryFrameBackBitForBit) {
  for (std::size_t k = 0; k < kCount; ++k) {
    EXPECT_EQ(sample::difference(read_flow_frame(scratch_.path(), stamp_, k, true), sample::flow_frame(k)), "") << k;
  }
}

TEST_F(FlowFile, HasTheFreeSurfaceWhereThereIsOne) {
  hdf5::FileReader reader(file("surface.h5"));
  EXPECT_EQ(reader.read<double>("/frames/time"), (std::vector<double>{0, 0.5, 1, 1.5}));
  EXPECT_FALSE(reader.has("/steps/00001"));
  EXPECT_EQ(reader.read<double>("/steps/00002/height"), values(sample::flow_frame(2).surface[2]));
  EXPECT_EQ(reader.attribute<std::string>("/steps/00002/curvature", "units"), "1/m");
  reader.close();
}

TEST_F(FlowFile, IsRefusedToAnotherRun) {
  EXPECT_THROW(read_flow_frame(scratch_.path(), {std::string(64, 'b'), "0001"}, 0, true), StoreError);
  EXPECT_THROW(read_flow_frame(scratch_.path(), {std::string(64, 'a'), "0002"}, 0, true), StoreError);
  // Also when only the surface is another's.
  const Path other = scratch_.fresh("other");
  write_flow_frames(other, {std::string(64, 'b'), "0001"}, {1, &sample::flow_frame});
  std::filesystem::copy_file(other / "surface.h5", file("surface.h5"),
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THROW(read_flow_frame(scratch_.path(), stamp_, 0, true), StoreError);
}

TEST(FlowFrames, WithoutAnySurfaceHaveNoFileForIt) {
  const Scratch scratch;
  const Stamp stamp{std::string(64, 'a'), "0001"};
  write_flow_frames(scratch.path(), stamp, {1, [](std::size_t) { return sample::flow_frame(1); }});
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "surface.h5"));
  EXPECT_EQ(sample::difference(read_flow_frame(scratch.path(), stamp, 0, false), sample::flow_frame(1)), "");
}

TEST(FlowFrames, OfOneRunMustBeAlike) {
  const Scratch scratch;
  const auto write = [&](const auto& change) {
    const auto load = [&](std::size_t k) {
      simulation::FlowFrame frame = sample::flow_frame(k);
      if (k == 2) change(frame);
      return frame;
    };
    write_flow_frames(scratch.fresh("run"), {std::string(64, 'a'), "0001"}, {3, load});
  };
  EXPECT_NO_THROW(write([](auto&) {}));
  EXPECT_THROW(write([](auto& frame) { frame.vertices.pop_back(); }), std::logic_error);
  EXPECT_THROW(write([](auto& frame) { frame.surface.pop_back(); }), std::logic_error);
  EXPECT_THROW(write([](auto& frame) { frame.vertices[2].values = std::vector<float>(); }), std::logic_error);
}

}  // namespace
}  // namespace seapile::store
