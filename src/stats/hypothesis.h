// Tests of samples against what they should be: chi-square, Kolmogorov-Smirnov, z.
#pragma once

#include <span>

namespace meander {

/// `p` is the chance of a statistic at least as large when the hypothesis holds.
struct ChiSquareTest {
  double statistic = 0;
  int degrees = 0;
  double p = 1;
};

/// Pearson 1900: counts in cells against their expectations, which must have the same total. Cells whose
/// expectation is below 5 are pooled, smallest first, until none is (Cochran 1954). A sample in a cell of
/// expectation 0 gives p = 0; a single remaining cell gives degrees 0 and p = 1.
[[nodiscard]] ChiSquareTest chi_square_test(std::span<const double> observed,
                                            std::span<const double> expected);

struct KolmogorovTest {
  double statistic = 0;
  double p = 1;
};

/// The largest distance between the empirical cdf and the true one. `cdf` holds the true cdf at each sample,
/// in ascending order; a value outside [0, 1] or NaN gives p = 0.
[[nodiscard]] KolmogorovTest kolmogorov_smirnov(std::span<const double> cdf);

/// (mean - reference) / standard_error; with no error, 0 when they are equal and infinite otherwise.
[[nodiscard]] double z_score(double mean, double reference, double standard_error) noexcept;

/// z of the difference of two independent means.
[[nodiscard]] double two_sample_z(double mean_a, double error_a, double mean_b, double error_b) noexcept;

}  // namespace meander
