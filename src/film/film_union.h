// The union of films of disjoint samples, as resolved images hold them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "math/image.h"

namespace meander {

/// Means and sums of squared deviations, in double, of the samples of several resolved films: what one film
/// of all the samples would have (Chan, Golub and LeVeque 1979, "Updating formulae and a pairwise algorithm
/// for computing sample variances"). A film of one sample has no variance, and its deviations from its own
/// mean are 0: it adds what its mean differs by, and nothing else.
class FilmUnion {
 public:
  /// `resolved` holds R G B and, from two samples on, the variance of each mean, all finite, no variance
  /// below 0; the same size every time. `samples` >= 1 a pixel.
  void add(const Image& resolved, std::uint64_t samples);

  /// Samples a pixel so far.
  [[nodiscard]] std::uint64_t samples() const noexcept { return samples_; }

  /// Six channels, as film.h's resolve; the variances are 0 below two samples. Needs one film at least.
  [[nodiscard]] Image resolve() const;

 private:
  struct Sums {
    double mean = 0;
    double m2 = 0;
  };

  int width_ = 0;
  int height_ = 0;
  std::uint64_t samples_ = 0;
  std::vector<std::array<Sums, 3>> pixels_;
};

}  // namespace meander
