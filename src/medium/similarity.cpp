#include "medium/similarity.h"

#include <cassert>
#include <cmath>

#include "medium/color_maps.h"

namespace meander {

namespace {

Coefficients with_look(const Coefficients& medium, double g, const Surface& surface, ColorMaps& maps) {
  const ColorMap before = maps.of(medium.g, surface);
  const ColorMap after = maps.of(g, surface);
  const DVec3 albedo = albedo_of(medium);
  const DVec3 sigma_t_reduced = sigma_t_of(reduced(medium));
  Coefficients result{{}, {}, g};
  for (int c = 0; c < 3; ++c) {
    const double color = before.color(albedo[c]);
    const double absorption = after.one_minus_albedo(color);
    const double sigma_t = sigma_t_reduced[c] / ((1 - g) + g * absorption);
    result.sigma_s[c] = after.albedo(color) * sigma_t;
    result.sigma_a[c] = absorption * sigma_t;
  }
  return result;
}

}  // namespace

Coefficients with_g(const Coefficients& medium, double g, GLock lock, Surface surface) {
  ColorMaps maps;
  return with_g(medium, g, lock, surface, maps);
}

Coefficients with_g(const Coefficients& medium, double g, GLock lock, Surface surface, ColorMaps& maps) {
  assert(std::abs(g) < 1);
  if (g == medium.g) return medium;
  switch (lock) {
    case GLock::look:
      return with_look(medium, g, surface, maps);
    case GLock::sigma_t:
      return {medium.sigma_s, medium.sigma_a, g};
    case GLock::sigma_s_reduced:
      break;
  }
  return unreduced(reduced(medium), g);
}

Medium with_g(const Medium& medium, double g, GLock lock, Surface surface) {
  return make_medium(with_g(coefficients_of(medium), g, lock, surface));
}

Coefficients reduced(const Coefficients& medium) {
  return {medium.sigma_s * (1 - medium.g), medium.sigma_a, 0};
}

Medium reduced(const Medium& medium) { return make_medium(reduced(coefficients_of(medium))); }

Coefficients unreduced(const Coefficients& isotropic, double g) {
  assert(isotropic.g == 0 && std::abs(g) < 1);
  return {isotropic.sigma_s / (1 - g), isotropic.sigma_a, g};
}

Medium unreduced(const Medium& isotropic, double g) {
  return make_medium(unreduced(coefficients_of(isotropic), g));
}

}  // namespace meander
