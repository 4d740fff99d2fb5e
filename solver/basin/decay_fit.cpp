#include "solver/basin/decay_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace seapile::basin {
namespace {

/// A series over times from 0 to 1, with values that span 1.
struct Series {
  std::vector<double> time, value;
};

/// A, B, c, then w and d by the series' length.
using Parameters = Eigen::Matrix<double, 5, 1>;
constexpr int kCosine = 0, kSine = 1, kMean = 2, kFrequency = 3, kDecayRate = 4;

/// At one time, the value that the parameters give, and its derivative by each.
struct Prediction {
  double value = 0;
  Parameters derivative;
};

Prediction prediction(const Parameters& p, double t) {
  const double e = std::exp(-p[kDecayRate] * t);
  const double cosine = e * std::cos(p[kFrequency] * t), sine = e * std::sin(p[kFrequency] * t);
  const double wave = p[kCosine] * cosine + p[kSine] * sine;
  return {wave + p[kMean], {cosine, sine, 1, t * (p[kSine] * cosine - p[kCosine] * sine), -t * wave}};
}

/// Sum of the squared residuals of every `stride`-th sample.
double squares(const Series& a, const Parameters& p, std::size_t stride = 1) {
  double sum = 0;
  for (std::size_t i = 0; i < a.time.size(); i += stride) {
    const double residual = a.value[i] - prediction(p, a.time[i]).value;
    sum += residual * residual;
  }
  return sum;
}

/// The best A, B, c of a frequency without decay, from every `stride`-th sample.
Parameters with_best_shares(const Series& a, double frequency, std::size_t stride) {
  Parameters p;
  p << 0, 0, 0, frequency, 0;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < a.time.size(); i += stride) {
    const Eigen::Vector3d basis = prediction(p, a.time[i]).derivative.head<3>();
    normal += basis * basis.transpose();
    right += basis * a.value[i];
  }
  p.head<3>() = normal.ldlt().solve(right);
  return p;
}

/// The best frequency of a table that goes to 30 periods, or 0.45 periods a sample. Without decay it is close enough,
/// up to two e-foldings in a period.
Parameters first_guess(const Series& a) {
  constexpr std::size_t kEnough = 200;
  const std::size_t stride = (a.time.size() + kEnough - 1) / kEnough, used = (a.time.size() - 1) / stride + 1;
  const double most = std::min(30.0, 0.45 * static_cast<double>(used));
  Parameters best = Parameters::Zero();
  double least = std::numeric_limits<double>::infinity();
  for (double periods = 0.5; periods < most; periods += 0.5) {
    const Parameters p = with_best_shares(a, 2 * std::numbers::pi * periods, stride);
    const double sum = squares(a, p, stride);
    if (sum < least) {
      least = sum;
      best = p;
    }
  }
  return best;
}

/// Levenberg-Marquardt, to where no step makes the sum smaller.
Parameters least_squares(const Series& a, Parameters p) {
  double damping = 1e-3, sum = squares(a, p);
  for (int iteration = 0; iteration < 200 && damping < 1e12; ++iteration) {
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    Parameters right = Parameters::Zero();
    for (std::size_t i = 0; i < a.time.size(); ++i) {
      const Prediction at = prediction(p, a.time[i]);
      normal += at.derivative * at.derivative.transpose();
      right += at.derivative * (a.value[i] - at.value);
    }
    normal.diagonal() *= 1 + damping;
    const Parameters step = normal.ldlt().solve(right);
    const double next = squares(a, p + step);
    if (next < sum) {
      p += step;
      sum = next;
      damping /= 10;
      if (step.norm() < 1e-13 * p.norm()) break;
    } else {
      damping *= 10;
    }
  }
  return p;
}

}  // namespace

std::optional<Mode> fitted(std::span<const double> time, std::span<const double> amplitude) {
  if (time.size() != amplitude.size()) throw std::logic_error("a series has as many times as amplitudes");
  if (time.size() < 8) return {};
  const double begin = time.front(), length = time.back() - begin;
  const auto [least, most] = std::minmax_element(amplitude.begin(), amplitude.end());
  const double scale = *most - *least;
  if (!(scale > 0)) return {};
  Series a;
  for (std::size_t i = 0; i < time.size(); ++i) {
    a.time.push_back((time[i] - begin) / length);
    a.value.push_back(amplitude[i] / scale);
  }

  const Parameters p = least_squares(a, first_guess(a));
  const double frequency = std::abs(p[kFrequency]);
  if (!(frequency >= 2 * std::numbers::pi * kFewestPeriods)) return {};
  return Mode{frequency / length, p[kDecayRate] / length};
}

std::pair<double, double> window_of(const Mode& mode) {
  const double period = 2 * std::numbers::pi / mode.frequency;
  const double decayed = mode.decay_rate > 0 ? 2 / mode.decay_rate : std::numeric_limits<double>::infinity();
  return {period, period + std::clamp(decayed, 2 * period, 10 * period)};
}

}  // namespace seapile::basin
