// Values quoted with many digits were computed in 40-digit arithmetic.
#include "stats/distributions.h"

#include <doctest/doctest.h>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace meander {
namespace {

void check_relative(double value, double expected, double tolerance) {
  CAPTURE(value);
  CAPTURE(expected);
  CHECK(std::abs(value - expected) <= tolerance * std::abs(expected));
}

}  // namespace

TEST_CASE("The normal's tails keep their relative precision") {
  check_relative(normal_survival(3), 0.0013498980316300945, 1e-14);
  check_relative(normal_survival(10), 7.6198530241605261e-24, 1e-14);
  check_relative(normal_survival(35), 1.1249107064724062e-268, 1e-12);
  check_relative(normal_cdf(-10), 7.6198530241605261e-24, 1e-14);
  check_relative(two_sided_p(4.5), 6.7953462494601208e-6, 1e-14);
  check_relative(two_sided_p(-4.5), 6.7953462494601208e-6, 1e-14);
  CHECK(normal_cdf(0) == 0.5);
  CHECK(two_sided_p(0) == 1);
}

TEST_CASE("The inverse normal gives the quantile, far out in the tails too") {
  check_relative(inverse_normal(1e-300), -37.047096299361199, 1e-13);
  check_relative(inverse_normal(1e-9), -5.9978070150076869, 1e-13);
  check_relative(inverse_normal(1e-3), -3.0902323061678135, 1e-13);
  check_relative(inverse_normal(0.025), -1.9599639845400542, 1e-13);
  check_relative(inverse_normal(0.975), 1.9599639845400542, 1e-13);
  check_relative(inverse_normal(0.3), -0.52440051270804078, 1e-13);
  CHECK(std::abs(inverse_normal(0.5)) < 1e-15);
  CHECK(inverse_normal(0) == -std::numeric_limits<double>::infinity());
  CHECK(inverse_normal(1) == std::numeric_limits<double>::infinity());
}

TEST_CASE("A two-sided threshold undoes the two-sided p-value") {
  for (const double z : {1e-3, 0.5, 2.0, 5.0, 12.0, 30.0}) {
    check_relative(two_sided_threshold(two_sided_p(z)), z, 1e-11);
  }
  CHECK(two_sided_threshold(1) == 0);
  CHECK(std::isinf(two_sided_threshold(0)));
}

TEST_CASE("The chi-square survival agrees with high-precision values on both branches") {
  check_relative(chi_square_survival(3.841458820694124, 1), 0.050000000000000057, 1e-13);
  check_relative(chi_square_survival(1, 2), 0.60653065971263342, 1e-13);
  check_relative(chi_square_survival(20, 10), 0.029252688076961073, 1e-13);
  check_relative(chi_square_survival(150, 100), 0.00090393204235400909, 1e-12);
  check_relative(chi_square_survival(1000, 1000), 0.49405285382923964, 1e-11);
  check_relative(chi_square_survival(1200, 1000), 1.2255942330622904e-5, 1e-11);
  check_relative(chi_square_survival(5100, 5000), 0.15863934861940395, 1e-11);
  check_relative(chi_square_survival(0.5, 7), 0.99944648139042497, 1e-13);
  check_relative(chi_square_survival(400, 3), 2.2138865931011177e-86, 1e-12);
  CHECK(chi_square_survival(0, 4) == 1);
  CHECK(chi_square_survival(std::numeric_limits<double>::infinity(), 4) == 0);
}

TEST_CASE("The Kolmogorov survival is the limit law at Stephens' argument, on both series") {
  const std::size_t n = 10'000;
  const double scale = 100 + 0.12 + 0.11 / 100;
  check_relative(kolmogorov_survival(0.3 / scale, n), 0.999990694198665, 1e-12);
  check_relative(kolmogorov_survival(0.5 / scale, n), 0.963945243664875, 1e-12);
  check_relative(kolmogorov_survival(0.99 / scale, n), 0.280873839225549, 1e-12);
  check_relative(kolmogorov_survival(1.0 / scale, n), 0.269999671677355, 1e-12);
  check_relative(kolmogorov_survival(1.36 / scale, n), 0.0494858767553779, 1e-12);
  check_relative(kolmogorov_survival(2.0 / scale, n), 0.000670925255779695, 1e-12);
  CHECK(kolmogorov_survival(0, n) == 1);
}

TEST_CASE("The Sidak level keeps its precision for many tests, and its inverse undoes it") {
  check_relative(sidak_level(0.01, 3072), 3.2715883506548267e-6, 1e-14);
  check_relative(sidak_level(0.01, 1'000'000), 1.0050335802996816e-8, 1e-14);
  check_relative(sidak_level(0.01, 1), 0.01, 1e-15);
  check_relative(sidak_p(sidak_level(0.01, 3072), 3072), 0.01, 1e-13);
  CHECK(sidak_p(1, 5) == 1);
}

}  // namespace meander
