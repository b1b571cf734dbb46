#include "scene/camera_moves.h"

#include <algorithm>
#include <cmath>

namespace meander {
namespace {

constexpr double kPole = 1e-4;     // radians that a view keeps off the axis of `up`
constexpr double kNearest = 1e-9;  // distances and heights
constexpr double kFarthest = 1e9;
constexpr double kStep = 0.9;  // of the distance that a step of dolly leaves

// Right-handed axes in which `up` is exactly the camera's.
struct UpFrame {
  DVec3 x;
  DVec3 up;
  DVec3 z;
};

UpFrame frame_of_up(const DVec3& camera_up) {
  const DVec3 up = glm::normalize(camera_up);
  const DVec3 a = std::abs(up.y) > 0.5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0);
  const DVec3 z = glm::normalize(glm::cross(a, up));
  return {glm::cross(up, z), up, z};
}

// A unit direction by azimuth and elevation about `up`, kept off the poles.
DVec3 direction_at(const UpFrame& frame, double azimuth, double elevation) {
  const double limit = glm::half_pi<double>() - kPole;
  const double e = std::clamp(elevation, -limit, limit);
  return std::cos(e) * (std::sin(azimuth) * frame.x + std::cos(azimuth) * frame.z) + std::sin(e) * frame.up;
}

double azimuth_of(const UpFrame& frame, const DVec3& d) {
  return std::atan2(glm::dot(d, frame.x), glm::dot(d, frame.z));
}

double elevation_of(const UpFrame& frame, const DVec3& d) {
  return std::atan2(glm::dot(d, frame.up), std::hypot(glm::dot(d, frame.x), glm::dot(d, frame.z)));
}

// The axes of the picture: toward the camera, to the right and up.
struct ViewAxes {
  DVec3 back;
  DVec3 right;
  DVec3 up;
};

ViewAxes axes_of(const Camera& camera) {
  const DVec3 back = glm::normalize(camera.look_from - camera.look_at);
  const DVec3 right = glm::normalize(glm::cross(camera.up, back));
  return {back, right, glm::cross(back, right)};
}

double clamped(double length) { return std::clamp(length, kNearest, kFarthest); }

double slope_of(const Camera& camera) { return std::tan(glm::radians(camera.vertical_fov) / 2); }

// The motion, 0 where it is not a number a pointer can make.
double sane(double motion) { return std::isfinite(motion) ? std::clamp(motion, -1e3, 1e3) : 0; }

}  // namespace

double view_height(const Camera& camera) {
  if (camera.orthographic_height) return *camera.orthographic_height;
  return 2 * slope_of(camera) * glm::distance(camera.look_from, camera.look_at);
}

Camera orbit(const Camera& camera, double dx, double dy) {
  const UpFrame up = frame_of_up(camera.up);
  const DVec3 offset = camera.look_from - camera.look_at;
  const double azimuth = azimuth_of(up, offset) - glm::pi<double>() * sane(dx);
  const double elevation = elevation_of(up, offset) + glm::pi<double>() * sane(dy);
  Camera moved = camera;
  moved.look_from = camera.look_at + glm::length(offset) * direction_at(up, azimuth, elevation);
  return moved;
}

Camera pan(const Camera& camera, double dx, double dy) {
  const ViewAxes axes = axes_of(camera);
  const DVec3 shift = view_height(camera) * (sane(dy) * axes.up - sane(dx) * axes.right);
  Camera moved = camera;
  moved.look_from += shift;
  moved.look_at += shift;
  return moved;
}

Camera dolly(const Camera& camera, double steps) {
  const double factor = std::pow(kStep, sane(steps));
  Camera moved = camera;
  if (camera.orthographic_height) {
    moved.orthographic_height = clamped(*camera.orthographic_height * factor);
    return moved;
  }
  const DVec3 offset = camera.look_from - camera.look_at;
  const double distance = glm::length(offset);
  moved.look_from = camera.look_at + clamped(distance * factor) / distance * offset;
  return moved;
}

Camera frame(const Camera& camera, const Bounds& bounds, double aspect, double margin) {
  const ViewAxes axes = axes_of(camera);
  const DVec3 half = 0.5 * (bounds.high - bounds.low);
  const double radius = glm::length(half);
  double height = 0;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const DVec3 p = half * DVec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const double extent =
        margin * std::max(std::abs(glm::dot(p, axes.up)), std::abs(glm::dot(p, axes.right)) / aspect);
    height = std::max(height, 2 * extent);
    distance = std::max(distance, glm::dot(p, axes.back) + extent / slope_of(camera));
  }
  Camera framed = camera;
  framed.look_at = bounds.low + half;
  if (camera.orthographic_height) {
    framed.orthographic_height = radius > 0 ? clamped(height) : *camera.orthographic_height;
    distance = std::max(glm::distance(camera.look_from, camera.look_at), 2 * radius);
  } else if (!(radius > 0)) {
    distance = glm::distance(camera.look_from, camera.look_at);
  }
  framed.look_from = framed.look_at + clamped(distance) * axes.back;
  return framed;
}

Camera view_from(const Camera& camera, const Bounds& bounds, const DVec3& direction, double aspect) {
  const UpFrame up = frame_of_up(camera.up);
  const DVec3 offset = camera.look_from - camera.look_at;
  // On the axis any azimuth would do: the view from the front is tipped over.
  const double level = glm::length(glm::cross(direction, up.up));
  const double azimuth = azimuth_of(up, level > kPole * glm::length(direction) ? direction : up.z);
  Camera turned = camera;
  turned.look_from =
      camera.look_at + glm::length(offset) * direction_at(up, azimuth, elevation_of(up, direction));
  return frame(turned, bounds, aspect);
}

}  // namespace meander
