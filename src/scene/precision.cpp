#include "scene/precision.h"

#include <algorithm>
#include <cstdio>

#include "scene/object_measures.h"

namespace meander {

std::vector<std::string> precision_warnings(const Scene& scene) {
  std::vector<std::string> warnings;
  for (const Object& object : scene.objects) {
    const auto* body = std::get_if<TranslucentMaterial>(&scene.materials[object.material].kind);
    if (!body) continue;
    const double sigma = largest(body->medium.sigma_t);
    const Bounds bounds = world_bounds(object);
    const DVec3 half = 0.5 * (bounds.high - bounds.low);
    const double ratio = 1 / (sigma * std::max({half.x, half.y, half.z}));
    if (!(ratio < kLeastMeanFreePath * (1 - 1e-6)))
      continue;  // the least itself, as it is rounded, is enough
    char text[160];
    std::snprintf(text, sizeof text,
                  "a mean free path of %.2g of its half size is finite but not accurate: single precision "
                  "needs %.2g or more",
                  ratio, kLeastMeanFreePath);
    warnings.push_back("object '" + object.name + "': " + text);
  }
  return warnings;
}

}  // namespace meander
