// Which pixels a comparison of two images counts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "math/image.h"

namespace meander {

/// The counted pixels of two images under a mask; the mask outlives it.
class CountedPixels {
 public:
  /// Throws Error (input) unless both images have one size and at least `channels` channels, and the mask is
  /// empty or of that size.
  CountedPixels(const Image& a, const Image& b, std::span<const std::uint8_t> mask, int channels);

  [[nodiscard]] bool counts(std::size_t pixel) const noexcept { return mask_.empty() || mask_[pixel] != 0; }

 private:
  std::span<const std::uint8_t> mask_;  // empty when every pixel counts
};

}  // namespace meander
