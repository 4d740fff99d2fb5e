#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "solver/base/fields.h"

namespace seapile::grains {

using base::between;
using base::Field;
using base::later;
using base::part;
using base::positive;
using base::SameAs;

/// Radii drawn uniformly between two bounds.
struct RadiusSpec {
  double min = 1.12e-2;  ///< [m]
  double max = 1.92e-2;  ///< [m]
  friend bool operator==(const RadiusSpec&, const RadiusSpec&) = default;
};
void fields(auto& visit, SameAs<RadiusSpec> auto& radius) {
  visit(Field{"min", "m", positive(10), "smallest radius"}, radius.min);
  visit(Field{"max", "m", positive(10), "largest radius"}, radius.max);
}

/// Coulomb coefficients; the pile has its own.
struct FrictionSpec {
  double grain = 0.5;  ///< mu_p-p [-]
  double wall = 0;     ///< mu_p-w [-]
  friend bool operator==(const FrictionSpec&, const FrictionSpec&) = default;
};
void fields(auto& visit, SameAs<FrictionSpec> auto& friction) {
  visit(Field{"grain", "-", between(0, 10), "between grains, mu_p-p"}, friction.grain);
  visit(Field{"wall", "-", between(0, 10), "between grain and wall, mu_p-w"}, friction.wall);
}

/// The grains: discs, per unit depth (thesis table 6.1).
struct GrainsSpec {
  std::int64_t count = 11596;
  RadiusSpec radius;
  double density = 1500;   ///< rho_p [kg/m3]
  FrictionSpec friction;
  double restitution = 0;  ///< e [-], of every contact
  friend bool operator==(const GrainsSpec&, const GrainsSpec&) = default;
};
void fields(auto& visit, SameAs<GrainsSpec> auto& grains) {
  visit(Field{"count", "-", between(1, 10'000'000), "number of grains"}, grains.count);
  visit(part("radius", "radii, drawn uniformly between two bounds"), grains.radius);
  visit(Field{"density", "kg/m3", positive(1e5), "density rho_p"}, grains.density);
  visit(part("friction", "Coulomb coefficients"), grains.friction);
  visit(Field{"restitution", "-", between(0, 1), "coefficient of restitution e"}, grains.restitution);
}

/// Number format of the contact solver; positions are always double.
enum class Precision { single_, double_ };

/// Sub-stepped soft sequential impulses, the production method.
struct SoftMethod {
  static constexpr const char* kName = "soft";
  friend bool operator==(const SoftMethod&, const SoftMethod&) = default;
};
void fields(auto&, SameAs<SoftMethod> auto&) {}

/// Non-smooth contact dynamics, the thesis' method.
struct NonSmoothMethod {
  static constexpr const char* kName = "nonsmooth";
  std::int64_t sweeps = 100;  ///< over all contacts, at most, per step
  double tolerance = 0;       ///< [m/s]: rms velocity changed by a sweep, below which no further one is made
  double correction = 1e-3;   ///< [m/s]: largest speed at which an overlap is taken back
  friend bool operator==(const NonSmoothMethod&, const NonSmoothMethod&) = default;
};
void fields(auto& visit, SameAs<NonSmoothMethod> auto& method) {
  visit(Field{"sweeps", "-", between(1, 100'000), "sweeps over all contacts, at most, per step"}, method.sweeps);
  visit(Field{"tolerance", "m/s", between(0, 1), "rms velocity changed by a sweep, below which no further one is made"},
        method.tolerance);
  visit(Field{"correction", "m/s", positive(100), "largest speed at which an overlap is taken back"}, method.correction);
}

using Method = std::variant<SoftMethod, NonSmoothMethod>;

/// Who solves: coloured blocks, or the slow reference that compares all with all.
enum class Solver { blocks, brute_force };

/// How contacts are solved.
struct ContactSpec {
  double step = 5e-4;                        ///< dt [s], between two detections of contacts
  std::int64_t substeps = 10;                ///< of size h = dt/substeps
  Precision precision = Precision::single_;  ///< of the contact solver
  double stiffness = 0.125;                  ///< f h [-]: contact frequency f times sub-step
  double damping = 10;                       ///< zeta [-], damping ratio of a contact
  Method method = SoftMethod{};              ///< substeps, stiffness and damping are the soft one's
  Solver solver = Solver::blocks;
  friend bool operator==(const ContactSpec&, const ContactSpec&) = default;
};
void fields(auto& visit, SameAs<ContactSpec> auto& contact) {
  visit(Field{"step", "s", between(1e-8, 1e-2), "time step dt, between two detections of contacts"}, contact.step);
  visit(Field{"substeps", "-", between(1, 1000), "sub-steps per step"}, contact.substeps);
  visit(part("precision", "number format of the contact solver"), contact.precision);
  visit(Field{"stiffness", "-", positive(0.25), "contact frequency times sub-step, f h"}, contact.stiffness);
  visit(Field{"damping", "-", positive(1000), "damping ratio zeta of a contact"}, contact.damping);
  visit(later(part("method", "soft: sub-stepped soft impulses; nonsmooth: non-smooth contact dynamics")), contact.method);
  visit(later(part("solver", "blocks: coloured blocks; brute_force: all pairs in natural order, double, few grains")),
        contact.solver);
}

/// How the bed is brought to rest. A target solid fraction is reached through the friction used while settling.
struct PreparationSpec {
  std::optional<double> solid_fraction = {};  ///< target [-]; absent: as the grains' own friction gives it
  double tolerance = 1e-3;                    ///< on the target [-]
  double longest = 12;                        ///< [s] of settling before the bed counts as not settled
  ContactSpec contact;                        ///< the solver while settling
  friend bool operator==(const PreparationSpec&, const PreparationSpec&) = default;
};
void fields(auto& visit, SameAs<PreparationSpec> auto& preparation) {
  visit(Field{"solid_fraction", "-", between(0.75, 0.88), "target solid fraction; null: as the grains' friction gives it"},
        preparation.solid_fraction);
  visit(Field{"tolerance", "-", between(1e-4, 0.1), "tolerance on the target"}, preparation.tolerance);
  visit(Field{"longest", "s", positive(1000), "longest settling time"}, preparation.longest);
  visit(part("contact", "the contact solver while settling"), preparation.contact);
}

}  // namespace seapile::grains

template <>
struct seapile::base::EnumNames<seapile::grains::Solver> {
  static constexpr const char* values[] = {"blocks", "brute_force"};
};

template <>
struct seapile::base::EnumNames<seapile::grains::Precision> {
  static constexpr const char* values[] = {"single", "double"};
};
