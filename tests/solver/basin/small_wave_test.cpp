// The theory of small waves against the linear equations it is derived from, set up anew, and against published values.
#include "solver/basin/small_wave.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace seapile::basin {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

constexpr WallKind kBottoms[] = {WallKind::slip, WallKind::no_slip};

/// L = 1, H = 0.5, g = 1, nu = 0.01, one half wave.
SmallWave reference(WallKind bottom) {
  return {
      .wavenumber = pi, .depth = 0.5, .gravity = 1, .tension = 0, .density = 1, .viscosity = 0.01, .bottom = bottom};
}

/// A wave in units of 1/k and its frequency without viscosity: w0^2 tanh kH = 1.
SmallWave scaled(double depth, double viscosity, WallKind bottom) {
  SmallWave wave = reference(bottom);
  wave.wavenumber = 1;
  wave.depth = depth;
  wave.gravity = 1 / std::tanh(depth);
  wave.viscosity = viscosity;
  return wave;
}

/// One wave of water with tension in SI units.
SmallWave capillary(WallKind bottom) {
  return {.wavenumber = 500,
          .depth = 1.5e-3,
          .gravity = 9.81,
          .tension = 0.07,
          .density = 1000,
          .viscosity = 1e-3,
          .bottom = bottom};
}

/// The linear equations for one s. v = A exp(ky) + B exp(-k(y + H)) + C exp(qy) + E exp(-q(y + H)) is the vertical
/// velocity, y up from the surface; A and B alone have a pressure, -rho s/k (A exp(ky) - B exp(-k(y + H))).
struct Equations {
  Eigen::Matrix<Complex, 5, 5> matrix;  ///< of A, B, C, E and a
  Eigen::Matrix<Complex, 5, 1> right;   ///< from a(0) = 1, at rest
};

Equations equations(const SmallWave& wave, Complex s) {
  const double k = wave.wavenumber, nu = wave.viscosity / wave.density, H = wave.depth;
  const double w0_squared = wave.gravity * k + wave.tension * k * k * k / wave.density;
  const Complex q = std::sqrt(k * k + s / nu), f = std::exp(-q * H);  // what is left of a layer at the other side
  const double F = std::exp(-k * H);
  Equations e;
  e.right.setZero();
  e.matrix.row(0) << F, 1, f, 1, 0;  // v at the bottom
  if (wave.bottom == WallKind::slip)
    e.matrix.row(1) << k * k * F, k * k, q * q * f, q * q, 0;  // v'' there: no shear
  else
    e.matrix.row(1) << k * F, -k, q * f, -q, 0;  // v' there: no sliding
  // v'' + k^2 v at the surface: no shear
  e.matrix.row(2) << 2 * k * k, 2 * k * k * F, q * q + k * k, (q * q + k * k) * f, 0;
  e.matrix.row(3) << 1, F, 1, f, -s;  // da/dt = v
  e.right[3] = -1;
  // -p + 2 mu v' = -rho w0^2/k a
  e.matrix.row(4) << s / k + 2 * nu * k, -(s / k + 2 * nu * k) * F, 2 * nu * q, -2 * nu * q * f, w0_squared / k;
  // Rows of like size.
  for (int i = 0; i < 5; ++i) {
    const double size = e.matrix.row(i).cwiseAbs().maxCoeff();
    e.matrix.row(i) /= size;
    e.right[i] /= size;
  }
  return e;
}

/// a^(s)/a(0).
Complex transform(const SmallWave& wave, Complex s) {
  const Equations e = equations(wave, s);
  return e.matrix.fullPivLu().solve(e.right)[4];
}

/// How singular the equations are: the determinant by the product of its columns' lengths.
double determinant(const SmallWave& wave, Complex s) {
  Eigen::Matrix<Complex, 5, 5> matrix = equations(wave, s).matrix;
  for (int i = 0; i < 5; ++i) matrix.col(i).normalize();
  return std::abs(matrix.fullPivLu().determinant());
}

Complex root(const Mode& mode) { return {-mode.decay_rate, mode.frequency}; }

TEST(SmallWave, HasTheKnownModes) {
  const Mode slip = slowest_mode(reference(WallKind::slip)).value();
  EXPECT_NEAR(slip.decay_rate, 0.1656260, 6e-8);
  EXPECT_NEAR(slip.frequency, 1.6674980, 6e-8);
  const Mode no_slip = slowest_mode(reference(WallKind::no_slip)).value();
  EXPECT_NEAR(no_slip.decay_rate, 0.2005789, 6e-8);
  EXPECT_NEAR(no_slip.frequency, 1.6491873, 6e-8);
}

