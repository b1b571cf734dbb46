#include "app/linear_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "math/color.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 6> kChannels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};

int channel_index(const LoadedImage& loaded, std::string_view name) {
  const auto found = std::find(loaded.channels.begin(), loaded.channels.end(), name);
  return found == loaded.channels.end() ? -1 : static_cast<int>(found - loaded.channels.begin());
}

// One sample has no variance: what such a file stores says nothing.
bool has_variance(const LoadedImage& loaded) {
  if (find_integer(loaded.attributes, "meander/spp").value_or(2) < 2) return false;
  return std::all_of(kChannels.begin() + 3, kChannels.end(),
                     [&](std::string_view name) { return channel_index(loaded, name) >= 0; });
}

}  // namespace

Image linear_picture(const LoadedImage& loaded, const std::string& path) {
  const bool grey = loaded.image.channels < 3;
  const int count = has_variance(loaded) ? 6 : 3;
  std::array<int, 6> source{};
  for (int c = 0; c < count; ++c) {
    source[c] = grey ? 0 : channel_index(loaded, kChannels[c]);
    if (source[c] < 0)
      throw Error(Place{path, 0, 0}, "has no channel " + std::string(kChannels[c]) + ", needs R, G and B");
  }
  Image picked(loaded.image.width, loaded.image.height, count);
  for (int y = 0; y < picked.height; ++y)
    for (int x = 0; x < picked.width; ++x)
      for (int c = 0; c < count; ++c) {
        const float value = loaded.image.at(x, y)[source[c]];
        picked.at(x, y)[c] = loaded.encoded ? static_cast<float>(decode_srgb(Real(value))) : value;
      }
  return picked;
}

void refuse_bad_values(const Image& image, const std::string& path, const std::string& subject) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        const float value = image.at(x, y)[c];
        if (std::isfinite(value) && (c < 3 || value >= 0)) continue;
        const bool variance = std::isfinite(value);
        throw Error(Place{path, 0, 0}, subject + "has the " + (variance ? "variance " : "value ") +
                                           std::to_string(value) + " in pixel " + std::to_string(x) + ", " +
                                           std::to_string(y) +
                                           (variance ? "; none may be below 0" : "; all must be finite"));
      }
}

}  // namespace meander
