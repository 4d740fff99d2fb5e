#include "runner/store/manifest.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "runner/store/sealed_text.h"
#include "runner/store/stamp.h"

namespace seapile::store {

namespace {

using Json = nlohmann::ordered_json;
using simulation::Outcome;

constexpr const char* kOutcomes[] = {"completed", "diverged", "stopped"};
constexpr const char* kBy[] = {"scene", "asked"};

/// JSON knows no NaN and no infinity: they are written as text.
Json from_number(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  return value;
}

double to_number(const Json& json) {
  if (json.is_number()) return json.get<double>();
  const auto text = json.get<std::string>();
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  throw std::invalid_argument("\"" + text + "\" is no number");
}

Json document(const std::string& text) { return text.empty() ? Json(nullptr) : Json::parse(text); }

std::string text_of(const Json& json) { return json.is_null() ? "" : json.dump(); }

Json from_header(const RunHeader& header) {
  Json bed = nullptr;
  if (!header.bed_id.empty()) bed = Json{{"case", header.bed_id}, {"run", header.bed_run}};
  Json parts = Json::array(), numerics = Json::object();
  for (const simulation::Part& part : header.parts) {
    Json entry{{"name", part.name},
               {"built", part.built},
               {"reason", part.reason},
               {"by", kBy[static_cast<std::size_t>(part.by)]}};
    if (part.criterion)
      entry["criterion"] = Json{{"quantity", part.criterion->quantity},
                                {"number", from_number(part.criterion->number)},
                                {"threshold", from_number(part.criterion->threshold)},
                                {"bound", from_number(part.criterion->bound)},
                                {"answer", part.criterion->answer}};
    parts.push_back(std::move(entry));
  }
  for (const simulation::NumericsVersion& module : header.numerics) numerics[module.module] = module.version;
  return {{"kind", header.kind},
          {"case", header.case_id},
          {"canonical", header.canonical},
          {"bed", bed},
          {"scene", document(header.scene_json)},
          {"record", document(header.record_json)},
          {"parts", parts},
          {"numerics", numerics}};
}

RunHeader to_header(const Json& json) {
  RunHeader header;
  header.kind = json.at("kind");
  header.case_id = json.at("case");
  header.canonical = json.at("canonical");
  if (!json.at("bed").is_null()) {
    header.bed_id = json.at("bed").at("case");
    header.bed_run = json.at("bed").at("run");
  }
  header.scene_json = text_of(json.at("scene"));
  header.record_json = text_of(json.at("record"));
  for (const Json& part : json.at("parts")) {
    simulation::Part& read = header.parts.emplace_back();
    read.name = part.at("name");
    read.built = part.at("built");
    read.reason = part.at("reason");
    read.by = part.value("by", kBy[0]) == kBy[1] ? scene::By::asked : scene::By::scene;
    if (const auto found = part.find("criterion"); found != part.end())
      read.criterion =
          scene::Criterion{found->at("quantity"), to_number(found->at("number")), to_number(found->at("threshold")),
                           to_number(found->at("bound")), found->at("answer")};
  }
  for (const auto& [module, version] : json.at("numerics").items()) header.numerics.push_back({module, version});
  return header;
}

Json from_result(const simulation::RunResult& result) {
  Json metrics = Json::array(), profile = Json::array();
  for (const simulation::Metric& metric : result.metrics) {
    metrics.push_back(Json{{"name", metric.name},
                           {"value", from_number(metric.value)},
                           {"unit", metric.unit},
                           {"meaning", metric.meaning}});
  }
  for (const simulation::ProfileEntry& entry : result.profile) {
    profile.push_back(Json{{"part", entry.part}, {"seconds", from_number(entry.seconds)}, {"calls", entry.calls}});
  }
  return {{"outcome", name(result.outcome)},
          {"reason", result.reason},
          {"time", from_number(result.time)},
          {"depth", from_number(result.depth)},
          {"state_hash", hex(result.state_hash)},
          {"metrics", metrics},
          {"profile", profile}};
}

simulation::RunResult to_result(const Json& json) {
  simulation::RunResult result;
  const auto outcome = std::find(std::begin(kOutcomes), std::end(kOutcomes), json.at("outcome").get<std::string>());
  if (outcome == std::end(kOutcomes)) throw std::invalid_argument("the outcome is none");
  result.outcome = static_cast<Outcome>(outcome - std::begin(kOutcomes));
  result.reason = json.at("reason");
  result.time = to_number(json.at("time"));
  result.depth = to_number(json.at("depth"));
  result.state_hash = std::stoull(json.at("state_hash").get<std::string>(), nullptr, 16);
  for (const Json& metric : json.at("metrics")) {
    result.metrics.push_back(
        {metric.at("name"), to_number(metric.at("value")), metric.at("unit"), metric.at("meaning")});
  }
  for (const Json& entry : json.at("profile")) {
    result.profile.push_back({entry.at("part"), to_number(entry.at("seconds")), entry.at("calls")});
  }
  return result;
}

Json from_provenance(const Provenance& p) {
  return {{"version", p.version},
          {"commit", p.commit},
          {"dirty", p.dirty},
          {"compiler", p.compiler},
          {"flags", p.flags},
          {"build_type", p.build_type},
          {"libraries", p.libraries},
          {"host_cpu", p.host_cpu},
          {"cores", p.cores},
          {"threads", p.threads},
          {"simd", p.simd},
          {"cpu_seconds", from_number(p.cpu_seconds)},
          {"wall_seconds", from_number(p.wall_seconds)},
          {"peak_memory_mb", from_number(p.peak_memory_mb)},
          {"attempts", p.attempts}};
}

Provenance to_provenance(const Json& json) {
  Provenance p;
  p.version = json.at("version");
  p.commit = json.at("commit");
  p.dirty = json.at("dirty");
  p.compiler = json.at("compiler");
  p.flags = json.at("flags");
  p.build_type = json.at("build_type");
  p.libraries = json.at("libraries");
  p.host_cpu = json.at("host_cpu");
  p.cores = json.at("cores");
  p.threads = json.at("threads");
  p.simd = json.at("simd");
  p.cpu_seconds = to_number(json.at("cpu_seconds"));
  p.wall_seconds = to_number(json.at("wall_seconds"));
  p.peak_memory_mb = to_number(json.at("peak_memory_mb"));
  p.attempts = json.at("attempts");
  return p;
}

[[noreturn]] void damaged(const std::filesystem::path& where, const std::string& what) {
  throw StoreError(StoreError::Kind::damaged, where.string() + " is damaged: " + what);
}

}  // namespace

const char* name(Outcome outcome) { return kOutcomes[static_cast<int>(outcome)]; }

std::string hex(std::uint64_t bits) { return fmt::format("{:016x}", bits); }

std::string manifest_text(const Manifest& manifest) {
  Json json = {{"schema", manifest.schema}, {"run", manifest.run}};
  json.update(from_header(manifest.header));
  json["records"] = manifest.records;
  json["frames"] = manifest.frames;
  json["flow_records"] = manifest.flow_records;
  json["flow_frames"] = manifest.flow_frames;
  json["result"] = from_result(manifest.result);
  json["provenance"] = from_provenance(manifest.provenance);
  json["files"] = Json::array();
  for (const FileEntry& file : manifest.files) {
    json["files"].push_back(Json{{"path", file.path}, {"bytes", file.bytes}, {"sha256", file.sha256}});
  }
  return with_seal(json.dump(2, ' ', false, Json::error_handler_t::replace));
}

Manifest parse_manifest(const std::string& text, const std::filesystem::path& where) {
  Manifest manifest;
  manifest.seal = seal_of(text, where);
  try {
    const Json json = Json::parse(unsealed(text, where));
    manifest.schema = json.at("schema");
    if (manifest.schema > kSchema) {
      damaged(where, fmt::format("it is of schema {}; this program knows {}", manifest.schema, kSchema));
    }
    manifest.run = json.at("run");
    manifest.header = to_header(json);
    manifest.records = json.at("records");
    manifest.frames = json.at("frames");
    manifest.flow_records = json.value("flow_records", std::size_t{0});  // The first manifests say nothing of water.
    manifest.flow_frames = json.value("flow_frames", std::size_t{0});
    manifest.result = to_result(json.at("result"));
    manifest.provenance = to_provenance(json.at("provenance"));
    for (const Json& file : json.at("files")) {
      manifest.files.push_back({file.at("path"), file.at("bytes"), file.at("sha256")});
    }
  } catch (const nlohmann::json::exception& error) {
    damaged(where, error.what());
  } catch (const std::logic_error& error) {
    damaged(where, error.what());
  }
  return manifest;
}

}  // namespace seapile::store
