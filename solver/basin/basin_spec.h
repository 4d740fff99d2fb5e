// A basin of water in a box, with a free surface or a fixed top, alone or with a pile that is driven into it.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <variant>

#include "solver/base/fields.h"
#include "solver/fluid/element.h"
#include "solver/fluid/free_surface.h"
#include "solver/pile/pile_spec.h"

namespace seapile::basin {

using base::between;
using base::Field;
using base::part;
using base::positive;
using base::SameAs;

/// What water does along a wall at rest.
enum class WallKind {
  slip,     ///< it slides freely
  no_slip,  ///< it sticks; where a wall that it sticks to meets the surface, it slides all the same
};

/// How the surface moves.
enum class SurfaceScheme {
  conservative,  ///< by the water's flux through vertical sections: no volume is lost, whatever the solver's tolerance
  upwinded,      ///< kinematic condition, implicit, upwinded weak form
  galerkin,      ///< kinematic condition, explicit Euler, plain Galerkin (the thesis' centred scheme)
  differences,   ///< kinematic condition, explicit Euler, differences from the left (thesis (3.18))
};

/// Which transfer a new mesh's velocities are made by.
enum class TransferMethod {
  projection,     ///< L2 projection on the common refinement of both meshes: keeps momentum
  interpolation,  ///< values of the old mesh at the new vertices
};

}  // namespace seapile::basin

namespace seapile::base {

template <>
struct EnumNames<basin::WallKind> {
  static constexpr const char* values[] = {"slip", "no_slip"};
};
template <>
struct EnumNames<basin::SurfaceScheme> {
  static constexpr const char* values[] = {"conservative", "upwinded", "galerkin", "differences"};
};
template <>
struct EnumNames<basin::TransferMethod> {
  static constexpr const char* values[] = {"projection", "interpolation"};
};

}  // namespace seapile::base

