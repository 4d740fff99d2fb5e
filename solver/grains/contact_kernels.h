// The inner loops of the contact solver, compiled once per instruction set and chosen at run time.
//
// All variants do the same IEEE operations on each of a block's sixteen lanes (no fused multiply-add, no approximate
// reciprocals), so they give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/base/instruction_set.h"
#include "solver/grains/contact_blocks.h"
#include "solver/grains/grains.h"

namespace seapile::grains {

/// Softness of a contact at sub-step h: frequency f, damping ratio zeta (Catto, Box2D v3; formulation.md 2.3).
template <class Real>
struct Softness {
  Real inverse_h;      ///< 1/h [1/s]
  Real bias_rate;      ///< share of an overlap that is corrected per time [1/s]
  Real mass_scale;     ///< [-]
  Real impulse_scale;  ///< [-]
  Real push_speed;     ///< largest correction speed [m/s]
  Real twist = 2;      ///< ContactLaw::twist [-]
};

/// Sums of one call.
struct SweepSums {
  double work = 0;      ///< of the impulse changes on the relative motion [J/m]
  double residual = 0;  ///< sum of squared normal velocity changes [m2/s2]
};
struct BodySums {
  double work = 0;      ///< of the warm-started impulses [J/m]
  double lift = 0;      ///< vertical contact impulse of the sub-step before [N s/m]
};

/// Sums of the non-smooth kernels.
struct SolveSums {
  double residual = 0;  ///< sum of squared velocity changes, normal and tangential [m2/s2]
  double touching = 0;  ///< contacts with an impulse
  double work = 0;      ///< of the impulses on the relative motion [J/m]; by assess()
};

/// What decides whether a block may rest.
struct Nearness {
  double margin;   ///< closing in this step that does not come from the bodies' own velocities [m]
  double time;     ///< of the step [s]
  double closing;  ///< so far (ContactSystem::closing) [m]
  double reach;    ///< largest closing of any gap in this step [m]
  double twist = 2;  ///< ContactLaw::twist [-]
};

template <class Real>
struct ContactKernels {
  const char* name;

  /// Start of a step: normal, gap and activity of blocks [first, last); adds the velocity changes by the kept impulses
  /// to `warm`. A block in which no gap can close within twice the step's time at the present relative velocity plus a
  /// margin rests in this step: its impulses are zeroed. Blocks that need not wake are passed over.
  void (*refresh)(ContactBlock<Real>* block, std::uint8_t* active, double* wake, std::int32_t first, std::int32_t last,
                  const Disc* disc, const BodyGroup<Real>* bodies, Before<Real>* warm, const Nearness& near);

  /// One Gauss-Seidel sweep over blocks [first, last): normal impulse, friction, both bodies moved on.
  /// `sums` are added to.
  void (*sweep)(ContactBlock<Real>* block, const std::uint8_t* active, std::int32_t first, std::int32_t last,
                BodyGroup<Real>* bodies, Real friction, const Softness<Real>& soft, SweepSums* sums);

  /// Start of the first sub-step for groups [first, last): gravity, push and the warm start of refresh(); drift zero.
  /// `push`: four of them for each group; null: none.
  void (*begin)(BodyGroup<Real>* bodies, Before<Real>* before, const Push<Real>* push, std::int32_t first,
                std::int32_t last, Real h, Real gravity, BodySums* sums);

  /// Start of a later sub-step for groups [first, last): drift by the last velocity, then gravity, push and the warm
  /// start, which per body is the contacts' velocity change of the sub-step before: v <- v + (v - before).
  void (*advance)(BodyGroup<Real>* bodies, Before<Real>* before, const Push<Real>* push, std::int32_t first,
                  std::int32_t last, Real h, Real gravity, BodySums* sums);

  // Non-smooth method.

  /// Bodies of groups [first, last): v <- v + momentum (v - v_old), v_old <- v. The old velocities stand in the drift.
  void (*extrapolate)(BodyGroup<Real>* bodies, std::int32_t first, std::int32_t last, Real momentum);

  /// One Gauss-Seidel sweep over blocks [first, last), which starts from p + momentum (p - p_old) and leaves p in p_old.
  /// `sums` are added to.
  void (*solve)(ContactBlock<Real>* block, Iterate<Real>* iterate, const std::uint8_t* active, std::int32_t first,
                std::int32_t last, BodyGroup<Real>* bodies, Real friction, Real twist, Real momentum, SolveSums* sums);

  /// Residual of blocks [first, last) at the present impulses and velocities, nothing moved (natural map), and the
  /// impulses' work on the mean of the velocities now and those in `before`. `sums` are added to.
  void (*assess)(const ContactBlock<Real>* block, const Iterate<Real>* iterate, const std::uint8_t* active,
                 std::int32_t first, std::int32_t last, const BodyGroup<Real>* bodies, const Before<Real>* before,
                 Real friction, Real twist, SolveSums* sums);
};

using base::available;
using base::fastest;
using base::InstructionSet;

/// Kernels of one instruction set; it must be available.
template <class Real>
const ContactKernels<Real>& contact_kernels(InstructionSet set);

}  // namespace seapile::grains
