#include "medium/half_space.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "medium/rough_mirror.h"
#include "medium/surface.h"
#include "medium/table.h"

namespace meander {

TEST_CASE("a Gauss grid of n nodes integrates polynomials of degree 2n - 1 over (0, 1)") {
  for (const int n : {2, 5, 32, 64}) {
    const AngularGrid grid = make_gauss_grid(n);
    CHECK(grid.degree == 2 * n - 1);
    for (const int power : {0, 1, n, 2 * n - 1}) {
      double sum = 0;
      for (int i = 0; i < n; ++i) sum += grid.weight[i] * std::pow(grid.mu[i], power);
      CHECK(sum == doctest::Approx(1.0 / (power + 1)).epsilon(1e-13));
    }
    for (int i = 1; i < n; ++i) CHECK(grid.mu[i] > grid.mu[i - 1]);
  }
}

TEST_CASE("the diffuse reflectance agrees with the tabulated half-spaces, isotropic and Henyey-Greenstein") {
  const AngularGrid grid = make_gauss_grid(32);
  const HalfSpace isotropic(grid, 0);
  for (const Row& row : read_table("b2_halfspace_iso_vs_albedo.csv")) {
    CAPTURE(row.at("alpha"));
    CHECK(std::abs(isotropic.diffuse_reflectance(row.at("alpha")) - row.at("R_diffuse")) < 1e-9);
  }
  for (const Row& row : read_table("b4_halfspace_hg_vs_albedo.csv")) {
    if (row.at("eta") != 1) continue;
    CAPTURE(row.at("alpha"));
    CAPTURE(row.at("g"));
    const HalfSpace half_space(grid, row.at("g"));
    CHECK(std::abs(half_space.diffuse_reflectance(row.at("alpha")) - row.at("R_diffuse_total")) < 1e-9);
  }
}

TEST_CASE("strong peaks agree with adding-doubling on 120 angles and 185 moments") {
  struct Case {
    double g;
    double albedo;
    double reflectance;
  };
  // From the reference solver slabrt.py; its own error is below 2e-7 here.
  const Case cases[] = {
      {0.95, 0.99949520444220086, 0.794624530507},   {0.95, 0.98360655737704927, 0.293672221426},
      {0.95, 0.82429501084598666, 0.041441414282},   {0.99, 0.99989900010099986, 0.794632155098},
      {0.99, 0.99667774086378746, 0.293732008921},   {0.99, 0.95911155981827356, 0.041498195067},
      {0.999, 0.99998989909192837, 0.794633895987},  {0.999, 0.99966677774075308, 0.293746314786},
      {0.999, 0.9957549394685814, 0.041515096265},   {0.9999, 0.99999898990001013, 0.794634070486},
      {0.9999, 0.99996666777774079, 0.293747760899}, {0.9999, 0.99957386587823083, 0.041516869662},
      {-0.95, 0.98068350668647841, 0.800300105503},  {-0.95, 0.60606060606060608, 0.325684834237},
      {-0.95, 0.10737496467928791, 0.051654004247},  {-0.99, 0.98029507872066535, 0.808443552735},
      {-0.99, 0.60120240480961917, 0.331460355293},  {-0.99, 0.10544425328819576, 0.052414512831},
  };
  const AngularGrid grid = make_gauss_grid(64);
  for (const Case& c : cases) {
    CAPTURE(c.g);
    CAPTURE(c.albedo);
    CHECK(std::abs(HalfSpace(grid, c.g).diffuse_reflectance(c.albedo) - c.reflectance) < 1e-6);
  }
}

TEST_CASE("the reflection of an isotropic half-space has Chandrasekhar's form") {
  // R(mu, mu0) = alpha H H0 / (4 (mu + mu0)) with H from the reflectance, R(mu0) = 1 - sqrt(1 - alpha)
  // H(mu0): the discrete equations obey it exactly (Chandrasekhar 1960, chapter V).
  const double albedo = 0.9;
  const AngularGrid grid = make_gauss_grid(16);
  const SquareMatrix r = HalfSpace(grid, 0).reflection(albedo);
  std::vector<double> h(16);
  for (int i = 0; i < 16; ++i) {
    double reflected = 0;
    for (int j = 0; j < 16; ++j) reflected += 2 * r.at(j, i) * grid.mu[j] * grid.weight[j];
    h[i] = (1 - reflected) / std::sqrt(1 - albedo);
  }
  CHECK(h[0] > 1);
  CHECK(h[15] < 1.85009851676981233);  // H(1), just above the last node
  CHECK(h[15] > 1.84);
  for (int i = 0; i < 16; ++i) {
    for (int j = 0; j < 16; ++j) {
      const double expected = albedo * h[i] * h[j] / (4 * (grid.mu[i] + grid.mu[j]));
      CHECK(r.at(i, j) == doctest::Approx(expected).epsilon(1e-10));
    }
  }
}

TEST_CASE("single scattering alone is left at a tiny albedo, and it follows the phase function") {
  // R(mu, mu0) -> alpha h(mu, -mu0) / (4 (mu + mu0)), h = sum (2l + 1) (-g)^l P_l(mu) P_l(mu0).
  const double albedo = 1e-7;
  for (const double g : {0.5, -0.4}) {
    const AngularGrid grid = make_gauss_grid(32);
    const SquareMatrix r = HalfSpace(grid, g).reflection(albedo);
    for (const int i : {5, 16, 31}) {
      for (const int j : {8, 30}) {
        double kernel = 0;
        for (unsigned l = 0; l <= 63; ++l) {
          kernel +=
              (2 * l + 1) * std::pow(-g, l) * std::legendre(l, grid.mu[i]) * std::legendre(l, grid.mu[j]);
        }
        const double expected = albedo * kernel / (4 * (grid.mu[i] + grid.mu[j]));
        CHECK(r.at(i, j) == doctest::Approx(expected).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("the reflection is symmetric and its flux is the diffuse reflectance") {
  for (const double g : {-0.9, 0.3, 0.95}) {
    const AngularGrid grid = make_gauss_grid(24);
    const HalfSpace half_space(grid, g);
    for (const double albedo : {0.2, 0.9, 0.9999}) {
      const SquareMatrix r = half_space.reflection(albedo);
      double flux = 0;
      for (int i = 0; i < 24; ++i) {
        for (int j = 0; j < 24; ++j) {
          CHECK(r.at(i, j) == r.at(j, i));
          flux += 4 * grid.mu[i] * grid.weight[i] * r.at(i, j) * grid.mu[j] * grid.weight[j];
        }
      }
      CHECK(flux == doctest::Approx(half_space.diffuse_reflectance(albedo)).epsilon(1e-10));
    }
  }
}

TEST_CASE("black reflects nothing and white all but the millionth that its clamped albedo takes") {
  for (const double g : {-0.8, 0.0, 0.8}) {
    const HalfSpace half_space(make_gauss_grid(16), g);
    CHECK(half_space.diffuse_reflectance(0) == doctest::Approx(0).epsilon(1e-13));
    // 1 - A -> (4 / sqrt(3)) s as s -> 0 (diffusion limit), s^2 = 1e-12 / (1 - g).
    const double expected = 4 / std::sqrt(3.0) * std::sqrt(1e-12 / (1 - g));
    CHECK(1 - half_space.diffuse_reflectance(1) == doctest::Approx(expected).epsilon(2e-3));
  }
}

TEST_CASE("a rough mirror is symmetric, gains nothing, and is Fresnel's where it is almost smooth") {
  const AngularGrid grid = make_gauss_grid(16);
  for (const double roughness : {0.02, 0.5, 1.0}) {
    const SquareMatrix mirror = rough_mirror(grid, roughness, 1.5);
    double sum = 0;
    for (int i = 0; i < mirror.n; ++i) {
      double out = 0;
      for (int j = 0; j < mirror.n; ++j) {
        CHECK(mirror.at(i, j) == doctest::Approx(mirror.at(j, i)));
        CHECK(mirror.at(i, j) >= 0);
        out += mirror.at(j, i) * std::sqrt(grid.weight[j] * grid.mu[j] / (grid.weight[i] * grid.mu[i]));
      }
      sum += 2 * grid.weight[i] * grid.mu[i] * out;
      CHECK(out < 1.02);
    }
    CHECK(sum < 1);
    if (roughness == 0.02) CHECK(sum == doctest::Approx(diffuse_internal_reflectance(1.5)).epsilon(0.005));
  }
}

TEST_CASE("a full matrix that is diagonal stands for the mirror of a smooth surface") {
  const AngularGrid grid = make_gauss_grid(16);
  const HalfSpace half_space(grid, 0.3);
  std::vector<double> diagonal;
  SquareMatrix full(16);
  for (int i = 0; i < 16; ++i) {
    diagonal.push_back(internal_reflectance(grid.mu[i], 1.4));
    full.at(i, i) = diagonal.back();
  }
  for (const double albedo : {0.0, 0.5, 0.99, 0.99999})
    CHECK(half_space.absorbed_fraction(albedo, full) ==
          doctest::Approx(half_space.absorbed_fraction(albedo, diagonal)).epsilon(1e-7));
}

}  // namespace meander
