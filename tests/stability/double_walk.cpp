#include "stability/double_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "render/parallel.h"
#include "stability/bodies.h"
#include "stats/moments.h"

namespace meander {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// Inside where dot(normal, p) <= offset.
struct Plane {
  DVec3 normal;
  double offset;
};

// A sphere, or where there are any, what is behind all planes.
struct ConvexBody {
  DVec3 center{0};
  double radius = 1;
  std::vector<Plane> planes;

  // Where the line p + t d is inside.
  [[nodiscard]] std::optional<glm::dvec2> inside(const DVec3& p, const DVec3& d) const {
    if (planes.empty()) {
      const DVec3 from = p - center;
      const double b = glm::dot(from, d);
      const double root = b * b - (glm::dot(from, from) - radius * radius);
      if (root <= 0) return std::nullopt;
      return glm::dvec2(-b - std::sqrt(root), -b + std::sqrt(root));
    }
    glm::dvec2 range(-kFar, kFar);
    for (const Plane& plane : planes) {
      const double speed = glm::dot(plane.normal, d);
      const double left = plane.offset - glm::dot(plane.normal, p);
      if (speed == 0 && left < 0) return std::nullopt;
      if (speed > 0) range.y = std::min(range.y, left / speed);
      if (speed < 0) range.x = std::max(range.x, left / speed);
    }
    if (range.x >= range.y) return std::nullopt;
    return range;
  }
};

ConvexBody body_of(const Object& object) {
  const DMat3 map = linear_part(object.transform);
  ConvexBody body;
  body.center = object.transform.translate;
  body.radius = object.transform.scale.x;
  if (std::holds_alternative<SphereShape>(object.shape)) return body;
  const auto* given = std::get_if<std::shared_ptr<const Mesh>>(&object.shape);
  const Mesh mesh = given ? **given : make_cube();
  for (const Triangle& t : mesh.triangles) {
    const DVec3 a = map * mesh.positions[t[0]];
    const DVec3 across = glm::cross(map * mesh.positions[t[1]] - a, map * mesh.positions[t[2]] - a);
    const DVec3 normal = glm::normalize(across);
    const double offset = glm::dot(normal, a + body.center);
    const auto same = [&](const Plane& plane) {
      return glm::length(plane.normal - normal) < 1e-9 &&
             std::abs(plane.offset - offset) < 1e-9 * (1 + std::abs(offset));
    };
    if (std::ranges::none_of(body.planes, same)) body.planes.push_back({normal, offset});
  }
  return body;
}

class DoubleWalk {
 public:
  DoubleWalk(const Scene& scene, std::uint64_t seed)
      : scene_(scene),
        body_(body_of(scene.objects[0])),
        medium_(std::get<TranslucentMaterial>(scene.materials[scene.objects[0].material].kind).medium),
        random_(seed) {
    forward_ = glm::normalize(scene.camera.look_at - scene.camera.look_from);
    right_ = glm::normalize(glm::cross(forward_, scene.camera.up));
    up_ = glm::cross(right_, forward_);
  }

  [[nodiscard]] bool grey() const { return is_grey(medium_.sigma_t) && is_grey(medium_.albedo); }

  // What a sample of one channel in one quarter finds in a surround of radiance 1.
  double sample(std::size_t quarter, int channel) {
    const double u = next() + static_cast<double>(quarter % 2) - 1;
    const double v = 1 - next() - static_cast<double>(quarter / 2);
    DVec3 p = scene_.camera.look_from;
    DVec3 d = forward_;
    if (scene_.camera.orthographic_height) {
      p += 0.5 * *scene_.camera.orthographic_height * (u * right_ + v * up_);
    } else {
      const double reach = std::tan(glm::radians(scene_.camera.vertical_fov) / 2);
      d = glm::normalize(forward_ + reach * (u * right_ + v * up_));
    }
    const auto range = body_.inside(p, d);
    if (!range || range->y <= 0) return 1;
    p += std::max(range->x, 0.0) * d;
    return walk(p, d, channel);
  }

 private:
  double next() { return uniform_(random_); }

  double walk(DVec3 p, DVec3 d, int channel) {
    const double sigma = medium_.sigma_t[channel];
    const double albedo = medium_.albedo[channel];
    for (double weight = 1;;) {
      const double step = -std::log1p(-next()) / sigma;
      const auto range = body_.inside(p, d);
      if (!range || step >= range->y) return weight;
      p += step * d;
      weight *= albedo;
      if (weight < 0.1) {
        if (next() >= weight) return 0;
        weight = 1;
      }
      scatter(d);
    }
  }

  // Henyey and Greenstein 1941, eq. 2, inverted as in the textbooks.
  void scatter(DVec3& d) {
    const double g = medium_.g;
    const double s = 2 * next() - 1;
    const double f = (1 - g * g) / (1 + g * s);
    const double mu = std::abs(g) < 1e-3 ? s + 1.5 * g * (1 - s * s) : (1 + g * g - f * f) / (2 * g);
    const double cosine = std::clamp(mu, -1.0, 1.0);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const double phi = 2 * glm::pi<double>() * next();
    const DVec3 least = std::abs(d.x) < 0.6 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
    const DVec3 a = glm::normalize(glm::cross(d, least));
    const DVec3 b = glm::cross(d, a);
    d = glm::normalize(cosine * d + sine * (std::cos(phi) * a + std::sin(phi) * b));
  }

  const Scene& scene_;
  ConvexBody body_;
  Medium medium_;
  DVec3 forward_;
  DVec3 right_;
  DVec3 up_;
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> uniform_{0, 1};
};

}  // namespace

bool knows_double_walk(const Scene& scene) {
  if (scene.objects.size() != 1 || !scene.lights.empty() || scene.environment.image) return false;
  const auto* material = std::get_if<TranslucentMaterial>(&scene.materials[scene.objects[0].material].kind);
  return material && material->boundary == Boundary::matched && scene.environment.radiance == Rgb(1) &&
         scene.film.width == scene.film.height && !std::holds_alternative<SlabShape>(scene.objects[0].shape);
}

Readings double_walk(const Scene& scene, std::uint64_t samples) {
  Readings readings;
  parallel_for(2, kWhole, [&](std::size_t quarter) {
    DoubleWalk walk(scene, 20261126 + quarter);
    for (int c = 0; c < (walk.grey() ? 1 : 3); ++c) {
      Moments moments;
      for (std::uint64_t i = 0; i < samples / kWhole; ++i) moments.add(walk.sample(quarter, c));
      readings[quarter][static_cast<std::size_t>(c)] = {moments.mean, moments.standard_error()};
    }
    if (walk.grey()) readings[quarter].fill(readings[quarter].front());
  });
  fill_whole(readings);
  return readings;
}

}  // namespace meander
