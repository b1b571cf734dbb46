#include "stats/rectangle.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/random.h"
#include "stats/distributions.h"
#include "stats/moments.h"

using namespace meander;

namespace {

struct Picture {
  Image radiance{5, 4, 4};
  Image variance{5, 4, 4};
};

// Pixels of `samples` draws each, of their own spread, around mean 1.
Picture draw(std::uint64_t seed, int samples) {
  Picture picture;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      Random random = stream(seed, static_cast<std::uint32_t>(5 * y + x), 0);
      Moments moments;
      for (int k = 0; k < samples; ++k) {
        const double sum = double{random.next()} + double{random.next()} + double{random.next()};
        moments.add(1 + (1 + x) * (sum - 1.5));
      }
      for (int c = 0; c < 3; ++c) {
        picture.radiance.at(x, y)[c] = static_cast<float>(moments.mean);
        picture.variance.at(x, y)[c] = static_cast<float>(moments.variance() / samples);
      }
      picture.radiance.at(x, y)[3] = static_cast<float>(samples);
    }
  }
  return picture;
}

}  // namespace

TEST_CASE("Student's t against tabulated quantiles") {
  CHECK(student_threshold(0.05, 1) == doctest::Approx(12.7062047364).epsilon(1e-9));
  CHECK(student_threshold(0.05, 4) == doctest::Approx(2.7764451052).epsilon(1e-9));
  CHECK(student_threshold(0.01, 10) == doctest::Approx(3.1692726726).epsilon(1e-9));
  CHECK(student_threshold(0.05, 1e9) == doctest::Approx(two_sided_threshold(0.05)).epsilon(1e-6));
  CHECK(student_two_sided_p(0, 3) == 1);
  CHECK(student_two_sided_p(std::sqrt(3.0), 1) == doctest::Approx(1.0 / 3));  // Cauchy
  for (const double degrees : {0.5, 2.5, 30.0, 4000.0})
    for (const double p : {0.9, 0.05, 1e-6})
      CHECK(student_two_sided_p(student_threshold(p, degrees), degrees) == doctest::Approx(p).epsilon(1e-8));
}

TEST_CASE("the mean of a rectangle by hand") {
  Picture picture;
  for (int x = 0; x < 2; ++x) {
    picture.radiance.at(1 + x, 2)[0] = x == 0 ? 1.0f : 3.0f;
    picture.variance.at(1 + x, 2)[0] = 0.25f;
    picture.radiance.at(1 + x, 2)[3] = 3;
  }
  const RectangleMean mean = rectangle_mean(picture.radiance, picture.variance, {1, 2, 3, 3});
  CHECK(mean.pixels == 2);
  CHECK(mean.mean[0] == 2);
  // Two pixels of two degrees of freedom each and equal variances make four.
  CHECK(mean.half_width[0] == doctest::Approx(2.7764451052 * std::sqrt(0.5) / 2));
  CHECK(mean.half_width[1] == 0);
}

TEST_CASE("a rectangle is clipped, and one sample has no error") {
  const Picture picture = draw(0, 1);
  const RectangleMean mean = rectangle_mean(picture.radiance, picture.variance, {-7, -7, 2, 70});
  CHECK(mean.pixels == 8);
  CHECK(std::isinf(mean.half_width[0]));
  CHECK(rectangle_mean(picture.radiance, picture.variance, {5, 0, 9, 4}).pixels == 0);
}

TEST_CASE("the 95 % interval covers at its rate, and more where pixels have few samples") {
  // The rates are what 100 000 intervals cover: Welch's and Satterthwaite's degrees of freedom are too few
  // for pixels of one or three each, which errs on the safe side.
  for (const auto& [samples, rate] : {std::pair(2, 0.9707), std::pair(4, 0.9542), std::pair(16, 0.95)}) {
    int covered = 0;
    constexpr int kIntervals = 2000;
    for (int i = 0; i < kIntervals; ++i) {
      const Picture picture = draw(static_cast<std::uint64_t>(1000 * samples + i), samples);
      const RectangleMean mean = rectangle_mean(picture.radiance, picture.variance, {0, 0, 5, 4});
      covered += std::abs(mean.mean[1] - 1) <= mean.half_width[1];
    }
    // Four standard deviations of the binomial.
    CAPTURE(samples);
    const double slack = 4 * std::sqrt((1 - rate) * rate / kIntervals);
    CHECK(std::abs(covered / static_cast<double>(kIntervals) - rate) < slack);
  }
}
