#include "display/capture.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "gl/framebuffer.h"
#include "gl/offscreen.h"

namespace meander {
namespace {

// Far below the texture limit of any OpenGL 3.3, and small: a tile takes 12 MiB as floats.
constexpr int kTile = 1024;

void paste(const Image8& tile, int x, int y, Image8& frame) {
  const std::size_t row = static_cast<std::size_t>(tile.width) * 3;
  for (int i = 0; i < tile.height; ++i) std::copy_n(tile.at(0, i), row, frame.at(x, y + i));
}

}  // namespace

Image8 capture_frame(const Image& linear, const ViewOptions& options) {
  assert(linear.width > 0 && linear.height > 0);
  const Offscreen context(1, 1);
  const Functions& gl = context.functions();
  FilmView view(gl);
  const Framebuffer target(gl, std::min(linear.width, kTile), std::min(linear.height, kTile));
  Image8 frame(linear.width, linear.height);
  for (int y = 0; y < linear.height; y += kTile) {
    for (int x = 0; x < linear.width; x += kTile) {
      const Region region{x, y, std::min(kTile, linear.width - x), std::min(kTile, linear.height - y)};
      view.upload(linear, region);
      target.bind(region.width, region.height);
      view.draw(options);
      paste(target.read(region.width, region.height), x, y, frame);
    }
  }
  return frame;
}

}  // namespace meander
