// Numerical integration for tests, in double.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace meander {

/// Nodes and weights of Gauss-Legendre quadrature with five points on [-1, 1] (Abramowitz & Stegun
/// 1964, 25.4.30).
struct GaussLegendre {
  static constexpr std::array<double, 5> nodes = {-0.9061798459386640, -0.5384693101056831, 0,
                                                  0.5384693101056831, 0.9061798459386640};
  static constexpr std::array<double, 5> weights = {
      0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
};

/// Five points on [a, b].
template <class Function>
[[nodiscard]] double gauss(const Function& f, double a, double b) {
  double sum = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    sum += GaussLegendre::weights[i] * f(0.5 * (a + b) + 0.5 * (b - a) * GaussLegendre::nodes[i]);
  }
  return 0.5 * (b - a) * sum;
}

/// Adaptive bisection until a panel and its halves agree within `tolerance` (absolute, for the whole
/// interval); at most 2^depth panels. The halves' tolerance shrinks by sqrt 2, since float functions round at
/// random.
template <class Function>
[[nodiscard]] double integrate(const Function& f, double a, double b, double tolerance, int depth = 24) {
  const double middle = 0.5 * (a + b);
  const double halves = gauss(f, a, middle) + gauss(f, middle, b);
  if (depth == 0 || std::abs(halves - gauss(f, a, b)) <= tolerance) return halves;
  const double finer = tolerance / std::sqrt(2.0);
  return integrate(f, a, middle, finer, depth - 1) + integrate(f, middle, b, finer, depth - 1);
}

/// Tensor grid of panels x panels panels, five by five points each, on a rectangle.
template <class Function>
[[nodiscard]] double integrate_rectangle(const Function& f, const std::array<double, 2>& low,
                                         const std::array<double, 2>& high, int panels) {
  double sum = 0;
  for (int i = 0; i < panels; ++i) {
    const double step = (high[0] - low[0]) / panels;
    const auto row = [&](double x) {
      double inner = 0;
      for (int j = 0; j < panels; ++j) {
        const double rise = (high[1] - low[1]) / panels;
        inner += gauss([&](double y) { return f(x, y); }, low[1] + j * rise, low[1] + (j + 1) * rise);
      }
      return inner;
    };
    sum += gauss(row, low[0] + i * step, low[0] + (i + 1) * step);
  }
  return sum;
}

}  // namespace meander
