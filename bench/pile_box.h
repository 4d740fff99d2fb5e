// The scene of the fluid's benchmark: a box of water, 5 x 4 m, with a pile that comes down from its open top.
#pragma once

#include <filesystem>
#include <vector>

#include "solver/fluid/flow.h"

namespace seapile::bench {

/// What a boundary edge is part of; also the label in the file of write_mesh().
enum BoxSide : std::int32_t { kBottom = 1, kWall = 2, kTop = 3, kPileSide = 4, kPileTip = 5 };

struct PileBox {
  double width = 5, height = 4;     ///< of the box; its top is at y = 0, its middle at x = 0 [m]
  double radius = 0.125;            ///< half the pile's width [m]
  double depth = 0.5;               ///< of its lowest point at the beginning [m]
  double cone = 60;                 ///< full angle of its tip [degrees]; 0: flat
  double speed = 0.2;               ///< downwards [m/s]
  double near = 0.05, far = 0.185;  ///< lengths of edges at the pile and far away, when there are 1,950 vertices [m]
  bool bed = true;                  ///< grains in the lower half: porosity and drag; without, water alone

  /// Depth of the shoulders, where the tip begins [m].
  double shoulder() const;
};

/// The mesh at the beginning, with about `vertices` of them.
mesh::TriangleMesh mesh_of(const PileBox& box, int vertices);

/// Water at rest, with what holds at its boundary: no slip at the pile, which moves already, slip at walls and bottom,
/// no traction at the top.
fluid::Flow flow_of(const PileBox& box, mesh::TriangleMesh mesh);

/// Share of the pile's way that each vertex of the mesh goes, vertically: 1 at the pile below its shoulders and beside
/// them, less towards top, bottom and walls, where vertices stay.
std::vector<double> shares(const PileBox& box, const mesh::TriangleMesh& at_first);

/// Brings the mesh to where it is when the pile has moved down by `travel` [m].
void move(const mesh::TriangleMesh& at_first, const std::vector<double>& share, double travel,
          mesh::TriangleMesh& mesh);

/// Sets porosity and drag to what they are where the vertices are.
void fill_bed(const PileBox& box, fluid::Flow& flow);

/// What the codes are compared by.
struct BoxState {
  double outflow = 0;         ///< through the top, by what the pile displaces [-]
  double kinetic_energy = 0;  ///< of the water [J/m]
  double far_energy = 0;      ///< of the water more than 0.5 m from the axis or 1 m below the top [J/m]
  double tip_error = 0;       ///< largest |u - u_pile| on the pile, by its speed [-]
  double largest_speed = 0;   ///< of the water, by the pile's [-]
};
BoxState state_of(const PileBox& box, const fluid::Flow& flow);

/// In FreeFEM's format: counts; x, y and a label of each vertex; the triangles; the boundary edges with their labels.
void write_mesh(const mesh::TriangleMesh& mesh, const std::filesystem::path& path);

}  // namespace seapile::bench
