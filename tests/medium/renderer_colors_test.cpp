#include "medium/renderer_colors.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "medium/medium.h"

using namespace meander;

TEST_CASE("Cycles' fit, at values worked out from the published coefficients by other means") {
  CHECK(cycles_albedo(0, 0.3) == 0);
  CHECK(cycles_albedo(0.5, 0) == doctest::Approx(0.9137007428788568).epsilon(1e-12));
  CHECK(cycles_albedo(0.01, 0.4) == doctest::Approx(0.08908929).epsilon(1e-4));
  CHECK(cycles_albedo(0.5, 0.9) == doctest::Approx(0.9907915125299582).epsilon(1e-12));
  CHECK(cycles_albedo(1, 0) == kCyclesLargestAlbedo);
}

TEST_CASE("what Cycles' fit delivers, measured elsewhere with the exact H-function") {
  const double asked[] = {0.1, 0.3, 0.5, 0.7, 0.8, 0.9};
  const double delivered[] = {0.1011, 0.3031, 0.5049, 0.7068, 0.8115, 0.9379};
  for (int i = 0; i < 6; ++i)
    CHECK(std::abs(color_of(DVec3(cycles_albedo(asked[i], 0)), 0).x - delivered[i]) < 1e-4);
}

TEST_CASE("the colours give the albedo back") {
  for (const double albedo : {1e-7, 0.003, 0.2, 0.7, 0.95, 0.9999, 0.999999})
    for (const double g : {0.0, 0.1, 0.5, 0.75, 0.9}) {
      CAPTURE(albedo);
      CAPTURE(g);
      CHECK(cycles_albedo(cycles_color(albedo, g), g) == doctest::Approx(albedo).epsilon(1e-12));
    }
  for (const double albedo : {0.003, 0.2, 0.7, 0.95, 0.9999, 0.99999999})
    for (const double g : {-0.9, -0.3, 0.0, 0.5, 0.99}) {
      CAPTURE(albedo);
      CAPTURE(g);
      CHECK(openpbr_albedo(openpbr_color(albedo, g), g) == doctest::Approx(albedo).epsilon(1e-12));
    }
}

TEST_CASE("the ends of the range") {
  CHECK(cycles_color(0, 0.5) == 0);
  CHECK(openpbr_color(0, -0.5) == 0);
  CHECK(openpbr_color(1e-4, 0.99) == 0);
  CHECK(std::abs(openpbr_albedo(0, 0.99) * (1 - 0.99) / 6e-6 - 1) < 0.1);
  CHECK(cycles_color(1, 0) == cycles_color(kCyclesLargestAlbedo, 0));
  CHECK(cycles_color(1, 0) < 0.93);
  CHECK(openpbr_color(1, 0.5) == doctest::Approx(1).epsilon(1e-5));
  CHECK(openpbr_color(1, 0.5) <= 1);
}
