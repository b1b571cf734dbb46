#include "stats/log_histogram.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace meander {

TEST_CASE("quantiles are the exact ones within half a bin") {
  std::mt19937_64 random(1);
  std::lognormal_distribution<double> heavy(0, 2);
  std::vector<double> values;
  LogHistogram histogram;
  for (int i = 0; i < 200000; ++i) {
    values.push_back(heavy(random));
    histogram.add(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double q : {0.001, 0.25, 0.5, 0.9, 0.99, 0.9999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
    CHECK(histogram.quantile(q) == doctest::Approx(values[rank - 1]).epsilon(0.011));
  }
  CHECK(histogram.largest() == values.back());
  CHECK(histogram.quantile(1) <= values.back());
  CHECK(histogram.count() == values.size());
}

TEST_CASE("a quantile is the smallest value that enough values do not exceed") {
  LogHistogram histogram;
  for (int i = 0; i < 9999; ++i) histogram.add(1);
  histogram.add(1000);
  CHECK(histogram.quantile(0.9999) == doctest::Approx(1).epsilon(0.011));
  CHECK(histogram.quantile(0.99991) == doctest::Approx(1000).epsilon(0.011));
  histogram.add(1000);
  CHECK(histogram.quantile(0.9999) == doctest::Approx(1000).epsilon(0.011));
}

TEST_CASE("zeros, negatives, NaN and the far ends count") {
  LogHistogram histogram;
  CHECK(histogram.quantile(0.5) == 0);
  for (const double value : {0.0, -3.0, std::numeric_limits<double>::quiet_NaN(), 1e-12})
    histogram.add(value);
  CHECK(histogram.count() == 4);
  CHECK(histogram.quantile(1) == 0);
  histogram.add(1e30);
  CHECK(histogram.count() == 5);
  CHECK(histogram.largest() == 1e30);
  CHECK(histogram.quantile(0.8) == 0);
  CHECK(histogram.quantile(1) > 1e13);
}

TEST_CASE("histograms merge to that of all values") {
  LogHistogram odd;
  LogHistogram even;
  LogHistogram all;
  for (int i = 1; i <= 1000; ++i) {
    (i % 2 ? odd : even).add(i);
    all.add(i);
  }
  odd.merge(even);
  CHECK(odd.count() == 1000);
  CHECK(odd.largest() == 1000);
  for (const double q : {0.1, 0.5, 0.999}) CHECK(odd.quantile(q) == all.quantile(q));
}

}  // namespace meander
