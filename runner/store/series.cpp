#include "runner/store/series.h"

#include <limits>

namespace seapile::store {

namespace {

using simulation::Record;

constexpr const char* kAlwaysThere = "time";

/// What columns() says of each column.
struct Column {
  std::string name, unit, meaning;
};

std::vector<Column> all_columns() {
  std::vector<Column> list;
  const Record any;
  columns(
      [&](const char* name, const char* unit, const char* meaning, double) {
        list.push_back({name, unit, meaning});
      },
      any);
  return list;
}

}  // namespace

void write_series(hdf5::FileWriter& writer, const std::string& group, const std::vector<Record>& records) {
  const std::vector<Column> list = all_columns();
  std::vector<std::vector<double>> values(list.size(), std::vector<double>(records.size()));
  for (std::size_t i = 0; i < records.size(); ++i) {
    auto into = values.begin();
    columns([&](const char*, const char*, const char*, double value) { (*into++)[i] = value; }, records[i]);
  }
  for (std::size_t c = 0; c < list.size(); ++c) {
    const std::string path = group + "/" + list[c].name;
    writer.dataset(path, {records.size(), 0}, values[c]);
    writer.attribute(path, "units", list[c].unit);
    writer.attribute(path, "meaning", list[c].meaning);
  }
}

std::vector<Record> read_series(const hdf5::FileReader& reader, const std::string& group) {
  std::vector<Record> records(reader.extents(group + "/" + kAlwaysThere).rows);
  std::vector<std::vector<double>> values;
  for (const Column& column : all_columns()) {
    const std::string path = group + "/" + column.name;
    values.push_back(reader.has(path) ? reader.read<double>(path)
                                      : std::vector<double>(records.size(), std::numeric_limits<double>::quiet_NaN()));
    if (values.back().size() != records.size()) reader.damaged(path + " is not as long as the other columns");
  }
  for (std::size_t i = 0; i < records.size(); ++i) {
    auto from = values.begin();
    columns([&](const char*, const char*, const char*, double& value) { value = (*from++)[i]; }, records[i]);
  }
  return records;
}

}  // namespace seapile::store
