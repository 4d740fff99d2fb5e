#include "runner/store/arrays.h"

#include <algorithm>
#include <stdexcept>

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::ArrayInfo;
using simulation::Entity;

// As they stand in files: entries are only added at the end.
constexpr const char* kEntities[] = {"run", "grain", "contact", "cell", "vertex", "triangle", "surface"};

}  // namespace

hdf5::Number number_of(const Array& array) {
  return std::visit([]<class T>(const std::vector<T>&) { return hdf5::number_of<T>(); }, array.values);
}

std::size_t value_count(const Array& array) {
  return std::visit([](const auto& values) { return values.size(); }, array.values);
}

std::size_t row_count(const Array& array) {
  const std::size_t count = value_count(array);
  if (array.info.columns < 1 || count % array.info.columns != 0) {
    throw std::logic_error(array.info.name + " has no whole rows");
  }
  return count / array.info.columns;
}

void describe_dataset(hdf5::FileWriter& writer, const std::string& path, const ArrayInfo& info, std::size_t order) {
  writer.attribute(path, "units", info.unit);
  writer.attribute(path, "meaning", info.meaning);
  writer.attribute(path, "entity", kEntities[static_cast<int>(info.entity)]);
  writer.attribute(path, "columns", std::int64_t{info.columns});
  writer.attribute(path, "order", static_cast<std::int64_t>(order));
}

ArrayInfo read_info(const hdf5::FileReader& reader, const std::string& group, const std::string& path) {
  ArrayInfo info;
  info.name = path.substr(group.size() + 1);
  info.unit = reader.attribute<std::string>(path, "units");
  info.meaning = reader.attribute<std::string>(path, "meaning");
  const auto columns = reader.attribute<std::int64_t>(path, "columns");
  if (columns < 1 || columns > 1000) reader.damaged(path + " has " + std::to_string(columns) + " columns");
  info.columns = static_cast<int>(columns);
  const auto entity = std::ranges::find(kEntities, reader.attribute<std::string>(path, "entity"));
  if (entity == std::end(kEntities)) reader.damaged(path + " belongs to nothing known");
  info.entity = static_cast<Entity>(entity - std::begin(kEntities));
  return info;
}

simulation::ArrayValues read_values(const hdf5::FileReader& reader, const std::string& path) {
  switch (reader.number(path)) {
    case hdf5::Number::f64:
      return reader.read<double>(path);
    case hdf5::Number::f32:
      return reader.read<float>(path);
    case hdf5::Number::i32:
      return reader.read<std::int32_t>(path);
    case hdf5::Number::i64:
      return reader.read<std::int64_t>(path);
    case hdf5::Number::u64:
      return reader.read<std::uint64_t>(path);
    case hdf5::Number::u8:
      break;
  }
  reader.damaged(path + " is of a type that no array has");
}

void write_arrays(hdf5::FileWriter& writer, const std::string& group, const std::vector<Array>& arrays) {
  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const Array& array = arrays[i];
    const std::string path = group + "/" + array.info.name;
    const auto columns = static_cast<std::uint64_t>(array.info.columns);
    writer.create(path, number_of(array), {row_count(array), columns == 1 ? 0 : columns});
    std::visit([&]<class T>(const std::vector<T>& values) { writer.append(path, std::span<const T>(values)); },
               array.values);
    describe_dataset(writer, path, array.info, i);
  }
}

std::vector<Array> read_arrays(const hdf5::FileReader& reader, const std::string& group) {
  const std::vector<std::string> paths = reader.datasets(group);
  std::vector<Array> arrays(paths.size());
  for (const std::string& path : paths) {
    const auto order = static_cast<std::uint64_t>(reader.attribute<std::int64_t>(path, "order"));
    if (order >= arrays.size() || !arrays[order].info.name.empty()) reader.damaged(path + " has no place of its own");
    arrays[order].info = read_info(reader, group, path);
    arrays[order].values = read_values(reader, path);
  }
  return arrays;
}

}  // namespace seapile::store
