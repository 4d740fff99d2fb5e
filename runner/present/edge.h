// The search for the value at which a scene stops holding.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runner/present/table.h"

namespace seapile::present {

/// A value that was tried.
struct EdgeProbe {
  double value = 0;
  bool finished = false;  ///< there is a run, completed or diverged
  std::string tripped;    ///< what did not hold; "": all did
};

/// One search: a combination of the study's other axes.
struct EdgeSearch {
  Labels labels;
  std::string path, unit;
  double good = 0, bad = 0;  ///< the ends, positive; either may be the larger
  double within = 0.05;      ///< ratio of the two at which the search ends, less 1
  bool whole = false;        ///< values are whole numbers
  std::vector<EdgeProbe> probes;
};

enum class EdgeEnd {
  searching,     ///< there is a value to be tried
  found,         ///< last good and first bad are as close as asked for
  never_holds,   ///< the good end does not hold
  always_holds,  ///< the bad end holds
};

struct EdgeState {
  EdgeEnd end = EdgeEnd::searching;
  std::vector<double> next;             ///< values to try
  double last_good = 0, first_bad = 0;  ///< so far; both ends have been tried
  std::string tripped;                  ///< at first_bad (never_holds: at the good end)
};

/// Both ends first, then the geometric mean of what holds and what does not, again and again: a function of the probes
/// alone. Whole numbers are rounded, and the search ends between neighbours.
EdgeState judge(const EdgeSearch& search);

/// Columns: labels, "path", "last_good", "first_bad" [unit], "end", "tripped", "probes".
store::Table edge_table(const std::vector<EdgeSearch>& searches);

/// "found", "searching", "never holds", "always holds".
std::string words(EdgeEnd end);

}  // namespace seapile::present
