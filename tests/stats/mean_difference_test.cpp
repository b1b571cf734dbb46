// The mean signed error and what its standard error says.
#include <doctest/doctest.h>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "math/random.h"
#include "stats/image_error.h"

namespace meander {
namespace {

// 2 x 1 pixels: their values, then their variances if there are any.
Image pair_image(const std::vector<float>& values, const std::vector<float>& variances) {
  const int channels = variances.empty() ? 3 : 6;
  Image image(2, 1, channels);
  for (int i = 0; i < 6; ++i) {
    image.at(i / 3, 0)[i % 3] = values[i];
    if (channels == 6) image.at(i / 3, 0)[i % 3 + 3] = variances[i];
  }
  return image;
}

// d = 0.5 0 0.25 | -1 0 0.
const std::vector<float> kA = {1.5f, 2, 0.25f, 3, -1, 2};
const std::vector<float> kB = {1, 2, 0, 4, -1, 2};
// Sums 0.09 0.16 0.04 | 0.16 0.16 0.16, whose roots are 0.3 0.4 0.2 | 0.4 0.4 0.4.
const std::vector<float> kVarianceA = {0.04f, 0.01f, 0, 0.05f, 0.15f, 0.09f};
const std::vector<float> kVarianceB = {0.05f, 0.15f, 0.04f, 0.11f, 0.01f, 0.07f};

double normal_sample(Random& random) {  // Box & Muller 1958
  const double radius = std::sqrt(-2 * std::log(1 - double{random.next()}));
  return radius * std::cos(2 * std::numbers::pi * random.next());
}

// 8 x 8 pixels about 1 with a standard deviation of 0.1 to 0.4; the channels share their noise or do not.
Image noisy_image(std::uint64_t seed, bool shared) {
  Image image(8, 8, 6);
  for (std::uint32_t pixel = 0; pixel < 64; ++pixel) {
    Random random = stream(seed, pixel, 0);
    const double deviation = 0.1 * (1 + pixel % 4);
    double noise = normal_sample(random);
    for (int channel = 0; channel < 3; ++channel) {
      image.values[pixel * 6 + channel] = static_cast<float>(1 + deviation * noise);
      image.values[pixel * 6 + channel + 3] = static_cast<float>(deviation * deviation);
      if (!shared) noise = normal_sample(random);
    }
  }
  return image;
}

}  // namespace

TEST_CASE("The mean difference and its errors from the variances of both are the hand-computed ones") {
  const MeanDifference m = mean_difference(pair_image(kA, kVarianceA), pair_image(kB, kVarianceB));
  CHECK(m.source == ErrorSource::both_variances);
  CHECK(m.mean == doctest::Approx(-0.25 / 6).epsilon(1e-14));
  CHECK(m.channel_mean[0] == doctest::Approx(-0.25));
  CHECK(m.channel_mean[1] == 0);
  CHECK(m.channel_mean[2] == doctest::Approx(0.125));
  // sqrt(0.09 + 0.16) / 2, sqrt(0.32) / 2, sqrt(0.2) / 2.
  CHECK(m.channel_standard_error[0] == doctest::Approx(0.25).epsilon(1e-6));
  CHECK(m.channel_standard_error[1] == doctest::Approx(std::sqrt(0.32) / 2).epsilon(1e-6));
  CHECK(m.channel_standard_error[2] == doctest::Approx(std::sqrt(0.2) / 2).epsilon(1e-6));
  // Correlated channels: sqrt(0.9^2 + 1.2^2) / 6 = 1.5 / 6.
  CHECK(m.standard_error == doctest::Approx(0.25).epsilon(1e-6));
}

TEST_CASE("One image's variances are used alone") {
  const MeanDifference of_a = mean_difference(pair_image(kA, kVarianceA), pair_image(kB, {}));
  CHECK(of_a.source == ErrorSource::variance_of_a);
  CHECK(of_a.channel_standard_error[0] == doctest::Approx(0.3 / 2).epsilon(1e-6));  // sqrt(0.04 + 0.05) / 2
  CHECK(of_a.channel_standard_error[1] == doctest::Approx(0.4 / 2).epsilon(1e-6));  // sqrt(0.01 + 0.15) / 2
  const MeanDifference of_b = mean_difference(pair_image(kA, {}), pair_image(kB, kVarianceB));
  CHECK(of_b.source == ErrorSource::variance_of_b);
  CHECK(of_b.channel_standard_error[0] == doctest::Approx(0.4 / 2).epsilon(1e-6));  // sqrt(0.05 + 0.11) / 2
  CHECK(of_b.channel_standard_error[1] == doctest::Approx(0.4 / 2).epsilon(1e-6));  // sqrt(0.15 + 0.01) / 2
}

TEST_CASE("Without variances the error is that of the spread over pixels") {
  const MeanDifference m = mean_difference(pair_image(kA, {}), pair_image(kB, {}));
  CHECK(m.source == ErrorSource::spread);
  // Two values x and y have the standard error |x - y| / 2. Pixels: 0.75 / 3 and -1 / 3.
  CHECK(m.standard_error == doctest::Approx((0.25 + 1.0 / 3) / 2).epsilon(1e-12));
  CHECK(m.channel_standard_error[0] == doctest::Approx(0.75).epsilon(1e-12));
  CHECK(m.channel_standard_error[1] == 0);
  CHECK(m.channel_standard_error[2] == doctest::Approx(0.125).epsilon(1e-12));
  const std::vector<std::uint8_t> first = {1, 0};
  const MeanDifference one = mean_difference(pair_image(kA, {}), pair_image(kB, {}), first);
  CHECK(one.mean == doctest::Approx(0.25).epsilon(1e-12));
  CHECK(std::isnan(one.standard_error));
  CHECK(std::isnan(one.channel_standard_error[0]));
}

TEST_CASE(
    "Values that are not finite are left out of the mean difference, bad variances make its error NaN") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> broken = kA;
  broken[3] = nan;
  const MeanDifference m = mean_difference(pair_image(broken, kVarianceA), pair_image(kB, kVarianceB));
  CHECK(m.mean == doctest::Approx(0.75 / 5).epsilon(1e-12));
  CHECK(m.channel_standard_error[0] == doctest::Approx(0.3).epsilon(1e-6));
  CHECK(m.standard_error == doctest::Approx(std::sqrt(0.81 + 0.64) / 5).epsilon(1e-6));
  for (const float bad : {nan, -1.0f, std::numeric_limits<float>::infinity()}) {
    std::vector<float> variances = kVarianceA;
    variances[0] = bad;
    const MeanDifference other = mean_difference(pair_image(kA, variances), pair_image(kB, kVarianceB));
    CHECK(std::isnan(other.standard_error));
    CHECK(std::isnan(other.channel_standard_error[0]));
    CHECK(other.channel_standard_error[1] == doctest::Approx(std::sqrt(0.32) / 2).epsilon(1e-6));
  }
}

