#include "scene/sky.h"

#include <algorithm>
#include <cmath>

#include "math/types.h"

namespace meander {
namespace {

constexpr int kWidth = 256;
constexpr int kHeight = 128;

// The height (sine of the elevation) of a row's upper edge.
double edge_height(int row) { return std::cos(row * glm::pi<double>() / kHeight); }

// L averaged over a row's solid angle: it is linear in the height, and so is solid angle.
double overcast_row(int row) {
  constexpr double kGround = 0.2 * 7.0 / 9;
  if (2 * row >= kHeight) return kGround;
  return (1 + edge_height(row) + edge_height(row + 1)) / 3;
}

// A panel that faces the subject: where its middle is seen (degrees to the right of -z, and up), and its
// angular size.
struct Panel {
  double azimuth;
  double elevation;
  double width;
  double height;
  DVec3 radiance;
};

constexpr DVec3 kSurround{0.05, 0.055, 0.065};
constexpr Panel kPanels[] = {{-20, 38, 70, 46, {6, 5.5, 4.9}},
                             {140, 40, 60, 50, {2, 2.05, 2.2}},
                             {-105, 15, 22, 75, {1.4, 1.45, 1.6}}};

DVec3 direction_at(double azimuth, double elevation) {
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
          -std::cos(azimuth) * std::cos(elevation)};
}

// 1 inside |x| <= edge, falling smoothly to 0 over the last eighth of it.
double inside(double x, double edge) {
  const double t = std::clamp(8 * (1 - std::abs(x) / edge), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// The fraction of the panel's radiance that arrives from a unit direction.
double panel_weight(const Panel& panel, const DVec3& d) {
  const DVec3 middle = direction_at(glm::radians(panel.azimuth), glm::radians(panel.elevation));
  const double along = glm::dot(d, middle);
  if (!(along > 0.1)) return 0;
  const DVec3 right = glm::normalize(glm::cross(middle, DVec3(0, 1, 0)));
  const DVec3 up = glm::cross(right, middle);
  return inside(glm::dot(d, right) / along, std::tan(glm::radians(panel.width) / 2)) *
         inside(glm::dot(d, up) / along, std::tan(glm::radians(panel.height) / 2));
}

DVec3 softbox_radiance(const DVec3& d) {
  DVec3 radiance = kSurround * (1 + 0.5 * d.y);
  for (const Panel& panel : kPanels) radiance += panel_weight(panel, d) * panel.radiance;
  return radiance;
}

}  // namespace

Image make_sky(Sky sky) {
  Image image(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y) {
    const double elevation = (0.5 - (y + 0.5) / kHeight) * glm::pi<double>();
    for (int x = 0; x < kWidth; ++x) {
      const double azimuth = ((x + 0.5) / kWidth - 0.5) * 2 * glm::pi<double>();
      const DVec3 radiance =
          sky == Sky::overcast ? DVec3(overcast_row(y)) : softbox_radiance(direction_at(azimuth, elevation));
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = static_cast<float>(radiance[c]);
    }
  }
  return image;
}

}  // namespace meander