TEST(SmallWave, HasTheKnownAmplitudes) {
  const std::vector<double> time = {1, 2, 3, 4, 5, 8, 10};
  const std::vector<double> known = {-0.0146111, -0.7339833, 0.1212901, 0.5018198, -0.1723952, 0.2101324, -0.1246170};
  const std::vector<double> found = amplitude(reference(WallKind::slip), time);
  for (std::size_t i = 0; i < time.size(); ++i) EXPECT_NEAR(found[i], known[i], 6e-8) << time[i];
}

TEST(SmallWave, AModeSolvesTheLinearEquationsWithoutForcing) {
  for (const WallKind bottom : kBottoms) {
    std::vector<SmallWave> waves = {reference(bottom), capillary(bottom)};
    for (const double depth : {0.2, 1.0, 3.0})
      for (const double viscosity : {1e-3, 1e-2, 0.1, 0.3}) waves.push_back(scaled(depth, viscosity, bottom));
    for (const SmallWave& wave : waves) {
      const auto mode = slowest_mode(wave);
      if (!mode) continue;
      const Complex s = root(*mode);
      EXPECT_LT(determinant(wave, s), 1e-8 * determinant(wave, 1.01 * s))
          << wave.depth << ' ' << wave.viscosity << ' ' << (bottom == WallKind::slip);
    }
  }
}

TEST(SmallWave, TheTransformHasItsPoleAtTheMode) {
  for (const WallKind bottom : kBottoms)
    for (const SmallWave& wave : {reference(bottom), capillary(bottom), scaled(0.5, 0.05, bottom)}) {
      const Complex s = root(slowest_mode(wave).value());
      // Around a simple pole at s alone, the mean of (a^ d) is the residue and that of (a^ d^2) vanishes.
      Complex residue = 0, next = 0;
      for (int i = 0; i < 32; ++i) {
        const Complex d = std::polar(0.2 * s.imag(), pi * (i + 0.5) / 16);
        residue += transform(wave, s + d) * d / 32.0;
        next += transform(wave, s + d) * d * d / 32.0;
      }
      EXPECT_GT(std::abs(residue), 0.4);
      EXPECT_LT(std::abs(next), 1e-10 * std::abs(s));
    }
}

/// The integral of a(t) exp(-s t) over all times, by Gauss-Legendre of 3 points on many intervals, the shortest of
/// which are at the start, where a layer grows.
double transform_of_amplitude(const SmallWave& wave, double s) {
  constexpr int kIntervals = 1000;
  constexpr double kPoint[] = {0.1127016653792583, 0.5, 0.8872983346207417}, kWeight[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const double end = 32 / s;  // to exp(-32)
  std::vector<double> time, weight;
  for (int i = 0; i < kIntervals; ++i)
    for (int j = 0; j < 3; ++j) {
      const double x = (i + kPoint[j]) / kIntervals;
      time.push_back(end * x * x * x);
      weight.push_back(kWeight[j] / kIntervals * 3 * end * x * x);
    }
  const std::vector<double> a = amplitude(wave, time);
  double sum = 0;
  for (std::size_t i = 0; i < time.size(); ++i) sum += weight[i] * a[i] * std::exp(-s * time[i]);
  return sum;
}

// Waves that oscillate, that hardly do (depth 1 without slip and with), and that do not.
TEST(SmallWave, TheAmplitudeHasTheTransformOfTheLinearEquations) {
  for (const WallKind bottom : kBottoms) {
    std::vector<SmallWave> waves = {reference(bottom), capillary(bottom)};
    for (const double depth : {0.2, 1.0, 3.0})
      for (const double viscosity : {1e-2, 0.1, 0.3274594, 0.6633312, 1.0, 5.0, 30.0})
        waves.push_back(scaled(depth, viscosity, bottom));
    for (const SmallWave& wave : waves)
      for (const double s : {0.5, 2.0}) {
        SmallWave inviscid = wave;
        inviscid.viscosity = 0;
        const double rate = s * slowest_mode(inviscid)->frequency;
        EXPECT_NEAR(rate * transform_of_amplitude(wave, rate), rate * transform(wave, rate).real(), 1e-10)
            << wave.depth << ' ' << wave.viscosity << ' ' << (bottom == WallKind::slip) << ' ' << s;
      }
  }
}

/// Roots with an imaginary part above `edge` by the winding of 1 - s a^(s), of which they are the poles.
long roots_above(const SmallWave& wave, double edge) {
  const auto at = [&](Complex s) { return 1.0 - s * transform(wave, s); };
  std::vector<Complex> path;  // the bound |s| < 1, and back above the axis
  const double reach = 1.01, start = std::asin(edge / reach), end = -reach * std::cos(start);
  constexpr int kPoints = 500;
  for (int i = 0; i < kPoints; ++i) path.push_back(std::polar(reach, start + (pi - 2 * start) * i / kPoints));
  for (int i = 0; i <= kPoints; ++i) path.emplace_back(end - 2 * end * i / kPoints, edge);
  double turns = 0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) turns += std::arg(at(path[i + 1]) / at(path[i])) / (2 * pi);
  return -std::lround(turns);
}

