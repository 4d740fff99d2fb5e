// Numbers that read well along an axis.
#pragma once

#include <string>
#include <vector>

namespace seapile::present {

/// The smallest of 1, 2 or 5 times a power of ten of which at most `most` fit into `span` > 0.
double nice_step(double span, int most);

/// The multiples of a step in [from, to], each with its text, which has the decimals that the step needs: "0.4".
struct Tick {
  double value = 0;
  std::string text;
};
std::vector<Tick> ticks(double from, double to, double step);

}  // namespace seapile::present
