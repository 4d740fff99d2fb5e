#include "runner/commands/window.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "runner/commands/command.h"

namespace seapile::commands {
namespace {

constexpr double kMostUneven = 30;  ///< of a window's edges; a whole jet is 20 times as long as high

/// A number, and nothing behind it.
double number_in(const std::string& text) {
  std::size_t read = 0;
  try {
    const double number = std::stod(text, &read);
    return read == text.size() ? number : std::nan("");
  } catch (const std::logic_error&) {
    return std::nan("");
  }
}

}  // namespace

std::optional<present::View> view_of(const std::string& window) {
  if (window.empty()) return std::nullopt;
  std::vector<double> edges;
  std::istringstream in(window);
  for (std::string text; std::getline(in, text, ',');) edges.push_back(number_in(text));
  const bool is_complete =
      edges.size() == 4 && std::ranges::all_of(edges, [](double edge) { return std::isfinite(edge); });
  if (!is_complete || edges[0] >= edges[1] || edges[2] >= edges[3]) {
    throw UsageError("--window: x0,x1,y0,y1 in metres (of a jet: in H), with x0 < x1 and y0 < y1");
  }
  const present::View view{edges[0], edges[1], edges[2], edges[3]};
  const double longer = std::max(view.width(), view.height()), shorter = std::min(view.width(), view.height());
  if (longer > kMostUneven * shorter) {
    throw UsageError(fmt::format("--window: one edge is more than {:g} times as long as the other", kMostUneven));
  }
  return view;
}

}  // namespace seapile::commands
