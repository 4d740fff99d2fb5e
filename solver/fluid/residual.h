// The residual of the whole mesh: the inner loop of a time step.
//
// The same arithmetic as element_residual() on one triangle after the other, on as many triangles at once as a vector
// holds; triangles are added to their vertices one by one in their order, so that every instruction set gives the same
// bits.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "solver/base/aligned.h"
#include "solver/base/instruction_set.h"
#include "solver/fluid/flow.h"

namespace seapile::fluid {

/// What a vertex brings to its triangles besides its unknowns.
struct alignas(64) VertexInput {
  double x, y;  ///< place [m]
  double porosity, porosity_rate;
  double mesh_x, mesh_y;        ///< w [m/s]
  double history_x, history_y;  ///< [m/s2]
  double source_x, source_y;    ///< s [N/m3]
  double drag;                  ///< beta [kg/m3/s]
  double carried_x, carried_y;  ///< u_g [m/s]
  double mobility;              ///< kappa [m3 s/kg]
  double response;              ///< chi [-]
  double unused;
};

/// A flow and a time scheme, packed for the kernels. Invariant: belongs to one mesh; pack() again when anything but the
/// unknowns has changed.
struct PackedFlow {
  base::AlignedVector<VertexInput> vertex;  ///< (vertices)
  std::vector<std::int32_t>
      corner;  ///< vertices of the triangles, by triangle; padded with the last one, (3 x padded triangles)
  std::int32_t triangles = 0;
  double rate = 0;          ///< [1/s]
  double unsteadiness = 0;  ///< [1/s]
};

void pack(PackedFlow& packed, const Flow& flow, const TimeScheme& scheme);

/// Residuals of all equations for `unknown`, (3 vertices); those of what is held are 0.
void residual_of(const Flow& flow, const PackedFlow& packed, std::span<const double> unknown,
                 std::span<double> residual, base::InstructionSet instructions);

/// The same, triangle by triangle from the flow itself: the slow twin.
void residual_of(const Flow& flow, const TimeScheme& scheme, std::span<const double> unknown,
                 std::span<double> residual);

/// What the equations lack, also where values are held, (3 vertices): of the triangles given and of all boundary edges,
/// so that it is whole at vertices of which no other triangle is one.
std::vector<double> lack_of(const Flow& flow, const TimeScheme& scheme, std::span<const std::int32_t> triangles);

/// Force of the fluid on a body whose vertices hold their velocities: what their momentum equations lack [N/m; per
/// radian when axisymmetric]. Exact for the scheme: it is the traction for which the flow would be what it is. `lack`:
/// of all triangles that touch the body; `of_body`: 1 for its vertices, (vertices).
std::array<double, 2> force_on(const Flow& flow, std::span<const double> lack, std::span<const std::uint8_t> of_body);

}  // namespace seapile::fluid
