#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "math/random.h"
#include "stats/image_error.h"
#include "stats/moments.h"

namespace meander {
namespace {

double normal_sample(Random& random) {  // Box & Muller 1958
  const double radius = std::sqrt(-2 * std::log(1 - double{random.next()}));
  return radius * std::cos(2 * std::numbers::pi * random.next());
}

// `rare`: a hundredth of the samples is bright and carries nearly all the variance. Skewness 20, as in a
// quarter of the 8 x 8 blocks of jade under a small lamp, whose samples deviate as much, 0.9 of their mean.
enum class Noise { normal, exponential, rare };

double exponential_sample(Random& random) { return -std::log(1 - double{random.next()}); }

double noise_sample(Noise noise, Random& random) {
  constexpr double kChance = 0.01;
  switch (noise) {
    case Noise::normal:
      return normal_sample(random);
    case Noise::exponential:
      return exponential_sample(random) - 1;
    case Noise::rare:
      break;
  }
  // Spread evenly with variance 0.01; the bright ones have variance 0.99.
  const double even = 0.1 * std::sqrt(12.0) * (double{random.next()} - 0.5);
  const double size = std::sqrt(0.99 / (kChance * (2 - kChance)));
  const double bright = random.next() < kChance ? exponential_sample(random) : 0;
  return even + size * (bright - kChance);
}

struct Render {
  int size = 32;
  int spp = 8;
  double scale = 1;           // of every sample
  double relative_noise = 1;  // of one sample
  Noise noise = Noise::normal;
};

// Pixel (x, y) has expectation 0.2 + x + 2 y over the size; its samples have the noise of the plan, of mean 0
// and variance 1.
Image render(const Render& plan, std::uint64_t seed) {
  Image image(plan.size, plan.size, 6);
  for (int y = 0; y < plan.size; ++y) {
    for (int x = 0; x < plan.size; ++x) {
      Random random = stream(seed, static_cast<std::uint32_t>(y * plan.size + x), 0);
      const double expectation = 0.2 + double(x + 2 * y) / plan.size;
      for (int channel = 0; channel < 3; ++channel) {
        Moments moments;
        for (int i = 0; i < plan.spp; ++i) {
          moments.add(plan.scale * expectation *
                      (1 + plan.relative_noise * noise_sample(plan.noise, random)));
        }
        image.at(x, y)[channel] = static_cast<float>(moments.mean);
        image.at(x, y)[channel + 3] = static_cast<float>(moments.variance() / plan.spp);
      }
    }
  }
  return image;
}

Image constant_image(int size, float value, float variance) {
  Image image(size, size, 6);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = i % 6 < 3 ? value : variance;
  return image;
}

void shift_pixel(Image& image, int x, int y, float by) {
  for (int channel = 0; channel < 3; ++channel) image.at(x, y)[channel] += by;
}

}  // namespace

TEST_CASE("The z-test's false alarms come as often as its level says") {
  // 400 pairs that share their expectation. At level 0.1 the count of alarms is binomial(400, 0.1), at 0.01
  // binomial(400, 0.01): the bounds hold with probability 0.999 each (0.1 on both sides, 0.01 from above).
  int alarms_at_tenth = 0;
  int alarms_at_hundredth = 0;
  double worst_fraction = 0;
  for (std::uint64_t pair = 0; pair < 400; ++pair) {
    const Image a = render({}, 2 * pair);
    const Image b = render({}, 2 * pair + 1);
    ZTestOptions options;
    const ZTest test = z_test(a, b, {}, options);
    alarms_at_hundredth += !test.passed;
    worst_fraction = std::max(worst_fraction, test.failed_fraction);
    options.alpha = 0.1;
    alarms_at_tenth += !z_test(a, b, {}, options).passed;
  }
  MESSAGE("false alarms of 400: ", alarms_at_tenth, " at 0.1, ", alarms_at_hundredth, " at 0.01");
  CHECK(alarms_at_tenth >= 22);
  CHECK(alarms_at_tenth <= 60);
  CHECK(alarms_at_hundredth <= 11);
  CHECK(worst_fraction <= 0.0025);
}

TEST_CASE("Skewed noise of few samples against a much better reference raises few false alarms") {
  // The normal thresholds are approximate here: 5 of 100 is five times the nominal 0.01.
  int alarms = 0;
  for (std::uint64_t pair = 0; pair < 100; ++pair) {
    const Image a = render({32, 8, 1, 1, Noise::exponential}, 2 * pair);
    const Image b = render({32, 256, 1, 1, Noise::exponential}, 2 * pair + 1);
    alarms += !z_test(a, b).passed;
  }
  MESSAGE("false alarms of 100: ", alarms);
  CHECK(alarms <= 5);
}

TEST_CASE("Blocks that missed the rare bright samples raise no more alarms than the level says") {
  // With a block's own variance alone all 200 fail. A binomial(200, 0.01) is at most 6 in 99.6 of
  // 100 cases.
  const Render few{64, 8, 1, 0.9, Noise::rare};
  const Render many{64, 512, 1, 0.9, Noise::rare};
  const Image reference = render(many, 1);
  int alarms = 0;
  int brighter_found = 0;
  for (std::uint64_t seed = 2; seed < 202; ++seed) {
    const Image a = render(few, seed);
    const ZTest test = z_test(a, reference);
    alarms += !test.passed;
    const ZTest swapped = z_test(reference, a);
    CHECK(swapped.worst_block_z == doctest::Approx(-test.worst_block_z).epsilon(1e-9));
    CHECK(swapped.passed == test.passed);
    Render brighter = few;
    brighter.scale = 1.03;
    brighter_found += seed < 22 && !z_test(render(brighter, seed), reference).image_passed;
  }
  MESSAGE("false alarms of 200: ", alarms, "; 3 % brighter found in ", brighter_found, " of 20");
  CHECK(alarms <= 6);
  CHECK(brighter_found == 20);
}

TEST_CASE("A 3 % brighter image fails at 8 samples although no single pixel shows it") {
  const Render plan{64, 8, 1, 0.5};
  Render brighter = plan;
  brighter.scale = 1.03;
  const ZTest test = z_test(render(brighter, 1), render(plan, 2));
  CHECK(test.pixels_passed);
  CHECK_FALSE(test.image_passed);
  CHECK_FALSE(test.passed);
  CHECK(test.image_p < 1e-4);
  for (const double z : test.image_z) CHECK(z > 3.5);
}

TEST_CASE("The scores that are drawn are those that are judged") {
  const Render plan{32, 8, 1, 0.5};
  Image a = render(plan, 5);
  const Image b = render(plan, 6);
  shift_pixel(a, 13, 22, 3);  // block (1, 2)
  const ZTest test = z_test(a, b);
  const ZScores scores = z_scores(a, b);
  CHECK(scores.blocks.width == 4);
  const auto largest = [](const Image& z) {
    return *std::ranges::max_element(z.values, {}, [](float value) { return std::abs(value); });
  };
  CHECK(largest(scores.values) == doctest::Approx(test.worst_pixel_z));
  CHECK(largest(scores.blocks) == doctest::Approx(test.worst_block_z));
  const float* pixel = scores.values.at(13, 22);
  CHECK(*std::max_element(pixel, pixel + 3) == largest(scores.values));
}

namespace {

// One block 30 % too bright and another as much too dark.
void shift_two_blocks(Image& image) {
  for (int y = 8; y < 16; ++y) {
    for (int x = 8; x < 16; ++x) {
      const float shift = 0.3f * image.at(x, y)[0];
      shift_pixel(image, x, y, shift);
      shift_pixel(image, x + 32, y, -shift);
    }
  }
}

}  // namespace

TEST_CASE("A region that is off fails by its blocks while the image mean holds") {
  const Render plan{64, 8, 1, 0.5};
  Image a = render(plan, 3);
  shift_two_blocks(a);
  const ZTest test = z_test(a, render(plan, 4));
  CHECK(test.pixels_passed);
  CHECK(test.image_passed);
  CHECK_FALSE(test.blocks_passed);
  CHECK_FALSE(test.passed);
}

TEST_CASE("A region that is off fails by its blocks beside a firefly in another block") {
  const Render plan{64, 8, 1, 0.5};
  for (std::uint64_t pair = 1; pair <= 10; ++pair) {
    CAPTURE(pair);
    Image a = render(plan, 2 * pair + 1);
    shift_two_blocks(a);
    for (int channel = 0; channel < 3; ++channel) {
      a.at(60, 60)[channel] += 100;
      a.at(60, 60)[channel + 3] = 1e4f;
    }
    const ZTest test = z_test(a, render(plan, 2 * pair + 2));
    CHECK(test.image_passed);
    CHECK_FALSE(test.blocks_passed);
    CHECK_FALSE(test.passed);
  }
}

TEST_CASE("The p-value is the least level at which the test fails") {
  const auto turns_at_p = [](const Image& a, const Image& b) {
    const double p = z_test(a, b).p;
    REQUIRE(p > 0);
    REQUIRE(p < 0.99);
    CHECK(z_test(a, b, {}, {.alpha = 0.999 * p}).passed);
    CHECK_FALSE(z_test(a, b, {}, {.alpha = 1.001 * p}).passed);
    return p;
  };
  // By blocks or the image, and by values: of 3072 three pixels of 5 sigma are more than the 7 allowed.
  for (std::uint64_t pair = 0; pair < 10; ++pair) turns_at_p(render({}, 2 * pair), render({}, 2 * pair + 1));
  const Image b = constant_image(32, 1, 0.005f);
  Image a = b;
  for (int i = 0; i < 3; ++i) shift_pixel(a, 8 * i, 0, 0.5f);
  const double p = turns_at_p(a, b);
  CHECK(p == doctest::Approx(z_test(a, b).pixels_p));
  CHECK(p < z_test(a, b).block_p);
}

TEST_CASE("Images that are equal pass") {
  const Image image = render({}, 5);
  const ZTest test = z_test(image, image);
  CHECK(test.passed);
  CHECK(test.values == 32 * 32 * 3);
  CHECK(test.worst_pixel_z == 0);
  CHECK(test.worst_block_z == 0);
  CHECK(test.block_p == 1);
  CHECK(test.image_p == 1);
  CHECK(test.pixels_p == 1);
  CHECK(test.p == 1);
}

TEST_CASE(
    "A few outlying pixels are tolerated, as the 99.75 % rule says, but neither many nor one that shifts its "
    "block") {
  const Image b = constant_image(32, 1, 0.005f);  // the difference of a pixel has standard deviation 0.1
  const auto shifted = [&](int pixels, float sigmas) {
    Image a = b;
    for (int i = 0; i < pixels; ++i) shift_pixel(a, i % 4 * 8, i / 4 * 8, 0.1f * sigmas);
    return z_test(a, b);
  };
  SUBCASE("One pixel of 1024 by 20 sigma: 3 values of 3072, at most 7 may fail") {
    const ZTest test = shifted(1, 20);
    CHECK(test.failed_fraction == doctest::Approx(3.0 / 3072).epsilon(1e-12));
    CHECK(test.worst_pixel_z == doctest::Approx(20).epsilon(1e-4));
    CHECK(test.worst_block_z == doctest::Approx(20.0 / 8).epsilon(1e-4));
    CHECK(test.image_z[1] == doctest::Approx(20.0 / 32).epsilon(1e-4));
    CHECK(test.passed);
  }
  SUBCASE("Three pixels by 20 sigma are 9 values") {
    const ZTest test = shifted(3, 20);
    CHECK_FALSE(test.pixels_passed);
    CHECK(test.blocks_passed);
    CHECK_FALSE(test.passed);
  }
  SUBCASE("One pixel by 60 sigma shifts its block by 7.5") {
    const ZTest test = shifted(1, 60);
    CHECK(test.pixels_passed);
    CHECK_FALSE(test.blocks_passed);
    CHECK_FALSE(test.passed);
  }
}

TEST_CASE("Furnace images without variance pass within rounding and fail 1e-3 apart") {
  const Image one = constant_image(32, 1, 0);
  CHECK(z_test(one, one).passed);
  CHECK(z_test(constant_image(32, 1.000002f, 0), one).passed);
  for (const float off : {1.00003f, 1.001f, 0.999f}) {
    const ZTest test = z_test(constant_image(32, off, 0), one);
    CHECK_FALSE(test.pixels_passed);
    CHECK_FALSE(test.blocks_passed);
    CHECK_FALSE(test.image_passed);
  }
  CHECK(z_test(Image(8, 8, 6), Image(8, 8, 6)).passed);
}

TEST_CASE("Values so dim that their variance is stored as 0 are not taken for certain") {
  // Of these values no variance below their square can be stored in single precision.
  const Image dim = constant_image(32, 7e-25f, 0);
  CHECK(z_test(constant_image(32, 1.9e-24f, 0), dim).passed);
  CHECK_FALSE(z_test(constant_image(32, 1e-15f, 0), dim).passed);
}

TEST_CASE("A mask confines the test to what it counts") {
  const Image b = constant_image(16, 1, 0);
  Image a = b;
  std::vector<std::uint8_t> mask(16 * 16, 1);
  for (int i = 0; i < 16; ++i) {
    shift_pixel(a, i, i, 1);
    mask[17 * i] = 0;
  }
  CHECK_FALSE(z_test(a, b).passed);
  CHECK(z_test(a, b, mask).passed);
  CHECK(z_test(a, b, mask).values == (16 * 16 - 16) * 3);
}

TEST_CASE("Blocks that a mask leaves nearly empty are judged together") {
  // Two counted pixels a block: 32 values a channel, one pooled block. Each is shifted by 2 of its sigma.
  const Image b = constant_image(32, 1, 0.005f);
  Image a = b;
  std::vector<std::uint8_t> mask(32 * 32, 0);
  for (int i = 0; i < 32; ++i) {
    const int x = i % 4 * 8 + i / 16;
    const int y = i / 4 % 4 * 8;
    mask[y * 32 + x] = 1;
    shift_pixel(a, x, y, 0.2f);
  }
  CHECK(z_test(a, b, mask).worst_block_z == doctest::Approx(2 * std::sqrt(32.0)).epsilon(1e-4));
}

TEST_CASE("A value or variance that is not finite fails the z-test") {
  const Image good = constant_image(8, 1, 0.01f);
  for (const int channel : {0, 3, 4}) {
    Image bad = good;
    bad.at(3, 3)[channel] = std::numeric_limits<float>::quiet_NaN();
    CHECK(z_test(bad, good).non_finite == 1);
    CHECK(z_test(bad, good).p == 0);
    CHECK_FALSE(z_test(bad, good).passed);
    CHECK_FALSE(z_test(good, bad).passed);
  }
}

TEST_CASE("An image without variances is refused") {
  CHECK_THROWS_WITH_AS((void)z_test(Image(8, 8, 3), Image(8, 8, 6)),
                       "the image has 3 channels where 6 are needed: R G B and the variance of each", Error);
}

}  // namespace meander
