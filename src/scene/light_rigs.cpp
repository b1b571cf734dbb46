#include "scene/light_rigs.h"

#include <algorithm>
#include <cmath>

#include "math/color.h"

namespace meander {
namespace {

// A rectangle light of a rig: degrees from the camera (to its right) and above the horizon; distance, width
// and height in half diagonals of the subject; irradiance at its centre, and a tint.
struct Lamp {
  const char* name;
  double azimuth;
  double elevation;
  double distance;
  double width;
  double height;
  double irradiance;
  DVec3 tint;
};

constexpr DVec3 kNeutral{1, 1, 1};
constexpr DVec3 kWarm{13, 11.5, 10};  // the back light of the built-in studio
constexpr DVec3 kCool{2.6, 2.8, 3.2};

constexpr double kFront = glm::pi<double>();  // white facing the key shines with radiance 1
constexpr double kBehind = 1.5 * glm::pi<double>();

std::vector<Lamp> lamps_of(Rig rig) {
  switch (rig) {
    case Rig::front:
      return {{"key", 15, 35, 4, 2.4, 2.4, kFront, kNeutral}};
    case Rig::three_quarter:
      return {{"key", 48, 38, 4, 2, 2, kFront, kNeutral},
              {"fill", -50, 15, 5, 3, 3, 0.15 * kFront, kCool},
              {"rim", 205, 30, 4, 1.6, 1.6, 0.5 * kFront, kWarm}};
    case Rig::back:
      return {{"key", 195, 32, 4, 2.4, 2.4, kBehind, kWarm}, {"fill", 25, 35, 5, 3, 3, 0.12 * kFront, kCool}};
    case Rig::rim:
      return {{"key", 140, 28, 4, 1, 2.6, kBehind, kWarm},
              {"rim", -140, 28, 4, 1, 2.6, 0.75 * kBehind, kCool},
              {"fill", 10, 30, 5, 3, 3, 0.06 * kFront, kCool}};
  }
  return {};
}

// The horizontal direction from the subject toward the camera. A camera that looks straight down or up has
// it below, or above, in its picture.
DVec3 heading_of(const Camera& camera) {
  const DVec3 back = glm::normalize(camera.look_from - camera.look_at);
  const DVec3 right = glm::normalize(glm::cross(camera.up, back));
  const DVec3 up = glm::cross(back, right);
  const DVec3 level(back.x, 0, back.z);
  const DVec3 tipped = (back.y > 0 ? -1.0 : 1.0) * DVec3(up.x, 0, up.z);
  const DVec3 longer = glm::length(level) >= glm::length(tipped) ? level : tipped;
  // Both vanish for no camera: one that looks along the vertical has its `up` across it, and one that lies on
  // its side looks along the ground.
  return glm::normalize(longer);
}

// Irradiance on a small surface that faces the middle of a parallel rectangle of radiance 1, from `distance`
// away on its axis: pi times the configuration factor (Howell, catalogue of radiation configuration factors,
// B-4).
double facing_irradiance(double width, double height, double distance) {
  const double a = width / (2 * distance);
  const double b = height / (2 * distance);
  const double ra = std::sqrt(1 + a * a);
  const double rb = std::sqrt(1 + b * b);
  return 2 * (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb));
}

struct Spherical {
  double distance;
  double azimuth;
  double elevation;
};

Spherical spherical_of(const DVec3& v) {
  return {glm::length(v), std::atan2(v.x, v.z), std::atan2(v.y, std::hypot(v.x, v.z))};
}

DVec3 vector_of(const Spherical& s) {
  return s.distance * DVec3(std::sin(s.azimuth) * std::cos(s.elevation), std::sin(s.elevation),
                            std::cos(s.azimuth) * std::cos(s.elevation));
}

// The vector turned about the origin, off the poles; zero stays zero.
DVec3 turned(const DVec3& v, double azimuth, double elevation) {
  if (!(glm::length(v) > 0)) return v;
  Spherical s = spherical_of(v);
  const double limit = glm::radians(89.0);
  s.azimuth += glm::radians(azimuth);
  s.elevation = std::clamp(s.elevation + glm::radians(elevation), -limit, limit);
  return vector_of(s);
}

void orbit_rectangle(RectangleLight& light, const DVec3& about, double azimuth, double elevation) {
  if (light.center == about) return;
  light.center = about + turned(light.center - about, azimuth, elevation);
  light.look_at = about;
  const DVec3 view = glm::normalize(about - light.center);
  if (glm::length(glm::cross(view, light.up)) < 0.01 * glm::length(light.up)) light.up = {0, 1, 0};
}

}  // namespace

std::vector<Light> make_rig(Rig rig, const Bounds& subject, const Camera& camera) {
  const DVec3 center = 0.5 * (subject.low + subject.high);
  const double half_diagonal = 0.5 * glm::length(subject.high - subject.low);
  const double unit = half_diagonal > 0 ? half_diagonal : 1;
  const double heading = spherical_of(heading_of(camera)).azimuth;
  std::vector<Light> lights;
  for (const Lamp& lamp : lamps_of(rig)) {
    RectangleLight light;
    light.center = center + vector_of({lamp.distance * unit, heading + glm::radians(lamp.azimuth),
                                       glm::radians(lamp.elevation)});
    light.look_at = center;
    light.width = lamp.width * unit;
    light.height = lamp.height * unit;
    const double radiance = lamp.irradiance / facing_irradiance(lamp.width, lamp.height, lamp.distance);
    light.radiance = Rgb(radiance / static_cast<double>(luminance(Rgb(lamp.tint))) * lamp.tint);
    lights.push_back({lamp.name, light, false});
  }
  return lights;
}

Light orbit_light(const Light& light, const DVec3& about, double azimuth, double elevation) {
  Light moved = light;
  if (auto* rectangle = std::get_if<RectangleLight>(&moved.shape)) {
    orbit_rectangle(*rectangle, about, azimuth, elevation);
  } else if (auto* sphere = std::get_if<SphereLight>(&moved.shape)) {
    sphere->center = about + turned(sphere->center - about, azimuth, elevation);
  } else if (auto* point = std::get_if<PointLight>(&moved.shape)) {
    point->position = about + turned(point->position - about, azimuth, elevation);
  } else {
    auto& sun = std::get<DirectionalLight>(moved.shape);
    sun.direction = -turned(-sun.direction, azimuth, elevation);
  }
  return moved;
}

}  // namespace meander
