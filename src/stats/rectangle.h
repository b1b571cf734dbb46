// The mean of a picture over a rectangle, with the interval that its noise allows.
#pragma once

#include <array>
#include <cstddef>

#include "math/image.h"

namespace meander {

/// Pixels x0 <= x < x1, y0 <= y < y1, row 0 at the top.
struct PixelRectangle {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
};

/// Per channel: the mean over the pixels, and the half width of its 95 % interval. A half width is infinite
/// where some pixel has fewer than two samples and so no variance of its own.
struct RectangleMean {
  std::array<double, 3> mean{};
  std::array<double, 3> half_width{};
  std::size_t pixels = 0;
};

/// `radiance` has the channels R G B and samples a pixel, `variance` those of each mean first; both of one
/// size. The rectangle is clipped to it; none of it left gives 0 pixels. Pixels draw from streams of their
/// own, so their variances add; the interval is Student's t with Welch and Satterthwaite's degrees of freedom
/// (Satterthwaite 1946, eq. 17).
[[nodiscard]] RectangleMean rectangle_mean(const Image& radiance, const Image& variance, PixelRectangle area);

}  // namespace meander
