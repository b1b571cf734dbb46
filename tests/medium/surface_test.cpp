#include "medium/surface.h"

#include <doctest/doctest.h>

#include <cmath>

#include "math/fresnel.h"
#include "medium/color_map.h"
#include "medium/half_space.h"
#include "medium/medium.h"
#include "medium/table.h"

namespace meander {

namespace {

constexpr double kAllIor[] = {1.00001, 1.01, 1.1, 1.3, 1.5, 2, 2.5, 4};

/// The whole reflected fraction under uniform light, which the tables hold: surface and body together.
double total_reflectance(double color, double ior) {
  const double surface = diffuse_external_reflectance(ior);
  return surface + (1 - surface) * color;
}

std::vector<double> mirror_of(const AngularGrid& grid, double ior) {
  std::vector<double> mirror;
  for (const double mu : grid.mu) mirror.push_back(internal_reflectance(mu, ior));
  return mirror;
}

AngularGrid critical_grid(int n, double ior) {
  return make_split_grid(n, std::sqrt((ior - 1) * (ior + 1)) / ior);
}

}  // namespace

TEST_CASE("the mean Fresnel reflectances agree with the tabulated ones, and vanish without an index step") {
  for (const Row& row : read_table("e1b_fresnel_averages.csv")) {
    CAPTURE(row.at("eta"));
    CHECK(std::abs(diffuse_external_reflectance(row.at("eta")) - row.at("F_diffuse_external")) < 1e-13);
    CHECK(std::abs(diffuse_internal_reflectance(row.at("eta")) - row.at("F_diffuse_internal")) < 1e-13);
    CHECK(std::abs(internal_reflectance(1, row.at("eta")) - row.at("F_normal")) < 1e-15);
  }
  CHECK(diffuse_external_reflectance(1) == 0);
  CHECK(diffuse_internal_reflectance(1) == 0);
  CHECK(internal_reflectance(0.3, 1) == 0);
}

TEST_CASE("the reflectance from inside is the walk's own, with total reflection beyond the critical angle") {
  for (const double ior : {1.1, 1.5, 4.0}) {
    for (int i = 0; i <= 100; ++i) {
      const double mu = i / 100.0;
      const Fresnel walk = eval_fresnel(static_cast<Real>(mu), static_cast<Real>(1 / ior));
      CHECK(internal_reflectance(mu, ior) ==
            doctest::Approx(static_cast<double>(walk.reflectance)).epsilon(1e-4));
    }
    CHECK(internal_reflectance(0.99 * std::sqrt(1 - 1 / (ior * ior)), ior) == 1);
  }
}

TEST_CASE("a split grid integrates what has a square root at the split") {
  for (const double split : {0.01, 0.4, 0.745, 0.97}) {
    CAPTURE(split);
    const AngularGrid grid = make_split_grid(16, split);
    CHECK(grid.degree >= 15);
    double roots = 0;
    double powers = 0;
    for (std::size_t i = 0; i < grid.mu.size(); ++i) {
      if (i > 0) CHECK(grid.mu[i] > grid.mu[i - 1]);
      if (grid.mu[i] > split) roots += grid.weight[i] * std::sqrt(grid.mu[i] - split);
      powers += grid.weight[i] * std::pow(grid.mu[i], grid.degree);
    }
    CHECK(roots == doctest::Approx(2.0 / 3 * std::pow(1 - split, 1.5)).epsilon(1e-13));
    CHECK(powers == doctest::Approx(1.0 / (grid.degree + 1)).epsilon(1e-9));
  }
}

TEST_CASE("dielectric colours agree with the tabulated half-spaces behind an index step") {
  int rows = 0;
  for (const Row& row : read_table("b4_halfspace_hg_vs_albedo.csv")) {
    if (row.at("eta") == 1) continue;
    CAPTURE(row.at("alpha"));
    CAPTURE(row.at("g"));
    CAPTURE(row.at("eta"));
    const ColorMap map(row.at("g"), {Boundary::dielectric, row.at("eta")});
    const double bound = row.at("g") > 0.5 ? 1e-6 : 1e-10;
    CHECK(std::abs(total_reflectance(map.color(row.at("alpha")), row.at("eta")) - row.at("R_diffuse_total")) <
          bound);
    ++rows;
  }
  CHECK(rows >= 28);
}

TEST_CASE("dielectric colours agree with the spread of half-spaces, backward and strongly forward ones too") {
  struct Case {
    double alpha, g, eta, total;
  };
  // The diffuse rows of b1_halfspace.csv with an index step.
  for (const Case& c : {Case{0.99, 0, 1.33, 0.682224687634}, Case{0.9999, 0.9, 1.5, 0.854380322702},
                        Case{0.95, -0.5, 1.33, 0.523121164217}, Case{0.8, 0.8, 1.5, 0.115931146367},
                        Case{0.99, 0.95, 1.33, 0.249291600030}, Case{1, 0.9, 1.5, 1}}) {
    CAPTURE(c.alpha);
    CAPTURE(c.g);
    const double color = ColorMap(c.g, {Boundary::dielectric, c.eta}).color(c.alpha);
    CHECK(std::abs(total_reflectance(color, c.eta) - c.total) < 3e-6);
  }
}

TEST_CASE("dielectric colours agree with a finer grid, solved without the table, for every g and index") {
  for (const double ior : kAllIor) {
    for (const double g : {-0.95, -0.71, -0.7, 0.0, 0.5, 0.95}) {
      const ColorMap map(g, {Boundary::dielectric, ior});
      const AngularGrid grid = critical_grid(g < -0.7 ? 40 : 24, ior);
      const HalfSpace fine(grid, g);
      const double bound = g < -0.7 ? 1e-4 : 2.5e-5;
      for (const double s : {0.003, 0.03, 0.2, 0.5, 0.8, 0.97}) {
        CAPTURE(ior);
        CAPTURE(g);
        CAPTURE(s);
        const double albedo = (1 - s) * (1 + s) / (1 - g * s * s);
        CHECK(std::abs(1 - map.color(albedo) - fine.absorbed_fraction(albedo, mirror_of(grid, ior))) < bound);
      }
    }
  }
}

TEST_CASE("a diffuse boundary with an index step mixes the matched colour with its mean reflectance") {
  for (const double ior : {1.0, 1.1, 1.5, 4.0}) {
    const double f = diffuse_internal_reflectance(ior);
    for (const double g : {-0.9, 0.0, 0.8}) {
      const ColorMap matched(g);
      const ColorMap diffuse(g, {Boundary::diffuse, ior});
      for (const double albedo : {0.0, 0.1, 0.5, 0.9, 0.999, 1.0}) {
        CAPTURE(ior);
        CAPTURE(g);
        CAPTURE(albedo);
        const double r = matched.color(albedo);
        CHECK(std::abs(diffuse.color(albedo) - r * (1 - f) / (1 - f * r)) < 1.5e-6);
      }
    }
  }
}

TEST_CASE("under every surface colour to albedo to colour returns the colour and both maps rise strictly") {
  for (const Boundary boundary : {Boundary::diffuse, Boundary::dielectric}) {
    for (const double ior : kAllIor) {
      for (const double g : {-0.999, -0.9, 0.0, 0.6, 0.95, 0.999}) {
        CAPTURE(ior);
        CAPTURE(g);
        const ColorMap map(g, {boundary, ior});
        CHECK(map.albedo(0) == 0);
        CHECK(map.albedo(1) == 1);
        CHECK(map.color(0) == 0);
        CHECK(map.color(1) == 1);
        double worst = 0;
        bool rises = true;
        double below_albedo = 0;
        double below_color = 0;
        for (int i = 1; i <= 500; ++i) {
          const double albedo = map.albedo(i / 500.0);
          const double color = map.color(i / 500.0);
          rises = rises && albedo > below_albedo && color > below_color;
          below_albedo = albedo;
          below_color = color;
          worst = std::max(worst, std::abs(map.color(albedo) - i / 500.0));
        }
        CHECK(rises);
        CHECK(worst < 1e-6);
      }
    }
  }
}

TEST_CASE("an index of 1 leaves the matched colours, and a larger one darkens a medium") {
  const ColorMap matched(0.4);
  for (const Boundary boundary : {Boundary::diffuse, Boundary::dielectric}) {
    CHECK(ColorMap(0.4, {boundary, 1}).color(0.9) == matched.color(0.9));
    double above = matched.color(0.9);
    for (const double ior : {1.1, 1.3, 1.5, 2.5}) {
      const double color = ColorMap(0.4, {boundary, ior}).color(0.9);
      CHECK(color < above);
      above = color;
    }
  }
}

TEST_CASE("exact inversion answers for the surface it is asked for; the literature's fits know none") {
  const Surface glass{Boundary::dielectric, 1.5};
  const DVec3 color(0.2, 0.5, 0.8);
  const Medium exact = medium_from_color(color, DVec3(1), 0.3, Inversion::exact, glass);
  const DVec3 back = color_of(DVec3(exact.albedo), 0.3, glass);
  for (int c = 0; c < 3; ++c) CHECK(std::abs(back[c] - color[c]) < 2e-6);
  CHECK(exact.albedo.y > medium_from_color(color, DVec3(1), 0.3, Inversion::exact).albedo.y);
  for (const Inversion inversion : {Inversion::chiang, Inversion::van_de_hulst})
    CHECK(medium_from_color(color, DVec3(1), 0.3, inversion, glass).albedo ==
          medium_from_color(color, DVec3(1), 0.3, inversion).albedo);
}

}  // namespace meander
