#include "app/scene_warnings.h"

#include <algorithm>
#include <iostream>

#include "scene/precision.h"

namespace meander {
namespace {

// Whether a light that no ray can hit stands before a body that lets no light be sampled through its surface.
bool hides_lights(const Scene& scene) {
  const bool delta = std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return std::holds_alternative<PointLight>(light.shape) ||
           std::holds_alternative<DirectionalLight>(light.shape);
  });
  return delta && std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
           const auto* body = std::get_if<TranslucentMaterial>(&scene.materials[object.material].kind);
           return body && body->boundary == Boundary::dielectric && body->roughness == 0;
         });
}

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene) {
  std::vector<std::string> warnings = precision_warnings(scene);
  if (hides_lights(scene))
    warnings.emplace_back(
        "point and directional lights cannot be seen through a smooth dielectric: give it a roughness, or "
        "the light a size");
  return warnings;
}

void warn(const std::string& text) { std::cerr << "meander: warning: " << text << '\n'; }

}  // namespace meander
