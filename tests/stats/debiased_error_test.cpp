#include "stats/debiased_error.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

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
  // Pixel 1: (1.5 - 1)^2 - 0.05 = 0.2; pixel 2: (2 - 2.5)^2 - 0.0625 = 0.1875; both over 1.75^2 + 1e-4, of
  // the mean of 1 and 2.5.
  const DebiasedError error = debiased_error(grey({1.5f, 2.0f}), grey({1.0f, 2.5f}, {0.05f, 0.0625f}));
  const double square = 1.75 * 1.75 + floor;
  const double first = 0.2 / square;
  const double second = 0.1875 / square;
  CHECK(error.mse == doctest::Approx((first + second) / 2).epsilon(1e-6));
  CHECK(error.standard_error == doctest::Approx(std::abs(first - second) / 2).epsilon(1e-6));
  REQUIRE(error.reference_mse);
  CHECK(*error.reference_mse == doctest::Approx((0.05 + 0.0625) / 2 / square).epsilon(1e-6));
  CHECK(error.pixels == 2);
  CHECK(error.rms() == doctest::Approx(std::sqrt(error.mse)));
  CHECK(error.rms_high() ==
        doctest::Approx(std::sqrt(error.mse + 1.96 * error.standard_error)).epsilon(1e-4));
  CHECK(error.rms_low() == doctest::Approx(std::sqrt(error.mse - 1.96 * error.standard_error)).epsilon(1e-4));
}

TEST_CASE("the weights' mean runs over the counted pixels among 3 x 3") {
  // One pixel counts, off by 0.3; then its neighbour, too, which is right; the third is out of reach.
  const Image a = grey({1.3f, 3.0f, 8.0f});
  const Image reference = grey({1.0f, 3.0f, 8.0f});
  const auto mse = [&](std::vector<std::uint8_t> mask) { return debiased_error(a, reference, mask).mse; };
  CHECK(mse({1, 0, 0}) == doctest::Approx(0.09 / (1 + 1e-4)).epsilon(1e-5));
  CHECK(mse({1, 1, 0}) == doctest::Approx(0.09 / (4 + 1e-4) / 2).epsilon(1e-5));
  CHECK(mse({1, 0, 1}) == doctest::Approx(0.09 / (1 + 1e-4) / 2).epsilon(1e-5));
  CHECK(mse({1, 1, 1}) == doctest::Approx(0.09 / (4 + 1e-4) / 3).epsilon(1e-5));
}

TEST_CASE("no pixel has no error, and one has no interval") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const DebiasedError none = debiased_error(grey({nan}), grey({1.0f}, {0.01f}));
  CHECK(none.pixels == 0);
  CHECK(std::isnan(none.mse));
  for (const double value : {none.rms(), none.rms_low(), none.rms_high(), none.reference_rms()})
    CHECK(std::isnan(value));
  CHECK_FALSE(none.reference_is_a_third());
  const DebiasedError one = debiased_error(grey({1.5f}), grey({1.0f}));
  CHECK(one.rms() == doctest::Approx(0.5).epsilon(1e-3));
  CHECK(std::isnan(one.rms_low()));
  CHECK(std::isnan(one.rms_high()));
}

TEST_CASE("without variance nothing is subtracted, and nothing is claimed of the reference") {
  const DebiasedError error = debiased_error(grey({1.5f}), grey({1.0f}));
  CHECK(error.mse == doctest::Approx(0.25 / (1 + 1e-4)));
  CHECK_FALSE(error.reference_mse);
  CHECK_FALSE(error.reference_is_a_third());
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

TEST_CASE("the reference's own error is held against a third of the other") {
  // v = 0.01; the debiased square is d^2 - v.
  CHECK(debiased_error(grey({1.3163f}), grey({1.0f}, {0.01f})).reference_is_a_third());
  CHECK_FALSE(debiased_error(grey({1.3161f}), grey({1.0f}, {0.01f})).reference_is_a_third());
}

TEST_CASE("an error below nothing is shown as 0") {
  const DebiasedError error = debiased_error(grey({1.0f}), grey({1.0f}, {0.04f}));
  CHECK(error.mse < 0);
  CHECK(error.rms() == 0);
  CHECK_FALSE(error.reference_is_a_third());
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
  // What is left of the noise in the weights, a ninth of the reference's variance, adds less than a
  // hundredth.
  CHECK(error.mse == doctest::Approx(0.01).epsilon(0.03));
  // The standard deviation of the mean of three d^2, d of variance 0.0125: 0.0125 sqrt(2 / 3) over 200.
  CHECK(error.standard_error == doctest::Approx(0.0125 * std::sqrt(2.0 / 3) / 200).epsilon(0.1));
  CHECK(*error.reference_mse == doctest::Approx(0.0025).epsilon(0.03));
}

TEST_CASE("a reference of two samples a pixel does not blow the error up") {
  // Truth 1; samples are exponential, so that means of two come near 0. The image has mse 1 / 64.
  std::mt19937 random(1);
  std::exponential_distribution<float> sample;
  Image a(200, 200, 3);
  Image reference(200, 200, 6);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int k = 0; k < 64; ++k) sum += sample(random);
        a.at(x, y)[c] = sum / 64;
        const float one = sample(random);
        const float other = sample(random);
        reference.at(x, y)[c] = 0.5f * (one + other);
        reference.at(x, y)[c + 3] = 0.25f * (one - other) * (one - other);
      }
  const DebiasedError error = debiased_error(a, reference);
  // No bright pixel outweighs the others; with r^2 for m^2 it comes out in the hundreds.
  CHECK(std::abs(error.mse) < 0.25);
  CHECK(*error.reference_mse == doctest::Approx(0.5).epsilon(0.25));
  CHECK_FALSE(error.reference_is_a_third());
}

}  // namespace meander
