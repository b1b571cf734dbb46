#include "gl/framebuffer.h"

#include <cassert>
#include <string>

#include "core/error.h"
#include "gl/state.h"

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

void Framebuffer::copy_to(GLuint to, const std::array<int, 4>& x_y_width_height) const {
  const Functions& gl = color_.gl();
  const auto [x, y, width, height] = x_y_width_height;
  gl.bind_framebuffer(GL_READ_FRAMEBUFFER, target_.id());
  gl.bind_framebuffer(GL_DRAW_FRAMEBUFFER, to);
  gl.blit_framebuffer(x, y, x + width, y + height, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT,
                      GL_NEAREST);
  gl.bind_framebuffer(GL_FRAMEBUFFER, to);
}

Image8 Framebuffer::read(int width, int height) const {
  assert(width <= width_ && height <= height_);
  color_.gl().bind_framebuffer(GL_FRAMEBUFFER, target_.id());
  return read_pixels(color_.gl(), width, height);
}

}  // namespace meander
