#include "stats/moments.h"

#include <doctest/doctest.h>
#include <cmath>
#include <initializer_list>

namespace meander {

TEST_CASE("Moments of a known set are its mean, variance and standard error") {
  Moments moments;
  for (const double value : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) moments.add(value);
  CHECK(moments.count == 8);
  CHECK(moments.mean == doctest::Approx(5).epsilon(1e-15));
  CHECK(moments.variance() == doctest::Approx(32.0 / 7).epsilon(1e-15));
  CHECK(moments.standard_error() == doctest::Approx(std::sqrt(4.0 / 7)).epsilon(1e-15));
}

TEST_CASE("Moments of fewer than two samples have no variance") {
  Moments moments;
  CHECK(moments.standard_error() == 0);
  moments.add(3);
  CHECK(moments.mean == 3);
  CHECK(moments.variance() == 0);
  CHECK(moments.standard_error() == 0);
}

TEST_CASE("Moments survive a large common offset") {
  Moments moments;
  for (int i = 0; i < 1000; ++i) moments.add(1e9 + i % 2);
  CHECK(moments.variance() == doctest::Approx(0.25 * 1000 / 999).epsilon(1e-9));
}

TEST_CASE("Merged moments equal those of all samples together") {
  Moments all, first, second, empty;
  for (int i = 0; i < 100; ++i) {
    const double value = std::sin(i * 1.7) + 0.01 * i;
    all.add(value);
    (i < 37 ? first : second).add(value);
  }
  first.merge(second);
  CHECK(first.count == 100);
  CHECK(first.mean == doctest::Approx(all.mean).epsilon(1e-14));
  CHECK(first.m2 == doctest::Approx(all.m2).epsilon(1e-14));
  first.merge(empty);
  CHECK(first.count == 100);
  empty.merge(first);
  CHECK(empty.mean == first.mean);
  CHECK(empty.m2 == first.m2);
}

}  // namespace meander
