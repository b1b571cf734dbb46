#include "display/capture.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "gl/framebuffer.h"
#include "gl/offscreen.h"

namespace meander {
namespace {

// Far below the texture limit of any OpenGL 3.3, and small: a tile takes 16 MiB a plane.
constexpr int kTile = 1024;

// `channels` of a rectangle of an image; of an image that is not there, nothing.
Image cropped(const Image& image, const Region& region, int channels) {
  if (image.values.empty()) return {};
  Image part(region.width, region.height, channels);
  for (int y = 0; y < region.height; ++y) {
    for (int x = 0; x < region.width; ++x) {
      std::copy_n(image.at(region.x + x, region.y + y), channels, part.at(x, y));
    }
  }
  return part;
}

void paste(const Image8& tile, int x, int y, Image8& frame) {
  const std::size_t row = static_cast<std::size_t>(tile.width) * 3;
  for (int i = 0; i < tile.height; ++i) std::copy_n(tile.at(0, i), row, frame.at(x, y + i));
}

// `show` puts a region of the picture into the textures; the version tells one tile from another.
template <typename Show>
Image8 capture(int width, int height, const ViewOptions& options, Show show) {
  assert(width > 0 && height > 0);
  const Offscreen context(1, 1);
  FilmView view(context.functions());
  FilmTextures textures(context.functions());
  const Framebuffer target(context.functions(), std::min(width, kTile), std::min(height, kTile));
  Image8 frame(width, height);
  std::uint64_t version = 0;
  for (int y = 0; y < height; y += kTile) {
    for (int x = 0; x < width; x += kTile) {
      const Region region{x, y, std::min(kTile, width - x), std::min(kTile, height - y)};
      show(textures, region, ++version);
      target.bind(region.width, region.height);
      const FilmPlacement whole{0, 0, static_cast<float>(region.width), static_cast<float>(region.height)};
      view.draw(textures, options, {whole, region.width, region.height, {}});
      paste(target.read(region.width, region.height), x, y, frame);
    }
  }
  return frame;
}

}  // namespace

Image8 capture_frame(const FilmPlanes& planes, const ViewOptions& options) {
  const auto show = [&](FilmTextures& textures, const Region& region, std::uint64_t version) {
    const FilmPlanes part{cropped(planes.radiance, region, 4), cropped(planes.error, region, 4),
                          cropped(planes.features, region, 4)};
    textures.show(part, version, options.view);
  };
  return capture(planes.radiance.width, planes.radiance.height, options, show);
}

Image8 capture_frame(const Image& linear, const ViewOptions& options) {
  const auto show = [&](FilmTextures& textures, const Region& region, std::uint64_t version) {
    textures.show(cropped(linear, region, 3), version);
  };
  return capture(linear.width, linear.height, options, show);
}

}  // namespace meander
