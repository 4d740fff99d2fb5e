#include "runner/execute/request.h"

#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "runner/study/study.h"

namespace seapile::execute {
namespace {

using nlohmann::json;

bool only(const std::string& text, const char* characters) {
  return text.find_first_not_of(characters) == std::string::npos;
}

[[noreturn]] void refuse(const std::string& file, const std::string& pointer, const std::string& what) {
  throw study::BadInput(file, {{pointer, what, "", ""}});
}

}  // namespace

std::string to_json(const Request& request) {
  return json{{"root", request.root},
              {"kind", request.kind},
              {"case_id", request.case_id},
              {"canonical", request.canonical},
              {"scene", json::parse(study::to_json(request.scene))},
              {"record", json::parse(study::to_json(request.record))},
              {"bed_id", request.bed_id},
              {"bed_run", request.bed_run},
              {"newest", request.newest},
              {"threads", request.threads},
              {"checkpoint_every", request.checkpoint_every},
              {"parent", request.parent}}
      .dump();
}

Request request_from_json(const std::string& text, const std::string& file) {
  Request request;
  try {
    const json object = json::parse(text);
    object.at("root").get_to(request.root);
    object.at("kind").get_to(request.kind);
    object.at("case_id").get_to(request.case_id);
    object.at("canonical").get_to(request.canonical);
    request.scene = study::scene_from_json(object.at("scene").dump());
    request.record = study::record_from_json(object.at("record").dump());
    object.at("bed_id").get_to(request.bed_id);
    object.at("bed_run").get_to(request.bed_run);
    object.at("newest").get_to(request.newest);
    object.at("threads").get_to(request.threads);
    object.at("checkpoint_every").get_to(request.checkpoint_every);
    object.at("parent").get_to(request.parent);
  } catch (const json::exception& error) {
    refuse(file, "", error.what());
  }
  if (request.kind != "bed" && request.kind != "drive" && request.kind != "flow")
    refuse(file, "/kind", "must be \"bed\", \"drive\" or \"flow\"");
  if ((request.kind == "flow") != is_water(request.scene))
    refuse(file, "/scene", "a flow needs a jet or a basin, and only a flow has one");
  if (request.kind == "drive" && !request.scene.pile) refuse(file, "/scene/pile", "a drive needs a pile");
  if (request.kind != "drive" && request.scene.fluid) refuse(file, "/scene/fluid", "only a drive has a fluid");
  // Both become parts of a path.
  if (!only(request.bed_id, "0123456789abcdef")) refuse(file, "/bed_id", "is not a case id");
  if (!only(request.bed_run, "0123456789")) refuse(file, "/bed_run", "is not a run number");
  if (!only(request.newest, "0123456789")) refuse(file, "/newest", "is not a run number");
  if (request.threads < 1) refuse(file, "/threads", "must be at least 1");
  if (!(request.checkpoint_every >= 0)) refuse(file, "/checkpoint_every", "must not be negative");
  if (study::case_id(request.canonical) != request.case_id) {
    refuse(file, "/case_id", "is not the SHA-256 of the canonical text");
  }
  return request;
}

Request read_request(const std::string& file) {
  std::ifstream opened;
  if (file != "-") {
    opened.open(file);
    if (!opened) refuse(file, "", "cannot be opened");
  }
  std::istream& in = file == "-" ? std::cin : opened;
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return request_from_json(text, file);
}

}  // namespace seapile::execute
