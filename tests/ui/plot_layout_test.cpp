#include "ui/plot_layout.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace meander;

namespace {

const PlotBox kArea{{0, 0}, {400, 200}};

bool inside(const PlotBox& box) {
  return box.low.x >= 0 && box.low.y >= 0 && box.high.x <= 400 && box.high.y <= 200;
}

}  // namespace

TEST_CASE("clutter is counted in a box and its margin, however long the line between") {
  PlotClutter clutter;
  clutter.add_line({0, 100}, {400, 100});
  CHECK(clutter.covered({{100, 80}, {200, 99}}, 0) == 0);
  CHECK(clutter.covered({{100, 80}, {200, 99}}, 2) > 40);
  CHECK(clutter.covered({{100, 90}, {102.5f, 110}}, 0) > 0);
  clutter.add_box({{10, 10}, {20, 20}});
  CHECK(clutter.covered({{12, 12}, {15, 15}}, 0) > 0);
}

TEST_CASE("places at the edges are inside, the upper right corner first") {
  const auto places = places_at_edges(kArea, {100, 50}, 8);
  REQUIRE(places.size() > 4);
  CHECK(places[0].high.x == 392);
  CHECK(places[0].low.y == 8);
  CHECK(std::ranges::all_of(places, inside));
  CHECK(places_at_edges(kArea, {390, 50}, 8).empty());
  // A flat curve leaves a place on one side of it at least, wherever it runs.
  for (float y = 0; y <= 200; y += 5) {
    PlotClutter flat;
    flat.add_line({0, y}, {400, y});
    CHECK(std::ranges::any_of(places, [&](const PlotBox& place) { return flat.covered(place, 5) == 0; }));
  }
}

TEST_CASE("places beside a line are inside and clear of it") {
  const ImVec2 from{0, 20};
  const ImVec2 to{400, 190};
  PlotClutter line;
  line.add_line(from, to);
  const auto places = places_beside(kArea, {50, 12}, from, to);
  REQUIRE(places.size() > 20);
  for (const PlotBox& place : places) {
    CHECK(inside(place));
    CHECK(line.covered(place, 3) == 0);
  }
}
