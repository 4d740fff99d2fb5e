// One row of a run's time series.
#pragma once

#include "solver/base/fields.h"

namespace seapile::simulation {

/// A record covers the steps since the record before it. Forces are impulses over the record divided by its time,
/// per unit depth of the plane [N/m]; positive y is up, so a soil that resists the pile gives positive tip_force_y.
struct Record {
  double time = 0;    ///< t at the end of the record [s]
  double span = 0;    ///< its length [s]
  double depth = 0;   ///< d [m]
  double travel = 0;  ///< path of the pile since the start [m]
  double speed = 0;   ///< of the pile, mean over the record [m/s], positive down
  double tip_force_x = 0, tip_force_y = 0;        ///< contact force on the tip [N/m]
  double sleeve_force_x = 0, sleeve_force_y = 0;  ///< contact force on the sleeve [N/m]
  double tip_resistance = 0;                      ///< q_c = tip_force_y / (2R) [Pa]
  double tip_resistance_thesis = 0;               ///< tip_force_y / R [Pa], thesis (6.1)
  double left_wall_force = 0, right_wall_force = 0;  ///< pressing the walls outwards [N/m]
  double base_force = 0;                          ///< pressing the base downwards [N/m]
  double overlap_max = 0, overlap_p999 = 0, overlap_mean = 0;  ///< of touching contacts, share of the smaller radius [-]
  double kinetic_energy = 0;    ///< translation and rotation [J/m]
  double potential_energy = 0;  ///< of the grains above the base [J/m]
  double contacts = 0;          ///< touching contacts [-]
  double residual = 0;          ///< rms normal velocity still changed by the last sweep [m/s]
  double pile_work = 0;         ///< done by the pile on the grains since the start [J/m]
  double dissipation = 0;       ///< taken out by the contacts since the start, summed per contact [J/m]
};

/// The columns of the series, in their order: visit(name, unit, meaning, member).
void columns(auto&& visit, base::SameAs<Record> auto& r) {
  visit("time", "s", "time at the end of the record", r.time);
  visit("span", "s", "length of the record", r.span);
  visit("depth", "m", "depth d of the tip below the initial bed surface", r.depth);
  visit("travel", "m", "path of the pile since the start", r.travel);
  visit("speed", "m/s", "mean speed of the pile, positive down", r.speed);
  visit("tip_force_x", "N/m", "horizontal contact force on the tip", r.tip_force_x);
  visit("tip_force_y", "N/m", "vertical contact force on the tip, positive up", r.tip_force_y);
  visit("sleeve_force_x", "N/m", "horizontal contact force on the sleeve", r.sleeve_force_x);
  visit("sleeve_force_y", "N/m", "vertical contact force on the sleeve, positive up", r.sleeve_force_y);
  visit("tip_resistance", "Pa", "q_c: vertical contact force on the tip over 2R", r.tip_resistance);
  visit("tip_resistance_thesis", "Pa", "vertical contact force on the tip over R, thesis (6.1)", r.tip_resistance_thesis);
  visit("left_wall_force", "N/m", "force pressing the left wall outwards", r.left_wall_force);
  visit("right_wall_force", "N/m", "force pressing the right wall outwards", r.right_wall_force);
  visit("base_force", "N/m", "force pressing the base downwards", r.base_force);
  visit("overlap_max", "-", "largest overlap, share of the smaller radius", r.overlap_max);
  visit("overlap_p999", "-", "99.9th percentile of the overlaps", r.overlap_p999);
  visit("overlap_mean", "-", "mean overlap of the touching contacts", r.overlap_mean);
  visit("kinetic_energy", "J/m", "kinetic energy of the grains", r.kinetic_energy);
  visit("potential_energy", "J/m", "potential energy of the grains above the base", r.potential_energy);
  visit("contacts", "-", "touching contacts", r.contacts);
  visit("residual", "m/s", "rms normal velocity still changed by the last sweep", r.residual);
  visit("pile_work", "J/m", "work of the pile on the grains since the start", r.pile_work);
  visit("dissipation", "J/m", "energy taken out by the contacts since the start, summed per contact", r.dissipation);
}

}  // namespace seapile::simulation
