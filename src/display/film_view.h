// Draws a film: linear radiance in, display-encoded pixels out, in whatever framebuffer is bound.
#pragma once

#include "gl/program.h"
#include "gl/texture.h"
#include "gl/vertex_array.h"
#include "math/image.h"

namespace meander {

struct ViewOptions {
  float exposure = 0;  // stops: every value is multiplied by 2^exposure
};

/// A rectangle of pixels of an image, row 0 at the top.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

class FilmView {
 public:
  /// Needs its context current, here and in every call. Error (runtime) when the shaders are missing or do
  /// not compile.
  explicit FilmView(const Functions& gl);

  /// Takes a copy of channels 0..2 (linear Rec. 709) of a region of `linear`, which must lie inside it. Error
  /// (runtime) when the context cannot hold a texture of that size.
  void upload(const Image& linear, const Region& region);

  /// Draws what was uploaded into the bound framebuffer, pixel for pixel with its lower left corner at (0,
  /// 0); the viewport must be of the region's size. Values are multiplied by 2^exposure, clamped to [0, 1],
  /// sRGB-encoded (IEC 61966-2-1) and rounded to 8 bits; NaN shows as 0, +infinity as 1.
  void draw(const ViewOptions& options) const;

 private:
  const Functions* gl_;
  Program program_;
  Texture texture_;
  VertexArray triangle_;
};

}  // namespace meander