TEST_CASE("The standard error of the mean difference is as large as its scatter, and never smaller") {
  // 400 pairs of one expectation. Where the error is right, the sum of (mean / error)^2 is chi-squared with
  // 400 degrees of freedom: 400 +- 94 holds with probability 0.999. Channels that share their noise are fully
  // correlated, so the overall error is right too; independent ones have a third of its square.
  double channel = 0;
  double shared = 0;
  double independent = 0;
  for (std::uint64_t pair = 0; pair < 400; ++pair) {
    const MeanDifference s = mean_difference(noisy_image(2 * pair, true), noisy_image(2 * pair + 1, true));
    const MeanDifference i = mean_difference(noisy_image(2 * pair, false), noisy_image(2 * pair + 1, false));
    channel += std::pow(i.channel_mean[2] / i.channel_standard_error[2], 2);
    shared += std::pow(s.mean / s.standard_error, 2);
    independent += std::pow(i.mean / i.standard_error, 2);
  }
  MESSAGE("mean squared z: channel ", channel / 400, ", shared ", shared / 400, ", independent ",
          independent / 400);
  CHECK(std::abs(channel - 400) < 94);
  CHECK(std::abs(shared - 400) < 94);
  CHECK(std::abs(3 * independent - 400) < 94);
}

}  // namespace meander
