// The columns of a cone penetration test, as both formats of files name them.
#pragma once

#include <string_view>
#include <vector>

#include "runner/study/cpt.h"

namespace seapile::study {

/// A column that is read: its name in CSV, its quantity in GEF, its unit here, and where it goes.
struct CptColumn {
  std::string_view name;
  int quantity;
  std::string_view unit;
  std::vector<double>& (*values)(Cpt&);
};

inline constexpr CptColumn kCptColumns[] = {
    {"depth", 1, "m", [](Cpt& cpt) -> std::vector<double>& { return cpt.depth; }},
    {"qc", 2, "Pa", [](Cpt& cpt) -> std::vector<double>& { return cpt.cone_resistance; }},
    {"fs", 3, "Pa", [](Cpt& cpt) -> std::vector<double>& { return cpt.sleeve_friction; }},
    {"Rf", 4, "-", [](Cpt& cpt) -> std::vector<double>& { return cpt.friction_ratio; }},
    {"u1", 5, "Pa", [](Cpt& cpt) -> std::vector<double>& { return cpt.pore_pressure[0]; }},
    {"u2", 6, "Pa", [](Cpt& cpt) -> std::vector<double>& { return cpt.pore_pressure[1]; }},
    {"u3", 7, "Pa", [](Cpt& cpt) -> std::vector<double>& { return cpt.pore_pressure[2]; }},
};

}  // namespace seapile::study
