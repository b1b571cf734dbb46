// Addressed randomness: a stream is named by (seed, pixel, sample) and never stored across samples. 32-bit
// arithmetic alone, so that a vector version gives the same numbers.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "math/types.h"

namespace meander {

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw 2011, "Parallel Random Numbers: As Easy as 1, 2, 3"): a
/// bijection of the 128-bit counter for each 64-bit key, so that distinct addresses never share a state.
[[nodiscard]] std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter,
                                                  std::array<std::uint32_t, 2> key) noexcept;

/// A number of Random::next() and a point of the step that follows it on the grid, so that number + rest is
/// uniform on (0, 1) and resolved to 2^-32 where it is small.
struct FineNumber {
  Real number;
  Real rest;
};

/// xoshiro128++ 1.0 (Blackman & Vigna 2021, "Scrambled Linear Pseudorandom Number Generators"). The state
/// must not be all zero.
class Random {
 public:
  explicit Random(const std::array<std::uint32_t, 4>& state) noexcept : s_(state) {}

  [[nodiscard]] const std::array<std::uint32_t, 4>& state() const noexcept { return s_; }

  [[nodiscard]] std::uint32_t next_bits() noexcept {
    const std::uint32_t result = rotate(s_[0] + s_[3], 7) + s_[0];
    const std::uint32_t t = s_[1] << 9;
    s_[2] ^= s_[0];
    s_[3] ^= s_[1];
    s_[1] ^= s_[2];
    s_[0] ^= s_[3];
    s_[2] ^= t;
    s_[3] = rotate(s_[3], 11);
    return result;
  }

  /// Uniform on the grid k 2^-p, k = 0 … 2^p - 1, with Real's p digits (float 24, double 53): 1 - next() is
  /// exact and never 0. The grid caps one free flight at p ln 2 mean free paths (float 16.6, double 36.7).
  [[nodiscard]] Real next() noexcept {
    if constexpr (kDigits <= 32) return static_cast<Real>(next_bits() >> (32 - kDigits)) * kSpacing;
    const std::uint64_t high = next_bits();
    return static_cast<Real>((high << 32 | next_bits()) >> (64 - kDigits)) * kSpacing;
  }

  /// The same number as next() would give, with what that cuts off (in float, 8 bits and half of a ninth).
  [[nodiscard]] FineNumber next_fine() noexcept {
    if constexpr (kDigits > 32) {
      return {next(), kSpacing / 2};
    } else {
      const std::uint32_t bits = next_bits();
      const std::uint32_t cut = bits & ((1u << (32 - kDigits)) - 1);
      return {static_cast<Real>(bits >> (32 - kDigits)) * kSpacing,
              static_cast<Real>(2 * cut + 1) * Real(0x1p-33)};
    }
  }

 private:
  static constexpr int kDigits = std::numeric_limits<Real>::digits;
  static constexpr Real kSpacing = std::numeric_limits<Real>::epsilon() / 2;

  static std::uint32_t rotate(std::uint32_t x, int k) noexcept { return (x << k) | (x >> (32 - k)); }

  std::array<std::uint32_t, 4> s_;
};

/// The stream of one sample of one pixel. Streams of one seed never start from the same state.
[[nodiscard]] Random stream(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample) noexcept;

}  // namespace meander
