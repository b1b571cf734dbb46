#include "io/studio.h"

#include <cmath>
#include <filesystem>
#include <sstream>

#include "core/error.h"
#include "io/scene_writer.h"
#include "scene/camera_moves.h"

namespace meander {
namespace {

std::string triple(const DVec3& v) {
  std::ostringstream text;
  text.precision(12);
  text << std::showpoint << '[' << v.x << ", " << v.y << ", " << v.z << ']';
  return text.str();
}

std::string number(double value) {
  std::ostringstream text;
  text.precision(12);
  text << std::showpoint << value;
  return text.str();
}

// A direction by azimuth (from +z toward +x) and elevation, in degrees.
DVec3 direction(double azimuth, double elevation) {
  const double a = glm::radians(azimuth);
  const double e = glm::radians(elevation);
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

}  // namespace

std::string studio_text(const Mesh& mesh, const std::string& path) {
  constexpr double kFarthest = 1e20;
  constexpr double kLargest = 1e12;  // as in a scene
  const Bounds bounds = bounds_of(mesh);
  const DVec3 center = 0.5 * (bounds.low + bounds.high);
  const double radius = 0.5 * glm::length(bounds.high - bounds.low);
  if (!(2 * radius <= kLargest && 2 * radius >= 1 / kLargest && glm::length(center) <= kFarthest)) {
    std::ostringstream text;
    text << "is " << 2 * radius << " across, its middle " << glm::length(center)
         << " from the origin; without a scene file a mesh must be 1e-12 to 1e12 across, within 1e20 of the "
            "origin";
    throw Error(Place{path, 0, 0}, text.str());
  }
  Camera camera;
  camera.look_from = glm::normalize(DVec3(0.45, 0.4, 1));
  camera.vertical_fov = 30;
  camera = frame(camera, bounds, 16.0 / 9, 1 / 0.72);
  const DVec3 ground(center.x, bounds.low.y - 1.001 * radius, center.z);
  std::ostringstream text;
  text << "[camera]\nlook_from = " << triple(camera.look_from) << "\nlook_at = " << triple(center)
       << "\nvertical_fov = " << camera.vertical_fov << "\n[environment]\nradiance = [0.15, 0.17, 0.2]\n"
       << "[[light]]\nname = \"key\"\ntype = \"rectangle\"\ncenter = "
       << triple(center + 4 * radius * direction(40, 40)) << "\nlook_at = " << triple(center)
       << "\nwidth = " << number(2 * radius) << "\nheight = " << number(2 * radius) << "\nradiance = 5\n"
       << "[[light]]\nname = \"back\"\ntype = \"rectangle\"\ncenter = "
       << triple(center + 4 * radius * direction(200, 25)) << "\nlook_at = " << triple(center)
       << "\nwidth = " << number(2.5 * radius) << "\nheight = " << number(2.5 * radius)
       << "\nradiance = [13, 11.5, 10]\n"
       << "[[material]]\nname = \"wax\"\ncolor = [0.85, 0.6, 0.33]\nradius = "
       << triple(radius * DVec3(0.12, 0.06, 0.03)) << "\nboundary = \"diffuse\"\n"
       << "[[material]]\nname = \"ground\"\ntype = \"diffuse\"\ncolor = 0.3\n"
       << "[[object]]\nname = \"object\"\nmaterial = \"wax\"\nmesh = "
       << toml_string(std::filesystem::path(path).filename().string())
       << "\n[[object]]\nname = \"ground\"\nmaterial = \"ground\"\nshape = \"slab\"\n"
       << "transform = { translate = " << triple(ground) << ", scale = " << number(radius) << " }\n";
  return text.str();
}

}  // namespace meander
