// Every way of looking at a film against the same on the CPU: views, tones, comparisons, placements.
#include "display/film_view.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "core/error.h"
#include "display/capture.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "gl/state.h"
#include "math/color_scale.h"
#include "math/tone.h"

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

Level3 grey(int level) {
  const auto l = static_cast<std::uint8_t>(level);
  return {l, l, l};
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

// Pixels off by more than `tolerance` levels in some channel.
int wrong_pixels(const Image8& frame, const std::function<Level3(int, int)>& wanted, int tolerance) {
  int wrong = 0;
  for (int y = 0; y < frame.height; ++y) {
    for (int x = 0; x < frame.width; ++x) {
      const Level3 want = wanted(x, y);
      bool off = false;
      for (std::size_t c = 0; c < 3; ++c) off = off || std::abs(frame.at(x, y)[c] - want[c]) > tolerance;
      wrong += off;
    }
  }
  return wrong;
}

int wrong_pixels(const FilmPlanes& planes, const ViewOptions& options, int tolerance) {
  const auto wanted = [&](int x, int y) { return expected(planes, x, y, options); };
  return wrong_pixels(capture_frame(planes, options), wanted, tolerance);
}

// One context with all that draws a film.
struct Easel {
  Offscreen context{1, 1};
  FilmView view{context.functions()};
  FilmTextures a{context.functions()};
  FilmTextures b{context.functions()};
  int width = 0;
  int height = 0;
  Framebuffer target;

  Easel(int w, int h) : width(w), height(h), target(context.functions(), w, h) {
    target.bind(w, h);
    clear(context.functions(), 0.2f);  // level 51
  }
  [[nodiscard]] Stage stage(const FilmPlacement& at) const { return {at, width, height, {}}; }
  [[nodiscard]] Image8 read() const { return target.read(width, height); }
};

Image gradient(int width, int height, float scale) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y)[0] = scale * static_cast<float>(x + 1) / static_cast<float>(width);
      image.at(x, y)[1] = scale * static_cast<float>(y + 1) / static_cast<float>(height);
      image.at(x, y)[2] = scale * static_cast<float>((x * 7 + y * 3) % 5) / 5;
    }
  }
  return image;
}

Level3 levels_of(const float* c, double factor = 1) {
  Level3 levels{};
  for (std::size_t i = 0; i < 3; ++i) {
    levels[i] = static_cast<std::uint8_t>(display_level(Tone::srgb, c[i] * factor));
  }
  return levels;
}

