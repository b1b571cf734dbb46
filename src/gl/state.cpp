#include "gl/state.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meander {

void reset_state(const Functions& gl) {
  for (const GLenum state : {GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_DITHER, GL_FRAMEBUFFER_SRGB,
                             GL_SCISSOR_TEST, GL_STENCIL_TEST}) {
    gl.disable(state);
  }
}

void clear(const Functions& gl, float grey) {
  reset_state(gl);
  gl.clear_color(grey, grey, grey, 1.0f);
  gl.clear(GL_COLOR_BUFFER_BIT);
}

Image8 read_pixels(const Functions& gl, int width, int height) {
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * height * 4);
  gl.pixel_storei(GL_PACK_ALIGNMENT, 4);
  gl.pixel_storei(GL_PACK_ROW_LENGTH, 0);
  gl.read_pixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  expect_no_error(gl, "reading the frame back");
  Image8 frame(width, height);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = rgba.data() + static_cast<std::size_t>(height - 1 - y) * width * 4;
    std::uint8_t* to = frame.at(0, y);
    for (int x = 0; x < width; ++x, from += 4, to += 3) {
      to[0] = from[0];
      to[1] = from[1];
      to[2] = from[2];
    }
  }
  return frame;
}

}  // namespace meander
