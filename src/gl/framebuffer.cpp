#include "gl/framebuffer.h"

#include <cassert>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"

namespace meander {
namespace {

GLuint new_renderbuffer(const Functions& gl) {
  GLuint id = 0;
  gl.gen_renderbuffers(1, &id);
  return id;
}

GLuint new_framebuffer(const Functions& gl) {
  GLuint id = 0;
  gl.gen_framebuffers(1, &id);
  return id;
}

}  // namespace

Framebuffer::Framebuffer(const Functions& gl, int width, int height)
    : color_(gl, new_renderbuffer(gl)), target_(gl, new_framebuffer(gl)), width_(width), height_(height) {
  assert(width > 0 && height > 0);
  const std::string size = std::to_string(width) + " x " + std::to_string(height);
  gl.bind_renderbuffer(GL_RENDERBUFFER, color_.id());
  gl.renderbuffer_storage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  expect_no_error(gl, "making a frame of " + size + " pixels");
  gl.bind_framebuffer(GL_FRAMEBUFFER, target_.id());
  gl.framebuffer_renderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.id());
  if (gl.check_framebuffer_status(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw Error(Fault::runtime, "this OpenGL cannot draw into a frame of " + size + " pixels");
  }
  expect_no_error(gl, "making a frame of " + size + " pixels");
}

void Framebuffer::bind(int width, int height) const {
  assert(width <= width_ && height <= height_);
  color_.gl().bind_framebuffer(GL_FRAMEBUFFER, target_.id());
  color_.gl().viewport(0, 0, width, height);
}

Image8 Framebuffer::read(int width, int height) const {
  assert(width <= width_ && height <= height_);
  const Functions& gl = color_.gl();
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width) * height * 4);
  gl.bind_framebuffer(GL_FRAMEBUFFER, target_.id());
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
