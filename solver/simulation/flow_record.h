// One row of the water's time series: of a basin, or of what stands between the grains of a saturated bed.
#pragma once

#include <limits>

#include "solver/base/fields.h"

namespace seapile::simulation {

/// The water at the end of a step. What the scene has not (a pile, a surface) is NaN.
struct FlowRecord {
  static constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();
  double time = 0;          ///< t [s]
  double volume = 0;        ///< of the water [m2]
  double volume_error = 0;  ///< (volume - volume at the start)/volume at the start [-]
  double rise = kAbsent;    ///< mean height of the surface above the rest level [m]
  double wave = kAbsent;    ///< amplitude of the surface's mode: (2/L) int (h - H) cos(n pi (x + L/2)/L) dx [m]
  double lowest = kAbsent, highest = kAbsent;                ///< heights of the surface above the rest level [m]
  double left = kAbsent, middle = kAbsent, right = kAbsent;  ///< the same at the walls and in the middle [m]
  double asymmetry = kAbsent;                                ///< largest |h(x) - h(-x)| of the surface's vertices [m]
  double kinetic_energy = 0;                                 ///< [J/m]
  double potential_energy = kAbsent;  ///< of the surface above the rest level, and of its tension [J/m]
  double pile_depth = kAbsent;        ///< of the tip below the rest level [m]
  double pile_speed = kAbsent;        ///< positive down [m/s]
  double pile_force_x = kAbsent,
         pile_force_y = kAbsent;  ///< of the water on the pile, without the buoyancy at rest level [N/m]
  double lowest_shape = 0;        ///< smallest shape quality q [-]
  double below_half = 0;          ///< share of the triangles with q < 0.5 [-]
  double smallest_angle = 0;      ///< [rad]
  double small_angles = 0;        ///< share of the triangles with an angle below 30 degrees [-]
  double vertices = 0;            ///< of the mesh
  double meshes = 1;              ///< made so far, the first one included
  double iterations = 0;          ///< corrections of the step
  double cfl = kAbsent;           ///< largest |v - w| dt/h, h the shortest edge of a triangle [-]; absent of a new mesh
  // Of a saturated bed, means over the fluid's steps since the record before; pressures are those above the hydrostatic one.
  double tip_force_x = kAbsent, tip_force_y = kAbsent;        ///< of the fluid on the tip, pores and grains alike [N/m]
  double sleeve_force_x = kAbsent, sleeve_force_y = kAbsent;  ///< of the fluid on the sleeve [N/m]
  double face_pressure = kAbsent;      ///< u1: mean over the tip's face [Pa]
  double shoulder_pressure = kAbsent;  ///< u2: behind the tip, mean of both sides [Pa]
  double sleeve_pressure = kAbsent;    ///< u3: on the sleeve, a pile's width above the shoulder [Pa]
  double grain_force_x = kAbsent, grain_force_y = kAbsent;  ///< of the fluid on all grains, without buoyancy [N/m]
  double grain_work = kAbsent;       ///< of these forces since the start [J/m]
  double lowest_porosity = kAbsent;  ///< of the vertices, before it is cut off [-]
  double clipped_volume = kAbsent;   ///< of the grains where the porosity is cut off [m2]
  double immersed = kAbsent;         ///< share of the grains' area that is in the fluid [-]
  double element_ratio = kAbsent;    ///< smallest edge of the mesh over the largest diameter of the grains [-]
  friend bool operator==(const FlowRecord&, const FlowRecord&) = default;
};

/// The columns of the series, in their order: visit(name, unit, meaning, member).
void columns(auto&& visit, base::SameAs<FlowRecord> auto& r) {
  visit("time", "s", "time at the end of the step", r.time);
  visit("volume", "m2", "volume of the water, per metre of the plane's depth", r.volume);
  visit("volume_error", "-", "volume over that at the start, less 1", r.volume_error);
  visit("rise", "m", "mean height of the surface above the rest level", r.rise);
  visit("wave", "m", "amplitude of the surface's mode n", r.wave);
  visit("lowest", "m", "lowest height of the surface above the rest level", r.lowest);
  visit("highest", "m", "highest height of the surface above the rest level", r.highest);
  visit("left", "m", "height of the surface above the rest level at the left wall", r.left);
  visit("middle", "m", "height of the surface above the rest level in the middle, or at the pile's right side",
        r.middle);
  visit("right", "m", "height of the surface above the rest level at the right wall", r.right);
  visit("asymmetry", "m", "largest difference of heights of the surface that should be mirror images", r.asymmetry);
  visit("kinetic_energy", "J/m", "kinetic energy of the water", r.kinetic_energy);
  visit("potential_energy", "J/m", "energy of the surface's height and tension above the rest level",
        r.potential_energy);
  visit("pile_depth", "m", "depth of the tip below the rest level", r.pile_depth);
  visit("pile_speed", "m/s", "speed of the pile, positive down", r.pile_speed);
  visit("pile_force_x", "N/m", "horizontal force of the water on the pile", r.pile_force_x);
  visit("pile_force_y", "N/m", "vertical force of the water on the pile, without the hydrostatic one at rest level",
        r.pile_force_y);
  visit("lowest_shape", "-", "smallest shape quality q of the triangles", r.lowest_shape);
  visit("below_half", "-", "share of the triangles with q < 0.5", r.below_half);
  visit("smallest_angle", "rad", "smallest angle of the triangles", r.smallest_angle);
  visit("small_angles", "-", "share of the triangles with an angle below 30 degrees", r.small_angles);
  visit("vertices", "-", "vertices of the mesh", r.vertices);
  visit("meshes", "-", "meshes made so far, the first one included", r.meshes);
  visit("iterations", "-", "corrections of the step", r.iterations);
  visit("cfl", "-",
        "largest speed of the water past its mesh, times dt over its triangle's shortest edge; of a mesh that has moved",
        r.cfl);
  visit("tip_force_x", "N/m", "horizontal force of the fluid on the tip, saturated bed", r.tip_force_x);
  visit("tip_force_y", "N/m", "vertical force of the fluid on the tip, without the hydrostatic one, positive up",
        r.tip_force_y);
  visit("sleeve_force_x", "N/m", "horizontal force of the fluid on the sleeve, saturated bed", r.sleeve_force_x);
  visit("sleeve_force_y", "N/m", "vertical force of the fluid on the sleeve, positive up", r.sleeve_force_y);
  visit("face_pressure", "Pa", "u1: excess pore pressure, mean over the tip's face", r.face_pressure);
  visit("shoulder_pressure", "Pa", "u2: excess pore pressure behind the tip, mean of both sides", r.shoulder_pressure);
  visit("sleeve_pressure", "Pa", "u3: excess pore pressure on the sleeve, a pile's width above the shoulder",
        r.sleeve_pressure);
  visit("grain_force_x", "N/m", "horizontal force of the fluid on all grains", r.grain_force_x);
  visit("grain_force_y", "N/m", "vertical force of the fluid on all grains, without buoyancy", r.grain_force_y);
  visit("grain_work", "J/m", "work of the fluid on the grains since the start, without buoyancy", r.grain_work);
  visit("lowest_porosity", "-", "smallest porosity of a vertex, before it is cut off", r.lowest_porosity);
  visit("clipped_volume", "m2", "area of the grains that the cut-off porosity leaves out", r.clipped_volume);
  visit("immersed", "-", "share of the grains' area that is in the fluid", r.immersed);
  visit("element_ratio", "-", "smallest edge of the mesh over the largest diameter of a grain", r.element_ratio);
}

}  // namespace seapile::simulation
