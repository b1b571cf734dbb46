// What the tests of drawn films share: a context with all that draws one, and pixels counted against a
// formula.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <functional>

#include "display/film_view.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "gl/state.h"
#include "math/color_scale.h"
#include "math/tone.h"

namespace meander {

inline Level3 grey(int level) {
  const auto l = static_cast<std::uint8_t>(level);
  return {l, l, l};
}

// Pixels off by more than `tolerance` levels in some channel.
inline int wrong_pixels(const Image8& frame, const std::function<Level3(int, int)>& wanted, int tolerance) {
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

inline Image gradient(int width, int height, float scale) {
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

inline Level3 levels_of(const float* c, double factor = 1) {
  Level3 levels{};
  for (std::size_t i = 0; i < 3; ++i) {
    levels[i] = static_cast<std::uint8_t>(display_level(Tone::srgb, c[i] * factor));
  }
  return levels;
}

inline FilmPlacement at_origin(int width, int height) {
  return {0, 0, static_cast<float>(width), static_cast<float>(height)};
}

}  // namespace meander
