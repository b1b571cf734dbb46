#include "math/color.h"

#include <doctest/doctest.h>
#include <algorithm>
#include <cmath>

namespace meander {

TEST_CASE("sRGB encoding gives the known values") {
  CHECK(encode_srgb(0) == 0);
  CHECK(encode_srgb(1) == doctest::Approx(1).epsilon(1e-6));
  CHECK(encode_srgb(Real(0.001)) == doctest::Approx(0.01292).epsilon(1e-6));
  CHECK(encode_srgb(Real(0.18)) == doctest::Approx(0.4613561295).epsilon(1e-6));
  CHECK(encode_srgb(Real(0.5)) == doctest::Approx(0.735356983052).epsilon(1e-6));
  CHECK(decode_srgb(Real(128) / 255) == doctest::Approx(0.215860500114).epsilon(1e-6));
}

TEST_CASE("sRGB decoding undoes encoding, monotonically and through the join") {
  double worst = 0;
  Real before = -1;
  for (int i = 0; i <= 100'000; ++i) {
    const Real linear = Real(i) / 100'000;
    const Real encoded = encode_srgb(linear);
    if (encoded <= before) FAIL("not monotone at " << linear);
    before = encoded;
    worst = std::max(worst, std::abs(double{decode_srgb(encoded)} - double{linear}));
  }
  // The published constants leave a step of 3e-8 at the join; the rest is rounding.
  CHECK(worst < 5e-7);
}

TEST_CASE("All 256 codes survive decoding and encoding") {
  for (int code = 0; code < 256; ++code) {
    CHECK(std::lround(255 * encode_srgb(decode_srgb(Real(code) / 255))) == code);
  }
}

TEST_CASE("Luminance weighs the Rec. 709 primaries and leaves grey alone") {
  CHECK(luminance({1, 0, 0}) == doctest::Approx(0.2126).epsilon(1e-6));
  CHECK(luminance({0, 1, 0}) == doctest::Approx(0.7152).epsilon(1e-6));
  CHECK(luminance({0, 0, 1}) == doctest::Approx(0.0722).epsilon(1e-6));
  CHECK(luminance({3, 3, 3}) == doctest::Approx(3).epsilon(1e-6));
}

}  // namespace meander
