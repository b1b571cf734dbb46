#include "medium/surface.h"

#include <cassert>
#include <cmath>

#include "medium/half_space.h"

namespace meander {

namespace {

/// Of the cosines inside and outside, which Snell's law ties.
double reflectance(double cos_in, double cos_out, double ior) {
  const double perpendicular = (ior * cos_in - cos_out) / (ior * cos_in + cos_out);
  const double parallel = (cos_in - ior * cos_out) / (cos_in + ior * cos_out);
  return 0.5 * (perpendicular * perpendicular + parallel * parallel);
}

}  // namespace

double internal_reflectance(double cos_i, double ior) {
  assert(cos_i >= 0 && cos_i <= 1 && ior >= 1);
  if (ior == 1) return 0;
  const double cos2_out = 1 - ior * ior * (1 - cos_i) * (1 + cos_i);
  return cos2_out > 0 ? reflectance(cos_i, std::sqrt(cos2_out), ior) : 1;
}

// Over t, cosine = t^4: grazing light, where an index near 1 makes the reflectance steep, gets most nodes.
double diffuse_external_reflectance(double ior) {
  assert(ior >= 1);
  if (ior == 1) return 0;
  const AngularGrid grid = make_gauss_grid(64);
  double sum = 0;
  for (std::size_t i = 0; i < grid.mu.size(); ++i) {
    const double t2 = grid.mu[i] * grid.mu[i];
    const double cos_out = t2 * t2;
    const double cos_in = std::sqrt((ior - 1) * (ior + 1) + cos_out * cos_out) / ior;
    sum += grid.weight[i] * 8 * t2 * t2 * t2 * grid.mu[i] * reflectance(cos_in, cos_out, ior);
  }
  return sum;
}

double diffuse_internal_reflectance(double ior) {
  return 1 - (1 - diffuse_external_reflectance(ior)) / (ior * ior);
}

}  // namespace meander
