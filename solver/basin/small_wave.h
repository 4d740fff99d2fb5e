// Small standing waves of a viscous liquid of finite depth: exact linear theory, which the solver is compared to.
//
// The surface is eta = a(t) cos kx, with k = n pi/L between slip walls, which such a wave satisfies exactly. Linearised
// Navier-Stokes, from rest, in the transform of time: the vertical velocity is a sum of cosh and sinh of k z and q z,
// z from the bottom, q^2 = k^2 + s/nu, of which the bottom leaves two. At the surface there is no shear, and the
// normal stress bears gravity and tension, w0^2 = g k + gamma k^3/rho:
//
//   a^(s)/a(0) = D/(s (D + w0^2)),   modes: D + w0^2 = 0,   m = s + 2 nu k^2
//   slip       D = m^2 coth kH - 4 nu^2 k^3 q coth qH
//   no slip    D = {m^2 (1 - T k/q) + 4 nu^2 k^3 (k - q T) - 4 nu k^2 m/(cosh kH cosh qH)}/{tanh kH - (k/q) tanh qH},
//              T = tanh kH tanh qH
//
// In deep water both are Prosperetti's (1981). s/D is the answer of the surface's height to a pressure: a sum of
// c_n/(s + lambda_n), c_n > 0, lambda_n > 0 real, over the diffusive motions of the liquid; the c_n sum to tanh kH.
// D + w0^2 = 0 has therefore at most one pair of complex roots, with |s|^2 <= w0^2 tanh kH, and every other singularity
// of a^ lies on the negative real axis. A root with a positive imaginary part is the mode, wherever it was found from.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solver/basin/basin_spec.h"

namespace seapile::basin {

struct SmallWave {
  double wavenumber = 0;  ///< k [1/m], above 0
  double depth = 0;       ///< H [m], above 0
  double gravity = 0;     ///< g [m/s2]
  double tension = 0;     ///< gamma [N/m]
  double density = 0;     ///< rho [kg/m3]
  double viscosity = 0;   ///< mu [Pa s]
  WallKind bottom = WallKind::slip;
};

/// A decaying oscillation: exp(-decay_rate t) cos(frequency t + phase).
struct Mode {
  double frequency = 0;   ///< [rad/s]
  double decay_rate = 0;  ///< [1/s]
};

/// The mode that oscillates; absent when the wave is overdamped (a frequency below 1e-5 of the decay rate counts as
/// none), in deep water from nu k^2 = 1.3115 w0 on, in shallower water sooner; and when nothing drives it back.
std::optional<Mode> slowest_mode(const SmallWave& wave);

/// The mode of an almost inviscid wave: 2 nu k^2, and at a bottom that it sticks to the layer's
/// k sqrt(nu w/2)/sinh 2kH, which is also taken from the frequency.
Mode nearly_inviscid_mode(const SmallWave& wave);

/// a(t)/a(0) of a wave that starts from rest, at each time [s]: the mode by its residue, and the rest, whose
/// singularities are on the negative real axis, by Talbot's contour with Weideman's constants. Exact to 1e-11 of a(0);
/// overdamped waves lose digits as (nu k^2/w0)^2 grows.
std::vector<double> amplitude(const SmallWave& wave, std::span<const double> time);
double amplitude(const SmallWave& wave, double time);

}  // namespace seapile::basin
