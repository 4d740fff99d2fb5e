// What a tip resistance is divided by so that tests of different size and soil can lie in one picture: the vertical
// effective stress that the undisturbed ground has at the tip's depth, and the width of the tip.
#pragma once

#include <filesystem>

namespace seapile::present {

/// The undisturbed ground, one layer, and the width of what is pushed into it.
struct Overburden {
  double unit_weight = 0;  ///< gamma [N/m3]
  double uplift = 0;       ///< gamma_w, what the water below its table takes off [N/m3]
  double water_depth = 0;  ///< z_w, of the water table below the surface of the ground [m]
  double width = 0;        ///< B, of the tip [m]
};

/// sigma'_v0(d) = gamma d - gamma_w max(0, d - z_w) [Pa], Terzaghi's principle: the weight of what lies above, less the
/// pressure of still water (any textbook of soil mechanics). Neglected: that walls with friction carry a share
/// (Janssen), that the top of the bed is looser than its middle, capillarity, and all that the pile changes.
double effective_stress(const Overburden& ground, double depth);

/// Of a drive: gamma = (1 - n) rho_p g and gamma_w = (1 - n) rho g of a saturated bed, 0 of a dry one: what the grains
/// weigh, and what they lose in the fluid, with the porosity n of the bed as it was measured (its metric
/// "solid_fraction", 1 - n), per cubic metre of a bed of discs that are a metre deep. z_w is 0 where the fluid covers
/// the bed; B = 2R. `bed_folder`: the run of its bed. Throws store::StoreError, also where one of them says too little.
Overburden overburden_of(const std::filesystem::path& run_folder, const std::filesystem::path& bed_folder);

/// d50 of a bed [m]: grains that are smaller have half of the mass. Throws store::StoreError.
double median_diameter(const std::filesystem::path& bed_folder);

}  // namespace seapile::present
