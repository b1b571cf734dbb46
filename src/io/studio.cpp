#include "io/studio.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

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

// The name as a TOML string.
std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04X", static_cast<unsigned>(c));
      text += escaped;
      continue;
    }
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text + '"';
}

// A direction by azimuth (from +z toward +x) and elevation, in degrees.
DVec3 direction(double azimuth, double elevation) {
  const double a = glm::radians(azimuth);
  const double e = glm::radians(elevation);
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

// How far along `view` a camera must stand from a box's centre for the box to fill the height, or 16:9 of it
// across, but for a margin.
double framing_distance(const DVec3& half_size, const DVec3& view, double fov) {
  const DVec3 right = glm::normalize(glm::cross(DVec3(0, 1, 0), view));
  const DVec3 up = glm::cross(view, right);
  const double slope = std::tan(glm::radians(fov) / 2) * 0.72;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const DVec3 signs(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const DVec3 p = signs * half_size;
    const double half_extent = std::max(std::abs(glm::dot(p, up)), std::abs(glm::dot(p, right)) * 9 / 16);
    distance = std::max(distance, glm::dot(p, view) + half_extent / slope);
  }
  return distance;
}

}  // namespace

std::string studio_text(const Mesh& mesh, const std::string& mesh_name) {
  const Bounds bounds = bounds_of(mesh);
  const DVec3 center = 0.5 * (bounds.low + bounds.high);
  const double radius = 0.5 * glm::length(bounds.high - bounds.low);
  const double fov = 30;
  const DVec3 view = glm::normalize(DVec3(0.45, 0.4, 1));
  const double distance = framing_distance(0.5 * (bounds.high - bounds.low), view, fov);
  const DVec3 ground(center.x, bounds.low.y - 1.001 * radius, center.z);
  std::ostringstream text;
  text << "[camera]\nlook_from = " << triple(center + distance * view) << "\nlook_at = " << triple(center)
       << "\nvertical_fov = " << fov << "\n[environment]\nradiance = [0.15, 0.17, 0.2]\n"
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
       << "[[object]]\nname = \"object\"\nmaterial = \"wax\"\nmesh = " << quoted(mesh_name)
       << "\n[[object]]\nname = \"ground\"\nmaterial = \"ground\"\nshape = \"slab\"\n"
       << "transform = { translate = " << triple(ground) << ", scale = " << number(radius) << " }\n";
  return text.str();
}

}  // namespace meander
