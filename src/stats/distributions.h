// The distributions that statistical tests ask for: normal, chi-square, Kolmogorov. Tails keep their relative
// precision, because a corrected level is far out in the tail.
#pragma once

#include <cstddef>

namespace meander {

/// P(Z <= z) of the standard normal (NIST DLMF 7.2.2: half of erfc(-z / sqrt 2)).
[[nodiscard]] double normal_cdf(double z) noexcept;

/// P(Z > z) of the standard normal, to full relative precision for large z.
[[nodiscard]] double normal_survival(double z) noexcept;

/// P(|Z| > |z|) of the standard normal.
[[nodiscard]] double two_sided_p(double z) noexcept;

/// The z with P(Z <= z) = p, p in [0, 1]; -infinity at 0, +infinity at 1. Start from Abramowitz & Stegun
/// 1964, 26.2.23, then Halley steps on the exact tail; absolute error below 1e-12.
[[nodiscard]] double inverse_normal(double p) noexcept;

/// The z >= 0 with P(|Z| > z) = p, p in [0, 1]: the threshold of a two-sided test at level p.
[[nodiscard]] double two_sided_threshold(double p) noexcept;

/// Q(a, x) = Gamma(a, x) / Gamma(a), a > 0, x >= 0: series below x = a + 1 (NIST DLMF 8.11.4), continued
/// fraction above (DLMF 8.9.2).
[[nodiscard]] double upper_incomplete_gamma(double a, double x) noexcept;

/// P(X > x) of chi-square with `degrees` >= 1 degrees of freedom: Q(degrees / 2, x / 2).
[[nodiscard]] double chi_square_survival(double x, int degrees) noexcept;

/// P(|T| > |t|) of Student's t with `degrees` > 0 degrees of freedom, which need not be whole: the
/// regularised incomplete beta I_x(degrees / 2, 1/2), x = degrees / (degrees + t^2) (NIST DLMF 8.17.22,
/// Lentz's way).
[[nodiscard]] double student_two_sided_p(double t, double degrees) noexcept;

/// The t >= 0 with P(|T| > t) = p, p in (0, 1]; relative error below 1e-9 up to 1e4 degrees, 1e-6 up to 1e9.
[[nodiscard]] double student_threshold(double p, double degrees) noexcept;

/// P(D_n > d) of Kolmogorov's statistic of n samples: the limit law (Kolmogorov 1933) at
/// (sqrt n + 0.12 + 0.11 / sqrt n) d (Stephens 1970). Good to three digits from n = 100.
[[nodiscard]] double kolmogorov_survival(double d, std::size_t n) noexcept;

/// The level of each of `count` independent tests whose family has level `alpha`: 1 - (1 - alpha)^(1 / count)
/// (Sidak 1967). alpha in [0, 1]; a count of 0 is taken as 1.
[[nodiscard]] double sidak_level(double alpha, std::size_t count) noexcept;

/// The inverse of sidak_level: the p-value of a family of `count` tests whose smallest p-value is p.
[[nodiscard]] double sidak_p(double p, std::size_t count) noexcept;

}  // namespace meander
