#include "app/preview_model.h"

#include <doctest/doctest.h>

#include <cmath>

#include "app/preview_desk.h"
#include "stats/rectangle.h"

using namespace meander;

namespace {

UiModel model_of(const Desk& desk, std::optional<PointedPixel> pointed = {}) {
  return make_model(desk.state, {desk.pictures, desk.generation, {10, 20, 320, 180}, pointed, false});
}

}  // namespace

TEST_CASE("the pixel under the pointer is read with its error, samples and scatterings") {
  const Desk desk(kKnot);
  const FilmPlanes& planes = desk.pictures.live()->planes;
  const auto reading = model_of(desk, PointedPixel{14, 7}).statistics.pixel;
  REQUIRE(reading);
  CHECK(reading->x == 14);
  for (int c = 0; c < 3; ++c) {
    CHECK(reading->value[c] == static_cast<double>(planes.radiance.at(14, 7)[c]));
    CHECK(reading->error[c] == doctest::Approx(std::sqrt(planes.error.at(14, 7)[c])));
  }
  CHECK(reading->samples == 4);
  CHECK_FALSE(model_of(desk).statistics.pixel);
}

TEST_CASE("a coarse picture and a part of the film are read at the place that they show") {
  LiveFrame frame;
  frame.film_width = 32;
  frame.film_height = 16;
  frame.scale = 4;
  frame.area = {8, 4, 24, 12};
  for (Image* plane : {&frame.planes.radiance, &frame.planes.error, &frame.planes.features})
    *plane = Image(4, 2, 4);
  frame.planes.radiance.at(1, 1)[0] = 5;
  frame.planes.features.at(1, 1)[0] = 3;
  const auto reading = read_pixel(frame, {64, 32}, {24, 16}, 2);
  REQUIRE(reading);
  CHECK(reading->value.x == 5);
  CHECK(reading->length_mm == 6);
  CHECK_FALSE(read_pixel(frame, {64, 32}, {15, 16}, 2));
  CHECK_FALSE(read_pixel(frame, {64, 32}, {48, 16}, 2));
}

TEST_CASE("the rectangle's statistics are those of its pixels") {
  Desk desk(kKnot);
  desk.state.look.region = PixelBox{3, 4, 20, 12};
  const auto reading = model_of(desk).statistics.rectangle;
  REQUIRE(reading);
  const FilmPlanes& planes = desk.pictures.live()->planes;
  const RectangleMean mean = rectangle_mean(planes.radiance, planes.error, {3, 4, 20, 12});
  CHECK(mean.pixels == 17 * 8);
  for (std::size_t c = 0; c < 3; ++c) {
    CHECK(reading->mean[static_cast<int>(c)] == mean.mean[c]);
    CHECK(reading->interval[static_cast<int>(c)] == mean.half_width[c]);
  }
}

TEST_CASE("only views with a scale have a legend, of the range that is drawn") {
  Desk desk(kKnot);
  for (std::size_t i = 0; i < kViewNames.size(); ++i) {
    desk.state.look.view = static_cast<View>(i);
    const auto legend = model_of(desk).overlay.legend;
    CHECK(legend.has_value() == has_scale(desk.state.look.view));
    if (legend) CHECK(legend->low == doctest::Approx(default_range(desk.state.look.view).low));
    if (legend) CHECK(legend->percent == (desk.state.look.view == View::noise));
  }
}

TEST_CASE("the model says what was changed, and in which lengths") {
  Desk desk(kKnot);
  CHECK_FALSE(model_of(desk).toolbar.modified);
  CHECK(model_of(desk).material.names == std::vector<std::string>{"wax"});
  CHECK(model_of(desk).overlay.mean_free_path_mm == doctest::Approx((0.15 + 0.085 + 0.05) / 3));
  CHECK(model_of(desk).statistics.spp == 4);
  SceneDocument wider = desk.now();
  wider.apply("material.wax.g=0.3");
  desk.state.change(wider);
  const UiModel model = model_of(desk);
  CHECK(model.toolbar.modified);
  CHECK(model.toolbar.can_undo);
  CHECK(model.material.now.g == doctest::Approx(0.3));
  CHECK(model.material.original.g == 0);
}
