// A scene as plain data: what the file says, in scene units, with coefficients already resolved. Nothing here
// traces.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "math/tone.h"
#include "math/types.h"
#include "medium/medium.h"
#include "medium/surface.h"
#include "scene/environment_image.h"
#include "scene/mesh.h"

namespace meander {

/// Perspective with the full vertical angle in degrees, or orthographic with the full height of the view.
struct Camera {
  DVec3 look_from{0, 0, 5};
  DVec3 look_at{0, 0, 0};
  DVec3 up{0, 1, 0};
  double vertical_fov = 40;
  std::optional<double> orthographic_height;
};

struct FilmSize {
  int width = 960;
  int height = 540;
};

struct Display {
  double exposure = 0;  // stops
  Tone tone = Tone::srgb;
};

/// The same radiance from every direction, or an image in its place; `visible` false hides it from camera
/// rays that have not scattered.
struct Environment {
  Rgb radiance{0};
  std::shared_ptr<const EnvironmentImage> image;
  bool visible = true;
};

/// Emits `radiance` from the side toward `look_at`; `width` runs along the horizontal of that view.
struct RectangleLight {
  DVec3 center{0};
  DVec3 look_at{0, -1, 0};
  DVec3 up{0, 1, 0};
  double width = 1;
  double height = 1;
  Rgb radiance{1};
};

struct SphereLight {
  DVec3 center{0};
  double radius = 1;
  Rgb radiance{1};
};

/// Intensity in power per steradian.
struct PointLight {
  DVec3 position{0};
  Rgb intensity{1};
};

/// Irradiance on a surface that faces the light; `direction` is the direction of travel.
struct DirectionalLight {
  DVec3 direction{0, -1, 0};
  Rgb irradiance{1};
};

/// Lights shine through one another; a visible one stops camera rays that have not scattered.
struct Light {
  std::string name;
  std::variant<RectangleLight, SphereLight, PointLight, DirectionalLight> shape;
  bool visible = false;
};

/// `ior` in [1, 4] is the index inside over the one outside, 1 where matched; `roughness` in [0, 1] is for
/// the dielectric boundary alone, 0 is smooth.
struct TranslucentMaterial {
  Medium medium;
  Boundary boundary = Boundary::matched;
  double ior = 1;
  double roughness = 0;
};

/// Opaque Lambertian of the given reflectance, on both sides.
struct DiffuseMaterial {
  Rgb color{Real(0.5)};
};

struct EmissiveMaterial {
  Rgb radiance{1};
};

struct Material {
  std::string name;
  std::variant<TranslucentMaterial, DiffuseMaterial, EmissiveMaterial> kind;
};

/// Scale first, then rotate Rz Ry Rx (degrees), then translate. Transforms never change sigma.
struct Transform {
  DVec3 translate{0};
  DVec3 rotate{0};
  DVec3 scale{1};
};

/// The linear part of the transform.
[[nodiscard]] DMat3 linear_part(const Transform& transform);

struct SphereShape {};  // radius 1 at the origin, exact
struct BoxShape {};     // [-1, 1]^3, exact
struct SlabShape {};    // |y| <= 1, unbounded in x and z, exact

struct Object {
  std::string name;
  std::variant<SphereShape, BoxShape, SlabShape, std::shared_ptr<const Mesh>> shape;
  std::size_t material = 0;
  Transform transform;
};

/// Lengths are in scene units, of `millimetres_per_unit` (> 0) millimetres each.
struct Scene {
  std::string name;
  double millimetres_per_unit = 1;
  Camera camera;
  FilmSize film;
  Display display;
  Environment environment;
  std::vector<Light> lights;
  std::vector<Material> materials;
  std::vector<Object> objects;
};

}  // namespace meander
