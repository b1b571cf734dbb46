#include "golden/faults.h"

#include <algorithm>
#include <cmath>

#include "math/tone.h"

namespace meander {
namespace {

constexpr int kBlock = 8;            // as ZTestOptions
constexpr double kBlockErrors = 10;  // standard errors of a block: 1.25 of each of its values

void swap_a_pixel(Image& image) {
  float* found = image.at(0, 0);
  float most = -1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x + 1 < image.width; ++x) {
      float* at = image.at(x, y);
      float off = 0;
      for (int c = 0; c < 3; ++c) off += std::abs(at[image.channels + c] - at[c]);
      if (off > most) {
        most = off;
        found = at;
      }
    }
  }
  std::swap_ranges(found, found + image.channels, found + image.channels);
}

void shift(Image& image) {
  const Image still = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      std::copy_n(still.at(std::max(x - 1, 0), std::max(y - 1, 0)), image.channels, image.at(x, y));
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

// The variances of the mean behind the colours say how much no single value can show.
void raise_block(Image& image) {
  const int left = image.width / 2 / kBlock * kBlock;
  const int top = image.height / 2 / kBlock * kBlock;
  for (int c = 0; c < 3; ++c) {
    double variance = 0;
    for (int i = 0; i < kBlock * kBlock; ++i)
      variance += double{image.at(left + i % kBlock, top + i / kBlock)[3 + c]};
    const auto each = static_cast<float>(kBlockErrors * std::sqrt(variance) / (kBlock * kBlock));
    for (int i = 0; i < kBlock * kBlock; ++i) image.at(left + i % kBlock, top + i / kBlock)[c] += each;
  }
}

void change_tone(Image& image) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c)
        image.at(x, y)[c] = static_cast<float>(tone_curve(Tone::filmic, double{image.at(x, y)[c]}));
}

}  // namespace

bool plant_fault(Image& image, std::string_view fault) {
  if (fault == "pixel")
    swap_a_pixel(image);
  else if (fault == "shift")
    shift(image);
  else if (fault == "blur")
    blur(image);
  else if (fault == "block" && image.channels == 6)
    raise_block(image);
  else if (fault == "tone")
    change_tone(image);
  else
    return false;
  return true;
}

}  // namespace meander
