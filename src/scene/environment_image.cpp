#include "scene/environment_image.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "core/error.h"
#include "math/color.h"

namespace meander {
namespace {

constexpr double kTurn = 2 * glm::pi<double>();
constexpr float kLargestRadiance = 1e30f;

// Distance of the cosine of `angle` from 1, without cancellation.
double one_minus_cos(double angle) noexcept {
  const double half = std::sin(0.5 * angle);
  return 2 * half * half;
}

// cos a - cos b between the upper and the lower edge of a row, without cancellation.
double height_of_row(int row, int rows) noexcept {
  const double step = glm::pi<double>() / rows;
  return 2 * std::sin((row + 0.5) * step) * std::sin(0.5 * step);
}

struct Height {
  double cos_theta;
  double sin_theta;
};

// The height at a fraction of a row's solid angle, counted from its upper edge; measured from the nearer
// pole, where it keeps its digits.
Height height_at(int row, int rows, double fraction) noexcept {
  const bool north = 2 * row < rows;
  const int from_pole = north ? row : rows - 1 - row;
  const double part = north ? fraction : 1 - fraction;
  const double depth =
      one_minus_cos(from_pole * glm::pi<double>() / rows) + part * height_of_row(from_pole, rows);
  const double sin_theta = std::sqrt(std::max(depth * (2 - depth), 0.0));
  return {north ? 1 - depth : depth - 1, sin_theta};
}

// An entry of a distribution, and how far across it a number fell.
struct Pick {
  int index;
  double fraction;
};

// Inverts running sums (from 0 to a positive total, `count` + 1 of them) at u in [0, 1); entries without
// weight are never picked.
Pick pick(const double* sums, int count, double u) noexcept {
  const double total = sums[count];
  const double target = std::min(u * total, std::nextafter(total, 0.0));
  const double* above = std::upper_bound(sums + 1, sums + count, target);
  const double low = above[-1];
  return {static_cast<int>(above - sums) - 1, (target - low) / (*above - low)};
}

[[noreturn]] void refuse_texel(int x, int y, const float* texel, double scale) {
  std::ostringstream text;
  text << "pixel (" << x << ", " << y << ") is [" << texel[0] << ", " << texel[1] << ", " << texel[2] << "]";
  if (scale != 1) text << " times " << scale;
  text << ", but radiance must be finite, 0 or more and at most " << kLargestRadiance;
  throw Error(Fault::input, text.str());
}

}  // namespace

EnvironmentImage::EnvironmentImage(const Image& image, double rotation, double scale)
    : width_(image.width), height_(image.height), turn_(std::fmod(rotation, 360.0) / 360) {
  assert(image.width > 0 && image.height > 0 && image.channels >= 3 && scale >= 0);
  const std::size_t rows = static_cast<std::size_t>(height_);
  texels_.reserve(rows * width_);
  luminances_.reserve(rows * (width_ + 1));
  powers_.reserve(rows + 1);
  powers_.push_back(0);
  for (int y = 0; y < height_; ++y) {
    double sum = 0;
    luminances_.push_back(sum);
    for (int x = 0; x < width_; ++x) {
      const float* values = image.at(x, y);
      const glm::vec3 texel(scale * glm::dvec3(values[0], values[1], values[2]));
      for (int c = 0; c < 3; ++c)
        if (!(values[c] >= 0 && texel[c] <= kLargestRadiance)) refuse_texel(x, y, values, scale);
      texels_.push_back(texel);
      sum += luminance(Rgb(texel));
      luminances_.push_back(sum);
    }
    powers_.push_back(powers_.back() + sum * (kTurn / width_) * height_of_row(y, height_));
  }
}

std::size_t EnvironmentImage::texel_of(const Vec3& direction) const noexcept {
  const DVec3 d(direction);
  const double turn = std::atan2(d.x, -d.z) / kTurn + 0.5 + turn_;
  const double down = std::atan2(std::hypot(d.x, d.z), d.y) / glm::pi<double>();
  const int x = std::min(static_cast<int>((turn - std::floor(turn)) * width_), width_ - 1);
  const int y = std::min(static_cast<int>(down * height_), height_ - 1);
  return static_cast<std::size_t>(y) * width_ + x;
}

Real EnvironmentImage::pdf_of(std::size_t texel) const noexcept {
  const double total = powers_.back();
  return total > 0 ? static_cast<Real>(luminance(Rgb(texels_[texel])) / total) : Real(0);
}

Rgb EnvironmentImage::radiance(const Vec3& direction) const noexcept {
  return Rgb(texels_[texel_of(direction)]);
}

EnvironmentImage::Sample EnvironmentImage::sample(const Vec2& u) const noexcept {
  if (!(powers_.back() > 0)) return {Vec3(0, 1, 0), Rgb(0), 0};
  const Pick row = pick(powers_.data(), height_, u.y);
  const double* sums = luminances_.data() + static_cast<std::size_t>(row.index) * (width_ + 1);
  const Pick column = pick(sums, width_, u.x);
  const double azimuth = kTurn * ((column.index + column.fraction) / width_ - 0.5 - turn_);
  const Height height = height_at(row.index, height_, row.fraction);
  const Vec3 direction(height.sin_theta * std::sin(azimuth), height.cos_theta,
                       -height.sin_theta * std::cos(azimuth));
  const std::size_t texel = static_cast<std::size_t>(row.index) * width_ + column.index;
  return {direction, Rgb(texels_[texel]), pdf_of(texel)};
}

Real EnvironmentImage::pdf(const Vec3& direction) const noexcept { return pdf_of(texel_of(direction)); }

}  // namespace meander
