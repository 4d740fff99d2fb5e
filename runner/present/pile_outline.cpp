#include "runner/present/pile_outline.h"

#include <algorithm>

namespace seapile::present {

std::vector<base::Vec2> pile_outline(const pile::PileSpec& pile, double apex, double top) {
  const double length = std::max(top - apex, pile::tip_height(pile)) + pile.radius;
  std::vector<base::Vec2> points;
  for (const base::Segment& segment : pile::outline(pile, length)) {
    if (points.empty()) points.push_back(segment.from + base::Vec2{0, apex});
    points.push_back(segment.to + base::Vec2{0, apex});
  }
  return points;
}

}  // namespace seapile::present
