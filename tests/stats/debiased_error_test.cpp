#include "stats/debiased_error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>

namespace meander {
namespace {

Image grey(std::initializer_list<float> values, std::initializer_list<float> variances = {}) {
  const int channels = variances.size() > 0 ? 6 : 3;
  Image image(static_cast<int>(values.size()), 1, channels);
  int x = 0;
  for (const float value : values) {
    for (int c = 0; c < 3; ++c) image.at(x, 0)[c] = value;
    ++x;
  }
  x = 0;
  for (const float variance : variances) {
    for (int c = 3; c < 6; ++c) image.at(x, 0)[c] = variance;
    ++x;
  }
  return image;
}

}  // namespace

TEST_CASE("the debiased error of two pixels is what the formula gives by hand") {
  const double floor = 1e-4;
  // Pixel 1: (1.5 - 1)^2 - 0.05 = 0.2 over 1 + 1e-4; pixel 2: (2 - 2.5)^2 - 0.0625 = 0.1875 over 6.25 + 1e-4.
  const DebiasedError error = debiased_error(grey({1.5f, 2.0f}), grey({1.0f, 2.5f}, {0.05f, 0.0625f}));
  const double first = 0.2 / (1 + floor);
  const double second = 0.1875 / (6.25 + floor);
  CHECK(error.mse == doctest::Approx((first + second) / 2).epsilon(1e-6));
  CHECK(error.standard_error == doctest::Approx(std::abs(first - second) / 2).epsilon(1e-6));
  REQUIRE(error.reference_mse);
  CHECK(*error.reference_mse ==
        doctest::Approx((0.05 / (1 + floor) + 0.0625 / (6.25 + floor)) / 2).epsilon(1e-6));
  CHECK(error.pixels == 2);
  CHECK(error.rms() == doctest::Approx(std::sqrt(error.mse)));
  CHECK(error.rms_high() ==
        doctest::Approx(std::sqrt(error.mse + 1.96 * error.standard_error)).epsilon(1e-4));
  CHECK(error.rms_low() == 0);  // 0.115 - 1.96 * 0.085 is below 0
}

TEST_CASE("without variance nothing is subtracted, and nothing is claimed of the reference") {
  const DebiasedError error = debiased_error(grey({1.5f}), grey({1.0f}));
  CHECK(error.mse == doctest::Approx(0.25 / (1 + 1e-4)));
  CHECK_FALSE(error.reference_mse);
  CHECK_FALSE(error.reference_suffices());
  CHECK(error.standard_error == 0);
}

TEST_CASE("a mask restricts, and pixels that are not finite are left out") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::vector<std::uint8_t> mask{1, 0, 1, 1};
  const DebiasedError error =
      debiased_error(grey({1.5f, 9.0f, nan, 1.0f}), grey({1.0f, 1.0f, 1.0f, inf}), mask);
  CHECK(error.pixels == 1);
  CHECK(error.mse == doctest::Approx(0.25 / (1 + 1e-4)));
}

TEST_CASE("a reference suffices up to a third of the error") {
  // v = 0.01; the debiased square is d^2 - v.
  CHECK(debiased_error(grey({1.3163f}), grey({1.0f}, {0.01f})).reference_suffices());
  CHECK_FALSE(debiased_error(grey({1.3161f}), grey({1.0f}, {0.01f})).reference_suffices());
}

TEST_CASE("an error below nothing is shown as 0") {
  const DebiasedError error = debiased_error(grey({1.0f}), grey({1.0f}, {0.04f}));
  CHECK(error.mse < 0);
  CHECK(error.rms() == 0);
  CHECK_FALSE(error.reference_suffices());
}

TEST_CASE("the error of a noisy image against a noisy reference is its own") {
  // Truth 1, standard deviations 0.1 and 0.05: mse 0.01, where the plain square would give 0.0125.
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  Image a(200, 200, 3);
  Image reference(200, 200, 6);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      for (int c = 0; c < 3; ++c) {
        a.at(x, y)[c] = 1 + 0.1f * normal(random);
        reference.at(x, y)[c] = 1 + 0.05f * normal(random);
        reference.at(x, y)[c + 3] = 0.0025f;
      }
  const DebiasedError error = debiased_error(a, reference);
  // The noise in the weights adds a few hundredths: E r^-2 = 1 + 3 * 0.0025, and covariances of that order.
  CHECK(error.mse == doctest::Approx(0.01).epsilon(0.03));
  // The standard deviation of the mean of three d^2, d of variance 0.0125: 0.0125 sqrt(2 / 3) over 200.
  CHECK(error.standard_error == doctest::Approx(0.0125 * std::sqrt(2.0 / 3) / 200).epsilon(0.1));
  CHECK(*error.reference_mse == doctest::Approx(0.0025).epsilon(0.03));
}

}  // namespace meander
