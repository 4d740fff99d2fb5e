// Frames of drives as figures: what is to be seen where, in metres, before anything is drawn. Several runs are panels
// of one figure and share every scale, so that they can be compared by eye.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/base/vec2.h"
#include "solver/scene/spec.h"
#include "solver/simulation/flow_frame.h"
#include "solver/simulation/frame.h"

namespace seapile::present {

enum class FigureKind {
  initial,   ///< grains, pile and fluid, and how large they are
  bed,       ///< grains in layers by their height before the drive
  forces,    ///< a line per contact, as wide as its normal force is large
  stress,    ///< an ellipse per cell, its semi-axes the principal stresses
  velocity,  ///< an arrow per grain
};

/// A part of the plane [m].
struct View {
  double left = 0, right = 0, bottom = 0, top = 0;
  double width() const { return right - left; }
  double height() const { return top - bottom; }
};

/// A frame of a drive, and what is known of its run.
struct FrameOfRun {
  std::string title;       ///< what tells the run from others
  scene::SceneSpec scene;  ///< with a pile
  double surface = 0;      ///< height of the initial bed surface above the base [m]
  simulation::Frame frame;
  std::optional<simulation::FlowFrame> fluid = {};  ///< of the same time, for `initial`
};

struct DrawnEdge {
  base::Vec2 from, to;
};

struct DrawnGrain {
  base::Vec2 centre;  ///< [m]
  double radius = 0;  ///< [m]
  long layer = 0;     ///< in which it lay before the drive, counted from the base
};

/// From centre to centre; for a wall or the pile from the centre to the point of contact.
struct DrawnForce {
  base::Vec2 from, to;  ///< [m]
  double force = 0;     ///< normal force, mean over the frame's window [N/m]
  double width = 0;     ///< of the line [m]
};

struct DrawnStress {
  base::Vec2 centre;                      ///< of the cell [m]
  double major = 0, minor = 0;            ///< principal stresses, compression positive [Pa]
  double direction = 0;                   ///< of the major one, angle from x [rad]
  double semi_major = 0, semi_minor = 0;  ///< of the ellipse [m]
};

struct DrawnVelocity {
  base::Vec2 tail, head;  ///< the tail is the grain's centre [m]
  double ratio = 0;       ///< speed over the pile's
};

struct FramePanel {
  std::string title;
  double depth = 0;              ///< d [m]
  View view;                     ///< what is seen
  View box;                      ///< its walls and base; open at the top
  double surface = 0;            ///< height of the initial bed surface [m]
  std::vector<base::Vec2> pile;  ///< outline, from the left sleeve's top over the tip to the right one's
  double pile_speed = 0;         ///< its largest one [m/s]
  // Only what lies in the view, at least in part; the lists that the kind of figure has no use for are empty.
  std::vector<DrawnGrain> grains;
  std::vector<DrawnForce> forces;
  std::vector<DrawnStress> stresses;
  std::vector<DrawnVelocity> velocities;
  std::vector<DrawnEdge> water;         ///< the free surface
  std::vector<std::string> sizes = {};  ///< initial: sentences on box, bed and pile, and on the fluid and its mesh
};

/// One for all panels of a figure.
struct FigureScale {
  double layer = 0;   ///< bed: height of a layer [m]
  double full = 0;    ///< forces, stress: the largest value in any panel [N/m], [Pa]; velocity: 1
  double length = 0;  ///< what the value `full` is long in the figure: width of a line, semi-axis, arrow [m]
};

struct FrameFigure {
  FigureKind kind = FigureKind::bed;
  FigureScale scale;
  std::vector<FramePanel> panels;
};

inline constexpr double kTipViewEdge = 1.2;  ///< [m]

/// Where a run is looked at when nothing is said. Bed and initial: the whole box, up to a little above the highest
/// grain or the fluid. All others: kTipViewEdge wide and high, the tip in the middle at a third of the height from the
/// top, ending at the box.
View default_view(FigureKind kind, const FrameOfRun& run);

/// Puts a figure together. Every panel shows `view`, or its default one (of bed and initial, what holds the boxes of
/// all runs). Throws std::invalid_argument, in a sentence, when there is nothing to be seen: a view beside the box,
/// velocities beside a pile that never moves; store::StoreError when a frame lacks an array.
FrameFigure frame_figure(FigureKind kind, const std::vector<FrameOfRun>& runs, const std::optional<View>& view);

}  // namespace seapile::present
