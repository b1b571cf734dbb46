// A two-dimensional texture of floats, read texel by texel: no filtering, no mipmaps.
#pragma once

#include <array>
#include <vector>

#include "gl/buffer.h"
#include "gl/name.h"

namespace meander {

/// A new texture name, bound to unit 0, clamped at its edges, without mipmaps, filtered as `filter` says.
[[nodiscard]] GLuint new_texture(const Functions& gl, GLint filter);

/// Error (runtime) when the context cannot hold a texture of that size.
void expect_texture_size(const Functions& gl, int width, int height);

class Texture {
 public:
  explicit Texture(const Functions& gl);

  /// Replaces the whole texture by `width` x `height` pixels of `channels` (3 or 4) interleaved floats, row 0
  /// first at texel y = 0, kept as 32-bit floats. The pixels are copied before it returns, into memory that
  /// no draw still reads; the texture takes them from there when the driver has time. Error (runtime) when
  /// the context cannot hold it.
  void upload(int width, int height, int channels, const float* pixels);
  /// Makes it the texture of sampler `unit`.
  void bind(int unit) const;

  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }

 private:
  static void destroy(const Functions& gl, GLuint id) { gl.delete_textures(1, &id); }
  void allocate(int width, int height, int channels);

  Name<destroy> name_;
  std::array<Buffer, 2> staging_;  // taken in turn
  int next_ = 0;
  int width_ = 0;
  int height_ = 0;
  int channels_ = 0;
};

}  // namespace meander
