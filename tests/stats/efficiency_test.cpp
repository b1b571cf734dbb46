#include "stats/efficiency.h"

#include <doctest/doctest.h>

#include <cmath>

namespace meander {

TEST_CASE("efficiency does not change with the time that an unbiased estimator runs") {
  CHECK(efficiency(0.04, 10) == doctest::Approx(2.5));
  CHECK(efficiency(0.01, 40) == doctest::Approx(2.5));
  CHECK(std::isnan(efficiency(0, 10)));
  CHECK(std::isnan(efficiency(-0.01, 10)));
  CHECK(std::isnan(efficiency(0.01, 0)));
}

TEST_CASE("noise falls as the root of the time") {
  CHECK(seconds_to_noise(3, 0.02, 0.01) == doctest::Approx(12));
  CHECK(seconds_to_noise(12, 0.005, 0.01) == doctest::Approx(3));
}

}  // namespace meander
