// Lights as a walk meets them: sampled from a point, or hit by a ray. Origins are in double, so that a scene
// far from the origin loses nothing; directions and distances are what is left after the subtraction.
#pragma once

#include <optional>
#include <vector>

#include "scene/camera_rays.h"
#include "scene/scene.h"

namespace meander {

/// A direction toward a light. `radiance` is what arrives along it unoccluded; for a light without extent
/// (`delta`) it is what a surface facing it receives per unit of lobe, and pdf is 1.
struct LightSample {
  Vec3 direction;
  double distance;  // infinite for a directional light and for the environment
  Rgb radiance;
  Real pdf;  // per steradian
  bool delta;
};

/// A light with what sampling it needs made once; refers to the light.
struct PreparedLight {
  PreparedLight(const Light& of) noexcept;  // implicit: a light is as good where speed does not matter

  const Light& light;
  struct Axes {
    DVec3 normal{0, 0, 1};
    DVec3 right{1, 0, 0};
    DVec3 up{0, 1, 0};
  } axes;  // of a rectangle
};

/// Those of a scene, to which it refers.
struct PreparedLights {
  PreparedLights(const Scene& from) : scene(from), lights(from.lights.begin(), from.lights.end()) {}

  const Scene& scene;
  std::vector<PreparedLight> lights;
};

/// Draws a direction toward a light from `point` with u in [0, 1)^2; nothing where the light shows its dark
/// side.
[[nodiscard]] std::optional<LightSample> sample_light(const PreparedLight& light, const DVec3& point,
                                                      const Vec2& u) noexcept;

/// How many lights are sampled: those of the scene's list and, after them, the environment if it is an image.
[[nodiscard]] inline std::size_t count_sampled_lights(const Scene& scene) noexcept {
  return scene.lights.size() + (scene.environment.image ? 1 : 0);
}

/// sample_light for the sampled light of that index.
[[nodiscard]] std::optional<LightSample> sample_light(const PreparedLights& lights, std::size_t index,
                                                      const DVec3& point, const Vec2& u) noexcept;

/// The group of contributions that the sampled light of that index belongs to, see Contribution.
[[nodiscard]] inline int light_group(const Scene& scene, std::size_t index) noexcept {
  return index < scene.lights.size() ? 1 + static_cast<int>(index) : 0;
}

/// Where a ray meets a light's emitting side.
struct LightHit {
  double distance;
  Rgb radiance;
  Real pdf;  // density with which sample_light would have drawn this direction from the ray's origin, per
             // steradian
};

/// Nothing for lights without extent.
[[nodiscard]] std::optional<LightHit> hit_light(const PreparedLight& light, const Ray& ray) noexcept;

}  // namespace meander
