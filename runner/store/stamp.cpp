#include "runner/store/stamp.h"

namespace seapile::store {

void write_stamp(hdf5::FileWriter& writer, const std::string& content, const Stamp& stamp) {
  writer.attribute("/", "seapile_schema", kSchema);
  writer.attribute("/", "content", content);
  writer.attribute("/", "case", stamp.case_id);
  writer.attribute("/", "run", stamp.run);
  if (!stamp.fingerprint.empty()) writer.attribute("/", "fingerprint", stamp.fingerprint);
}

void check_stamp(const hdf5::FileReader& reader, const std::string& content, const Stamp& stamp) {
  const auto require = [&](const char* name, const std::string& wanted) {
    const auto found = reader.attribute<std::string>("/", name);
    if (found != wanted) reader.damaged(std::string(name) + " is \"" + found + "\" instead of \"" + wanted + "\"");
  };
  const auto schema = reader.attribute<std::int64_t>("/", "seapile_schema");
  if (schema > kSchema) {
    reader.damaged("it is of schema " + std::to_string(schema) + "; this program knows " + std::to_string(kSchema));
  }
  require("content", content);
  require("case", stamp.case_id);
  require("run", stamp.run);
  if (!stamp.fingerprint.empty()) require("fingerprint", stamp.fingerprint);
}

}  // namespace seapile::store