FilmPlacement at_origin(int width, int height) {
  return {0, 0, static_cast<float>(width), static_cast<float>(height)};
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

TEST_CASE("whole factors of zoom show every film pixel as a block, wherever it is panned to") {
  const Image film = gradient(11, 9, 1);
  Easel easel(50, 40);
  easel.a.show(film, 1);
  for (const auto& [x, y] : {std::pair{5, 4}, std::pair{-7, -3}, std::pair{30, 25}}) {
    clear(easel.context.functions(), 0.2f);
    easel.view.draw(easel.a, {}, easel.stage({static_cast<float>(x), static_cast<float>(y), 33, 27}));
    const auto wanted = [&, ox = x, oy = y](int px, int py) {
      const bool inside = px >= ox && py >= oy && px < ox + 33 && py < oy + 27;
      return inside ? levels_of(film.at((px - ox) / 3, (py - oy) / 3)) : grey(51);
    };
    CHECK(wrong_pixels(easel.read(), wanted, 0) == 0);
  }
}

TEST_CASE("a film shrunk to half its size shows the mean of four pixels, in linear light") {
  const Image film = gradient(20, 12, 1);
  Easel easel(10, 6);
  easel.a.show(film, 1);
  easel.view.draw(easel.a, {}, easel.stage(at_origin(10, 6)));
  const auto wanted = [&](int x, int y) {
    std::array<float, 3> mean{};
    for (std::size_t c = 0; c < 3; ++c) {
      mean[c] = 0.25f * (film.at(2 * x, 2 * y)[c] + film.at(2 * x + 1, 2 * y)[c] +
                         film.at(2 * x, 2 * y + 1)[c] + film.at(2 * x + 1, 2 * y + 1)[c]);
    }
    return levels_of(mean.data());
  };
  CHECK(wrong_pixels(easel.read(), wanted, 1) == 0);
}

TEST_CASE("a shrunk film keeps its mean at any size, and one bad pixel stays where it is") {
  Image film(64, 64, 3);
  std::ranges::fill(film.values, 0.3f);
  std::fill_n(film.at(10, 10), 3, kNan);
  Easel easel(50, 50);
  easel.a.show(film, 1);
  easel.view.draw(easel.a, {}, easel.stage({0.3f, 0.6f, 41.7f, 37.9f}));
  const int level = display_level(Tone::srgb, 0.3f);
  int other = 0;
  const Image8 frame = easel.read();
  for (int y = 1; y < 38; ++y) {
    for (int x = 1; x < 41; ++x) other += frame.at(x, y)[0] != level;
  }
  CHECK(other >= 1);
  CHECK(other <= 4);
}

TEST_CASE("a coarse level is interpolated when enlarged, and reaches its values at the centres") {
  Image film(2, 1, 3);
  std::fill_n(film.at(1, 0), 3, 1.0f);
  Easel easel(20, 10);
  easel.a.show(film, 1);
  easel.view.draw(easel.a, {.smooth = true}, easel.stage(at_origin(20, 10)));
  const auto wanted = [](int x, int) {
    return grey(display_level(Tone::srgb, std::clamp((x + 0.5 - 5) / 10, 0.0, 1.0)));
  };
  CHECK(wrong_pixels(easel.read(), wanted, 1) == 0);
  easel.view.draw(easel.a, {.smooth = false}, easel.stage(at_origin(20, 10)));
  CHECK(wrong_pixels(
            easel.read(), [](int x, int) { return grey(x < 10 ? 0 : 255); }, 0) == 0);
}

TEST_CASE("nothing is drawn outside the clip rectangle") {
  Easel easel(20, 10);
  easel.a.show(gradient(20, 10, 1), 1);
  Stage stage = easel.stage(at_origin(20, 10));
  stage.clip = Region{4, 2, 10, 5};
  easel.view.draw(easel.a, {.exposure = 20}, stage);
  const Image8 frame = easel.read();
  int drawn = 0;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool touched = frame.at(x, y)[0] != 51;
      drawn += touched;
      if (touched) CHECK((x >= 4 && x < 14 && y >= 2 && y < 7));
    }
  }
  CHECK(drawn == 50);
}

TEST_CASE("a wipe shows one film left of the line and the other right of it, of whatever size") {
  Easel easel(24, 12);
  const Image a = gradient(24, 12, 1);
  const Image b = gradient(8, 4, 0.5f);
  easel.a.show(a, 1);
  easel.b.show(b, 1);
  for (const int line : {0, 7, 24}) {
    easel.view.draw_compared(easel.a, easel.b, {Comparison::wipe, static_cast<float>(line)}, {},
                             easel.stage(at_origin(24, 12)));
    const auto wanted = [&](int x, int y) {
      return x < line ? levels_of(a.at(x, y)) : levels_of(b.at(x / 3, y / 3));
    };
    CHECK(wrong_pixels(easel.read(), wanted, 0) <= 1);
    CHECK(wrong_pixels(easel.read(), wanted, 1) == 0);
  }
  easel.view.draw_compared(easel.a, easel.b, {Comparison::only_b}, {}, easel.stage(at_origin(24, 12)));
  const auto only_b = [&](int x, int y) { return levels_of(b.at(x / 3, y / 3)); };
  CHECK(wrong_pixels(easel.read(), only_b, 1) == 0);
}

TEST_CASE("a difference is the absolute difference of radiance, under the exposure") {
  Easel easel(24, 12);
  const Image a = gradient(24, 12, 1);
  const Image b = gradient(8, 4, 0.9f);
  easel.a.show(a, 1);
  easel.b.show(b, 1);
  const auto wanted = [&](int x, int y) {
    std::array<float, 3> off{};
    for (std::size_t c = 0; c < 3; ++c) off[c] = std::abs(a.at(x, y)[c] - b.at(x / 3, y / 3)[c]);
    return levels_of(off.data(), 8);
  };
  easel.view.draw_compared(easel.a, easel.b, {Comparison::difference}, {.exposure = 3},
                           easel.stage(at_origin(24, 12)));
  CHECK(wrong_pixels(easel.read(), wanted, 1) == 0);
  easel.view.draw_compared(easel.a, easel.a, {Comparison::difference}, {.exposure = 20},
                           easel.stage(at_origin(24, 12)));
  CHECK(wrong_pixels(
            easel.read(), [](int, int) { return grey(0); }, 0) == 0);
}

