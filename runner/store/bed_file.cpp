#include "runner/store/bed_file.h"

#include <stdexcept>

#include "runner/store/arrays.h"
#include "runner/store/seal.h"
#include "runner/store/series.h"

namespace seapile::store {

namespace {

using simulation::Array;
using simulation::Bed;
using simulation::Metric;
using simulation::ProfileEntry;

const std::string kGrains = "grains";
const std::string kMetrics = "/metrics";
const std::string kCost = "/cost";
const std::string kSeconds = "/seconds", kCalls = "/calls";

template <class T>
void write_number(hdf5::FileWriter& writer, const std::string& path, T value, const std::string& unit,
                  const std::string& meaning) {
  writer.dataset(path, {1, 0}, std::vector<T>{value});
  writer.attribute(path, "units", unit);
  writer.attribute(path, "meaning", meaning);
}

template <class T>
T read_number(const hdf5::FileReader& reader, const std::string& path) {
  const std::vector<T> values = reader.read<T>(path);
  if (values.size() != 1) reader.damaged(path + " is not one number");
  return values.front();
}

/// The element of a list that a dataset's attribute `order` points at.
template <class T>
T& place(const hdf5::FileReader& reader, const std::string& path, std::vector<T>& list) {
  const auto order = static_cast<std::uint64_t>(reader.attribute<std::int64_t>(path, "order"));
  if (order >= list.size()) reader.damaged(path + " has no place of its own");
  return list[order];
}

void write_cost(hdf5::FileWriter& writer, const std::vector<ProfileEntry>& profile) {
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const std::string group = kCost + "/" + profile[i].part;
    write_number(writer, group + kSeconds, profile[i].seconds, "s", "time spent in this part");
    write_number(writer, group + kCalls, profile[i].calls, "-", "how often it was called");
    writer.attribute(group + kSeconds, "order", static_cast<std::int64_t>(i));
  }
}

std::vector<ProfileEntry> read_cost(const hdf5::FileReader& reader) {
  std::vector<std::string> groups;
  for (const std::string& path : reader.datasets(kCost)) {
    if (path.ends_with(kSeconds)) groups.push_back(path.substr(0, path.size() - kSeconds.size()));
  }
  std::vector<ProfileEntry> profile(groups.size());
  for (const std::string& group : groups) {
    place(reader, group + kSeconds, profile) = {group.substr(kCost.size() + 1),
                                                read_number<double>(reader, group + kSeconds),
                                                read_number<std::int64_t>(reader, group + kCalls)};
  }
  return profile;
}

}  // namespace

void write_bed(const std::filesystem::path& file, const Stamp& stamp, const Bed& bed) {
  for (const Array& array : bed.grains) {
    if (!array.info.name.starts_with(kGrains + "/")) throw std::logic_error("a bed has an array " + array.info.name);
  }
  seal(file, hdf5::Storage::packed, [&](hdf5::FileWriter& writer) {
    write_stamp(writer, "bed", stamp);
    write_arrays(writer, "", bed.grains);
    writer.dataset("/porosity/profile", {bed.porosity_profile.size(), 0}, bed.porosity_profile);
    writer.attribute("/porosity/profile", "units", "-");
    writer.attribute("/porosity/profile", "meaning", "porosity of horizontal slices, from the base up");
    write_number(writer, "/porosity/spacing", bed.profile_spacing, "m", "height of a slice");
    for (std::size_t i = 0; i < bed.metrics.size(); ++i) {
      const Metric& metric = bed.metrics[i];
      write_number(writer, kMetrics + "/" + metric.name, metric.value, metric.unit, metric.meaning);
      writer.attribute(kMetrics + "/" + metric.name, "order", static_cast<std::int64_t>(i));
    }
    write_cost(writer, bed.profile);
    write_series(writer, bed.records);
  });
}

Bed read_bed(const std::filesystem::path& file, const Stamp& stamp) {
  hdf5::FileReader reader(file);
  check_stamp(reader, "bed", stamp);
  Bed bed;
  bed.grains = read_arrays(reader, "/" + kGrains);
  for (Array& array : bed.grains) array.info.name = kGrains + "/" + array.info.name;
  bed.porosity_profile = reader.read<double>("/porosity/profile");
  bed.profile_spacing = read_number<double>(reader, "/porosity/spacing");
  const std::vector<std::string> metrics = reader.datasets(kMetrics);
  bed.metrics.resize(metrics.size());
  for (const std::string& path : metrics) {
    place(reader, path, bed.metrics) = {path.substr(kMetrics.size() + 1), read_number<double>(reader, path),
                                        reader.attribute<std::string>(path, "units"),
                                        reader.attribute<std::string>(path, "meaning")};
  }
  bed.profile = read_cost(reader);
  bed.records = read_series<simulation::Record>(reader);
  reader.close();
  return bed;
}

}  // namespace seapile::store
