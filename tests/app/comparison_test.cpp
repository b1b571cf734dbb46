// The limits of compare, each at its value and beyond it.
#include "app/comparison.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace meander {
namespace {

using Lines = std::vector<std::string>;

Image grey_image(const std::array<float, 4>& values) {
  Image image(2, 2, 3);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = values[i / 3];
  return image;
}

// d = 0 1 / -1 2: rmse sqrt(1.5), mean |b| 2, mae 1.
const Image kA = grey_image({1, 2, 3, 4});
const Image kB = grey_image({1, 1, 4, 2});

Lines failures(const CompareLimits& limits) { return compare_images(kA, kB, {}, limits).failures; }
Lines fails_pixels(const PixelLimits& fail) { return failures({.fail = fail}); }

Image with_variance(const Image& image, float variance) {
  Image result(image.width, image.height, 6);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.values[i] = i % 6 < 3 ? image.values[i / 6 * 3 + i % 6] : variance;
  return result;
}

}  // namespace

TEST_CASE("Without a limit images must be equal") {
  CHECK(failures({}) == Lines{"the images differ, at most by 2 (pixel 1,1 R), and no threshold allows it"});
  CHECK(compare_images(kA, kA, {}, {}).passed());
  // A warning decides nothing.
  CHECK(failures({.warn = {.each = 9}}).size() == 1);
}

TEST_CASE("A metric at its limit passes, beyond it the metric, its value and the option are named") {
  CHECK(failures({.max_rmse = 1.225}).empty());
  CHECK(failures({.max_rmse = 1.224}) == Lines{"rmse is 1.22474487, above --max-rmse 1.224"});
  CHECK(failures({.max_relative_rmse = 0.613}).empty());
  CHECK(failures({.max_relative_rmse = 0.612}) ==
        Lines{"relative_rmse is 0.612372436, above --max-relative-rmse 0.612"});
  CHECK(failures({.max_relmse = 0.516}).empty());
  CHECK(failures({.max_relmse = 0.515}) == Lines{"relmse is 0.515593655, above --max-relmse 0.515"});
  CHECK(failures({.max_mae = 1}).empty());
  CHECK(failures({.max_mae = 0.999}) == Lines{"mae is 1, above --max-mae 0.999"});
  CHECK(failures({.min_psnr = -1.77}).empty());
  CHECK(failures({.min_psnr = -1.76}) == Lines{"psnr is -1.76091259 dB, below --min-psnr -1.76"});
  CHECK(compare_images(kA, kA, {}, {.min_psnr = 1000}).passed());
  CHECK(failures({.max_rmse = 2, .max_mae = 0.5, .min_psnr = 0}).size() == 2);
}

TEST_CASE("fail counts pixels beyond it, fail-percent allows some, hard-fail none: |d| is 0 1 1 2") {
  CHECK(fails_pixels({.each = 2}).empty());
  CHECK(fails_pixels({.each = 1}) ==
        Lines{"1 of 4 pixels (25 %) differ by more than --fail 1, above --fail-percent 0"});
  CHECK(fails_pixels({.each = 1, .percent = 25}).empty());
  CHECK(fails_pixels({.each = 1, .percent = 24.9}).size() == 1);
  CHECK(fails_pixels({.percent = 75}).empty());
  CHECK(fails_pixels({.percent = 74}) ==
        Lines{"3 of 4 pixels (75 %) differ by more than --fail 0, above --fail-percent 74"});
  CHECK(fails_pixels({.any = 2}).empty());
  CHECK(fails_pixels({.any = 1.5}) ==
        Lines{"the largest difference is 2 (pixel 1,1 R), above --hard-fail 1.5"});
  CHECK(fails_pixels({.each = 1, .percent = 25, .any = 1.5}).size() == 1);
  CHECK(fails_pixels({.each = 1, .percent = 5, .any = 1.5}).size() == 2);
}

TEST_CASE("Warnings follow the same rules and fail nothing") {
  const auto warns = [](const PixelLimits& warn) {
    const Comparison c = compare_images(kA, kB, {}, {.fail = {.any = 2}, .warn = warn});
    CHECK(c.passed());
    return c.warnings;
  };
  CHECK(warns({}).empty());
  CHECK(warns({.each = 1}) ==
        Lines{"1 of 4 pixels (25 %) differ by more than --warn 1, above --warn-percent 0"});
  CHECK(warns({.each = 1, .percent = 25}).empty());
  CHECK(warns({.percent = 5}) ==
        Lines{"3 of 4 pixels (75 %) differ by more than --warn 0, above --warn-percent 5"});
  CHECK(warns({.any = 2}).empty());
  CHECK(warns({.any = 1}) == Lines{"the largest difference is 2 (pixel 1,1 R), above --hard-warn 1"});
}

