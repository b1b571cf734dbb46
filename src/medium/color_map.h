// The map between the single-scattering albedo of a medium and the colour that a half-space of it shows.
#pragma once

#include <array>

#include "medium/surface.h"

namespace meander {

/// The curve of one g and surface, made once (milliseconds, see below; nothing when matched at g = 0) and
/// then cheap to evaluate in either direction. A colour is the diffuse albedo of the half-space under uniform
/// light from outside: the flux that leaves from below over the flux that entered; what the outer side of the
/// surface reflects is in neither. Both directions increase strictly, map 0 to 0 and 1 to 1 exactly, and are
/// each other's inverse as far as a double can hold an albedo near 1 (matched colours within 1e-9 for |g| <=
/// 0.95, 1e-6 for |g| <= 0.9999). A value type.
class ColorMap {
 public:
  /// |g| < 1. Matched and diffuse colours are within 1.5e-6 of the exact ones for |g| <= 0.95 and within 5e-6
  /// for |g| <= 0.9999; beyond that the curve of +-0.9999 is kept, over the same similarity variable.
  /// Diffuse with an index step has the closed form r (1 - F) / (1 - F r), r the matched colour and F
  /// diffuse_internal_reflectance. Rough dielectric is solved with a table of what the facets send back,
  /// within 2e-3. Smooth dielectric is solved with Fresnel's mirror inside. Within 2.5e-5 for -0.7 <= g <=
  /// 0.95, 1e-4 for -0.95 <= g < -0.7 and 1e-4 for 0.95 < g; stronger backward peaks 2e-4 up to ior 2, 1.5e-3
  /// up to 4. Takes about 8 ms, for g < -0.7 60 ms, rough 50 ms; the round trip of a colour is 1e-6 for |g|
  /// <= 0.999.
  explicit ColorMap(double g, Surface surface = {});

  /// albedo in [0, 1] to colour in [0, 1].
  [[nodiscard]] double color(double albedo) const noexcept;

  /// color in [0, 1] to albedo in [0, 1].
  [[nodiscard]] double albedo(double color) const noexcept;

  /// 1 - albedo(color) to full relative precision, which the difference itself would lose near white.
  [[nodiscard]] double one_minus_albedo(double color) const noexcept;

  [[nodiscard]] double g() const noexcept { return g_; }

 private:
  static constexpr int kNodes = 24;

  /// s = sqrt((1 - albedo)/(1 - albedo g)) and 1 - s, each to full relative precision.
  struct Similarity {
    double s;
    double one_minus;
  };
  [[nodiscard]] Similarity similarity_of(double color) const noexcept;

  double g_;
  bool tabulated_;
  std::array<double, kNodes> shape_{};  // Chebyshev coefficients of the curve, where it is tabulated
};

}  // namespace meander
