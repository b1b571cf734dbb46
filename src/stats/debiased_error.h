// The error of an image against a reference that is itself a noisy estimate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "math/image.h"

namespace meander {

/// Of the counted pixels p and channels c, r the reference, v the variance of its mean and m the mean of r
/// over the counted pixels among p's 3 x 3, w = 1 / (m^2 + 1e-4):
///   mse = mean w ((a - r)^2 - v),
/// whose expectation is a's own relative squared error but for what is left of r's noise in w, because a and
/// r are independent and E (a - r)^2 = E (a - truth)^2 + v. Not r's own square, as relmse has it: where r is
/// noisy, its dark pixels would outweigh all others. The noise's m is the same (film/noise.h). It may come
/// out negative where the reference is no better than a.
struct DebiasedError {
  double mse = 0;                       // NaN without pixels
  double standard_error = 0;            // of mse: from its spread over the pixels, which are independent; NaN
                                        // below two pixels
  std::optional<double> reference_mse;  // mean w v, what was subtracted; none where the variance is unknown
  std::size_t pixels = 0;               // counted and finite

  /// sqrt(mse), 0 where that is negative, NaN without pixels.
  [[nodiscard]] double rms() const noexcept;
  /// sqrt of mse -+ 1.96 standard errors, each 0 where that is negative: a 95 % interval while no rare bright
  /// pixel carries the spread.
  [[nodiscard]] double rms_low() const noexcept;
  [[nodiscard]] double rms_high() const noexcept;
  [[nodiscard]] double reference_rms() const noexcept;  // 0 where it is unknown
  /// Whether the reference's own error is at most a third of rms: what was subtracted is then a ninth at
  /// most. False where it is unknown.
  [[nodiscard]] bool reference_is_a_third() const noexcept;
};

/// `reference` has R G B, and the variance of each mean after them where it is known; `a` and `mask` as
/// image_error takes them (image_error.h), with the same errors. A pixel with a value that is not finite is
/// left out.
[[nodiscard]] DebiasedError debiased_error(const Image& a, const Image& reference,
                                           std::span<const std::uint8_t> mask = {});

}  // namespace meander
