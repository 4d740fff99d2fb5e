// Numbers that carry what the equations ask of a field: its first derivatives by x, y and t and its second by x and y.
#pragma once

#include <cmath>

namespace seapile::fluid::support {

struct Jet {
  double value = 0, x = 0, y = 0, t = 0, xx = 0, xy = 0, yy = 0;
  Jet() = default;
  Jet(double constant) : value(constant) {}
  Jet(double f, double fx, double fy, double ft, double fxx, double fxy, double fyy)
      : value(f), x(fx), y(fy), t(ft), xx(fxx), xy(fxy), yy(fyy) {}

  friend Jet operator+(const Jet& a, const Jet& b) {
    return {a.value + b.value, a.x + b.x, a.y + b.y, a.t + b.t, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend Jet operator-(const Jet& a, const Jet& b) { return a + -1 * b; }
  friend Jet operator*(const Jet& a, const Jet& b) {
    return {a.value * b.value,
            a.x * b.value + a.value * b.x,
            a.y * b.value + a.value * b.y,
            a.t * b.value + a.value * b.t,
            a.xx * b.value + 2 * a.x * b.x + a.value * b.xx,
            a.xy * b.value + a.x * b.y + a.y * b.x + a.value * b.xy,
            a.yy * b.value + 2 * a.y * b.y + a.value * b.yy};
  }
  friend Jet operator/(const Jet& a, const Jet& b) {
    const double q = 1 / b.value;
    return a * b.through(q, -q * q, 2 * q * q * q);
  }
  friend Jet sin(const Jet& a) { return a.through(std::sin(a.value), std::cos(a.value), -std::sin(a.value)); }
  friend Jet cos(const Jet& a) { return a.through(std::cos(a.value), -std::sin(a.value), -std::cos(a.value)); }

 private:
  /// A function of it whose value and first two derivatives there are given.
  Jet through(double f, double f1, double f2) const {
    return {f, f1 * x, f1 * y, f1 * t, f1 * xx + f2 * x * x, f1 * xy + f2 * x * y, f1 * yy + f2 * y * y};
  }
};

/// A place and a time, as arguments of fields.
struct Arguments {
  Jet x, y, t;
  Arguments(double at_x, double at_y, double at_t)
      : x(at_x, 1, 0, 0, 0, 0, 0), y(at_y, 0, 1, 0, 0, 0, 0), t(at_t, 0, 0, 1, 0, 0, 0) {}
};

}  // namespace seapile::fluid::support
