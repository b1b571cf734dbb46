#include "trace/overlaps.h"

#include <cmath>

namespace meander {
namespace {

constexpr int kPoints = 256;

bool is_translucent(const Scene& scene, std::size_t object) {
  return std::holds_alternative<TranslucentMaterial>(scene.materials[scene.objects[object].material].kind);
}

// Evenly spread directions (the spherical Fibonacci lattice).
DVec3 direction_of(int i) {
  const double z = 1 - (2 * i + 1) / static_cast<double>(kPoints);
  const double phi = i * glm::pi<double>() * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

bool are_apart(const Geometry& geometry, std::size_t a, std::size_t b) {
  return glm::distance(geometry.center(a), geometry.center(b)) > geometry.radius(a) + geometry.radius(b);
}

// Whether some points just inside of object a's surface lie inside of object b.
bool reaches_into(const Geometry& geometry, std::size_t a, std::size_t b) {
  const double size = geometry.size(a);
  for (int i = 0; i < kPoints; ++i) {
    const DVec3 d = direction_of(i);
    const DVec3 sideways = direction_of((i * 97) % kPoints) * (0.7 * size);
    const Ray toward{geometry.center(a) + sideways - 4 * size * d, Vec3(d)};
    const auto hit = geometry.hit_object(a, toward);
    if (!hit || !hit->entering) continue;
    const DVec3 inside = geometry.center(a) + DVec3(hit->point) - 1e-3 * size * DVec3(hit->normal);
    const auto ahead = geometry.hit_object(b, {inside, Vec3(d)});
    if (ahead && !ahead->entering) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> overlap_warnings(const Scene& scene, const Geometry& geometry) {
  std::vector<std::string> warnings;
  for (std::size_t a = 0; a < scene.objects.size(); ++a) {
    for (std::size_t b = a + 1; b < scene.objects.size(); ++b) {
      if (!is_translucent(scene, a) || !is_translucent(scene, b) || are_apart(geometry, a, b)) continue;
      if (!reaches_into(geometry, a, b) && !reaches_into(geometry, b, a)) continue;
      warnings.push_back("objects '" + scene.objects[a].name + "' and '" + scene.objects[b].name +
                         "' overlap: a walk sees only its own body's surface, so light there is not right");
    }
  }
  return warnings;
}

}  // namespace meander
