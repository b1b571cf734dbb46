#include "medium/medium.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "medium/coefficients.h"
#include "medium/color_map.h"

namespace meander {

namespace {

/// One channel while it is worked out; both albedos to full relative precision.
struct Channel {
  double sigma_t;
  double albedo;
  double one_minus_albedo;
};

/// Chiang, Kutz, Burley 2016, "Practical and Controllable Subsurface Scattering for Production Path Tracing";
/// the reduced result is brought to g by similarity.
Channel chiang(double color, double radius, double g) {
  const double exponent = color * (-5.09406 + color * (2.61188 - color * 4.31805));
  const double reduced_albedo = -std::expm1(exponent);
  const double one_minus_reduced = std::exp(exponent);
  const double s = 1.9 - color + 3.5 * (color - 0.8) * (color - 0.8);
  const double scale = 1 - g * one_minus_reduced;
  return {scale / (radius * s * (1 - g)), reduced_albedo / scale, one_minus_reduced * (1 - g) / scale};
}

/// The inversion of OpenPBR, after van de Hulst 1980 (Kulla & Conty 2017, "Revisiting Physically Based
/// Shading at Imageworks").
Channel van_de_hulst(double color, double radius, double g) {
  const double root = std::sqrt(9.59217 + color * (41.6808 + color * 17.7126));
  const double s = std::clamp(4.09712 + 4.20863 * color - root, 0.0, 1.0);
  const double scale = 1 - g * s * s;
  return {1 / radius, (1 - s) * (1 + s) / scale, s * s * (1 - g) / scale};
}

}  // namespace

Coefficients coefficients_from_albedo(const DVec3& albedo, const DVec3& mean_free_path, double g) {
  Coefficients result{{}, {}, g};
  for (int c = 0; c < 3; ++c) {
    assert(albedo[c] >= 0 && albedo[c] <= 1 && mean_free_path[c] > 0);
    result.sigma_s[c] = albedo[c] / mean_free_path[c];
    result.sigma_a[c] = (1 - albedo[c]) / mean_free_path[c];
  }
  return result;
}

Coefficients coefficients_from_color(const DVec3& color, const DVec3& radius, double g, Inversion inversion,
                                     Surface surface) {
  if (inversion == Inversion::exact) return coefficients_from_color(color, radius, ColorMap(g, surface));
  Coefficients result{{}, {}, g};
  for (int c = 0; c < 3; ++c) {
    assert(color[c] >= 0 && color[c] <= 1 && radius[c] > 0);
    const Channel channel = inversion == Inversion::chiang ? chiang(color[c], radius[c], g)
                                                           : van_de_hulst(color[c], radius[c], g);
    result.sigma_s[c] = channel.albedo * channel.sigma_t;
    result.sigma_a[c] = channel.one_minus_albedo * channel.sigma_t;
  }
  return result;
}

Coefficients coefficients_from_color(const DVec3& color, const DVec3& radius, const ColorMap& map) {
  Coefficients result{{}, {}, map.g()};
  for (int c = 0; c < 3; ++c) {
    assert(color[c] >= 0 && color[c] <= 1 && radius[c] > 0);
    const double sigma_t = 1 / radius[c];
    result.sigma_s[c] = map.albedo(color[c]) * sigma_t;
    result.sigma_a[c] = map.one_minus_albedo(color[c]) * sigma_t;
  }
  return result;
}

DVec3 albedo_of(const Coefficients& coefficients) {
  const DVec3 sigma_t = sigma_t_of(coefficients);
  DVec3 albedo(0);
  for (int c = 0; c < 3; ++c) {
    if (sigma_t[c] > 0) albedo[c] = coefficients.sigma_s[c] / sigma_t[c];
  }
  return albedo;
}

Medium make_medium(const Coefficients& coefficients) {
  assert(std::abs(coefficients.g) < 1);
  Medium medium{Rgb(sigma_t_of(coefficients)), Rgb(0), static_cast<Real>(coefficients.g)};
  const DVec3 albedo = albedo_of(coefficients);
  for (int c = 0; c < 3; ++c) {
    assert(coefficients.sigma_s[c] >= 0 && coefficients.sigma_a[c] >= 0);
    if (medium.sigma_t[c] > 0) medium.albedo[c] = static_cast<Real>(albedo[c]);
  }
  return medium;
}

Coefficients coefficients_of(const Medium& medium) {
  const DVec3 sigma_t(medium.sigma_t);
  const DVec3 albedo(medium.albedo);
  return {albedo * sigma_t, (1.0 - albedo) * sigma_t, static_cast<double>(medium.g)};
}

Medium medium_from_sigma(const DVec3& sigma_s, const DVec3& sigma_a, double g) {
  return make_medium({sigma_s, sigma_a, g});
}

Medium medium_from_albedo(const DVec3& albedo, const DVec3& mean_free_path, double g) {
  return make_medium(coefficients_from_albedo(albedo, mean_free_path, g));
}

Medium medium_from_color(const DVec3& color, const DVec3& radius, double g, Inversion inversion,
                         Surface surface) {
  return make_medium(coefficients_from_color(color, radius, g, inversion, surface));
}

DVec3 color_of(const DVec3& albedo, double g, Surface surface) {
  return color_of(albedo, ColorMap(g, surface));
}

DVec3 color_of(const DVec3& albedo, const ColorMap& map) {
  return {map.color(albedo.x), map.color(albedo.y), map.color(albedo.z)};
}

}  // namespace meander
