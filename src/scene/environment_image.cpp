#include "scene/environment_image.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <sstream>

#include "core/digest.h"
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

// Whether a value of the picture is a radiance; false for a NaN.
bool is_radiance(float value, double scale) noexcept {
  return value >= 0 && static_cast<float>(scale * static_cast<double>(value)) <= kLargestRadiance;
}

double turns(double rotation) noexcept { return std::fmod(rotation, 360.0) / 360; }

}  // namespace

std::shared_ptr<const EnvironmentImage::Picture> EnvironmentImage::read_picture(const Image& image,
                                                                                double scale) {
  assert(image.width > 0 && image.height > 0 && image.channels >= 3 && scale >= 0);
  auto picture = std::make_shared<Picture>();
  picture->width = image.width;
  picture->height = image.height;
  const std::size_t rows = static_cast<std::size_t>(image.height);
  picture->texels.reserve(rows * image.width);
  picture->luminances.reserve(rows * (image.width + 1));
  picture->powers.reserve(rows + 1);
  picture->powers.push_back(0);
  for (int y = 0; y < image.height; ++y) {
    double sum = 0;
    picture->luminances.push_back(sum);
    for (int x = 0; x < image.width; ++x) {
      const float* values = image.at(x, y);
      for (int c = 0; c < 3; ++c) {
        if (!is_radiance(values[c], scale)) refuse_texel(x, y, values, scale);
        picture->brightest = std::max(picture->brightest, values[c]);
      }
      picture->texels.emplace_back(values[0], values[1], values[2]);
      sum += luminance(Rgb(picture->texels.back()));
      picture->luminances.push_back(sum);
    }
    picture->powers.push_back(picture->powers.back() +
                              sum * (kTurn / image.width) * height_of_row(y, image.height));
  }
  return picture;
}

EnvironmentImage::EnvironmentImage(const Image& image, double rotation, double scale)
    : picture_(read_picture(image, scale)), turn_(turns(rotation)), scale_(static_cast<Real>(scale)) {}

EnvironmentImage::EnvironmentImage(const EnvironmentImage& picture, double rotation, double scale)
    : picture_(picture.picture_), turn_(turns(rotation)), scale_(static_cast<Real>(scale)) {
  assert(scale >= 0);
  if (is_radiance(picture_->brightest, scale)) return;
  for (std::size_t i = 0; i < picture_->texels.size(); ++i) {
    const glm::vec3& texel = picture_->texels[i];
    if (is_radiance(std::max({texel.x, texel.y, texel.z}), scale)) continue;
    const std::size_t width = static_cast<std::size_t>(picture_->width);
    refuse_texel(static_cast<int>(i % width), static_cast<int>(i / width), &texel.x, scale);
  }
}

std::size_t EnvironmentImage::texel_of(const Vec3& direction) const noexcept {
  const int width = picture_->width;
  const int height = picture_->height;
  const DVec3 d(direction);
  const double turn = std::atan2(d.x, -d.z) / kTurn + 0.5 + turn_;
  const double down = std::atan2(std::hypot(d.x, d.z), d.y) / glm::pi<double>();
  const int x = std::min(static_cast<int>((turn - std::floor(turn)) * width), width - 1);
  const int y = std::min(static_cast<int>(down * height), height - 1);
  return static_cast<std::size_t>(y) * width + x;
}

Real EnvironmentImage::pdf_of(std::size_t texel) const noexcept {
  if (is_black()) return 0;
  return static_cast<Real>(luminance(Rgb(picture_->texels[texel])) / picture_->powers.back());
}

Rgb EnvironmentImage::radiance(const Vec3& direction) const noexcept {
  return scale_ * Rgb(picture_->texels[texel_of(direction)]);
}

EnvironmentImage::Sample EnvironmentImage::sample(const Vec2& u) const noexcept {
  if (is_black()) return {Vec3(0, 1, 0), Rgb(0), 0};
  const Picture& p = *picture_;
  const Pick row = pick(p.powers.data(), p.height, u.y);
  const double* sums = p.luminances.data() + static_cast<std::size_t>(row.index) * (p.width + 1);
  const Pick column = pick(sums, p.width, u.x);
  const double azimuth = kTurn * ((column.index + column.fraction) / p.width - 0.5 - turn_);
  const Height height = height_at(row.index, p.height, row.fraction);
  const Vec3 direction(height.sin_theta * std::sin(azimuth), height.cos_theta,
                       -height.sin_theta * std::cos(azimuth));
  const std::size_t texel = static_cast<std::size_t>(row.index) * p.width + column.index;
  return {direction, scale_ * Rgb(p.texels[texel]), pdf_of(texel)};
}

Real EnvironmentImage::pdf(const Vec3& direction) const noexcept { return pdf_of(texel_of(direction)); }

std::uint64_t EnvironmentImage::digest() const noexcept {
  Digest digest;
  digest.add(picture_->width);
  digest.add(picture_->height);
  digest.add(std::as_bytes(std::span(picture_->texels)));
  digest.add(turn_);
  digest.add(scale_);
  return digest.value();
}

}  // namespace meander
