#include "runner/store/series.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seapile::store {

namespace {

using simulation::FlowRecord;
using simulation::Record;

/// What columns() says of each column.
struct Column {
  std::string path, unit, meaning;
};

template <class R>
std::vector<Column> all_columns() {
  std::vector<Column> list;
  const R any;
  const std::string group = kSeriesGroup<R>;
  columns(
      [&](const char* name, const char* unit, const char* meaning, double) {
        list.push_back({group + "/" + name, unit, meaning});
      },
      any);
  return list;
}

/// Makes every absent value the same NaN, so that a file does not depend on where it came from; true when all are.
template <class R>
bool is_absent(std::vector<double>& values) {
  if constexpr (requires { R::kAbsent; }) {
    for (double& value : values) value = std::isnan(value) ? R::kAbsent : value;
    return !values.empty() && std::ranges::all_of(values, [](double value) { return std::isnan(value); });
  }
  return false;
}

}  // namespace

template <class R>
void write_series(hdf5::FileWriter& writer, const std::vector<R>& records) {
  const std::vector<Column> list = all_columns<R>();
  std::vector<std::vector<double>> values(list.size(), std::vector<double>(records.size()));
  for (std::size_t i = 0; i < records.size(); ++i) {
    auto into = values.begin();
    columns([&](const char*, const char*, const char*, double value) { (*into++)[i] = value; }, records[i]);
  }
  for (std::size_t c = 0; c < list.size(); ++c) {
    if (is_absent<R>(values[c])) continue;
    writer.dataset(list[c].path, {records.size(), 0}, values[c]);
    writer.attribute(list[c].path, "units", list[c].unit);
    writer.attribute(list[c].path, "meaning", list[c].meaning);
  }
}

template <class R>
std::vector<R> read_series(const hdf5::FileReader& reader) {
  const std::vector<Column> list = all_columns<R>();
  std::vector<R> records(reader.extents(list.front().path).rows);  // The time, which is always there.
  std::vector<std::vector<double>> values;
  for (const auto& [path, unit, meaning] : list) {
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

template void write_series(hdf5::FileWriter&, const std::vector<Record>&);
template void write_series(hdf5::FileWriter&, const std::vector<FlowRecord>&);
template std::vector<Record> read_series(const hdf5::FileReader&);
template std::vector<FlowRecord> read_series(const hdf5::FileReader&);

}  // namespace seapile::store
