#include "display/film_textures.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace meander {
namespace {

using PlaneSet = std::array<bool, 3>;

PlaneSet planes_of(View view) {
  if (view == View::noise) return {true, true, false};
  if (view == View::scatterings) return {false, true, false};
  if (view == View::length || view == View::normals) return {false, false, true};
  return {true, false, false};
}

}  // namespace

FilmTextures::FilmTextures(const Functions& gl)
    : planes_{Texture(gl), Texture(gl), Texture(gl)}, content_{std::make_shared<const char>(), 0} {}

void FilmTextures::begin(int width, int height, std::uint64_t version) {
  assert(width > 0 && height > 0);
  if (width == width_ && height == height_ && version == version_) return;
  there_ = {};
  has_samples_ = false;
  width_ = width;
  height_ = height;
  version_ = version;
}

void FilmTextures::show(const FilmPlanes& planes, std::uint64_t version, View view) {
  begin(planes.radiance.width, planes.radiance.height, version);
  has_samples_ = true;
  const std::array<const Image*, 3> images{&planes.radiance, &planes.error, &planes.features};
  const PlaneSet wanted = planes_of(view);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image& image = *images[i];
    if (!wanted[i] || there_[i] || image.values.empty()) continue;
    assert(image.width == width_ && image.height == height_ && image.channels == 4);
    planes_[i].upload(image.width, image.height, image.channels, image.values.data());
    there_[i] = true;
    ++content_.uploads;
  }
}

void FilmTextures::show(const Image& linear, std::uint64_t version) {
  assert(linear.channels >= 3);
  begin(linear.width, linear.height, version);
  if (there_[0]) return;
  if (linear.channels == 3) {
    planes_[0].upload(linear.width, linear.height, 3, linear.values.data());
  } else {
    std::vector<float> rgb(static_cast<std::size_t>(linear.width) * linear.height * 3);
    float* to = rgb.data();
    for (std::size_t i = 0; i < linear.values.size(); i += static_cast<std::size_t>(linear.channels)) {
      to = std::copy_n(linear.values.data() + i, 3, to);
    }
    planes_[0].upload(linear.width, linear.height, 3, rgb.data());
  }
  there_[0] = true;
  ++content_.uploads;
}

bool FilmTextures::has(View view) const noexcept {
  if (view == View::samples && !has_samples_) return false;
  const PlaneSet wanted = planes_of(view);
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i] && !there_[i]) return false;
  }
  return true;
}

void FilmTextures::bind(int plane, int unit) const { planes_[static_cast<std::size_t>(plane)].bind(unit); }

}  // namespace meander
