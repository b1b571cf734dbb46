#include "stats/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace meander {
namespace {

constexpr double kInverseSqrt2 = 1 / std::numbers::sqrt2;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// x >= 0 with P(Z > x) = q, q in (0, 1/2].
double upper_quantile(double q) {
  const double t = std::sqrt(-2 * std::log(q));
  double x =
      t - (2.515517 + t * (0.802853 + t * 0.010328)) / (1 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
  for (int step = 0; step < 4; ++step) {
    const double density = std::exp(-0.5 * x * x) * kInverseSqrt2 * std::numbers::inv_sqrtpi;
    if (density == 0) break;  // q among the smallest subnormals: the start is as good as it gets
    const double newton = (normal_survival(x) - q) / density;
    x += newton / (1 - 0.5 * x * newton);
  }
  return x;
}

// P(a, x) = x^a e^-x / Gamma(a + 1) * (1 + x / (a + 1) + x^2 / ((a + 1) (a + 2)) + …).
double lower_gamma_series(double a, double x) {
  double term = 1;
  double sum = 1;
  for (double k = a + 1; term > sum * 1e-17; ++k) {
    term *= x / k;
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a + 1));
}

// Lentz's way through the continued fraction of Q(a, x) (Lentz 1976; Thompson & Barnett 1986).
double upper_gamma_fraction(double a, double x) {
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a;
  double c = 1 / kTiny;
  double d = 1 / std::max(b, kTiny);
  double value = d;
  for (int k = 1; k < 1'000'000; ++k) {
    const double numerator = k * (a - k);
    b += 2;
    d = numerator * d + b;
    c = b + numerator / c;
    if (std::abs(d) < kTiny) d = kTiny;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1 / d;
    value *= c * d;
    if (std::abs(c * d - 1) < 1e-16) break;
  }
  return value * std::exp(a * std::log(x) - x - std::lgamma(a));
}

// The continued fraction of I_x(a, b), for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b) {
  constexpr double kTiny = 1e-300;
  const auto away_from_zero = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1;
  double d = 1 / away_from_zero(1 - (a + b) * x / (a + 1));
  double value = d;
  for (int m = 1; m < 10'000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / away_from_zero(1 + even * d);
    c = away_from_zero(1 + even / c);
    value *= c * d;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / away_from_zero(1 + odd * d);
    c = away_from_zero(1 + odd / c);
    value *= c * d;
    if (std::abs(c * d - 1) < 1e-15) break;
  }
  return value;
}

// I_x(a, b), x in [0, 1] given with y = 1 - x, so that neither end loses digits.
double incomplete_beta(double x, double y, double a, double b) {
  if (x <= 0) return 0;
  if (y <= 0) return 1;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log(y));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(x, a, b) / a;
  return 1 - front * beta_fraction(y, b, a) / b;
}

}  // namespace

double normal_cdf(double z) noexcept { return 0.5 * std::erfc(-z * kInverseSqrt2); }

double normal_survival(double z) noexcept { return 0.5 * std::erfc(z * kInverseSqrt2); }

double two_sided_p(double z) noexcept { return std::erfc(std::abs(z) * kInverseSqrt2); }

double inverse_normal(double p) noexcept {
  if (p <= 0) return -kInfinity;
  if (p >= 1) return kInfinity;
  return p < 0.5 ? -upper_quantile(p) : upper_quantile(1 - p);
}

double two_sided_threshold(double p) noexcept {
  if (p <= 0) return kInfinity;
  return p >= 1 ? 0 : upper_quantile(0.5 * p);
}

double upper_incomplete_gamma(double a, double x) noexcept {
  if (!(x > 0)) return 1;
  if (std::isinf(x)) return 0;
  return x < a + 1 ? 1 - lower_gamma_series(a, x) : upper_gamma_fraction(a, x);
}

double chi_square_survival(double x, int degrees) noexcept {
  return upper_incomplete_gamma(0.5 * degrees, 0.5 * x);
}

double student_two_sided_p(double t, double degrees) noexcept {
  if (std::isinf(t)) return 0;
  const double whole = degrees + t * t;
  return incomplete_beta(degrees / whole, t * t / whole, 0.5 * degrees, 0.5);
}

double student_threshold(double p, double degrees) noexcept {
  if (p >= 1) return 0;
  // In log t the tail is smooth and falls: bisection between ends that bracket it.
  double low = -40;
  double high = 1;
  while (high < 700 && student_two_sided_p(std::exp(high), degrees) > p) high *= 2;
  for (int step = 0; step < 200 && high - low > 1e-13; ++step) {
    const double middle = 0.5 * (low + high);
    (student_two_sided_p(std::exp(middle), degrees) > p ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

double kolmogorov_survival(double d, std::size_t n) noexcept {
  const double root = std::sqrt(static_cast<double>(n));
  const double t = (root + 0.12 + 0.11 / root) * d;
  if (!(t > 0)) return 1;
  double sum = 0;
  if (t < 1) {  // the theta function's other face, which converges where the alternating series does not
    for (int k = 1; k <= 7; k += 2) {
      const double exponent = k * std::numbers::pi / t;
      sum += std::exp(-0.125 * exponent * exponent);
    }
    return 1 - sum * std::sqrt(2 * std::numbers::pi) / t;
  }
  for (int k = 1; k <= 6; ++k) sum += (k % 2 == 1 ? 1 : -1) * std::exp(-2.0 * k * k * t * t);
  return 2 * sum;
}

double sidak_level(double alpha, std::size_t count) noexcept {
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(std::max<std::size_t>(count, 1)));
}

double sidak_p(double p, std::size_t count) noexcept {
  return p >= 1 ? 1 : -std::expm1(static_cast<double>(std::max<std::size_t>(count, 1)) * std::log1p(-p));
}

}  // namespace meander
