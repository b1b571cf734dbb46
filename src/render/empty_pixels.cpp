#include "render/empty_pixels.h"

#include <cmath>
#include <limits>

namespace meander {
namespace {

constexpr double kRounding = 1e-6;  // of single-precision directions

}  // namespace

EmptyPixels::EmptyPixels(const Job& job, const CameraRays& camera) : job_(job), camera_(camera) {
  const FilmSize& film = job.scene->film;
  // From the middle of a pixel to its corners; directions that long at least are made unit.
  const double spread =
      0.5 * job.scale * (glm::length(camera.right) / film.width + glm::length(camera.up) / film.height);
  for (std::size_t i = 0; i < job.scene->objects.size(); ++i)
    outlines_.push_back(outline(camera, job.geometry->center(i), job.geometry->radius(i), spread));
}

EmptyPixels::Outline EmptyPixels::outline(const CameraRays& camera, const DVec3& center, double radius,
                                          double spread) noexcept {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const DVec3 from = center - camera.origin;
  if (camera.orthographic) {
    const double reach = radius + spread + kRounding * (glm::length(from) + radius + spread);
    return {from, reach * reach};
  }
  const double distance = glm::length(from);
  const double sine = radius / distance;
  if (!(sine < 1 && spread < 1)) return {camera.forward, -kNever};
  const double cosine = std::sqrt((1 - sine * sine) * (1 - spread * spread)) - sine * spread;
  return {from / distance, cosine - kRounding};
}

bool EmptyPixels::contains(int x, int y) const noexcept {
  const Ray ray = film_ray(job_, camera_, x + 0.5, y + 0.5);
  const DVec3 direction(ray.direction);
  for (const Outline& outline : outlines_) {
    if (camera_.orthographic) {
      const DVec3 to = outline.toward - (ray.origin - camera_.origin);
      const DVec3 across = to - glm::dot(to, direction) * direction;
      if (!(glm::dot(across, across) > outline.limit)) return false;
    } else if (!(glm::dot(outline.toward, direction) < outline.limit)) {
      return false;
    }
  }
  return true;
}

}  // namespace meander
