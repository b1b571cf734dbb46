// Every way of looking at a film against the same on the CPU: views and tones.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "display/capture.h"
#include "display/easel.h"

namespace meander {
namespace {

constexpr int kWidth = 40;
constexpr int kHeight = 30;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Every pixel its own values, over the ranges of the views; a few pixels of nothing and of no number.
FilmPlanes synthetic() {
  FilmPlanes planes{Image(kWidth, kHeight, 4), Image(kWidth, kHeight, 4), Image(kWidth, kHeight, 4)};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / (kWidth * kHeight);
    float* r = planes.radiance.values.data() + 4 * static_cast<std::size_t>(i);
    float* e = planes.error.values.data() + 4 * static_cast<std::size_t>(i);
    float* f = planes.features.values.data() + 4 * static_cast<std::size_t>(i);
    for (int c = 0; c < 3; ++c) r[c] = 1.5f * t * t * static_cast<float>(c + 1) / 3 - 0.01f;
    r[3] = std::exp2(14 * t - 1);
    for (int c = 0; c < 3; ++c) e[c] = r[c] * r[c] * std::pow(10.0f, 8 * std::fmod(7 * t, 1.0f) - 7);
    e[3] = std::pow(10.0f, 4 * t - 0.5f);
    f[0] = std::pow(10.0f, 5 * t - 2.5f);
    f[1] = std::sin(9 * t);
    f[2] = std::cos(9 * t) * std::sin(40 * t);
    f[3] = std::cos(9 * t) * std::cos(40 * t);
  }
  for (Image* plane : {&planes.radiance, &planes.error, &planes.features}) {
    std::fill_n(plane->at(3, 2), 4, 0.0f);
    std::fill_n(plane->at(4, 2), 4, kNan);
    std::fill_n(plane->at(5, 2), 4, kInfinity);
  }
  return planes;
}

Level3 scaled(double value, const ViewRange& range) {
  if (std::isnan(value) || value <= 0) return kNoData;
  return color_scale(std::round(255 * log_place(value, range.low, range.high)) / 255);
}

double luminance_of(const float* c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

Level3 clipping(const float* c, const ViewOptions& options) {
  const double scale = std::exp2(options.exposure);
  bool above = false;
  bool below = false;
  for (int i = 0; i < 3; ++i) {
    if (std::isnan(c[i])) return {38, 115, 255};
    above = above || tone_curve(options.tone, c[i] * scale) > 1;
    below = below || c[i] < 0;
  }
  if (above) return {255, 64, 26};
  if (below) return {38, 115, 255};
  return grey(display_level(options.tone, luminance_of(c) * scale));
}

Level3 normal_levels(const float* n) {
  const double squared = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
  if (std::isnan(squared) || squared == 0) return kNoData;
  Level3 levels{};
  for (std::size_t i = 0; i < 3; ++i) {
    levels[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(0.5 * n[i] + 0.5, 0.0, 1.0)));
  }
  return levels;
}

double noise_of(const float* r, const float* e) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += e[c] / (static_cast<double>(r[c]) * r[c] + 1e-4);
  return std::sqrt(sum / 3);
}

Level3 expected(const FilmPlanes& planes, int x, int y, const ViewOptions& options) {
  const float* r = planes.radiance.at(x, y);
  const float* e = planes.error.at(x, y);
  const float* f = planes.features.at(x, y);
  const ViewRange range =
      options.high > 0 ? ViewRange{options.low, options.high} : default_range(options.view);
  const double scale = std::exp2(options.exposure);
  switch (options.view) {
    case View::noise:
      return scaled(noise_of(r, e), range);
    case View::samples:
      return scaled(r[3], range);
    case View::scatterings:
      return scaled(e[3], range);
    case View::length:
      return scaled(f[0], range);
    case View::normals:
      return normal_levels(f + 1);
    case View::luminance:
      return grey(display_level(options.tone, luminance_of(r) * scale));
    case View::clipping:
      return clipping(r, options);
    case View::image:
      break;
  }
  Level3 levels{};
  for (std::size_t c = 0; c < 3; ++c) {
    levels[c] = static_cast<std::uint8_t>(display_level(options.tone, r[c] * scale));
  }
  return levels;
}