TEST(SmallWave, AModeIsFoundWhereThereIsOneAndNoneWhereItIsOverdamped) {
  int present = 0, absent = 0;
  for (const WallKind bottom : kBottoms)
    for (const double depth : {0.1, 0.3, 1.0, 3.0})
      for (double viscosity = 1e-3; viscosity < 3; viscosity *= 1.7) {
        const SmallWave wave = scaled(depth, viscosity, bottom);
        const auto mode = slowest_mode(wave);
        (mode ? present : absent) += 1;
        EXPECT_EQ(roots_above(wave, 0.02), mode && mode->frequency > 0.02) << depth << ' ' << viscosity;
      }
  EXPECT_GT(present, 40);
  EXPECT_GT(absent, 15);
}

// Bisection for critical damping. In deep water it is at 1.3115 (Lamb, Hydrodynamics, art. 349).
TEST(SmallWave, TheFrequencyVanishesLikeARootTowardsCriticalDamping) {
  for (const WallKind bottom : kBottoms)
    for (const double depth : {0.01, 0.1, 1.0, 50.0}) {
      double below = 1e-6, above = 3;
      for (int i = 0; i < 60; ++i) {
        const double between = std::sqrt(below * above);
        (slowest_mode(scaled(depth, between, bottom)) ? below : above) = between;
      }
      if (depth == 50) {
        EXPECT_NEAR(below, 1.3115, 1e-4);
      }
      const Mode far = slowest_mode(scaled(depth, below * (1 - 1e-4), bottom)).value();
      const Mode near = slowest_mode(scaled(depth, below * (1 - 1e-6), bottom)).value();
      EXPECT_NEAR(far.frequency / near.frequency, 10, 0.01) << depth;
      EXPECT_NEAR(far.decay_rate / near.decay_rate, 1, 1e-3) << depth;
    }
}

// In steps of 1 % a frequency falls from less than 0.15 to nothing.
TEST(SmallWave, ModesAreContinuousAndWithinTheirBoundsFromNoViscosityToCriticalDamping) {
  for (const WallKind bottom : kBottoms)
    for (const double depth : {0.01, 0.1, 1.0, 3.47, 4.13, 5.0, 50.0}) {
      Mode last = slowest_mode(scaled(depth, 0, bottom)).value();
      EXPECT_NEAR(last.frequency, 1, 1e-15);
      EXPECT_EQ(last.decay_rate, 0);
      bool overdamped = false;
      for (double viscosity = 1e-12; viscosity < 10; viscosity *= viscosity < 1e-5 ? 2 : 1.01) {
        const auto mode = slowest_mode(scaled(depth, viscosity, bottom));
        if (!mode) {
          EXPECT_TRUE(overdamped || last.frequency < 0.15) << depth << ' ' << viscosity;
          overdamped = true;
          continue;
        }
        EXPECT_FALSE(overdamped) << depth << ' ' << viscosity;
        EXPECT_LE(std::hypot(mode->frequency, mode->decay_rate), 1 + 1e-12) << depth << ' ' << viscosity;
        EXPECT_LT(mode->frequency, last.frequency + 1e-12) << depth << ' ' << viscosity;
        EXPECT_GT(mode->decay_rate, last.decay_rate) << depth << ' ' << viscosity;
        last = *mode;
      }
      EXPECT_TRUE(overdamped);
    }
}

TEST(SmallWave, TheDampingOfAnAlmostInviscidWaveIsThatOfItsBulkAndItsBottomLayer) {
  for (const WallKind bottom : kBottoms)
    for (const double depth : {0.1, 1.0, 3.0})
      for (const double viscosity : {1e-9, 1e-7}) {
        const SmallWave wave = scaled(depth, viscosity, bottom);
        const double layer =
            bottom == WallKind::slip ? 0 : std::sqrt(viscosity / 2) / std::sinh(2 * depth);  // k = w = 1
        const Mode estimate = nearly_inviscid_mode(wave), mode = slowest_mode(wave).value();
        EXPECT_NEAR(estimate.decay_rate, 2 * viscosity + layer, 1e-15);
        EXPECT_NEAR(estimate.frequency, 1 - layer, 1e-15);
        EXPECT_NEAR(mode.decay_rate / estimate.decay_rate, 1, 20 * std::sqrt(viscosity) / depth);
        EXPECT_NEAR(1 - mode.frequency, layer, 0.05 * layer + 1e-10);
      }
}

