// A simulated drive as the table of a cone penetration test, for software that reads those.
//
// A row is the mean over kCptInterval of new depth. All values are rounded to 1 Pa, so that the units of both formats,
// kPa and MPa, print the same digits.
#pragma once

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "runner/present/curve.h"

namespace seapile::present {

inline constexpr double kCptInterval = 0.02;  ///< [m]

/// A reading; what the run does not have is absent.
struct CptRow {
  double depth = 0;                                         ///< of the tip, the middle of the interval [m]
  double cone_resistance = 0;                               ///< q_c [Pa]
  std::optional<double> sleeve_friction;                    ///< f_s [Pa]
  std::array<std::optional<double>, 3> pore_pressure = {};  ///< u1, u2, u3 [Pa]
};

struct CptTable {
  std::string case_id, run;
  double width = 0;                ///< B of the tip [m]
  bool has_pore_pressure = false;  ///< a saturated bed
  std::vector<CptRow> rows;
};

/// The table of a drive, over the records that reach new depth; intervals that are not full are left out.
///
/// q_c: the grains' vertical force on the tip over its projection 2R, per metre of depth. No pressure of the fluid is
/// in it, so that there is no correction for an area ratio and no q_t. f_s: the grains' vertical force on the sleeve
/// over both sides of what is below the initial surface; absent until that is as long as the pile is wide. The sleeve
/// of a cone is shorter and near the tip. u1, u2, u3: excess pressures, as recorded, with those of the fluid at rest
/// below the bed's surface, rho g times the depth of the place: as a cone that was zeroed on the sea floor reads.
/// Throws store::StoreError.
CptTable cpt_table(const CurveSource& source);

/// "depth[m],qc[MPa],fs[kPa],Rf[%]", of a saturated bed "u1[kPa],u2[kPa],u3[kPa]", and "model"; absent: an empty field.
std::string cpt_csv(const CptTable& table);

/// GEF-CPT-Report, marked as simulated, with f_s and pore pressures in MPa as that format asks; absent: the columns'
/// void. `day`: on which the file is made.
std::string cpt_gef(const CptTable& table, std::chrono::year_month_day day);

}  // namespace seapile::present
