// False-colour pictures of the difference of two images, pixel by pixel.
#include "stats/error_picture.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <vector>

#include "core/error.h"
#include "math/color_scale.h"

namespace meander {
namespace {

Image grey_image(const std::vector<float>& values) {
  Image image(static_cast<int>(values.size()), 1, 3);
  for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = values[i / 3];
  return image;
}

Level3 level(const Image8& picture, int x) {
  const std::uint8_t* rgb = picture.at(x, 0);
  return {rgb[0], rgb[1], rgb[2]};
}

// Largest difference of a channel, in levels.
int distance(const Level3& a, const Level3& b) {
  int largest = 0;
  for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(int{a[c]} - int{b[c]}));
  return largest;
}

}  // namespace

TEST_CASE("the relative luminance error is that of its formula") {
  CHECK(relative_luminance_error(1.04, 0.99) == doctest::Approx(0.05));
  CHECK(relative_luminance_error(0, 0.99) == doctest::Approx(-0.99));
  CHECK(relative_luminance_error(0.02, 0) == doctest::Approx(2));
  CHECK(relative_luminance_error(-1, -0.99) == doctest::Approx(-0.01));
}

TEST_CASE("an error picture: grey where equal, orange brighter, blue darker, saturated beyond full scale") {
  // b = 0.99, so that the divisor is 1: errors 0, +0.05, -0.05, +0.2, -0.99 at full scale 0.1.
  const Image a = grey_image({0.99f, 1.04f, 0.94f, 1.19f, 0});
  const Image8 picture = error_picture(a, grey_image(std::vector<float>(5, 0.99f)), 0.1, false);
  CHECK(level(picture, 0) == diverging_scale(0));
  CHECK(distance(level(picture, 1), diverging_scale(0.5)) <= 1);
  CHECK(distance(level(picture, 2), diverging_scale(-0.5)) <= 1);
  CHECK(level(picture, 3) == diverging_scale(1));
  CHECK(level(picture, 4) == diverging_scale(-1));
  CHECK(level(picture, 3)[0] > level(picture, 3)[2] + 50);
  CHECK(level(picture, 4)[2] > level(picture, 4)[0] + 50);
}

TEST_CASE("an absolute error picture forgets the sign") {
  const Image a = grey_image({0.99f, 1.04f, 0.94f, 3});
  const Image8 picture = error_picture(a, grey_image(std::vector<float>(4, 0.99f)), 0.1, true);
  CHECK(level(picture, 0) == color_scale(0));
  CHECK(distance(level(picture, 1), color_scale(0.5)) <= 1);
  CHECK(distance(level(picture, 2), color_scale(0.5)) <= 1);
  CHECK(level(picture, 3) == color_scale(1));
}

TEST_CASE("the error weighs the channels by their luminance") {
  Image a = grey_image({0.99f});
  a.values[1] += 0.1f;  // green alone: 0.7152 of it
  const Image8 picture = error_picture(a, grey_image({0.99f}), 0.1, false);
  CHECK(distance(level(picture, 0), diverging_scale(0.7152)) <= 1);
}

TEST_CASE("what is not finite is pure green, on neither scale") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  for (const bool absolute : {false, true}) {
    const Image8 picture =
        error_picture(grey_image({nan, 1, infinite}), grey_image({1, nan, 1}), 1, absolute);
    for (int x = 0; x < 3; ++x) CHECK(level(picture, x) == Level3{0, 255, 0});
  }
}

TEST_CASE("an error picture needs two images of one size, further channels do not matter") {
  CHECK_THROWS_WITH_AS((void)error_picture(Image(2, 1, 3), Image(1, 2, 3), 1, false),
                       "the images differ in size: 2 x 1 and 1 x 2; they must be equal", Error);
  CHECK_THROWS_AS((void)error_picture(Image(2, 1, 1), Image(2, 1, 3), 1, false), Error);
  CHECK(error_picture(Image(2, 1, 6), Image(2, 1, 3), 1, false).width == 2);
}

}  // namespace meander
