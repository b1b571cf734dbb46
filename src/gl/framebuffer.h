// A target of our own to draw a frame into: what comes back never depends on the context's own buffer.
#pragma once

#include <array>

#include "gl/name.h"
#include "math/image.h"

namespace meander {

class Framebuffer {
 public:
  /// 8-bit RGBA, `width` x `height` pixels. Error (runtime) when the context cannot make it.
  Framebuffer(const Functions& gl, int width, int height);

  /// Drawing goes here from now on, over the `width` x `height` pixels at the lower left.
  void bind(int width, int height) const;
  /// Copies the rectangle at (x, y) from the lower left to the same place of the framebuffer that GL calls
  /// `to`, which is then the bound one.
  void copy_to(GLuint to, const std::array<int, 4>& x_y_width_height) const;
  /// The `width` x `height` pixels at the lower left, as RGB, top row first.
  [[nodiscard]] Image8 read(int width, int height) const;

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }

 private:
  static void destroy_target(const Functions& gl, GLuint id) { gl.delete_framebuffers(1, &id); }
  static void destroy_color(const Functions& gl, GLuint id) { gl.delete_renderbuffers(1, &id); }

  Name<destroy_color> color_;
  Name<destroy_target> target_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace meander