/// exp(z^2) erfc(z) for z in the right half-plane: the Faddeeva function w(i z) after Weideman (1994).
Complex scaled_erfc(Complex z) {
  constexpr int kTerms = 40;
  const double L = std::sqrt(kTerms / std::numbers::sqrt2);
  static const std::vector<double> kCoefficient = [&] {
    constexpr int kPoints = 4 * kTerms;
    std::vector<double> c(kTerms, 0.0);
    for (int n = 0; n < kTerms; ++n)
      for (int j = -kPoints / 2 + 1; j < kPoints / 2; ++j) {
        const double angle = 2 * pi * j / kPoints, t = L * std::tan(angle / 2);
        c[n] += std::exp(-t * t) * (L * L + t * t) * std::cos((n + 1) * angle) / kPoints;
      }
    return c;
  }();
  const Complex Z = (L - z) / (L + z);
  Complex sum = 0;
  for (int n = kTerms - 1; n >= 0; --n) sum = sum * Z + kCoefficient[n];
  return 2.0 * sum / ((L + z) * (L + z)) + std::numbers::inv_sqrtpi / (L + z);
}

/// Prosperetti (1981), Phys. Fluids 24, 1217: a(t)/a(0) in infinitely deep liquid, b = nu k^2.
double prosperetti(double b, double w0, double time) {
  Eigen::Matrix4d companion = Eigen::Matrix4d::Zero();
  companion.diagonal(-1).setOnes();
  companion.col(3) << -(b * b + w0 * w0), -4 * std::pow(b, 1.5), -2 * b, 0;
  const Eigen::Vector4cd z = companion.eigenvalues();
  Complex a = 4 * b * b / (8 * b * b + w0 * w0) * std::erfc(std::sqrt(b * time));
  for (int i = 0; i < 4; ++i) {
    Complex Z = 1;
    for (int j = 0; j < 4; ++j)
      if (j != i) Z *= z[j] - z[i];
    const Complex u = z[i] * std::sqrt(time);
    const Complex grown = u.real() > 0 ? scaled_erfc(u) : 2.0 * std::exp(u * u) - scaled_erfc(-u);
    a += z[i] / Z * w0 * w0 / (z[i] * z[i] - b) * std::exp(-b * time) * grown;
  }
  return a.real();
}

TEST(SmallWave, InDeepWaterIsProsperettis) {
  const double known[][2] = {{1, 0.5459694}, {3, -0.9357834}, {6, 0.8531069}, {10, -0.7126378}, {15, -0.5566357}};
  for (const auto& [time, a] : known) EXPECT_NEAR(prosperetti(0.01, 1, time), a, 6e-8);
  for (const WallKind bottom : kBottoms)
    for (const double b : {1e-4, 0.01, 0.1, 0.5, 1.0, 1.3, 1.4, 3.0})
      for (const double time : {0.01, 0.1, 1.0, 3.0, 6.0, 10.0, 15.0, 60.0})
        EXPECT_NEAR(amplitude(scaled(60, b, bottom), time), prosperetti(b, 1, time), 1e-10) << b << ' ' << time;
}

TEST(SmallWave, WithoutViscosityItIsACosine) {
  const SmallWave wave = [] {
    SmallWave w = capillary(WallKind::no_slip);
    w.viscosity = 0;
    return w;
  }();
  const double w = std::sqrt((9.81 * 500 + 0.07e-3 * 1.25e8) * std::tanh(0.75));
  EXPECT_NEAR(slowest_mode(wave)->frequency, w, 1e-12 * w);
  for (const double time : {0.0, 0.01, 0.1}) EXPECT_NEAR(amplitude(wave, time), std::cos(w * time), 1e-12);
  SmallWave thin = wave;
  thin.viscosity = 1e-12;
  for (const double time : {0.0, 0.01, 0.1}) EXPECT_NEAR(amplitude(thin, time), std::cos(w * time), 1e-4);
}

TEST(SmallWave, ASurfaceThatNothingDrivesBackStays) {
  SmallWave wave = reference(WallKind::slip);
  wave.gravity = 0;
  EXPECT_FALSE(slowest_mode(wave));
  EXPECT_EQ(amplitude(wave, 3.0), 1);
}

TEST(SmallWave, StartsAtOneAndFromRest) {
  for (const WallKind bottom : kBottoms) {
    const SmallWave wave = reference(bottom);
    EXPECT_EQ(amplitude(wave, 0.0), 1);
    const double time = 1e-3, fall = pi * std::tanh(pi / 2) * time * time / 2;
    EXPECT_NEAR(1 - amplitude(wave, time), fall, 0.05 * fall);
  }
}

}  // namespace
}  // namespace seapile::basin
