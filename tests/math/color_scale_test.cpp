// The colours of false-colour pictures: evenly spaced to the eye, and readable in black and white.
#include "math/color_scale.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "math/tone.h"

namespace meander {
namespace {

double decoded(std::uint8_t level) {
  const double x = level / 255.0;
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

// OKLab of display levels, the way back from oklch_levels (Ottosson 2020).
std::array<double, 3> oklab(const Level3& levels) {
  const double r = decoded(levels[0]);
  const double g = decoded(levels[1]);
  const double b = decoded(levels[2]);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

}  // namespace

TEST_CASE("equal steps of the colour scale are equal steps to the eye") {
  double smallest = 1e9;
  double largest = 0;
  for (int i = 0; i < 16; ++i) {
    const auto a = oklab(color_scale(i / 16.0));
    const auto b = oklab(color_scale((i + 1) / 16.0));
    const double step = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
    smallest = std::min(smallest, step);
    largest = std::max(largest, step);
    CHECK(b[0] - a[0] == doctest::Approx(0.75 / 16).epsilon(0.06));  // lightness, evenly: nothing is clipped
  }
  CHECK(largest < 1.15 * smallest);
}

TEST_CASE("the diverging scale gives both signs the same lightness and chroma, in even steps from grey") {
  const auto grey = diverging_scale(0);
  CHECK(grey[0] == grey[1]);
  CHECK(grey[1] == grey[2]);
  for (int i = 1; i <= 16; ++i) {
    const auto plus = oklab(diverging_scale(i / 16.0));
    const auto minus = oklab(diverging_scale(-i / 16.0));
    for (const auto& lab : {plus, minus}) {
      CHECK(lab[0] == doctest::Approx(0.20 + 0.55 * i / 16).epsilon(0.01));  // nothing is clipped
      CHECK(std::hypot(lab[1], lab[2]) == doctest::Approx(0.13 * i / 16).epsilon(0.04).scale(0.1));
    }
    CHECK(plus[1] * minus[1] + plus[2] * minus[2] < 0);  // opposite hues
    CHECK(plus[2] > 0);                                  // orange is the yellow side
  }
  CHECK(diverging_scale(3) == diverging_scale(1));
  CHECK(diverging_scale(-3) == diverging_scale(-1));
}

TEST_CASE("the colour scale ends where it says, beyond its ends too") {
  CHECK(color_scale(-1) == color_scale(0));
  CHECK(color_scale(2) == color_scale(1));
  CHECK(log_place(1e-9, 0.1, 10) == 0);
  CHECK(log_place(1, 0.1, 10) == doctest::Approx(0.5));
  CHECK(log_place(1e9, 0.1, 10) == 1);
}

TEST_CASE("the filmic curve keeps middle grey, rises throughout, and a display clips it at 255") {
  CHECK(filmic(0.18) == doctest::Approx(0.18).epsilon(1e-6));
  CHECK(filmic(0) == 0);
  CHECK(filmic(10.0) < 1);
  CHECK(filmic(10.03) > 1);
  for (double x = 1e-4; x < 1e4; x *= 1.3) CHECK(filmic(1.3 * x) > filmic(x));
  CHECK(display_level(Tone::filmic, HUGE_VAL) == 255);
  CHECK(display_level(Tone::filmic, NAN) == 0);
  CHECK(display_level(Tone::filmic, -1) == 0);
  CHECK(display_level(Tone::srgb, 0.5) == 188);
}

}  // namespace meander