TEST_CASE("films of different sizes in a row, and new values under a new version alone") {
  Easel easel(16, 16);
  for (const int size : {3, 16, 1, 5, 16}) {
    const Image film = gradient(size, size, 1);
    easel.a.show(film, 1);
    easel.view.draw(easel.a, {}, easel.stage(at_origin(size, size)));
    const Image8 frame = easel.read();
    int wrong = 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) wrong += std::abs(frame.at(x, y)[1] - levels_of(film.at(x, y))[1]) > 1;
    }
    CHECK(wrong == 0);
  }
  const Image8 before = easel.read();
  const Image darker = gradient(16, 16, 0.5f);
  easel.a.show(darker, 1);  // the same version: nobody looks
  easel.view.draw(easel.a, {}, easel.stage(at_origin(16, 16)));
  CHECK(easel.read().rgb == before.rgb);
  easel.a.show(darker, 2);
  easel.view.draw(easel.a, {}, easel.stage(at_origin(16, 16)));
  const Image8 after = easel.read();
  CHECK(after.rgb != before.rgb);
  CHECK(after.rgb == capture_frame(darker, {}).rgb);
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

TEST_CASE("new textures in the place of old ones are not taken for them") {
  Easel easel(8, 8);
  for (const float scale : {1.0f, 0.5f}) {
    easel.a = FilmTextures(easel.context.functions());
    const Image film = gradient(8, 8, scale);
    easel.a.show(film, 1);
    easel.view.draw(easel.a, {}, easel.stage(at_origin(8, 8)));
    CHECK(wrong_pixels(
              easel.read(), [&](int x, int y) { return levels_of(film.at(x, y)); }, 1) == 0);
  }
}

TEST_CASE("the shaders are kept when their new text does not compile, and the film goes on") {
  Easel easel(8, 8);
  easel.a.show(gradient(8, 8, 1), 1);
  easel.view.draw(easel.a, {}, easel.stage(at_origin(8, 8)));
  const Image8 before = easel.read();
  setenv("MEANDER_SHADERS", MEANDER_SOURCE_DIR "/tests/display/broken", 1);
  std::string message;
  try {
    easel.view.reload();
  } catch (const Error& error) {
    message = error.what();
  }
  unsetenv("MEANDER_SHADERS");
  CHECK(message.find("tests/display/broken/film.frag does not compile: ") != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
  clear(easel.context.functions(), 0.2f);
  easel.view.draw(easel.a, {}, easel.stage(at_origin(8, 8)));
  CHECK(easel.read().rgb == before.rgb);
  easel.view.draw(easel.a, {.view = View::clipping},
                  easel.stage(at_origin(8, 8)));  // compiled from the good text
  setenv("MEANDER_SHADERS", MEANDER_SOURCE_DIR "/tests/display/white", 1);
  easel.view.reload();
  unsetenv("MEANDER_SHADERS");
  easel.view.draw(easel.a, {}, easel.stage(at_origin(8, 8)));
  CHECK(wrong_pixels(
            easel.read(), [](int, int) { return grey(255); }, 0) == 0);
}

TEST_CASE("a picture is fitted in whole factors where there is room, and shrunk where there is none") {
  CHECK(fitted(960, 540, {10, 40, 960, 540}) == FilmPlacement{10, 40, 960, 540});
  CHECK(fitted(100, 50, {0, 0, 350, 350}) == FilmPlacement{25, 100, 300, 150});
  const FilmPlacement small = fitted(960, 540, {0, 0, 480, 400});
  CHECK(small.width == doctest::Approx(480));
  CHECK(small.height == doctest::Approx(270));
  CHECK(small.y == 65);
  CHECK(fitted(1, 1000, {0, 0, 10, 10}).width >= 1);
}

}  // namespace meander
