// Light from all around as a latitude-longitude picture: looked up by direction, and sampled in proportion to
// what it shines.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "math/image.h"
#include "math/types.h"

namespace meander {

/// Row 0 is at the zenith (+y); unrotated, the centre of the picture is seen along -z, and what is right of
/// it toward +x. Every texel has one radiance over its whole solid angle (no interpolation), so that the
/// density of sampling is exactly proportional to luminance.
class EnvironmentImage {
 public:
  /// The first three channels are linear radiance, times `scale` (0 or more). `rotation`, in degrees, turns
  /// the surround by R_y(rotation): at +90, what was seen along -z is seen along -x. Error (input) with the
  /// place of the first texel that is not finite, negative, or more than 1e30 when scaled.
  explicit EnvironmentImage(const Image& image, double rotation = 0, double scale = 1);

  /// The same picture under another rotation and scale, which take the place of the ones it had; the texels
  /// are shared. Errors as above.
  EnvironmentImage(const EnvironmentImage& picture, double rotation, double scale);

  /// What arrives from a unit direction, looking outward.
  [[nodiscard]] Rgb radiance(const Vec3& direction) const noexcept;

  /// pdf is per steradian; both it and the radiance are 0 when the picture is black.
  struct Sample {
    Vec3 direction;
    Rgb radiance;
    Real pdf;
  };
  /// Draws a texel in proportion to its luminance times its solid angle and a direction uniform over that,
  /// with u in [0, 1)^2; O(log width + log height). Texels of luminance 0 are never drawn.
  [[nodiscard]] Sample sample(const Vec2& u) const noexcept;

  /// Density per steradian with which `sample` draws a unit direction: luminance over the sphere's integral
  /// of it.
  [[nodiscard]] Real pdf(const Vec3& direction) const noexcept;

  /// Of all that decides the radiance (core/digest.h).
  [[nodiscard]] std::uint64_t digest() const noexcept;

 private:
  // What the file holds, unscaled.
  struct Picture {
    int width;
    int height;
    float brightest = 0;             // of all channels
    std::vector<glm::vec3> texels;   // row by row
    std::vector<double> luminances;  // running sums within each row, width + 1 a row
    std::vector<double> powers;      // running sums over the rows of luminance times solid angle, height + 1
  };

  [[nodiscard]] static std::shared_ptr<const Picture> read_picture(const Image& image, double scale);
  [[nodiscard]] std::size_t texel_of(const Vec3& direction) const noexcept;
  [[nodiscard]] Real pdf_of(std::size_t texel) const noexcept;
  [[nodiscard]] bool is_black() const noexcept { return !(picture_->powers.back() > 0 && scale_ > 0); }

  std::shared_ptr<const Picture> picture_;
  double turn_;  // the rotation, in whole turns
  Real scale_;
};

}  // namespace meander
