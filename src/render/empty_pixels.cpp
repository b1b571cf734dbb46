#include "render/empty_pixels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meander {
namespace {

constexpr double kRounding = 0x1p-21;  // of single-precision directions

}  // namespace

EmptyPixels::EmptyPixels(const Job& job, const CameraRays& camera) : job_(job), camera_(camera) {
  // From the middle of a pixel to its corners; directions that long at least are made unit.
  const double spread =
      0.5 * job.scale *
      (glm::length(camera.right) * camera.pixel_width + glm::length(camera.up) * camera.pixel_height);
  for (std::size_t i = 0; i < job.scene->objects.size(); ++i)
    outlines_.push_back(outline(camera, job.geometry->center(i), job.geometry->radius(i), spread));
}

EmptyPixels::Outline EmptyPixels::outline(const CameraRays& camera, const DVec3& center, double radius,
                                          double spread) noexcept {
  const DVec3 from = center - camera.origin;
  const double distance = glm::length(from);
  double reach = radius + spread;
  if (!camera.orthographic) {
    // The sine of the angle under which the radius is seen and of the half-angle of a pixel; of their sum.
    const double sine = radius / distance;
    if (!(sine * sine + spread * spread < 1)) return {from, std::numeric_limits<double>::infinity()};
    reach = distance * (sine * std::sqrt(1 - spread * spread) + spread * std::sqrt(1 - sine * sine));
  }
  reach += kRounding * (distance + reach);
  return {from, reach * reach};
}

bool EmptyPixels::contains(int x, int y) const noexcept {
  const Ray ray = film_ray(job_, camera_, x + 0.5, y + 0.5);
  const DVec3 direction(ray.direction);
  return std::ranges::all_of(outlines_, [&](const Outline& outline) {
    const DVec3 to = outline.center - (ray.origin - camera_.origin);
    const double along = glm::dot(to, direction);
    const DVec3 across = to - along * direction;
    const bool behind = !camera_.orthographic && along <= 0 && std::isfinite(outline.squared);
    return behind || glm::dot(across, across) > outline.squared;
  });
}

}  // namespace meander
