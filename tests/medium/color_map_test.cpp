#include "medium/color_map.h"

#include <doctest/doctest.h>

#include <cmath>

#include "medium/half_space.h"
#include "medium/table.h"

namespace meander {

namespace {

constexpr double kAllG[] = {-0.9999, -0.99, -0.96, -0.95, -0.9, -0.5, -1e-6, 0,
                            1e-6,    0.3,   0.8,   0.9,   0.95, 0.99, 0.999, 0.9999};

}  // namespace

TEST_CASE("colours agree with the tabulated Henyey-Greenstein half-spaces") {
  for (const Row& row : read_table("b4_halfspace_hg_vs_albedo.csv")) {
    if (row.at("eta") != 1) continue;
    CAPTURE(row.at("g"));
    CAPTURE(row.at("alpha"));
    const ColorMap map(row.at("g"));
    CHECK(std::abs(map.color(row.at("alpha")) - row.at("R_diffuse_total")) < 2e-9);
    const double inverse = map.albedo(row.at("R_diffuse_total"));
    CHECK(1 - inverse == doctest::Approx(1 - row.at("alpha")).epsilon(1e-6));
  }
}

TEST_CASE("colours of the isotropic half-space agree with the H-function tables") {
  const ColorMap map(0);
  for (const Row& row : read_table("b2_halfspace_iso_vs_albedo.csv")) {
    CAPTURE(row.at("alpha"));
    CHECK(std::abs(map.color(row.at("alpha")) - row.at("R_diffuse")) < 1.5e-6);
  }
  for (const Row& row : read_table("b3_albedo_remap.csv")) {
    CAPTURE(row.at("A_target"));
    CHECK(std::abs(map.albedo(row.at("A_target")) - row.at("alpha_exact_for_A")) < 1e-5);
    CHECK(std::abs(map.color(row.at("alpha_chiang2016")) - row.at("R_diffuse_actual")) < 1.5e-6);
  }
}

TEST_CASE("colours agree with a half-space on a grid twice as fine, for every g") {
  for (const double g : kAllG) {
    const ColorMap map(g);
    const HalfSpace fine(make_gauss_grid(64), g);
    const double bound = std::abs(g) <= 0.95 ? 1.5e-6 : 5e-6;
    for (const double s : {0.003, 0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.97, 0.999}) {
      CAPTURE(g);
      CAPTURE(s);
      const double albedo = (1 - s) * (1 + s) / (1 - g * s * s);
      CHECK(std::abs(map.color(albedo) - fine.diffuse_reflectance(albedo)) < bound);
    }
  }
}

TEST_CASE("colour to albedo to colour returns the colour, and both maps rise strictly from 0 to 1") {
  for (const double g : kAllG) {
    CAPTURE(g);
    const ColorMap map(g);
    CHECK(map.albedo(0) == 0);
    CHECK(map.albedo(1) == 1);
    CHECK(map.color(0) == 0);
    CHECK(map.color(1) == 1);
    const double bound = std::abs(g) <= 0.95 ? 1e-9 : 1e-6;
    double worst = 0;
    bool rises = true;
    double previous = 0;
    for (int i = 1; i <= 5000; ++i) {
      const double albedo = map.albedo(i / 5000.0);
      rises = rises && albedo > previous;
      previous = albedo;
      worst = std::max(worst, std::abs(map.color(albedo) - i / 5000.0));
    }
    CHECK(rises);
    CHECK(worst < bound);
    previous = 0;
    rises = true;
    for (int i = 1; i <= 5000; ++i) {
      const double color = map.color(i / 5000.0);
      rises = rises && color > previous;
      previous = color;
    }
    CHECK(rises);
  }
}

TEST_CASE("near white the missing part of the albedo is right to a thousandth") {
  for (const double g : kAllG) {
    CAPTURE(g);
    const ColorMap map(g);
    const HalfSpace fine(make_gauss_grid(64), g);
    // 1 - A goes as sqrt(1 - alpha) there, so the relative error of 1 - alpha is twice that of 1 - A.
    const double missing = map.one_minus_albedo(0.999);
    CHECK(1 - fine.diffuse_reflectance(1 - missing) == doctest::Approx(1e-3).epsilon(5e-4));
    CHECK(missing == doctest::Approx(1 - map.albedo(0.999)).epsilon(1e-4));
  }
}

TEST_CASE("near white the colour obeys the diffusion limit even where 1 - albedo would round away") {
  for (const double g : {-0.5, 0.0, 0.8}) {
    CAPTURE(g);
    // 1 - A = (4 / sqrt(3)) s, s^2 = (1 - alpha) / (1 - g).
    const double expected = 3.0 / 16 * 1e-20 * (1 - g);
    CHECK(ColorMap(g).one_minus_albedo(1 - 0x1p-33) ==
          doctest::Approx(expected * std::pow(0x1p-33 * 1e10, 2)).epsilon(1e-4));
  }
}

TEST_CASE("a g beyond 0.9999 is served by the curve of 0.9999") {
  const ColorMap map(0.99999999);
  CHECK(map.albedo(0.5) < 1);
  CHECK(map.color(map.albedo(0.5)) == doctest::Approx(0.5).epsilon(1e-6));
}

}  // namespace meander
