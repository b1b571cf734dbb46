#include "golden/faults.h"

#include <algorithm>

#include "math/tone.h"

namespace meander {
namespace {

void shift(Image& image) {
  for (int y = 0; y < image.height; ++y)
    std::copy_backward(image.at(0, y),
                       image.at(0, y) + static_cast<std::ptrdiff_t>(image.width - 1) * image.channels,
                       image.at(0, y) + static_cast<std::ptrdiff_t>(image.width) * image.channels);
}

float mean_around(const Image& image, int x, int y, int channel) {
  float sum = 0;
  int count = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, image.height - 1); ++v) {
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, image.width - 1); ++u) {
      sum += image.at(u, v)[channel];
      ++count;
    }
  }
  return sum / static_cast<float>(count);
}

void blur(Image& image) {
  const Image sharp = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = mean_around(sharp, x, y, c);
}

void change_tone(Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<float>(tone_curve(Tone::filmic, double{image.at(x, y)[c]}));
}

}  // namespace

bool plant_fault(Image& image, std::string_view fault) {
  if (fault == "shift")
    shift(image);
  else if (fault == "blur")
    blur(image);
  else if (fault == "tone")
    change_tone(image);
  else
    return false;
  return true;
}

}  // namespace meander
