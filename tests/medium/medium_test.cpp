#include "medium/medium.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "medium/color_map.h"
#include "medium/table.h"

namespace meander {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void check_close(const Rgb& value, const DVec3& expected, double relative) {
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(static_cast<double>(value[c]) == doctest::Approx(expected[c]).epsilon(relative));
  }
}

}  // namespace

TEST_CASE("sigma_s and sigma_a give their sum and their ratio") {
  const Medium medium = medium_from_sigma({2.19, 2.62, 3.0}, {0.0021, 0.0041, 1.0}, 0.25);
  check_close(medium.sigma_t, {2.1921, 2.6241, 4.0}, 1e-7);
  check_close(medium.albedo, {2.19 / 2.1921, 2.62 / 2.6241, 0.75}, 1e-7);
  CHECK(medium.g == Real(0.25));
}

TEST_CASE("a pure absorber and a vacuum have albedo 0, whichever way they are described") {
  const Medium sigma = medium_from_sigma({0, 0, 1}, {2, 0, 0}, 0.5);
  CHECK(sigma.sigma_t == Rgb(2, 0, 1));
  CHECK(sigma.albedo == Rgb(0, 0, 1));
  const Medium albedo = medium_from_albedo(DVec3(0.9), {1, kInfinity, 2}, 0);
  CHECK(albedo.sigma_t == Rgb(1, 0, 0.5));
  check_close(albedo.albedo, {0.9, 0, 0.9}, 1e-7);
  for (const Inversion inversion : {Inversion::exact, Inversion::chiang, Inversion::van_de_hulst}) {
    const Medium color = medium_from_color(DVec3(0.5), {1, kInfinity, 1}, 0, inversion);
    CHECK(color.sigma_t.y == 0);
    CHECK(color.albedo.y == 0);
    CHECK(color.albedo.x > Real(0.5));
  }
}

TEST_CASE("the mapping of Chiang et al. gives its published-notebook values") {
  const DVec3 radius(1, 0.3, 0.2);
  const Medium colored = medium_from_color({0.5, 0.75, 0.3}, radius, 0, Inversion::chiang);
  check_close(colored.sigma_t, {0.58309, 2.87666, 2.0202}, 5e-6);
  check_close(colored.albedo, {0.912298, 0.984595, 0.755792}, 1e-6);
  check_close(colored.sigma_t * colored.albedo, {0.531952, 2.83235, 1.52685}, 5e-6);
  const Medium grey = medium_from_color(DVec3(0.5), radius, 0, Inversion::chiang);
  check_close(grey.sigma_t, {0.58309, 1.94363, 2.91545}, 5e-6);
  check_close(grey.sigma_t * grey.albedo, {0.531952, 1.77317, 2.65976}, 5e-6);
}

TEST_CASE("the mapping of Chiang et al. agrees with the tabulated albedos") {
  for (const Row& row : read_table("b3_albedo_remap.csv")) {
    const Medium medium = medium_from_color(DVec3(row.at("A_target")), DVec3(1), 0, Inversion::chiang);
    CHECK(std::abs(static_cast<double>(medium.albedo.x) - row.at("alpha_chiang2016")) < 1e-7);
  }
}

TEST_CASE("for any g the mapping of Chiang et al. keeps the reduced coefficients") {
  const DVec3 color(0.2, 0.6, 0.95);
  const DVec3 radius(1, 0.3, 2);
  const Medium reduced = medium_from_color(color, radius, 0, Inversion::chiang);
  for (const double g : {-0.7, 0.3, 0.9}) {
    CAPTURE(g);
    const Medium medium = medium_from_color(color, radius, g, Inversion::chiang);
    for (int c = 0; c < 3; ++c) {
      CAPTURE(c);
      const double sigma_s = static_cast<double>(medium.sigma_t[c] * medium.albedo[c]);
      const double sigma_a =
          static_cast<double>(medium.sigma_t[c]) * (1 - static_cast<double>(medium.albedo[c]));
      const double reduced_sigma_s = static_cast<double>(reduced.sigma_t[c] * reduced.albedo[c]);
      const double reduced_sigma_a =
          static_cast<double>(reduced.sigma_t[c]) * (1 - static_cast<double>(reduced.albedo[c]));
      CHECK(sigma_s * (1 - g) == doctest::Approx(reduced_sigma_s).epsilon(1e-6));
      CHECK(sigma_a == doctest::Approx(reduced_sigma_a).epsilon(1e-3));  // what 1 - albedo keeps of a float
    }
  }
}

