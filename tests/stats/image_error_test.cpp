#include "stats/image_error.h"

#include <doctest/doctest.h>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.h"

namespace meander {
namespace {

Image make_image(int width, int height, const std::vector<float>& values) {
  Image image(width, height, 3);
  image.values = values;
  return image;
}

const std::vector<float> kReference = {1, 2, 0, 4, -1, 2};
const std::vector<float> kOther = {1.5f, 2, 0.25f, 3, -1, 2};

}  // namespace

TEST_CASE("Every metric of a two-pixel pair equals the hand-computed one") {
  const ImageError error = image_error(make_image(2, 1, kOther), make_image(2, 1, kReference));
  CHECK(error.pixels == 2);
  CHECK(error.non_finite == 0);
  CHECK(error.mse == doctest::Approx((0.25 + 0.0625 + 1) / 6).epsilon(1e-14));
  CHECK(error.rmse == doctest::Approx(std::sqrt(1.3125 / 6)).epsilon(1e-14));
  CHECK(error.relative_rmse == doctest::Approx(std::sqrt(1.3125 / 6) / (10.0 / 6)).epsilon(1e-14));
  CHECK(error.relmse == doctest::Approx((0.25 / 1.0001 + 0.0625 / 1e-4 + 1 / 16.0001) / 6).epsilon(1e-14));
  CHECK(error.mae == doctest::Approx(1.75 / 6).epsilon(1e-14));
  CHECK(error.mean_signed == doctest::Approx(-0.25 / 6).epsilon(1e-14));
  CHECK(error.psnr == doctest::Approx(-10 * std::log10(1.3125 / 6)).epsilon(1e-14));
  CHECK(error.max_abs == 1);
  CHECK(error.max_x == 1);
  CHECK(error.max_y == 0);
  CHECK(error.max_channel == 0);
}

TEST_CASE("Every metric of a pair of 3 x 1 pixels equals the hand-computed one") {
  // d = (0.5 0 0) (0 -0.25 0) (0 0 0.125): d^2 sums to 0.25 + 0.0625 + 0.015625 = 0.328125, |d| to 0.875, d
  // to 0.375; |b| sums to 9 (0.5) + 0 = 4.5, so its mean is 0.5.
  const ImageError error =
      image_error(make_image(3, 1, {1, 0.5f, 0.5f, 0.5f, 0.25f, 0.5f, 0.5f, 0.5f, 0.625f}),
                  make_image(3, 1, std::vector<float>(9, 0.5f)));
  CHECK(error.pixels == 3);
  CHECK(error.mse == doctest::Approx(0.328125 / 9).epsilon(1e-14));
  CHECK(error.rmse == doctest::Approx(0.190940654).epsilon(1e-8));
  CHECK(error.relative_rmse == doctest::Approx(0.381881308).epsilon(1e-8));
  CHECK(error.relmse == doctest::Approx(0.328125 / 9 / 0.2501).epsilon(1e-14));
  CHECK(error.mae == doctest::Approx(0.875 / 9).epsilon(1e-14));
  CHECK(error.mean_signed == doctest::Approx(0.375 / 9).epsilon(1e-14));
  CHECK(error.psnr == doctest::Approx(14.382031887).epsilon(1e-9));
}

TEST_CASE("Every metric of a pair of 2 x 2 grey pixels equals the hand-computed one") {
  // d = 0 1 / -1 2: mean d^2 = 6 / 4, mean |b| = 8 / 4, mean |d| = 4 / 4, mean d = 2 / 4.
  const ImageError error = image_error(make_image(2, 2, {1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4}),
                                       make_image(2, 2, {1, 1, 1, 1, 1, 1, 4, 4, 4, 2, 2, 2}));
  CHECK(error.pixels == 4);
  CHECK(error.rmse == doctest::Approx(1.224744871).epsilon(1e-9));
  CHECK(error.relative_rmse == doctest::Approx(0.6123724357).epsilon(1e-9));
  CHECK(error.relmse == doctest::Approx((1 / 1.0001 + 1 / 16.0001 + 4 / 4.0001) / 4).epsilon(1e-14));
  CHECK(error.mae == doctest::Approx(1).epsilon(1e-14));
  CHECK(error.psnr == doctest::Approx(-1.760912591).epsilon(1e-9));
  CHECK(error.mean_signed == doctest::Approx(0.5).epsilon(1e-14));
  CHECK(error.max_abs == 2);
  CHECK(error.max_x == 1);
  CHECK(error.max_y == 1);
  CHECK(error.max_channel == 0);
}

TEST_CASE("Equal images have no error and infinite PSNR, black ones too") {
  for (const Image& image : {make_image(2, 1, kReference), Image(2, 1, 3)}) {
    const ImageError error = image_error(image, image);
    CHECK(error.mse == 0);
    CHECK(error.relative_rmse == 0);
    CHECK(error.relmse == 0);
    CHECK(error.psnr == std::numeric_limits<double>::infinity());
    CHECK(error.max_x == -1);
  }
}

TEST_CASE("A mask leaves pixels out, an all-zero mask none") {
  const Image a = make_image(2, 1, kOther);
  const Image b = make_image(2, 1, kReference);
  const std::vector<std::uint8_t> second = {0, 255};
  CHECK(image_error(a, b, second).pixels == 1);
  CHECK(image_error(a, b, second).mse == doctest::Approx(1.0 / 3).epsilon(1e-14));
  const std::vector<std::uint8_t> none = {0, 0};
  CHECK(image_error(a, b, none).mse == image_error(a, b).mse);
}

TEST_CASE("Further channels do not count") {
  Image a(1, 1, 6);
  a.values = {1, 2, 3, 100, 100, 100};
  const Image b = make_image(1, 1, {1, 2, 4});
  CHECK(image_error(a, b).mse == doctest::Approx(1.0 / 3).epsilon(1e-14));
}

TEST_CASE("Values that are not finite are counted and left out") {
  std::vector<float> broken = kOther;
  broken[0] = std::numeric_limits<float>::quiet_NaN();
  broken[1] = std::numeric_limits<float>::infinity();
  const ImageError error = image_error(make_image(2, 1, broken), make_image(2, 1, kReference));
  CHECK(error.non_finite == 2);
  CHECK(error.mse == doctest::Approx(1.0625 / 4).epsilon(1e-14));
  CHECK(error.relative_rmse == doctest::Approx(std::sqrt(1.0625 / 4) / (7.0 / 4)).epsilon(1e-14));
}

TEST_CASE("With nothing left to compare every metric is NaN, so that no bound can hold") {
  const Image broken = make_image(1, 1, std::vector<float>(3, std::numeric_limits<float>::quiet_NaN()));
  const ImageError error = image_error(broken, Image(1, 1, 3));
  CHECK(error.non_finite == 3);
  CHECK(std::isnan(error.mse));
  CHECK(std::isnan(error.relmse));
  CHECK(std::isnan(error.relative_rmse));
  CHECK(std::isnan(error.max_abs));
}

TEST_CASE("Images that cannot be compared are named in one line") {
  CHECK_THROWS_WITH_AS((void)image_error(Image(2, 1, 3), Image(1, 2, 3)),
                       "the images differ in size: 2 x 1 and 1 x 2; they must be equal", Error);
  CHECK_THROWS_WITH_AS((void)image_error(Image(2, 1, 1), Image(2, 1, 3)),
                       "the image has 1 channels where 3 are needed: R G B", Error);
  const std::vector<std::uint8_t> mask(3, 1);
  CHECK_THROWS_WITH_AS((void)image_error(Image(2, 1, 3), Image(2, 1, 3), mask),
                       "the mask has 3 pixels where the images have 2", Error);
}

TEST_CASE("Pixels beyond a threshold have one channel that is, or one that is not finite") {
  const Image a = make_image(2, 1, kOther);  // largest |d|: 0.5 and 1
  const Image b = make_image(2, 1, kReference);
  CHECK(pixels_beyond(a, b, 0.25) == 2);
  CHECK(pixels_beyond(a, b, 0.5) == 1);
  CHECK(pixels_beyond(a, b, 1) == 0);
  const std::vector<std::uint8_t> first = {1, 0};
  CHECK(pixels_beyond(a, b, 0.25, first) == 1);
  CHECK(pixels_beyond(a, a, 0) == 0);
  Image broken = a;
  broken.values[4] = std::numeric_limits<float>::quiet_NaN();
  CHECK(pixels_beyond(broken, a, 1000) == 1);
  CHECK(pixels_beyond(a, broken, 1000) == 1);
}

}  // namespace meander
