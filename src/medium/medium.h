// What a walk needs to know of a homogeneous medium, and the three ways people describe one.
#pragma once

#include "math/types.h"
#include "medium/surface.h"

namespace meander {

/// A homogeneous medium. sigma_t is the extinction coefficient per scene unit (>= 0, 0 is vacuum), albedo the
/// single-scattering albedo sigma_s / sigma_t in [0, 1], both per channel; g the Henyey-Greenstein mean
/// cosine, |g| < 1.
struct Medium {
  Rgb sigma_t{1};
  Rgb albedo{0};
  Real g = 0;
};

class ColorMap;

enum class Inversion { exact, chiang, van_de_hulst };

/// sigma_s and sigma_a >= 0 per scene unit.
[[nodiscard]] Medium medium_from_sigma(const DVec3& sigma_s, const DVec3& sigma_a, double g);

/// albedo in [0, 1]; mean_free_path > 0 in scene units, +infinity is vacuum.
[[nodiscard]] Medium medium_from_albedo(const DVec3& albedo, const DVec3& mean_free_path, double g);

/// color in [0, 1]: the diffuse albedo of a half-space of the material (ColorMap says of what flux); radius >
/// 0 in scene units. `exact` (ColorMap of g and the surface) and `van_de_hulst` (Kulla & Conty 2017) take
/// sigma_t = 1 / radius; `chiang` (Chiang, Kutz, Burley 2016) yields reduced quantities, which are un-reduced
/// by similarity for g. These two hold for a matched boundary and are the same whatever the surface. An
/// infinite radius is vacuum.
[[nodiscard]] Medium medium_from_color(const DVec3& color, const DVec3& radius, double g, Inversion inversion,
                                       Surface surface = {});

/// The colour (diffuse albedo of the half-space under uniform light, ColorMap) that a medium of this albedo
/// and g delivers under this surface: monotone in albedo, 0 at 0 and 1 at 1. Accurate as ColorMap, which to
/// keep where it is asked more than once for one g and surface.
[[nodiscard]] DVec3 color_of(const DVec3& albedo, double g, Surface surface = {});
[[nodiscard]] DVec3 color_of(const DVec3& albedo, const ColorMap& map);

}  // namespace meander
