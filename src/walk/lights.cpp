#include "walk/lights.h"

#include <cmath>
#include <limits>

#include "math/frame.h"
#include "math/warp.h"

namespace meander {
namespace {

using Axes = PreparedLight::Axes;

Axes axes_of(const RectangleLight& light) noexcept {
  const DVec3 normal = glm::normalize(light.look_at - light.center);
  const DVec3 right = glm::normalize(glm::cross(normal, light.up));
  return {normal, right, glm::cross(right, normal)};
}

// Area density seen as a density per steradian.
Real solid_angle_pdf(double distance, double cosine, double area) noexcept {
  return static_cast<Real>(distance * distance / (area * cosine));
}

std::optional<LightSample> sample(const RectangleLight& light, const Axes& axes, const DVec3& point,
                                  const Vec2& u) noexcept {
  const DVec3 target =
      light.center + (u.x - 0.5) * light.width * axes.right + (u.y - 0.5) * light.height * axes.up;
  const DVec3 toward = target - point;
  const double distance = glm::length(toward);
  const double cosine = -glm::dot(toward, axes.normal) / distance;
  if (!(cosine > 0)) return std::nullopt;
  return LightSample{Vec3(toward / distance), distance, light.radiance,
                     solid_angle_pdf(distance, cosine, light.width * light.height), false};
}

std::optional<LightHit> hit(const RectangleLight& light, const Axes& axes, const Ray& ray) noexcept {
  const DVec3 direction(ray.direction);
  const double cosine = -glm::dot(direction, axes.normal);
  if (!(cosine > 0)) return std::nullopt;
  const DVec3 toward = light.center - ray.origin;
  const double distance = -glm::dot(toward, axes.normal) / cosine;
  if (!(distance > 0)) return std::nullopt;
  const DVec3 local = distance * direction - toward;
  if (std::abs(glm::dot(local, axes.right)) > light.width / 2) return std::nullopt;
  if (std::abs(glm::dot(local, axes.up)) > light.height / 2) return std::nullopt;
  return LightHit{distance, light.radiance, solid_angle_pdf(distance, cosine, light.width * light.height)};
}

// 1 - cosine of the half-angle under which a sphere is seen from a squared distance > r^2, without
// cancellation.
double cone_of(double radius, double squared_distance) noexcept {
  const double sin2 = radius * radius / squared_distance;
  return sin2 / (1 + std::sqrt(1 - sin2));
}

// Distance along a unit direction to the first crossing of a sphere's surface.
std::optional<double> sphere_distance(const DVec3& to_center, const DVec3& direction,
                                      double radius) noexcept {
  const double along = glm::dot(to_center, direction);
  const DVec3 off = to_center - along * direction;
  const double discriminant = radius * radius - glm::dot(off, off);
  if (!(discriminant >= 0)) return std::nullopt;
  const double half = std::sqrt(discriminant);
  if (along - half > 0) return along - half;
  if (along + half > 0) return along + half;
  return std::nullopt;
}

std::optional<LightSample> sample(const SphereLight& light, const Axes&, const DVec3& point,
                                  const Vec2& u) noexcept {
  const DVec3 to_center = light.center - point;
  const double squared = glm::dot(to_center, to_center);
  if (squared <= light.radius * light.radius) {
    const Vec3 direction = sample_sphere(u);
    const auto distance = sphere_distance(to_center, DVec3(direction), light.radius);
    if (!distance) return std::nullopt;
    return LightSample{direction, *distance, light.radiance, pdf_sphere(), false};
  }
  const Real cone = static_cast<Real>(cone_of(light.radius, squared));
  const Vec3 axis(to_center / std::sqrt(squared));
  const Vec3 direction = renormalise(make_frame(axis).to_world(sample_cone(cone, u)));
  const auto distance = sphere_distance(to_center, DVec3(direction), light.radius);
  // A direction on the rim may miss by rounding; the closest point of approach is as far as it goes.
  return LightSample{direction, distance.value_or(glm::dot(to_center, DVec3(direction))), light.radiance,
                     pdf_cone(cone), false};
}

std::optional<LightHit> hit(const SphereLight& light, const Axes&, const Ray& ray) noexcept {
  const DVec3 to_center = light.center - ray.origin;
  const auto distance = sphere_distance(to_center, DVec3(ray.direction), light.radius);
  if (!distance) return std::nullopt;
  const double squared = glm::dot(to_center, to_center);
  const bool within = squared <= light.radius * light.radius;
  const Real pdf = within ? pdf_sphere() : pdf_cone(static_cast<Real>(cone_of(light.radius, squared)));
  return LightHit{*distance, light.radiance, pdf};
}

std::optional<LightSample> sample(const PointLight& light, const Axes&, const DVec3& point,
                                  const Vec2&) noexcept {
  const DVec3 toward = light.position - point;
  const double squared = glm::dot(toward, toward);
  if (!(squared > 0)) return std::nullopt;
  const double distance = std::sqrt(squared);
  return LightSample{Vec3(toward / distance), distance, light.intensity * static_cast<Real>(1 / squared), 1,
                     true};
}

std::optional<LightSample> sample(const DirectionalLight& light, const Axes&, const DVec3&,
                                  const Vec2&) noexcept {
  return LightSample{Vec3(-glm::normalize(light.direction)), std::numeric_limits<double>::infinity(),
                     light.irradiance, 1, true};
}

std::optional<LightHit> hit(const PointLight&, const Axes&, const Ray&) noexcept { return std::nullopt; }
std::optional<LightHit> hit(const DirectionalLight&, const Axes&, const Ray&) noexcept {
  return std::nullopt;
}

}  // namespace

PreparedLight::PreparedLight(const Light& of) noexcept : light(of) {
  if (const auto* rectangle = std::get_if<RectangleLight>(&of.shape)) axes = axes_of(*rectangle);
}

std::optional<LightSample> sample_light(const PreparedLight& light, const DVec3& point,
                                        const Vec2& u) noexcept {
  return std::visit([&](const auto& shape) { return sample(shape, light.axes, point, u); },
                    light.light.shape);
}

std::optional<LightSample> sample_light(const PreparedLights& lights, std::size_t index, const DVec3& point,
                                        const Vec2& u) noexcept {
  if (index < lights.lights.size()) return sample_light(lights.lights[index], point, u);
  const EnvironmentImage::Sample sample = lights.scene.environment.image->sample(u);
  if (!(sample.pdf > 0)) return std::nullopt;
  return LightSample{sample.direction, std::numeric_limits<double>::infinity(), sample.radiance, sample.pdf,
                     false};
}

std::optional<LightHit> hit_light(const PreparedLight& light, const Ray& ray) noexcept {
  return std::visit([&](const auto& shape) { return hit(shape, light.axes, ray); }, light.light.shape);
}

}  // namespace meander
