#pragma once

#include <string>
#include <vector>

namespace seapile::base {

/// One thing that is wrong with what the user asked for.
struct Problem {
  std::string pointer;  ///< JSON pointer into the document, e.g. "/base/pile/radius"
  std::string what;     ///< what is wrong, in one clause
  std::string allowed;  ///< the allowed range or values; empty when there is none to name
  std::string nearest;  ///< the nearest known key or name; empty when there is none
};

using Problems = std::vector<Problem>;

}  // namespace seapile::base