TEST_CASE("van de Hulst's inversion agrees with the tabulated albedos and stays in range at its ends") {
  for (const Row& row : read_table("b3_albedo_remap.csv")) {
    const Medium medium = medium_from_color(DVec3(row.at("A_target")), DVec3(4), 0, Inversion::van_de_hulst);
    CHECK(std::abs(static_cast<double>(medium.albedo.x) - row.at("alpha_kulla_conty2017")) < 1e-7);
    CHECK(medium.sigma_t.x == Real(0.25));
  }
  for (const double g : {-0.5, 0.0, 0.9}) {
    const Medium ends = medium_from_color({0, 1, 0.5}, DVec3(1), g, Inversion::van_de_hulst);
    CHECK(ends.albedo.x >= 0);
    CHECK(ends.albedo.x < Real(1e-5 / (1 - g)));
    CHECK(ends.albedo.y <= 1);
    CHECK(ends.albedo.y > Real(1 - 1e-6));
  }
  // alpha = (1 - s^2)/(1 - g s^2): g raises the albedo at one colour so that 1 - alpha shrinks by (1 - g)/(1
  // - g s^2).
  const double alpha =
      static_cast<double>(medium_from_color(DVec3(0.5), DVec3(1), 0, Inversion::van_de_hulst).albedo.x);
  const double s2 = 1 - alpha;
  const Medium forward = medium_from_color(DVec3(0.5), DVec3(1), 0.8, Inversion::van_de_hulst);
  CHECK(1 - static_cast<double>(forward.albedo.x) ==
        doctest::Approx(0.2 * s2 / (1 - 0.8 * s2)).epsilon(1e-4));
}

TEST_CASE("exact inversion delivers the colour asked for, with sigma_t from the radius alone") {
  const DVec3 color(0.05, 0.5, 0.93);
  for (const double g : {-0.6, 0.0, 0.4, 0.85}) {
    CAPTURE(g);
    const Medium medium = medium_from_color(color, {0.5, 2, 8}, g, Inversion::exact);
    const Rgb sigma_t(2, 0.5, 0.125);
    for (int c = 0; c < 3; ++c)
      CHECK(std::abs(medium.sigma_t[c] - sigma_t[c]) <= std::numeric_limits<double>::epsilon() * sigma_t[c]);
    // Beside the map's own error there is what a float keeps of an albedo near 1: half a unit of 2^-24.
    const DVec3 albedo(medium.albedo);
    const DVec3 back = color_of(albedo, g);
    const DVec3 above = color_of(albedo + DVec3(0x1p-25), g);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(back[c] - color[c]) < 1e-9 + 1.1 * (above[c] - back[c]));
  }
}

TEST_CASE("exact inversion takes black to albedo 0 and white to albedo 1, exactly, at any g") {
  for (const double g : {-0.99, 0.0, 0.5, 0.99}) {
    const Medium medium = medium_from_color({0, 1, 0.5}, DVec3(1), g, Inversion::exact);
    CHECK(medium.albedo.x == 0);
    CHECK(medium.albedo.y == 1);
    CHECK(color_of(DVec3(0, 1, 1), g) == DVec3(0, 1, 1));
  }
}

TEST_CASE("color_of tells what Chiang's mapping really yields") {
  const Medium medium = medium_from_color({0.8, 0.9, 0.99}, DVec3(1), 0, Inversion::chiang);
  const DVec3 delivered = color_of(DVec3(medium.albedo), 0);
  CHECK(delivered.x == doctest::Approx(0.795412495).epsilon(1e-5));
  CHECK(delivered.y == doctest::Approx(0.870413684).epsilon(1e-5));
  CHECK(delivered.z == doctest::Approx(0.921329259).epsilon(2e-5));
}

}  // namespace meander