int wrong_pixels(const FilmPlanes& planes, const ViewOptions& options, int tolerance) {
  const auto wanted = [&](int x, int y) { return expected(planes, x, y, options); };
  return wrong_pixels(capture_frame(planes, options), wanted, tolerance);
}

}  // namespace

TEST_CASE("every view equals its formula on the CPU within one level, in both tones") {
  const FilmPlanes planes = synthetic();
  for (int view = 0; view < static_cast<int>(kViewNames.size()); ++view) {
    for (const Tone tone : {Tone::srgb, Tone::filmic}) {
      ViewOptions options{.exposure = 0.7f, .tone = tone, .view = static_cast<View>(view)};
      CAPTURE(kViewNames[static_cast<std::size_t>(view)]);
      CAPTURE(static_cast<int>(tone));
      const int steps = has_scale(options.view) ? 4 : 1;  // one step of the colour scale is up to 4 levels
      CHECK(wrong_pixels(planes, options, steps) == 0);
      CHECK(wrong_pixels(planes, options, 0) <= kWidth * kHeight / 100);
      if (tone == Tone::srgb || view == 0) CHECK(wrong_pixels(planes, {.exposure = 0.7f}, 1) == 0);
    }
  }
}

TEST_CASE("the range of a colour scale is the caller's to choose") {
  const FilmPlanes planes = synthetic();
  const ViewOptions narrow{.view = View::length, .low = 0.5f, .high = 2.0f};
  CHECK(wrong_pixels(planes, narrow, 4) == 0);
  CHECK(capture_frame(planes, narrow).rgb != capture_frame(planes, {.view = View::length}).rgb);
}

TEST_CASE("a view whose planes are not there is drawn as the image") {
  const Image film = gradient(9, 7, 1);
  const Image8 image = capture_frame(film, {});
  for (const View view : {View::noise, View::samples, View::scatterings, View::length, View::normals}) {
    CHECK(capture_frame(film, {.view = view}).rgb == image.rgb);
  }
  CHECK(capture_frame(film, {.view = View::luminance}).rgb != image.rgb);
}

TEST_CASE("the filmic curve draws as its CPU twin over twenty stops, and keeps middle grey") {
  Image ramp(1000, 1, 3);
  for (int i = 0; i < 1000; ++i) std::fill_n(ramp.at(i, 0), 3, std::exp2(0.02f * static_cast<float>(i) - 12));
  const ViewOptions filmic_tone{.tone = Tone::filmic};
  const auto wanted = [&](int x, int) { return grey(display_level(Tone::filmic, ramp.at(x, 0)[0])); };
  CHECK(wrong_pixels(capture_frame(ramp, filmic_tone), wanted, 0) <= 1);
  CHECK(wrong_pixels(capture_frame(ramp, filmic_tone), wanted, 1) == 0);
  Image special(3, 1, 3);
  special.values = {kNan, kInfinity, -1, 0, -kInfinity, 1e38f, 0.18f, 0.18f, 0.18f};
  const auto middle = static_cast<std::uint8_t>(display_level(Tone::srgb, 0.18));
  const std::vector<std::uint8_t> levels{0, 255, 0, 0, 0, 255, middle, middle, middle};
  CHECK(capture_frame(special, filmic_tone).rgb == levels);
}

TEST_CASE("planes are uploaded when a view looks at them, not before") {
  const FilmPlanes planes = synthetic();
  Easel easel(kWidth, kHeight);
  easel.a.show(planes, 7, View::image);
  CHECK(easel.a.has(View::samples));
  CHECK_FALSE(easel.a.has(View::noise));
  CHECK_FALSE(easel.a.has(View::normals));
  const auto image_only = easel.a.content();
  easel.a.show(planes, 7, View::luminance);
  CHECK(easel.a.content() == image_only);
  easel.a.show(planes, 7, View::noise);
  CHECK(easel.a.has(View::noise));
  CHECK(easel.a.has(View::image));
  easel.view.draw(easel.a, {.view = View::noise}, easel.stage(at_origin(kWidth, kHeight)));
  const Image8 frame = easel.read();
  CHECK(frame.rgb == draw_frame(easel.context.functions(), planes, {.view = View::noise}).rgb);
  easel.a.show(planes, 8, View::image);
  CHECK_FALSE(easel.a.has(View::noise));
}

}  // namespace meander
