#include "io/environment_file.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/error.h"
#include "io/image_file.h"

namespace meander {
namespace {

// R G B, wherever the file keeps them.
Image pick_rgb(const LoadedImage& loaded, const Place& place) {
  constexpr std::array<const char*, 3> kNames{"R", "G", "B"};
  std::array<std::ptrdiff_t, 3> source{};
  for (int c = 0; c < 3; ++c) {
    const auto found = std::find(loaded.channels.begin(), loaded.channels.end(), kNames[c]);
    if (found == loaded.channels.end())
      throw Error(place, std::string("has no channel ") + kNames[c] + "; an environment needs R, G and B");
    source[c] = found - loaded.channels.begin();
  }
  const Image& image = loaded.image;
  Image picked(image.width, image.height, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) picked.at(x, y)[c] = image.at(x, y)[source[c]];
  return picked;
}

// A picture that fills its frame: a crop would be stretched over the whole sphere.
void check_whole(const LoadedImage& loaded, const Place& place) {
  const Placement& p = loaded.placement;
  if (p.full_width == 0) return;
  const bool whole =
      p.x == 0 && p.y == 0 && p.full_width == loaded.image.width && p.full_height == loaded.image.height;
  if (whole) return;
  throw Error(place, "its data window is not its display window; an environment needs the whole picture");
}

}  // namespace

std::shared_ptr<const EnvironmentImage> load_environment(const std::string& path, double rotation,
                                                         double scale) {
  const Place place{path, 0, 0};
  const LoadedImage loaded = read_image(path);
  if (loaded.encoded)
    throw Error(place,
                "is display-encoded and clipped at white, so it cannot hold the radiance of lights; an "
                "environment must be linear, as OpenEXR or Radiance HDR");
  check_whole(loaded, place);
  const Image picture = pick_rgb(loaded, place);
  try {
    return std::make_shared<const EnvironmentImage>(picture, rotation, scale);
  } catch (const Error& error) {
    throw Error(place, error.what());
  }
}

}  // namespace meander
