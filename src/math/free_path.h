// The exponential free path: how far light flies in a homogeneous medium before it collides.
#pragma once

#include <cmath>
#include <limits>

#include "math/random.h"
#include "math/types.h"

namespace meander {

/// T(s) = exp(-sigma s), in [0, 1]; sigma >= 0 and s >= 0 in inverse units. 1 in a vacuum, even over an
/// infinite distance.
[[nodiscard]] inline Real transmittance(Real sigma, Real s) noexcept {
  return sigma > 0 ? std::exp(-sigma * s) : Real(1);
}

/// Distance with cdf xi in [0, 1): -ln(1 - xi) / sigma. +infinity in a vacuum. 1 - xi is exact on the
/// generator's grid and never 0, which xi itself can be.
[[nodiscard]] inline Real sample_free_path(Real sigma, Real xi) noexcept {
  return sigma > 0 ? -std::log(Real(1) - xi) / sigma : std::numeric_limits<Real>::infinity();
}

/// The same for numbers off the grid. In a body far thinner than the mean free path a flight ends inside for
/// the first few numbers of the grid alone: of an optical thickness of 1e-6, 17 of them instead of 16.8, and
/// never before 0. What they leave out counts to first order, which is all that matters where the flight is
/// short.
[[nodiscard]] inline Real sample_free_path(Real sigma, const FineNumber& xi) noexcept {
  return sigma > 0 ? (xi.rest - std::log(Real(1) - xi.number)) / sigma
                   : std::numeric_limits<Real>::infinity();
}

/// sigma exp(-sigma s), per unit length.
[[nodiscard]] inline Real pdf_free_path(Real sigma, Real s) noexcept {
  return sigma * transmittance(sigma, s);
}

/// The cdf 1 - exp(-sigma s): the xi that gives s.
[[nodiscard]] inline Real invert_free_path(Real sigma, Real s) noexcept {
  return sigma > 0 ? -std::expm1(-sigma * s) : Real(0);
}

}  // namespace meander
