#include "render/first_hits.h"

#include "render/parallel.h"

namespace meander {
namespace {

bool is_translucent(const Scene& scene, std::size_t object) noexcept {
  return std::holds_alternative<TranslucentMaterial>(scene.materials[scene.objects[object].material].kind);
}

// Rays through places of the job's area, in its own pixels.
class FirstHitFinder {
 public:
  explicit FirstHitFinder(const Job& job) noexcept
      : job_(job), area_(area_of(job)), camera_(camera_of(job)) {}

  [[nodiscard]] std::optional<SurfaceHit> at(double x, double y) const noexcept {
    return job_.geometry->closest_hit(film_ray(job_, camera_, area_.x0 + x, area_.y0 + y));
  }
  [[nodiscard]] bool shows_object(int x, int y) const noexcept {
    const auto hit = at(x, y);
    return hit && is_translucent(*job_.scene, hit->object);
  }

 private:
  const Job& job_;
  Tile area_;
  CameraRays camera_;
};

bool same_shape(const Object& a, const Object& b) noexcept {
  if (a.shape.index() != b.shape.index()) return false;
  const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&a.shape);
  if (mesh && *mesh != std::get<std::shared_ptr<const Mesh>>(b.shape)) return false;
  const Transform& s = a.transform;
  const Transform& t = b.transform;
  return s.translate == t.translate && s.rotate == t.rotate && s.scale == t.scale;
}

}  // namespace

FirstHits first_hits(const Job& job, const std::atomic<bool>& stop) {
  const FirstHitFinder finder(job);
  const Tile area = area_of(job);
  const int width = area.x1 - area.x0;
  const int height = area.y1 - area.y0;
  const auto stride = static_cast<std::size_t>(width);
  FirstHits found{std::vector<std::uint8_t>(stride * height), Image(width, height, 3)};
  std::vector<std::uint8_t> middles(found.mask.size());
  parallel_for(
      job.threads, static_cast<std::size_t>(height),
      [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x < width && !stop; ++x) {
          const auto hit = finder.at(x + 0.5, y + 0.5);
          if (!hit) continue;
          middles[row * stride + x] = is_translucent(*job.scene, hit->object);
          const Real side = hit->entering ? Real(1) : Real(-1);
          for (int c = 0; c < 3; ++c)
            found.normals.at(x, y)[c] = static_cast<float>(side * hit->shading_normal[c]);
        }
      },
      job.priority);
  // Corners of pixels whose middle shows no object do not matter.
  const std::size_t corner_stride = stride + 1;
  std::vector<std::uint8_t> corners(corner_stride * (static_cast<std::size_t>(height) + 1));
  const auto middle = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < width && y < height && middles[static_cast<std::size_t>(y) * stride + x];
  };
  parallel_for(
      job.threads, static_cast<std::size_t>(height) + 1,
      [&](std::size_t row) {
        const int y = static_cast<int>(row);
        for (int x = 0; x <= width && !stop; ++x)
          corners[row * corner_stride + x] =
              (middle(x - 1, y - 1) || middle(x, y - 1) || middle(x - 1, y) || middle(x, y)) &&
              finder.shows_object(x, y);
      },
      job.priority);
  for (std::size_t y = 0; y < static_cast<std::size_t>(height) && !stop; ++y) {
    for (std::size_t x = 0; x < stride; ++x) {
      const std::uint8_t* corner = &corners[y * corner_stride + x];
      found.mask[y * stride + x] = middles[y * stride + x] && corner[0] && corner[1] &&
                                   corner[corner_stride] && corner[corner_stride + 1];
    }
  }
  return found;
}

bool same_first_hits(const Scene& a, const Scene& b) noexcept {
  if (a.film.width != b.film.width || a.film.height != b.film.height) return false;
  const Camera& c = a.camera;
  const Camera& d = b.camera;
  if (c.look_from != d.look_from || c.look_at != d.look_at || c.up != d.up ||
      c.vertical_fov != d.vertical_fov || c.orthographic_height != d.orthographic_height)
    return false;
  if (a.objects.size() != b.objects.size()) return false;
  for (std::size_t i = 0; i < a.objects.size(); ++i)
    if (!same_shape(a.objects[i], b.objects[i]) || is_translucent(a, i) != is_translucent(b, i)) return false;
  return true;
}

}  // namespace meander
