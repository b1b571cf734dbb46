#include "medium/medium.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "medium/color_map.h"

namespace meander {

namespace {

/// One channel while it is worked out.
struct Coefficients {
  double sigma_t;
  double albedo;
};

Medium make_medium(const Coefficients (&channels)[3], double g) {
  assert(std::abs(g) < 1);
  Medium medium;
  medium.g = static_cast<Real>(g);
  for (int c = 0; c < 3; ++c) {
    assert(channels[c].sigma_t >= 0 && channels[c].albedo >= 0 && channels[c].albedo <= 1);
    medium.sigma_t[c] = static_cast<Real>(channels[c].sigma_t);
    medium.albedo[c] = medium.sigma_t[c] > 0 ? static_cast<Real>(channels[c].albedo) : Real(0);
  }
  return medium;
}

Coefficients from_sigma(double sigma_s, double sigma_a) {
  assert(sigma_s >= 0 && sigma_a >= 0);
  const double sigma_t = sigma_s + sigma_a;
  return {sigma_t, sigma_t > 0 ? sigma_s / sigma_t : 0.0};
}

/// Chiang, Kutz, Burley 2016, "Practical and Controllable Subsurface Scattering for Production Path Tracing";
/// the reduced result is brought to g by similarity.
Coefficients chiang(double color, double radius, double g) {
  const double reduced_albedo = -std::expm1(color * (-5.09406 + color * (2.61188 - color * 4.31805)));
  const double s = 1.9 - color + 3.5 * (color - 0.8) * (color - 0.8);
  const double scale = 1 - g * (1 - reduced_albedo);
  return {scale / (radius * s * (1 - g)), reduced_albedo / scale};
}

/// The inversion of OpenPBR, after van de Hulst 1980 (Kulla & Conty 2017, "Revisiting Physically Based
/// Shading at Imageworks").
double van_de_hulst_albedo(double color, double g) {
  const double root = std::sqrt(9.59217 + color * (41.6808 + color * 17.7126));
  const double s = std::clamp(4.09712 + 4.20863 * color - root, 0.0, 1.0);
  return (1 - s) * (1 + s) / (1 - g * s * s);
}

}  // namespace

Medium medium_from_sigma(const DVec3& sigma_s, const DVec3& sigma_a, double g) {
  return make_medium(
      {from_sigma(sigma_s.x, sigma_a.x), from_sigma(sigma_s.y, sigma_a.y), from_sigma(sigma_s.z, sigma_a.z)},
      g);
}

Medium medium_from_albedo(const DVec3& albedo, const DVec3& mean_free_path, double g) {
  Coefficients channels[3];
  for (int c = 0; c < 3; ++c) {
    assert(mean_free_path[c] > 0);
    channels[c] = {1 / mean_free_path[c], albedo[c]};
  }
  return make_medium(channels, g);
}

Medium medium_from_color(const DVec3& color, const DVec3& radius, double g, Inversion inversion) {
  const ColorMap map(inversion == Inversion::exact ? g : 0.0);
  Coefficients channels[3];
  for (int c = 0; c < 3; ++c) {
    assert(color[c] >= 0 && color[c] <= 1 && radius[c] > 0);
    switch (inversion) {
      case Inversion::exact:
        channels[c] = {1 / radius[c], map.albedo(color[c])};
        break;
      case Inversion::chiang:
        channels[c] = chiang(color[c], radius[c], g);
        break;
      case Inversion::van_de_hulst:
        channels[c] = {1 / radius[c], van_de_hulst_albedo(color[c], g)};
        break;
    }
  }
  return make_medium(channels, g);
}

DVec3 color_of(const DVec3& albedo, double g) {
  const ColorMap map(g);
  return {map.color(albedo.x), map.color(albedo.y), map.color(albedo.z)};
}

}  // namespace meander
