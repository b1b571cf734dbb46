// Linear Rec. 709 and its display encoding.
#pragma once

#include <cmath>

#include "math/types.h"

namespace meander {

/// Relative luminance of linear Rec. 709 (ITU-R BT.709-6, item 3.2).
[[nodiscard]] inline Real luminance(const Rgb& c) noexcept {
  return Real(0.2126) * c.x + Real(0.7152) * c.y + Real(0.0722) * c.z;
}

/// Linear to sRGB-encoded, both in [0, 1] (IEC 61966-2-1).
[[nodiscard]] inline Real encode_srgb(Real linear) noexcept {
  return linear <= Real(0.0031308) ? Real(12.92) * linear
                                   : Real(1.055) * std::pow(linear, Real(1 / 2.4)) - Real(0.055);
}

/// sRGB-encoded to linear, both in [0, 1].
[[nodiscard]] inline Real decode_srgb(Real encoded) noexcept {
  return encoded <= Real(0.04045) ? encoded / Real(12.92)
                                  : std::pow((encoded + Real(0.055)) / Real(1.055), Real(2.4));
}

}  // namespace meander
