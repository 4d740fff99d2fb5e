// The XDMF sidecar of a .vtkhdf file: text that tells ParaView, also those too old for transient VTKHDF, where the
// arrays of each step lie. It refers to plain or virtual datasets only: two of ParaView's three XDMF readers drop
// arrays that are cut out of larger ones by the XDMF file itself. The cells of a step are always listed: two of them
// also see points without cells otherwise.
#pragma once

#include <string>
#include <vector>

#include "runner/store/hdf5_file.h"

namespace seapile::store {

struct XdmfArray {
  std::string path;  ///< in the HDF5 file
  std::string name;
  hdf5::Number number = hdf5::Number::f64;
  hdf5::Extents extents;
};

struct XdmfStep {
  double time = 0;
  XdmfArray points;
  XdmfArray cells;                ///< one point per row, the three of a triangle, or the four of a quadrilateral
  std::vector<XdmfArray> arrays;  ///< one row per point, or
  bool of_cells = false;          ///< one row per cell
};

/// `file` is the name of the HDF5 file beside the sidecar. Steps without a cell are left out.
std::string xdmf(const std::string& file, const std::vector<XdmfStep>& steps);

}  // namespace seapile::store
