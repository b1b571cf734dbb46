// A rectangle of floats: what images are before a file format or a texture has its say.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meander {

/// `channels` interleaved floats a pixel, row 0 at the top.
struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> values;

  Image() = default;
  Image(int w, int h, int c)
      : width(w), height(h), channels(c), values(static_cast<std::size_t>(w) * h * c, 0.0f) {}

  [[nodiscard]] std::size_t index(int x, int y) const noexcept {
    return (static_cast<std::size_t>(y) * width + x) * channels;
  }
  [[nodiscard]] const float* at(int x, int y) const noexcept { return values.data() + index(x, y); }
  [[nodiscard]] float* at(int x, int y) noexcept { return values.data() + index(x, y); }
};

/// A finished frame: three interleaved 8-bit display-encoded values (R G B) a pixel, row 0 at the top.
struct Image8 {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;

  Image8() = default;
  Image8(int w, int h) : width(w), height(h), rgb(static_cast<std::size_t>(w) * h * 3, std::uint8_t{0}) {}

  [[nodiscard]] std::size_t index(int x, int y) const noexcept {
    return (static_cast<std::size_t>(y) * width + x) * 3;
  }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const noexcept { return rgb.data() + index(x, y); }
  [[nodiscard]] std::uint8_t* at(int x, int y) noexcept { return rgb.data() + index(x, y); }
};

}  // namespace meander
