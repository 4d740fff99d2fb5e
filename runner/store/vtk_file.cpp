#include "runner/store/vtk_file.h"

#include <cstdio>

#include "runner/store/arrays.h"

namespace seapile::store {

namespace {

using simulation::Array;

/// Where the array lies when the frames are put one after the other. The positions of points are the points.
std::string flattened(const Array& array, const std::string& data_group) {
  return leaf(array) == "position" ? "/VTKHDF/Points" : "/VTKHDF/" + data_group + "/" + leaf(array);
}

}  // namespace

std::string step_path(const char* name, std::size_t index) {
  char path[64];
  std::snprintf(path, sizeof path, "/%s/%05zu", name, index);
  return path;
}

void write_head(hdf5::FileWriter& writer, const std::string& content, const std::string& type, const Stamp& stamp) {
  write_stamp(writer, content, stamp);
  writer.group("/VTKHDF");
  writer.attribute("/VTKHDF", "Version", Integers{2, 0});
  writer.attribute("/VTKHDF", "Type", type);
}

void write_per_frame(hdf5::FileWriter& writer, const std::string& name, const std::string& unit,
                     const std::string& meaning, const std::vector<double>& values) {
  writer.dataset("/frames/" + name, {values.size(), 0}, values);
  writer.attribute("/frames/" + name, "units", unit);
  writer.attribute("/frames/" + name, "meaning", meaning);
}

std::vector<XdmfStep> write_values(hdf5::FileWriter& writer, const std::string& data_group, const ListLayout& layout,
                                   const std::vector<double>& time, const ListSource& load) {
  for (std::size_t a = 0; a < layout.arrays.size(); ++a) {
    const std::string path = flattened(layout.arrays[a], data_group);
    writer.create(path, number_of(layout.arrays[a]), extents_in_file(layout.arrays[a], layout.total_rows));
    describe_dataset(writer, path, layout.arrays[a].info, a);
  }
  std::vector<XdmfStep> steps(layout.rows.size());
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const std::vector<Array> list = load(k);
    const std::vector<Array>& arrays = list.empty() ? layout.arrays : list;
    steps[k].time = time[k];
    for (std::size_t a = 0; a < arrays.size(); ++a) {
      const Array& array = arrays[a];
      const std::string source = flattened(array, data_group), path = step_path("steps", k) + "/" + leaf(array);
      const hdf5::Extents extents = extents_in_file(array, layout.rows[k]);
      const std::uint64_t hash =
          std::visit([&]<class T>(const std::vector<T>& v) { return writer.append(source, std::span<const T>(v)); },
                     is_vector_in_space(array) ? in_space(array).values : array.values);
      writer.window(path, source, layout.first_row[k], extents, hash);
      describe_dataset(writer, path, array.info, a);
      const XdmfArray entry{path, leaf(array), number_of(array), extents};
      if (leaf(array) == "position") {
        steps[k].points = entry;
      } else {
        steps[k].arrays.push_back(entry);
      }
    }
  }
  return steps;
}

void write_steps(hdf5::FileWriter& writer, const std::string& data_group, const ListLayout& layout,
                 const StepOffsets& offsets) {
  const std::size_t count = offsets.time.size();
  const std::size_t topologies = count == 0 ? 1 : offsets.cells.size() / count;
  const std::string group = "/VTKHDF/Steps";
  writer.group(group);
  writer.attribute(group, "NSteps", whole(count));
  writer.dataset(group + "/Values", {count, 0}, offsets.time);
  writer.dataset(group + "/NumberOfParts", {count, 0}, Integers(count, 1));
  writer.dataset(group + "/PartOffsets", {count, 0}, offsets.parts);
  writer.dataset(group + "/PointOffsets", {count, 0}, offsets.points);
  writer.dataset(group + "/CellOffsets", {count, topologies}, offsets.cells);
  writer.dataset(group + "/ConnectivityIdOffsets", {count, topologies}, offsets.connectivities);
  for (const Array& array : layout.arrays) {
    if (leaf(array) == "position") continue;
    writer.dataset(group + "/" + data_group + "Offsets/" + leaf(array), {count, 0}, offsets.rows);
  }
}

}  // namespace seapile::store
