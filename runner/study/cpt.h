// Cone penetration tests as their files have them: GEF-CPT-Report, or CSV with units in its header.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "solver/base/problem.h"

namespace seapile::study {

/// A cone penetration test in SI units, a row per reading. A value that is missing is NaN; a column that the file does
/// not have is empty.
struct Cpt {
  std::vector<double> depth;            ///< below the ground's surface [m]; where the file has it, corrected for tilt
  std::vector<double> cone_resistance;  ///< q_c [Pa]
  std::vector<double> sleeve_friction;  ///< f_s [Pa]
  std::vector<double> friction_ratio;   ///< R_f = f_s/q_c [-]
  std::array<std::vector<double>, 3> pore_pressure;  ///< u1, u2, u3 [Pa]
  std::optional<double> cone_area;                   ///< projected area of the cone [m2], where the file says it
  bool is_simulated = false;                         ///< the file says that no ground was tested
};

/// What a file of ours says of itself where it is simulated: in GEF its project, in CSV its column "model".
inline constexpr std::string_view kSimulatedProject = "SEAPILE-SIMULATED", kSimulatedModel = "plane strain discs";

/// GEF 1.0 and 1.1 (CUR, Geotechnical Exchange Format for CPT-Data, 1999), ASCII: columns by their quantity (1 length,
/// 2 q_c, 3 f_s, 4 R_f, 5 to 7 u1 to u3, 11 corrected depth) in the units that the header names, voids, separators,
/// measurement 1 (the cone's area). Each problem's `what` begins with its line.
Cpt parse_gef(std::string_view text, base::Problems& problems);

/// CSV: "depth[m],qc[MPa]" and any of fs, Rf, u1, u2, u3, each with its unit; other columns are ignored, an empty field
/// is a missing value. Each problem's `what` begins with its line.
Cpt parse_cpt_csv(std::string_view text, base::Problems& problems);

/// Reads a file by the ending of its name, .gef or .csv. Throws BadInput.
Cpt read_cpt(const std::filesystem::path& file);

}  // namespace seapile::study
