// The previewer as a whole, off-screen; preview_storm has the rest.
#include "app/previewer.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "app/preview_desk.h"

namespace meander {

TEST_CASE("an edit before the first frame is in the first picture") {
  const Offscreen context(1, 1);
  PreviewOptions options;
  options.settings.threads = 2;
  options.settings.budget.spp = 1;
  Previewer previewer(context.functions(), Desk::small(kKnot), options, 1);
  previewer.apply("light.key.radiance=0.5");
  for (const Timer timer; timer.seconds() < 60 && previewer.spp() < 1;) {
    (void)previewer.update(timer.seconds());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  REQUIRE(previewer.spp() == 1);
  const Scene& shown = *previewer.pictures().newest()->scene;
  REQUIRE(shown.lights.size() == 2);
  CHECK(std::get<RectangleLight>(shown.lights[1].shape).radiance == Rgb(0.5f));
}

}  // namespace meander