namespace seapile::basin {

/// Water at rest level.
struct FlatSurface {
  static constexpr const char* kName = "flat";
  friend bool operator==(const FlatSurface&, const FlatSurface&) = default;
};
void fields(auto&, SameAs<FlatSurface> auto&) {}

/// h = depth + amplitude sin(s)/s, s = x/width, x from the middle of the basin; thesis ch. 4.2, where it is a hump.
struct HumpSurface {
  static constexpr const char* kName = "hump";
  double amplitude = 0.0625;  ///< a [m]
  double width = 1.0 / 30;    ///< c [m]
  friend bool operator==(const HumpSurface&, const HumpSurface&) = default;
};
void fields(auto& visit, SameAs<HumpSurface> auto& hump) {
  visit(Field{"amplitude", "m", between(-1e4, 1e4), "height a of the hump a sin(s)/s, s = x/c"}, hump.amplitude);
  visit(Field{"width", "m", positive(1e4), "width c"}, hump.width);
}

/// h = depth + amplitude cos(mode pi (x + width/2)/width): a standing wave that the walls do not disturb.
struct CosineSurface {
  static constexpr const char* kName = "cosine";
  double amplitude = 5e-4;  ///< a [m]
  std::int64_t mode = 1;    ///< n: half waves in the basin
  friend bool operator==(const CosineSurface&, const CosineSurface&) = default;
};
void fields(auto& visit, SameAs<CosineSurface> auto& wave) {
  visit(Field{"amplitude", "m", between(-1e4, 1e4), "amplitude a"}, wave.amplitude);
  visit(Field{"mode", "-", between(1, 1000), "number n of half waves in the basin"}, wave.mode);
}

using InitialSurface = std::variant<FlatSurface, HumpSurface, CosineSurface>;

struct SurfaceSpec {
  double tension = 0;  ///< gamma [N/m]
  InitialSurface initial = FlatSurface{};
  SurfaceScheme scheme = SurfaceScheme::conservative;
  bool volume_correction = false;  ///< thesis (3.17), with the flux that the pile displaces as its target
  friend bool operator==(const SurfaceSpec&, const SurfaceSpec&) = default;
};
void fields(auto& visit, SameAs<SurfaceSpec> auto& surface) {
  visit(Field{"tension", "N/m", between(0, 100), "surface tension gamma"}, surface.tension);
  visit(part("initial", "shape at the start: flat, hump (thesis ch. 4.2) or cosine"), surface.initial);
  visit(part("scheme", "conservative; upwinded; or the thesis' galerkin or differences, explicit"), surface.scheme);
  visit(part("volume_correction", "whether the surface is lifted so that its flux is what the pile displaces (3.17)"),
        surface.volume_correction);
}

/// A rigid pile in the middle of the basin, which the water sticks to.
struct BasinPileSpec {
  double radius = 0.125;  ///< R [m], half-width
  pile::Tip tip = pile::ConicalTip{};
  pile::Driving driving = pile::SinusoidalDriving{};
  double start = 0.5;  ///< depth of the tip's lowest point below the rest level at the start [m]
  friend bool operator==(const BasinPileSpec&, const BasinPileSpec&) = default;
};
void fields(auto& visit, SameAs<BasinPileSpec> auto& pile) {
  visit(Field{"radius", "m", positive(100), "half-width R"}, pile.radius);
  visit(part("tip", "shape of the tip"), pile.tip);
  visit(part("driving", "how the pile moves"), pile.driving);
  visit(Field{"start", "m", positive(1e4), "depth of the tip below the rest level at the start"}, pile.start);
}

/// Rectangles halved, mirrored in the middle: for basins without a pile.
struct StructuredMesh {
  static constexpr const char* kName = "structured";
  std::int64_t columns = 192;  ///< across the width; even
  std::int64_t rows = 24;      ///< over the depth
  double bottom_row = 1;       ///< height of the lowest row over that of an even one; the others grow evenly [-]
  friend bool operator==(const StructuredMesh&, const StructuredMesh&) = default;
};
void fields(auto& visit, SameAs<StructuredMesh> auto& mesh) {
  visit(Field{"columns", "-", between(2, 10000), "rectangles across the width, an even number"}, mesh.columns);
  visit(Field{"rows", "-", between(1, 10000), "rectangles over the depth"}, mesh.rows);
  visit(Field{"bottom_row", "-", between(0.001, 1), "height of the lowest row over that of an even one"},
        mesh.bottom_row);
}

/// Triangles by Gmsh, mirrored in the middle; finer near the pile.
struct UnstructuredMesh {
  static constexpr const char* kName = "unstructured";
  double size = 0.112;       ///< of the edges, far from the pile [m]
  double pile_size = 0.112;  ///< at the pile's tip [m]
  double growth = 0.15;      ///< of the edges with the distance from the tip [-]
  friend bool operator==(const UnstructuredMesh&, const UnstructuredMesh&) = default;
};
void fields(auto& visit, SameAs<UnstructuredMesh> auto& mesh) {
  visit(Field{"size", "m", positive(1e3), "size of the elements far from the pile"}, mesh.size);
  visit(Field{"pile_size", "m", positive(1e3), "size of the elements at the pile's tip"}, mesh.pile_size);
  visit(Field{"growth", "-", between(0.01, 1), "growth of the elements with the distance from the tip"}, mesh.growth);
}

using MeshPattern = std::variant<StructuredMesh, UnstructuredMesh>;

/// Vertices keep their share of the height between what is below and what is above them; thesis (4.6).
struct VerticalMotion {
  static constexpr const char* kName = "vertical";
  friend bool operator==(const VerticalMotion&, const VerticalMotion&) = default;
};
void fields(auto&, SameAs<VerticalMotion> auto&) {}

/// Near the pile vertices follow it, far from it the surface; thesis Appendix A.
struct ZonesMotion {
  static constexpr const char* kName = "zones";
  double reach = 1.25;  ///< x_2 - x_1, from the pile's side to where its influence ends [m]
  friend bool operator==(const ZonesMotion&, const ZonesMotion&) = default;
};
void fields(auto& visit, SameAs<ZonesMotion> auto& motion) {
  visit(Field{"reach", "m", positive(1e4), "from the pile's side to where its influence on the mesh ends"},
        motion.reach);
}

/// Displacements solve Laplace's equation; thesis (4.2).
struct EllipticMotion {
  static constexpr const char* kName = "elliptic";
  double stiffening = 0;  ///< power of 1/area that an element resists with; 0: (4.2) itself [-]
  friend bool operator==(const EllipticMotion&, const EllipticMotion&) = default;
};
void fields(auto& visit, SameAs<EllipticMotion> auto& motion) {
  visit(Field{"stiffening", "-", between(0, 3), "power of 1/area that an element resists with; 0: thesis (4.2)"},
        motion.stiffening);
}

using MotionMethod = std::variant<VerticalMotion, ZonesMotion, EllipticMotion>;

/// When a new mesh is made: too many small angles (thesis ch. 4.3), or one bad shape.
struct RemeshSpec {
  double angle = std::numbers::pi / 6;  ///< an angle below this is small [rad]
  double share = 0.05;                  ///< of the elements that may have a small angle [-]
  double shape = 0.3;                   ///< lowest shape quality q [-]
  TransferMethod transfer = TransferMethod::projection;
  friend bool operator==(const RemeshSpec&, const RemeshSpec&) = default;
};
void fields(auto& visit, SameAs<RemeshSpec> auto& remesh) {
  visit(Field{"angle", "rad", between(0, std::numbers::pi / 3), "an angle of a triangle below this is small"},
        remesh.angle);
  visit(Field{"share", "-", between(0, 1), "share of triangles with a small angle from which a new mesh is made"},
        remesh.share);
  visit(Field{"shape", "-", between(0, 0.7), "shape quality q below which one triangle is enough for it"},
        remesh.shape);
  visit(part("transfer", "of the velocities to the new mesh: projection (keeps momentum) or interpolation"),
        remesh.transfer);
}

struct BasinMeshSpec {
  MeshPattern pattern = StructuredMesh{};
  MotionMethod motion = VerticalMotion{};
  std::optional<RemeshSpec> remesh = {};  ///< absent: the first mesh is kept
  friend bool operator==(const BasinMeshSpec&, const BasinMeshSpec&) = default;
};
void fields(auto& visit, SameAs<BasinMeshSpec> auto& mesh) {
  visit(part("pattern", "structured (without a pile) or unstructured"), mesh.pattern);
  visit(part("motion", "how the mesh follows: vertical (4.6), zones (Appendix A) or elliptic (4.2)"), mesh.motion);
  visit(part("remesh", "when a new mesh is made; null: never"), mesh.remesh);
}

struct BasinTimeSpec {
  double step = 1e-3;      ///< dt [s]
  double duration = 1;     ///< [s]
  std::int64_t order = 2;  ///< of the scheme in time, 1 or 2
  /// Whether surface, mesh and flow are found together in each step; otherwise the surface moves by the velocities
  /// before it, once. The explicit schemes of the surface have nothing to be found.
  bool iterated = true;
  double tolerance = 1e-9;  ///< of the flow's equations [-]
  /// The fastest rate that the stabilisation reckons with [1/s] (solver/fluid/element.h); absent: that of the scheme.
  std::optional<double> rate = {};
  friend bool operator==(const BasinTimeSpec&, const BasinTimeSpec&) = default;
};
void fields(auto& visit, SameAs<BasinTimeSpec> auto& time) {
  visit(Field{"step", "s", positive(100), "time step dt"}, time.step);
  visit(Field{"duration", "s", positive(1e6), "time at which the run ends"}, time.duration);
  visit(Field{"order", "-", between(1, 2), "order in time: implicit Euler or BDF2"}, time.order);
  visit(part("iterated", "whether surface, mesh and flow are found together in each step"), time.iterated);
  visit(Field{"tolerance", "-", between(1e-13, 1e-2), "largest residual of the flow's equations"}, time.tolerance);
  visit(Field{"rate", "1/s", between(0, 1e9), "fastest rate that the stabilisation reckons with; null: the scheme's"},
        time.rate);
}

/// x in [-width/2, width/2], y in [0, depth] at rest.
struct BasinSpec {
  double width = 1;         ///< L [m]
  double depth = 0.25;      ///< H [m], of the water at rest
  double gravity = 9.81;    ///< g [m/s2], downwards
  double density = 1000;    ///< rho [kg/m3]
  double viscosity = 1e-3;  ///< mu [Pa s]
  WallKind walls = WallKind::slip;
  WallKind bottom = WallKind::slip;
  std::optional<SurfaceSpec> surface = SurfaceSpec{};  ///< absent: an open top at a fixed height, with p = p_ext
  std::optional<BasinPileSpec> pile = {};              ///< absent: water alone
  BasinMeshSpec mesh;
  BasinTimeSpec time;
  fluid::Convection convection = fluid::Convection::included;  ///< not written in a study: decided (scene/analysis.h)
  friend bool operator==(const BasinSpec&, const BasinSpec&) = default;
};
void fields(auto& visit, SameAs<BasinSpec> auto& basin) {
  visit(Field{"width", "m", positive(1e4), "width L"}, basin.width);
  visit(Field{"depth", "m", positive(1e4), "depth H of the water at rest"}, basin.depth);
  visit(Field{"gravity", "m/s2", between(0, 1000), "gravity g, downwards"}, basin.gravity);
  visit(Field{"density", "kg/m3", positive(1e5), "density rho"}, basin.density);
  visit(Field{"viscosity", "Pa s", positive(1e6), "viscosity mu"}, basin.viscosity);
  visit(part("walls", "slip or no_slip along the sides"), basin.walls);
  visit(part("bottom", "slip or no_slip along the bottom"), basin.bottom);
  visit(part("surface", "the free surface; null: an open top at a fixed height"), basin.surface);
  visit(part("pile", "the driven pile; null: water alone"), basin.pile);
  visit(part("mesh", "the mesh, and how it follows"), basin.mesh);
  visit(part("time", "steps and scheme in time"), basin.time);
}

}  // namespace seapile::basin
