#include "runner/present/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace seapile::present {
namespace {

// "viridis" of S. van der Walt and N. Smith (2015, matplotlib 1.5, file _cm_listed.py; CC0): every 17th of its 256
// colours, between which it is almost straight.
constexpr std::array<Colour, 16> kViridis = {{{0.267004, 0.004874, 0.329415},
                                              {0.282656, 0.100196, 0.422160},
                                              {0.277134, 0.185228, 0.489898},
                                              {0.253935, 0.265254, 0.529983},
                                              {0.221989, 0.339161, 0.548752},
                                              {0.190631, 0.407061, 0.556089},
                                              {0.163625, 0.471133, 0.558148},
                                              {0.139147, 0.533812, 0.555298},
                                              {0.120565, 0.596422, 0.543611},
                                              {0.134692, 0.658636, 0.517649},
                                              {0.208030, 0.718701, 0.472873},
                                              {0.327796, 0.773980, 0.406640},
                                              {0.477504, 0.821444, 0.318195},
                                              {0.647257, 0.858400, 0.209861},
                                              {0.824940, 0.884720, 0.106217},
                                              {0.993248, 0.906157, 0.143936}}};

}  // namespace

Colour colour_of(double share) {
  if (std::isnan(share)) return {0.5, 0.5, 0.5};
  // The table runs from dark to pale.
  const double place = (1 - std::clamp(share, 0.0, 1.0)) * (kViridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), kViridis.size() - 2);
  const double part = place - static_cast<double>(below);
  const Colour &a = kViridis[below], &b = kViridis[below + 1];
  return {a.red + part * (b.red - a.red), a.green + part * (b.green - a.green), a.blue + part * (b.blue - a.blue)};
}

}  // namespace seapile::present
