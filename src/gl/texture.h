// A two-dimensional texture of floats, read texel by texel: no filtering, no mipmaps.
#pragma once

#include "gl/name.h"

namespace meander {

class Texture {
 public:
  explicit Texture(const Functions& gl);

  /// Replaces the whole texture by `width` x `height` pixels of `channels` (3 or 4) interleaved floats, row 0
  /// first at texel y = 0, kept as 32-bit floats. Error (runtime) when the context cannot hold it.
  void upload(int width, int height, int channels, const float* pixels);
  /// Makes it the texture of sampler `unit`.
  void bind(int unit) const;

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }

 private:
  static void destroy(const Functions& gl, GLuint id) { gl.delete_textures(1, &id); }

  Name<destroy> name_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace meander
