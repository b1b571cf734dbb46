// A storm over the previewer, of a seed and a number of steps (MEANDER_STORM_SEED, MEANDER_STORM_STEPS). Run
// it under the sanitizers too.
#include <doctest/doctest.h>

#include <cstdlib>

#include "app/storm.h"

namespace meander {
namespace {

unsigned seed_of_run() {
  const char* asked = std::getenv("MEANDER_STORM_SEED");
  return asked == nullptr ? 1u : static_cast<unsigned>(std::atoi(asked));
}

int steps_of_run() {
  const char* asked = std::getenv("MEANDER_STORM_STEPS");
  return asked == nullptr ? 500 : std::atoi(asked);
}

}  // namespace

TEST_CASE(
    "after a storm of edits and resizes the picture is that of the last state, and none was lost on the "
    "way") {
  const Folder folder;
  Storm storm(folder, seed_of_run());
  for (int i = 0; i < steps_of_run(); ++i) {
    CAPTURE(i);
    REQUIRE_NOTHROW(storm.step());
  }
  storm.calm_down();
  const auto& frame = storm.previewer().pictures().newest();
  REQUIRE(frame);
  REQUIRE(storm.previewer().spp() == 8);
  CHECK(storm.pictures > steps_of_run() / 10);
  const FilmPlanes fresh = fresh_planes(storm.previewer().state(), 8);
  CHECK(frame->planes.radiance.values == fresh.radiance.values);
  CHECK(frame->planes.error.values == fresh.error.values);
  CHECK(frame->planes.features.values == fresh.features.values);
  MESSAGE(storm.pictures << " pictures, " << storm.refused << " edits refused");
}

}  // namespace meander