TEST_CASE("Limits see the mask's pixels alone") {
  const std::vector<std::uint8_t> mask = {1, 1, 1, 0};  // leaves |d| = 0 1 1
  CHECK(compare_images(kA, kB, mask, {.fail = {.any = 1}}).passed());
  CHECK(compare_images(kA, kB, mask, {.fail = {.each = 0, .percent = 60}}).failures ==
        Lines{"2 of 3 pixels (66.67 %) differ by more than --fail 0, above --fail-percent 60"});
}

TEST_CASE("A value that is not finite fails whatever the limits allow") {
  Image broken = kA;
  broken.at(1, 0)[1] = std::numeric_limits<float>::quiet_NaN();
  broken.at(1, 1)[2] = std::numeric_limits<float>::infinity();
  const std::string line = "values that are not finite in A or B: 2";
  CHECK(compare_images(broken, kA, {}, {}).failures == Lines{line});
  CHECK(compare_images(kA, broken, {}, {.max_relmse = 1000}).failures == Lines{line});
  CHECK(compare_images(broken, kA, {}, {.fail = {.each = 9, .percent = 49}}).failures ==
        Lines{line, "2 of 4 pixels (50 %) differ by more than --fail 9, above --fail-percent 49"});
}

TEST_CASE("A z-test that fails says which of its tests, and which way A leans") {
  const Image b = with_variance(kB, 0.01f);
  CHECK(compare_images(b, b, {}, {.z_test = true}).passed());
  const Image brighter = with_variance(grey_image({1.3f, 1.3f, 4.3f, 2.3f}), 0.01f);
  // z = 0.3 * 4 / sqrt(4 * 0.02) = 4.243 for the one block and for the image: beyond the 3.143 of three tests
  // at half of 1 %, while a value alone has 2.121.
  const Comparison c = compare_images(brighter, b, {}, {.z_test = true});
  REQUIRE(c.failures.size() == 2);
  CHECK(c.failures[0].starts_with("z-test: a block is brighter in A, z 4.243 beyond 3.143 (p 6.6"));
  CHECK(c.failures[1].starts_with("z-test: the whole image is brighter in A, z 4.243 beyond 3.143 (p 6.6"));
  const Lines darker = compare_images(b, brighter, {}, {.z_test = true}).failures;
  REQUIRE(darker.size() == 2);
  CHECK(darker[1].starts_with("z-test: the whole image is darker in A, z -4.243 beyond 3.143"));
  // Other limits hold beside it.
  CHECK(compare_images(brighter, b, {}, {.max_mae = 0.2, .z_test = true}).failures.size() == 3);
}

TEST_CASE("A report without limits tells nothing of them") {
  const std::string text = comparison_text(compare_images(kA, kB, {}, {}));
  CHECK(text.find("beyond") == std::string::npos);
  CHECK(text.find("z_test") == std::string::npos);
  CHECK(text.find("noise") == std::string::npos);
  const std::string full = comparison_text(
      compare_images(with_variance(kA, 1), with_variance(kB, 1), {}, {.fail = {.each = 1}, .z_test = true}));
  CHECK(full.find("beyond_fail       1 pixels\n") != std::string::npos);
  CHECK(full.find("z_test            passed, p ") != std::string::npos);
  CHECK(full.find("result            FAILED\n") != std::string::npos);
}

TEST_CASE("A report says where the standard error comes from") {
  const Image a = with_variance(kA, 0.01f);
  const Image b = with_variance(kB, 0.01f);
  const auto says = [](const Image& x, const Image& y, const std::string& source) {
    const Comparison c = compare_images(x, y, {}, {});
    return comparison_text(c).find("(" + source + ")\n") != std::string::npos &&
           comparison_json(c).find("\"error_from\": \"" + source + "\"") != std::string::npos;
  };
  CHECK(says(a, b, "variances of A and B"));
  CHECK(says(a, kB, "variance of A alone"));
  CHECK(says(kA, b, "variance of B alone"));
  CHECK(says(kA, kB, "spread over pixels"));
}

