#include "stats/counted_pixels.h"

#include <algorithm>
#include <string>

#include "core/error.h"

namespace meander {
namespace {

std::string size_of(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

void require_channels(const Image& image, int channels) {
  if (image.channels >= channels) return;
  throw Error(Fault::input, "the image has " + std::to_string(image.channels) + " channels where " +
                                std::to_string(channels) + " are needed: R G B" +
                                (channels > 3 ? " and the variance of each" : ""));
}

}  // namespace

CountedPixels::CountedPixels(const Image& a, const Image& b, std::span<const std::uint8_t> mask, int channels)
    : mask_(mask) {
  if (a.width != b.width || a.height != b.height) {
    throw Error(Fault::input,
                "the images differ in size: " + size_of(a) + " and " + size_of(b) + "; they must be equal");
  }
  require_channels(a, channels);
  require_channels(b, channels);
  const std::size_t pixels = static_cast<std::size_t>(a.width) * a.height;
  if (!mask.empty() && mask.size() != pixels) {
    throw Error(Fault::input, "the mask has " + std::to_string(mask.size()) +
                                  " pixels where the images have " + std::to_string(pixels));
  }
  if (std::all_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m == 0; })) mask_ = {};
}

}  // namespace meander
