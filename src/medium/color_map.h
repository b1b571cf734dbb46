// The map between the single-scattering albedo of a medium and the colour that a half-space of it shows.
#pragma once

#include <array>

namespace meander {

/// One g's curve, made once (some milliseconds; nothing at g = 0) and then cheap to evaluate in either
/// direction. A colour is the diffuse albedo of the matched half-space under uniform light. Both directions
/// increase strictly, map 0 to 0 and 1 to 1 exactly, and are each other's inverse as far as a double can hold
/// an albedo near 1 (colours within 1e-9 for |g| <= 0.95, 1e-6 for |g| <= 0.9999). A value type.
class ColorMap {
 public:
  /// |g| < 1. Colours are within 1.5e-6 of the exact ones for |g| <= 0.95 and within 5e-6 for |g| <= 0.9999;
  /// beyond that the curve of +-0.9999 is kept, over the same similarity variable.
  explicit ColorMap(double g);

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
  std::array<double, kNodes> shape_{};  // Chebyshev coefficients of the curve; unused at g = 0
};

}  // namespace meander
