#include "medium/color_maps.h"

#include <doctest/doctest.h>

#include "core/timer.h"

using namespace meander;

TEST_CASE("a kept map is the map that would be made, for its own g and surface alone") {
  ColorMaps maps;
  const Surface surfaces[] = {
      {}, {Boundary::diffuse, 1.5}, {Boundary::dielectric, 1.5}, {Boundary::dielectric, 1.3}};
  for (int round = 0; round < 2; ++round)
    for (const Surface& surface : surfaces)
      for (const double g : {0.0, 0.5, -0.3}) {
        const ColorMap fresh(g, surface);
        const ColorMap kept = maps.of(g, surface);
        CHECK(kept.g() == g);
        for (const double albedo : {0.1, 0.9, 0.9999}) CHECK(kept.color(albedo) == fresh.color(albedo));
      }
}

TEST_CASE("a map that is kept costs next to nothing, one that was long not asked for is made anew") {
  ColorMaps maps;
  const Surface glass{Boundary::dielectric, 1.5};
  const Timer making;
  (void)maps.of(0.5, glass);
  const double made = making.seconds();
  const Timer asking;
  for (int i = 0; i < 10; ++i) (void)maps.of(0.5, glass);
  CHECK(asking.seconds() < 0.1 * made);
  for (int i = 0; i < 40; ++i) (void)maps.of(0.0, {Boundary::diffuse, 1 + 0.01 * (i + 1)});
  CHECK(maps.of(0.5, glass).color(0.9) == ColorMap(0.5, glass).color(0.9));
}