TEST_CASE("A noise says of which pixels it is, and whether the variances are reliable") {
  const Image a = with_variance(kA, 0.01f);
  Comparison c = compare_images(a, a, {}, {});
  REQUIRE(c.noise_a.has_value());
  const double own = c.noise_a->relative;
  const auto shows = [&](const std::string& text) {
    return comparison_text(c).find(text) != std::string::npos ||
           comparison_json(c).find(text) != std::string::npos;
  };
  CHECK(shows(" (all 4 pixels)\n"));
  CHECK(shows("variance_a        reliable\n"));
  // What the render of the file has stored of its object's pixels stands in; nonsense does not.
  const auto stored = [](const char* noise, std::int64_t pixels) {
    return ImageAttributes{{{"meander/relative_noise", noise}}, {{"meander/noise_pixels", pixels}}};
  };
  for (const auto& [noise, pixels] : {std::pair("0.25", 0), {"0.25", 5}, {"nan", 3}, {"-1", 3}, {"", 3}}) {
    use_stored_noise(stored(noise, pixels), c.noise_a);
    CHECK(c.noise_a->relative == own);
    CHECK(c.noise_a->over == NoisePixels::all);
  }
  use_stored_noise(stored("0.25", 3), c.noise_a);
  CHECK(shows("relative_noise_a  0.25 (the object's 3 pixels)\n"));
  CHECK(shows("\"relative_noise_a\": 0.25"));
  CHECK(shows("\"over\": \"object\""));
  // A mask asks for its own pixels.
  c = compare_images(a, a, std::vector<std::uint8_t>{1, 1, 0, 0}, {});
  use_stored_noise(stored("0.25", 1), c.noise_a);
  CHECK(c.noise_a->over == NoisePixels::mask);
  CHECK(c.noise_a->relative != 0.25);
  CHECK(shows(" (the mask's 2 pixels)\n"));
  // An image without variances has none.
  c = compare_images(kA, kA, {}, {});
  use_stored_noise(stored("0.25", 3), c.noise_a);
  CHECK_FALSE(c.noise_a.has_value());
}

TEST_CASE("Variances that rare bright samples carry are said to, beside the verdict too") {
  // One pixel of 16 x 16 carries nearly all the variance, and outshines its neighbours.
  Image a(16, 16, 6);
  for (std::size_t i = 0; i < a.values.size(); ++i) a.values[i] = i % 6 < 3 ? 1 : 1e-4f;
  for (int k = 0; k < 6; ++k) a.at(8, 8)[k] = k < 3 ? 100 : 1e4f;
  const Comparison c = compare_images(a, a, {}, {.z_test = true});
  CHECK(c.noise_a->doubt == NoiseDoubt::rare_bright_samples);
  const std::string text = comparison_text(c);
  CHECK(text.find("variance_b        not reliable: rare bright samples carry it") != std::string::npos);
  CHECK(text.find("z_test            passed, p 1, by variances that rare bright samples carry\n") !=
        std::string::npos);
  CHECK(comparison_json(c).find("\"reliable\": false") != std::string::npos);
}

TEST_CASE("What is undefined is said to be, and null in JSON") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const float sign : {1.0f, -1.0f}) {
    Image broken = with_variance(kA, 0.01f);
    for (float& value : broken.values) value = std::copysign(nan, sign);
    const Comparison c = compare_images(broken, broken, {}, {.max_rmse = 1, .z_test = true});
    const std::string text = comparison_text(c);
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.find("rmse              undefined\n") != std::string::npos);
    CHECK(text.find("variance_a        not reliable: not all values") != std::string::npos);
    CHECK(text.find("z_test            FAILED\n") != std::string::npos);
    const std::string json = comparison_json(c);
    CHECK(json.find("nan") == std::string::npos);
    for (const char* name : {"rmse", "psnr", "max_abs", "relative_noise_a"})
      CHECK(json.find("\"" + std::string(name) + "\": null") != std::string::npos);
    for (const std::string& line : c.failures) CHECK(line.find("nan") == std::string::npos);
  }
}

TEST_CASE("JSON has null for what is infinite or not known") {
  const std::string json = comparison_json(compare_images(kA, kA, {}, {}));
  for (const char* name : {"psnr", "max_abs_at", "relative_noise_a", "relative_noise_b", "noise_a",
                           "variance_b", "beyond_fail", "z_test"})
    CHECK(json.find("\"" + std::string(name) + "\": null") != std::string::npos);
  CHECK(json.find("\"passed\": true") != std::string::npos);
}

}  // namespace meander
