// Where contributions go. No walk knows a film: the plain film, bins and tests are sinks alike.
#pragma once

#include <concepts>
#include <cstdint>

#include "math/types.h"

namespace meander {

/// Light that one sample of a pixel has found. Its value is unweighted * albedo.
struct Contribution {
  int group = 0;            // 0: environment and emissive objects; 1 + i: light i
  std::uint32_t order = 0;  // number of scatterings in media
  Rgb unweighted{0};        // radiance times everything but the single-scattering albedos
  Rgb albedo{1};            // product of the albedos over the scatterings
  Real length = 0;          // path length inside media, scene units

  [[nodiscard]] Rgb value() const noexcept { return unweighted * albedo; }
};

template <class S>
concept Sink = requires(S& sink, const Contribution& contribution) {
  sink.add(contribution);
};

/// Adds everything up: what one sample is worth.
struct RadianceSink {
  Rgb radiance{0};
  void add(const Contribution& contribution) noexcept { radiance += contribution.value(); }
};

}  // namespace meander
