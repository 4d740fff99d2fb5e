#include "runner/execute/message.h"

#include <nlohmann/json.hpp>

namespace seapile::execute {

using nlohmann::json;

std::string encode(const Message& message) {
  json object;
  if (const auto* started = std::get_if<Started>(&message)) {
    object = {{"run", started->run}, {"resumed", started->resumed}};
  } else if (const auto* advanced = std::get_if<Advanced>(&message)) {
    object = {{"fraction", advanced->fraction}};
  } else {
    object = {{"trouble", std::get<Trouble>(message).sentence}};
  }
  // A sentence may quote bytes that are no UTF-8, such as a path.
  return object.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<Message> decode(const std::string& line) {
  const json object = json::parse(line, nullptr, false);
  try {
    if (object.contains("run")) return Started{object.at("run"), object.at("resumed")};
    if (object.contains("fraction")) return Advanced{object.at("fraction")};
    if (object.contains("trouble")) return Trouble{object.at("trouble")};
  } catch (const json::exception&) {
    // Falls through: a line that only looks like a message is none.
  }
  return std::nullopt;
}

}  // namespace seapile::execute
