// A two-dimensional texture of bytes, smoothly sampled: fonts, icons, thumbnails.
#pragma once

#include <cstdint>

#include "gl/name.h"
#include "math/image.h"

namespace meander {

class Picture {
 public:
  explicit Picture(const Functions& gl);

  /// Replaces it by `width` x `height` bytes of coverage, which is sampled as white of that opacity. Error
  /// (runtime) when the context cannot hold it.
  void upload_coverage(int width, int height, const std::uint8_t* coverage);
  /// Replaces it by an opaque picture.
  void upload(const Image8& image);

  /// What GL calls it.
  [[nodiscard]] GLuint id() const noexcept { return name_.id(); }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }

 private:
  static void destroy(const Functions& gl, GLuint id) { gl.delete_textures(1, &id); }

  Name<destroy> name_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace meander
