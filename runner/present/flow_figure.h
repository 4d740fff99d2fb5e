// Frames of the water as figures: what is to be seen where before anything is drawn. A jet's lengths are in H, the
// die's radius or half gap, its velocities in U, the mean in the die; x is 0 at the lip, y on the axis. A basin's and a
// saturated bed's are in m and m/s; x is 0 in the middle, y at the bottom. Several runs, or times of one, are panels of
// one figure and share every scale, so that they can be compared by eye.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "runner/present/frame_figure.h"
#include "solver/simulation/flow_frame.h"

namespace seapile::present {

enum class FlowFigureKind {
  mesh,      ///< the edges of the triangles
  velocity,  ///< triangles coloured by the speed, and arrows on a regular grid
  pressure,  ///< triangles coloured by the pressure without the hydrostatic one
  porosity,  ///< triangles coloured by the share of the plane that is outside grains
};

/// Where the pile of a saturated bed is in a frame.
struct PileInBed {
  double surface;  ///< height of the bed at rest above the base [m]
  double depth;    ///< of the tip below it [m]
};

/// A frame of a flow, and what is known of its run.
struct FlowOfRun {
  std::string title;       ///< what tells the run from others
  scene::SceneSpec scene;  ///< with a jet, a basin or a fluid
  simulation::FlowFrame frame;
  std::optional<PileInBed> pile = {};  ///< of a saturated bed
};

struct DrawnTriangle {
  std::array<base::Vec2, 3> corner;
  std::array<double, 3> value;  ///< |u|, or what else the colours stand for, at the corners; linear between them
};

struct FlowPanel {
  std::string title;
  View view;                                ///< what is seen
  View die;                                 ///< of a jet: its wall, solid above the fluid; as high as the view
  std::vector<base::Vec2> pile;             ///< as pile_outline() has it; empty: none
  std::size_t vertices = 0, triangles = 0;  ///< of the whole mesh
  // Only what may lie in the view, at least in part: by bounding boxes.
  std::vector<DrawnEdge> edges;       ///< mesh: between two triangles
  std::vector<DrawnEdge> boundary;    ///< of one triangle, but for the free surface
  std::vector<DrawnEdge> surface;     ///< the free surface
  std::vector<DrawnTriangle> faces;   ///< none of a mesh
  std::vector<DrawnVelocity> arrows;  ///< velocity: middles on the grid; as a whole in the view and in the fluid
};

struct FlowFigure {
  FlowFigureKind kind = FlowFigureKind::mesh;
  bool basins = false;  ///< all panels are of basins or saturated beds; otherwise of jets
  bool beds = false;    ///< all panels are of saturated beds
  double low = 0;       ///< the smallest value of the colours: 0 of speeds and porosities
  double full = 0;      ///< the largest value at a corner of a triangle of any panel; of porosities 1
  double spacing = 0;   ///< velocity: of the grid of arrows
  double length = 0;    ///< velocity: of an arrow of the speed `full`
  std::vector<FlowPanel> panels;
};

/// What tells the run from others, and a basin's time or the depth in a saturated bed.
std::string title_of(const FlowOfRun& run);

/// A jet around the lip: from 2 H before it to 4 H behind it, ending at the fluid; a little beyond the axis and the
/// surface. Otherwise the fluid as a whole, and a little more.
View default_view(const FlowOfRun& run);

/// Puts a figure together. Every panel shows `view`, or what holds the default ones of all runs. Throws
/// std::invalid_argument, in a sentence, when the view lies beside the fluid or jets and basins stand side by side;
/// store::StoreError when a frame lacks an array.
FlowFigure flow_figure(FlowFigureKind kind, const std::vector<FlowOfRun>& runs, const std::optional<View>& view);

}  // namespace seapile::present
