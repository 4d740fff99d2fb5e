// What a worker tells its runner while it works: one line of JSON each, on its standard output.
#pragma once

#include <optional>
#include <string>
#include <variant>

namespace seapile::execute {

/// The case is claimed and its run folder is open.
struct Started {
  std::string run;
  bool resumed = false;
};

/// How far it is.
struct Advanced {
  double fraction = 0;  ///< of simulated time or depth, 0..1
};

/// Why it ends without a completed case.
struct Trouble {
  std::string sentence;
};

using Message = std::variant<Started, Advanced, Trouble>;

/// One line without its end.
std::string encode(const Message& message);

/// Absent when the line is no message.
std::optional<Message> decode(const std::string& line);

}  // namespace seapile::execute
