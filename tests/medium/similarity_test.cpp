#include "medium/similarity.h"

#include <doctest/doctest.h>

#include <cmath>

#include "medium/color_map.h"

namespace meander {

namespace {

constexpr double kAllG[] = {-0.8, -0.3, 0.0, 0.5, 0.9};
const Coefficients kJade{{3, 0.4, 20}, {0.01, 0.3, 0.0004}, 0.35};
const Surface kSurfaces[] = {
    {}, {Boundary::diffuse, 1}, {Boundary::diffuse, 1.4}, {Boundary::dielectric, 1.5}};

void check_close(const DVec3& value, const DVec3& expected, double relative) {
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(value[c] == doctest::Approx(expected[c]).epsilon(relative));
  }
}

}  // namespace

TEST_CASE("reducing and un-reducing return the medium, and agree with the formulas for alpha and sigma_t") {
  for (const double g : kAllG) {
    const Coefficients medium{kJade.sigma_s, kJade.sigma_a, g};
    const Coefficients isotropic = reduced(medium);
    CHECK(isotropic.g == 0);
    const Coefficients back = unreduced(isotropic, g);
    CHECK(back.g == g);
    check_close(back.sigma_s, medium.sigma_s, 1e-15);
    CHECK(back.sigma_a == medium.sigma_a);
    // alpha = alpha' / (1 - g (1 - alpha')), sigma_t = sigma_t' (1 - g (1 - alpha')) / (1 - g).
    const DVec3 alpha = albedo_of(isotropic);
    const DVec3 scale = 1.0 - g * (1.0 - alpha);
    check_close(albedo_of(back), alpha / scale, 1e-14);
    check_close(sigma_t_of(back), sigma_t_of(isotropic) * scale / (1 - g), 1e-14);
  }
}

TEST_CASE("the look lock holds the colour under every surface, and sigma_t'") {
  for (const Surface& surface : kSurfaces) {
    for (const double g : kAllG) {
      CAPTURE(surface.ior);
      CAPTURE(g);
      const Coefficients changed = with_g(kJade, g, GLock::look, surface);
      CHECK(changed.g == g);
      const DVec3 before = color_of(albedo_of(kJade), kJade.g, surface);
      const DVec3 after = color_of(albedo_of(changed), g, surface);
      for (int c = 0; c < 3; ++c) CHECK(std::abs(after[c] - before[c]) < 1e-8);
      check_close(sigma_t_of(reduced(changed)), sigma_t_of(reduced(kJade)), 1e-9);
      // And it is no mere similarity: that misses the colour.
      const Coefficients similar = with_g(kJade, g, GLock::sigma_s_reduced, surface);
      CHECK(std::abs(color_of(albedo_of(similar), g, surface).y - before.y) > 1e-5);
    }
  }
}

TEST_CASE("the sigma_t lock changes g alone; sigma_s_reduced holds sigma_a and sigma_s (1 - g)") {
  for (const double g : kAllG) {
    const Coefficients plain = with_g(kJade, g, GLock::sigma_t, {});
    CHECK(plain.g == g);
    CHECK(plain.sigma_s == kJade.sigma_s);
    CHECK(plain.sigma_a == kJade.sigma_a);
    const Coefficients similar = with_g(kJade, g, GLock::sigma_s_reduced, {});
    CHECK(similar.g == g);
    CHECK(similar.sigma_a == kJade.sigma_a);
    check_close(similar.sigma_s * (1 - g), kJade.sigma_s * (1 - kJade.g), 1e-15);
  }
}

TEST_CASE("every lock returns the medium when g goes there and back") {
  const Surface glass{Boundary::dielectric, 1.5};
  for (const GLock lock : {GLock::look, GLock::sigma_t, GLock::sigma_s_reduced}) {
    for (const double g : kAllG) {
      const Coefficients back = with_g(with_g(kJade, g, lock, glass), kJade.g, lock, glass);
      CHECK(back.g == kJade.g);
      check_close(back.sigma_s, kJade.sigma_s, 1e-6);
      check_close(back.sigma_a, kJade.sigma_a, 1e-6);
    }
    CHECK(with_g(kJade, kJade.g, lock, glass).sigma_s == kJade.sigma_s);
  }
}

TEST_CASE("black, white and vacuum keep what they are under the look lock") {
  const Coefficients ends{{0, 2, 0}, {3, 0, 0}, 0};
  const Coefficients changed = with_g(ends, 0.8, GLock::look, {});
  CHECK(changed.sigma_s.x == 0);
  CHECK(changed.sigma_a.x == doctest::Approx(3));
  CHECK(changed.sigma_s.y == doctest::Approx(10));
  CHECK(changed.sigma_a.y == 0);
  CHECK(changed.sigma_s.z == 0);
  CHECK(changed.sigma_a.z == 0);
}

TEST_CASE("a medium in floats keeps its colour within 1e-4, and its sigma_t'") {
  const Medium wax{Rgb(4, 1, 20), Rgb(Real(0.9), Real(0.3), Real(0.9995)), 0};
  for (const Surface& surface : kSurfaces) {
    const Medium changed = with_g(wax, 0.8, GLock::look, surface);
    CHECK(changed.g == Real(0.8));
    const DVec3 before = color_of(DVec3(wax.albedo), 0, surface);
    const DVec3 after = color_of(DVec3(changed.albedo), static_cast<double>(changed.g), surface);
    for (int c = 0; c < 3; ++c) CHECK(std::abs(after[c] - before[c]) < 1e-4);
    const Medium isotropic = reduced(changed);
    CHECK(isotropic.g == 0);
    check_close(DVec3(isotropic.sigma_t), DVec3(wax.sigma_t), 1e-5);
    check_close(DVec3(unreduced(isotropic, 0.8).sigma_t), DVec3(changed.sigma_t), 1e-5);
  }
}

}  // namespace meander
