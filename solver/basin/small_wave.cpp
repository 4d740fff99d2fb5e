#include "solver/basin/small_wave.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace seapile::basin {
namespace {

using Complex = std::complex<double>;
constexpr Complex kI{0, 1};

/// The frequency without viscosity, by which all times are scaled: w^2 = w0^2 tanh kH.
double inviscid_frequency(const SmallWave& wave) {
  const double k = wave.wavenumber;
  return std::sqrt((wave.gravity * k + wave.tension / wave.density * k * k * k) * std::tanh(k * wave.depth));
}

/// The wave in units of 1/k and 1/w.
struct Scaled {
  double viscosity = 0;  ///< nu k^2/w
  double depth = 0;      ///< kH; at most 100, where it is deep water in every digit
  WallKind bottom = WallKind::slip;
};

Scaled scaled(const SmallWave& wave) {
  const double k = wave.wavenumber;
  return {wave.viscosity / wave.density * k * k / inviscid_frequency(wave), std::min(k * wave.depth, 100.0),
          wave.bottom};
}

/// 1 + D tanh kH, whose root is the mode, at s = i + beside. Without viscosity it is s^2 + 1, which is put down so that
/// a decay keeps its digits however slow it is.
Complex balance(const Scaled& wave, Complex beside) {
  const double nu = wave.viscosity, t = std::tanh(wave.depth);
  const Complex s = kI + beside, m = s + 2 * nu;
  const Complex q = std::sqrt(1.0 + s / nu);  // real part >= 0
  const Complex tq = std::tanh(q * wave.depth);
  const Complex potential = beside * (beside + 2.0 * kI) + 4 * nu * (s + nu);
  if (wave.bottom == WallKind::slip) return potential - 4 * nu * nu * t * q / tq;

  const double sech = 1 / std::cosh(wave.depth);
  const Complex e = std::exp(-q * wave.depth), sech_q = 2.0 * e / (1.0 + e * e);
  const Complex layer =
      m * m * sech * sech * tq / q + 4 * nu * nu * t * (1.0 - q * t * tq) - 4 * nu * t * sech * m * sech_q;
  return potential + layer / (t - tq / q);
}

/// Derivative of the balance, by Cauchy's integral over a circle that keeps away from the real axis.
Complex slope(const Scaled& wave, Complex beside) {
  constexpr int kPoints = 16;
  const double radius = 0.1 * (1 + beside.imag());
  Complex sum = 0;
  for (int i = 0; i < kPoints; ++i) {
    const Complex turn = std::polar(1.0, 2 * std::numbers::pi * (i + 0.5) / kPoints);
    sum += balance(wave, beside + radius * turn) / turn;
  }
  return sum / (kPoints * radius);
}

/// Lowest frequency by the decay rate that counts as one.
constexpr double kOscillates = 1e-5;

/// The root, by Newton from a guess, as its distance from i; absent when that leaves the upper half-plane.
std::optional<Complex> root_near(const Scaled& wave, Complex beside) {
  double last = 1;
  for (int iteration = 0; iteration < 40; ++iteration) {
    if (!(1 + beside.imag() > -kOscillates * beside.real()) || !(std::abs(beside) < 3)) return {};
    const Complex step = balance(wave, beside) / slope(wave, beside);
    beside -= step;
    const double size = std::abs(step) / std::abs(beside);
    // Where two roots are about to meet, the last digits are noise and the steps stop to shrink before they vanish.
    if (size < 1e-15 || (size < 1e-6 && size >= 0.5 * last)) return beside;
    last = size;
  }
  return {};
}

/// The mode of an almost inviscid wave, as its distance from i.
Complex nearly_inviscid(const Scaled& wave) {
  const Complex layer = wave.bottom == WallKind::slip
                            ? Complex(0)
                            : Complex(1, 1) * std::sqrt(wave.viscosity / 2) / std::sinh(2 * wave.depth);
  return -2 * wave.viscosity - layer;
}

/// The mode as its distance from i; absent when overdamped. Follows it from a viscosity so small that the estimate
/// holds; where the pair meets on the real axis there is nothing more to follow.
std::optional<Complex> root(const Scaled& wave) {
  Scaled at = wave;
  while (std::abs(nearly_inviscid(at)) > 0.1) at.viscosity /= 4;
  std::optional<Complex> found = root_near(at, nearly_inviscid(at));
  double stride = 2;
  while (found && at.viscosity < wave.viscosity) {
    Scaled next = at;
    next.viscosity = std::min(at.viscosity * stride, wave.viscosity);
    if (const auto further = root_near(next, *found)) {
      at = next;
      found = further;
    } else {
      stride = std::sqrt(stride);
      if (stride < 1 + 1e-12) return {};
    }
  }
  return found;
}

/// The part of a(t) that is no oscillation: the inverse transform of a^ without the mode's poles.
double diffusive_part(const Scaled& wave, double time, const std::optional<Complex>& pole, Complex residue) {
  constexpr int kNodes = 32;
  double sum = 0;
  for (int i = 0; i < kNodes / 2; ++i) {  // the other half is conjugate
    const double angle = std::numbers::pi * (2 * i + 1) / kNodes, c = 0.6407 * angle;
    const Complex z = double{kNodes} * Complex(0.5017 * angle / std::tan(c) - 0.6122, 0.2645 * angle);
    const Complex slope_z = Complex(0.5017 * (1 / std::tan(c) - c / (std::sin(c) * std::sin(c))), 0.2645);
    const Complex s = z / time;
    Complex transform = (1.0 - 1.0 / balance(wave, s - kI)) / s;
    if (pole) transform -= residue / (s - *pole) + std::conj(residue) / (s - std::conj(*pole));
    sum += (std::exp(z) * transform * slope_z).imag();
  }
  return 2 * sum / time;
}

}  // namespace

std::optional<Mode> slowest_mode(const SmallWave& wave) {
  const double w = inviscid_frequency(wave);
  if (w == 0) return {};
  if (wave.viscosity == 0) return Mode{w, 0};
  const auto beside = root(scaled(wave));
  if (!beside) return {};
  return Mode{w * (1 + beside->imag()), -w * beside->real()};
}

Mode nearly_inviscid_mode(const SmallWave& wave) {
  const double w = inviscid_frequency(wave);
  const Complex beside = nearly_inviscid(scaled(wave));
  return {w * (1 + beside.imag()), -w * beside.real()};
}

std::vector<double> amplitude(const SmallWave& wave, std::span<const double> time) {
  const double w = inviscid_frequency(wave);
  std::vector<double> a;
  a.reserve(time.size());
  if (w == 0 || wave.viscosity == 0) {
    for (const double t : time) a.push_back(std::cos(w * t));
    return a;
  }
  const Scaled unit = scaled(wave);
  const auto beside = root(unit);
  std::optional<Complex> pole;
  Complex residue = 0;
  // Close to critical damping the residues of the two poles are large and cancel, and the contour holds the poles.
  if (beside && 1 + beside->imag() > -0.1 * beside->real()) {
    pole = kI + *beside;
    residue = -1.0 / (*pole * slope(unit, *beside));
  }
  for (const double t : time) {
    if (!(t > 0)) {
      a.push_back(1);
      continue;
    }
    const double mode = pole ? 2 * (residue * std::exp(*pole * (w * t))).real() : 0;
    a.push_back(mode + diffusive_part(unit, w * t, pole, residue));
  }
  return a;
}

double amplitude(const SmallWave& wave, double time) { return amplitude(wave, std::span(&time, 1)).front(); }

}  // namespace seapile::basin
