#include "app/progress.h"

#include <doctest/doctest.h>

#include <limits>

using namespace meander;

TEST_CASE("a progress line says which budget ends the image, when, and the noise then") {
  const Progress progress{100, 2, 0.04};
  CHECK(progress_line(progress, {400, {}, {}}) ==
        " 25.0 %  100 spp  noise 4.00 %  2.0 s  6.0 s to go (spp), 2.00 % then");
  CHECK(progress_line(progress, {{}, 18.0, 0.01}) ==
        " 11.1 %  100 spp  noise 4.00 %  2.0 s  16.0 s to go (time), 1.33 % then");
  CHECK(progress_line(progress, {{}, 40.0, 0.01}) ==
        "  6.2 %  100 spp  noise 4.00 %  2.0 s  30.0 s to go (error), 1.00 % then");
  CHECK(progress_line({1, 2, std::numeric_limits<double>::infinity()}, {{}, {}, 0.01}) ==
        "  0.0 %  1 spp  noise ?  2.0 s");
  CHECK(progress_line({100, 2, 0.04, false}, {{}, 4.0, {}}) ==
        " 50.0 %  100 spp  noise 4.00 % (unreliable)  2.0 s  2.0 s to go (time), 2.83 % then");
}

TEST_CASE("the closing line says what was reached, and what is left of the error") {
  CHECK(closing_line({3000, 30, 0.013}, {{}, 30.0, 0.01}) ==
        "reached 1.3 % in 30.0 s (time); 1 % would take 20.7 s more");
  CHECK(closing_line({3000, 30, 0.013, false}, {{}, 30.0, 0.01}) ==
        "reached 1.3 % in 30.0 s (time); 1 % would take at least 20.7 s more");
  CHECK(closing_line({64, 2, 0.1}, {64, {}, 0.001}) ==
        "reached 10 % in 2.0 s (spp); 0.1 % would take 333 min more");
  CHECK(closing_line({64, 2, 0.1}, {1000, {}, 0.05}) ==
        "reached 10 % in 2.0 s (interrupt); 5 % would take 6.0 s more");
  CHECK(closing_line({3000, 20, 0.00999}, {{}, 30.0, 0.01}) == "reached 0.999 % in 20.0 s (error)");
  CHECK(closing_line({64, 2, 0.1}, {64, {}, {}}) == "");
}

TEST_CASE("a plain line is due once the end is foreseen, then every five seconds") {
  const double unknown = std::numeric_limits<double>::infinity();
  LineTimes lines({{}, 30.0, 0.01});
  CHECK_FALSE(lines.due({1, 0.1, unknown}));
  CHECK_FALSE(lines.due({2, 0.2, 0.2, false}));
  CHECK(lines.due({4, 0.4, 0.15}));
  CHECK_FALSE(lines.due({8, 0.8, 0.1}));
  CHECK_FALSE(lines.due({53, 5.3, 0.04}));
  CHECK(lines.due({54, 5.5, 0.04}));
  CHECK_FALSE(lines.due({104, 10.4, 0.03}));
  // What never gets reliable is said after five seconds.
  LineTimes doubtful({{}, 30.0, {}});
  CHECK_FALSE(doubtful.due({40, 4.0, 0.2, false}));
  CHECK(doubtful.due({51, 5.1, 0.2, false}));
  // Less than a second is left.
  LineTimes brief({64, {}, {}});
  CHECK_FALSE(brief.due({16, 0.25, 0.1}));
  CHECK_FALSE(brief.due({32, 0.5, 0.07}));
}
