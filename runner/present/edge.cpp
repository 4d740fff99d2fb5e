#include "runner/present/edge.h"

#include <algorithm>
#include <cmath>

namespace seapile::present {
namespace {

const EdgeProbe* probe_at(const EdgeSearch& search, double value) {
  const auto found = std::ranges::find(search.probes, value, &EdgeProbe::value);
  return found != search.probes.end() && found->finished ? &*found : nullptr;
}

/// Between the two; absent where there is nothing between them.
std::optional<double> between(const EdgeSearch& search, double good, double bad) {
  const double larger = std::max(good, bad), smaller = std::min(good, bad);
  if (search.whole) {
    if (larger - smaller <= 1) return {};
    return std::clamp(std::round(std::sqrt(good * bad)), smaller + 1, larger - 1);
  }
  if (larger / smaller <= 1 + search.within) return {};
  return std::sqrt(good * bad);
}

}  // namespace

EdgeState judge(const EdgeSearch& search) {
  EdgeState state;
  state.last_good = search.good;
  state.first_bad = search.bad;
  const EdgeProbe *good = probe_at(search, search.good), *bad = probe_at(search, search.bad);
  if (!good) state.next.push_back(search.good);
  if (!bad) state.next.push_back(search.bad);
  if (!state.next.empty()) return state;
  state.tripped = good->tripped.empty() ? bad->tripped : good->tripped;
  if (!good->tripped.empty()) {
    state.end = EdgeEnd::never_holds;
    return state;
  }
  if (bad->tripped.empty()) {
    state.end = EdgeEnd::always_holds;
    return state;
  }
  while (const auto value = between(search, state.last_good, state.first_bad)) {
    const EdgeProbe* probe = probe_at(search, *value);
    if (!probe) {
      state.next = {*value};
      return state;
    }
    (probe->tripped.empty() ? state.last_good : state.first_bad) = *value;
    if (!probe->tripped.empty()) state.tripped = probe->tripped;
  }
  state.end = EdgeEnd::found;
  return state;
}

std::string words(EdgeEnd end) {
  switch (end) {
    case EdgeEnd::found:
      return "found";
    case EdgeEnd::never_holds:
      return "never holds";
    case EdgeEnd::always_holds:
      return "always holds";
    case EdgeEnd::searching:
      break;
  }
  return "searching";
}

store::Table edge_table(const std::vector<EdgeSearch>& searches) {
  std::vector<Labels> labels;
  for (const EdgeSearch& search : searches) labels.push_back(search.labels);
  store::Table table = label_table(labels);
  const std::string unit = searches.empty() ? "" : searches.front().unit;
  const auto add = [&](const char* name, const std::string& of) {
    table.columns.emplace_back(name);
    table.units.push_back(of);
  };
  add("path", "");
  add("last_good", unit);
  add("first_bad", unit);
  add("end", "");
  add("tripped", "");
  add("probes", "-");
  for (std::size_t i = 0; i < searches.size(); ++i) {
    const EdgeState state = judge(searches[i]);
    auto& row = table.rows[i];
    const bool both = state.end == EdgeEnd::found || state.end == EdgeEnd::searching;
    row.emplace_back(searches[i].path);
    store::Cell none;
    row.push_back(both || state.end == EdgeEnd::always_holds
                      ? store::Cell(state.end == EdgeEnd::always_holds ? searches[i].bad : state.last_good)
                      : none);
    row.push_back(both || state.end == EdgeEnd::never_holds
                      ? store::Cell(state.end == EdgeEnd::never_holds ? searches[i].good : state.first_bad)
                      : none);
    row.emplace_back(words(state.end));
    row.push_back(state.tripped.empty() ? none : store::Cell(state.tripped));
    row.emplace_back(static_cast<double>(searches[i].probes.size()));
  }
  return table;
}

}  // namespace seapile::present
