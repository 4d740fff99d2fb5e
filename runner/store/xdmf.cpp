#include "runner/store/xdmf.h"

#include <fmt/format.h>

namespace seapile::store {

namespace {

std::string data_item(const std::string& file, const XdmfArray& array) {
  const bool real = array.number == hdf5::Number::f64 || array.number == hdf5::Number::f32;
  const bool is_unsigned = array.number == hdf5::Number::u64 || array.number == hdf5::Number::u8;
  const bool wide = array.number != hdf5::Number::f32 && array.number != hdf5::Number::i32;
  const std::string extents = array.extents.columns == 0
                                  ? fmt::format("{}", array.extents.rows)
                                  : fmt::format("{} {}", array.extents.rows, array.extents.columns);
  return fmt::format(R"(<DataItem Format="HDF" NumberType="{}" Precision="{}" Dimensions="{}">{}:{}</DataItem>)",
                     real ? "Float" : (is_unsigned ? "UInt" : "Int"), wide ? 8 : 4, extents, file, array.path);
}

const char* attribute_type(const hdf5::Extents& extents) {
  if (extents.columns == 0) return "Scalar";
  return extents.columns == 3 ? "Vector" : "Matrix";
}

const char* topology_type(const hdf5::Extents& cells) {
  if (cells.columns == 0) return "Polyvertex\" NodesPerElement=\"1";
  return cells.columns == 3 ? "Triangle" : "Quadrilateral";
}

}  // namespace

std::string xdmf(const std::string& file, const std::vector<XdmfStep>& steps) {
  std::string text = R"(<?xml version="1.0" encoding="utf-8"?>
<Xdmf Version="2.0">
  <Domain>
    <Grid Name="steps" GridType="Collection" CollectionType="Temporal">
)";
  for (const XdmfStep& step : steps) {
    if (step.cells.extents.rows == 0) continue;
    text += fmt::format("      <Grid Name=\"step\" GridType=\"Uniform\">\n        <Time Value=\"{}\"/>\n", step.time);
    text += fmt::format("        <Topology TopologyType=\"{}\" NumberOfElements=\"{}\">{}</Topology>\n",
                        topology_type(step.cells.extents), step.cells.extents.rows, data_item(file, step.cells));
    text += fmt::format("        <Geometry GeometryType=\"XYZ\">{}</Geometry>\n", data_item(file, step.points));
    for (const XdmfArray& array : step.arrays) {
      text +=
          fmt::format("        <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", array.name,
                      attribute_type(array.extents), step.of_cells ? "Cell" : "Node", data_item(file, array));
    }
    text += "      </Grid>\n";
  }
  return text + "    </Grid>\n  </Domain>\n</Xdmf>\n";
}

}  // namespace seapile::store
