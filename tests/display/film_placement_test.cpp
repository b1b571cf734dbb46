// Where a film is drawn, and what is kept from one drawing to the next: zoom, pan, clipping, comparisons,
// uploads, shaders.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "core/error.h"
#include "display/capture.h"
#include "display/easel.h"

namespace meander {

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
  std::fill_n(film.at(10, 10), 3, std::numeric_limits<float>::quiet_NaN());
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

TEST_CASE("preparing draws nothing, and changes nothing that is drawn") {
  Easel easel(8, 8);
  const Image film = gradient(8, 8, 1);
  easel.a.show(film, 1);
  for (int round = 0; round < 2; ++round) {
    clear(easel.context.functions(), 0.2f);
    easel.view.prepare(easel.a, {});
    CHECK(wrong_pixels(
              easel.read(), [](int, int) { return grey(51); }, 0) == 0);
    easel.target.bind(8, 8);
    easel.view.draw(easel.a, {}, easel.stage(at_origin(8, 8)));
    CHECK(wrong_pixels(
              easel.read(), [&](int x, int y) { return levels_of(film.at(x, y)); }, 1) == 0);
  }
  CHECK(easel.context.functions().get_error() == GL_NO_ERROR);
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

TEST_CASE("of many ways of drawing those used last are kept, and one forgotten draws as before") {
  Easel easel(8, 8);
  const Image colors = gradient(8, 8, 1);
  Image four(8, 8, 4);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      for (int c = 0; c < 4; ++c) four.at(x, y)[c] = colors.at(x, y)[c % 3];
  const FilmPlanes planes{four, four, four};
  const std::array<FilmPlacement, 3> filters{at_origin(8, 8), FilmPlacement{0, 0, 12, 12},
                                             FilmPlacement{0, 0, 7, 7}};
  std::vector<std::vector<std::uint8_t>> first;
  const auto draw_all = [&](const auto& use) {
    for (const Tone tone : {Tone::srgb, Tone::filmic}) {
      for (std::size_t view = 0; view < kViewNames.size(); ++view) {
        for (const FilmPlacement& placement : filters) {
          clear(easel.context.functions(), 0.2f);
          easel.a.show(planes, 1, static_cast<View>(view));
          easel.view.draw(easel.a, {.tone = tone, .view = static_cast<View>(view)}, easel.stage(placement));
          use(easel.read().rgb);
        }
      }
    }
  };
  draw_all([&](const auto& rgb) { first.push_back(rgb); });
  REQUIRE(first.size() == 48);
  REQUIRE(first[0] != first[24]);  // the curves
  for (int view = 1; view < 4; ++view) REQUIRE(first[3 * view] != first[0]);
  std::size_t index = 0;
  draw_all([&](const auto& rgb) { CHECK(rgb == first[index++]); });
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
