// The coefficients of a medium in double precision: what materials are converted and edited in, because near
// white a float albedo keeps few digits of the absorption.
#pragma once

#include "medium/medium.h"

namespace meander {

/// sigma_s and sigma_a >= 0 per channel and unit of length, the full ones that go with g; |g| < 1.
struct Coefficients {
  DVec3 sigma_s{0};
  DVec3 sigma_a{0};
  double g = 0;
};

/// As medium_from_albedo and medium_from_color (medium.h).
[[nodiscard]] Coefficients coefficients_from_albedo(const DVec3& albedo, const DVec3& mean_free_path,
                                                    double g);
[[nodiscard]] Coefficients coefficients_from_color(const DVec3& color, const DVec3& radius, double g,
                                                   Inversion inversion, Surface surface = {});
/// The exact inversion for the map's own g and surface.
[[nodiscard]] Coefficients coefficients_from_color(const DVec3& color, const DVec3& radius,
                                                   const ColorMap& map);

/// There and back; a vacuum channel has albedo 0.
[[nodiscard]] Medium make_medium(const Coefficients& coefficients);
[[nodiscard]] Coefficients coefficients_of(const Medium& medium);

[[nodiscard]] inline DVec3 sigma_t_of(const Coefficients& c) { return c.sigma_s + c.sigma_a; }

/// sigma_s / sigma_t, 0 in vacuum.
[[nodiscard]] DVec3 albedo_of(const Coefficients& coefficients);

}  // namespace meander
