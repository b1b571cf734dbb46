#include "film/film_union.h"

#include <cassert>

namespace meander {

void FilmUnion::add(const Image& resolved, std::uint64_t samples) {
  assert(samples >= 1 && resolved.channels >= (samples > 1 ? 6 : 3));
  if (samples_ == 0) {
    width_ = resolved.width;
    height_ = resolved.height;
    pixels_.resize(static_cast<std::size_t>(width_) * height_);
  }
  assert(resolved.width == width_ && resolved.height == height_);
  const double before = static_cast<double>(samples_);
  const double more = static_cast<double>(samples);
  const double share = more / (before + more);
  const float* values = resolved.values.data();
  for (std::array<Sums, 3>& pixel : pixels_) {
    for (int c = 0; c < 3; ++c) {
      const double difference = static_cast<double>(values[c]) - pixel[c].mean;
      const double own = samples > 1 ? static_cast<double>(values[3 + c]) * more * (more - 1) : 0;
      pixel[c].mean += difference * share;
      pixel[c].m2 += own + difference * difference * before * share;
    }
    values += resolved.channels;
  }
  samples_ += samples;
}

Image FilmUnion::resolve() const {
  assert(samples_ > 0);
  const double n = static_cast<double>(samples_);
  Image image(width_, height_, 6);
  float* out = image.values.data();
  for (const std::array<Sums, 3>& pixel : pixels_) {
    for (int c = 0; c < 3; ++c) {
      out[c] = static_cast<float>(pixel[c].mean);
      out[3 + c] = samples_ > 1 ? static_cast<float>(pixel[c].m2 / (n - 1) / n) : 0.0f;
    }
    out += 6;
  }
  return image;
}

}  // namespace meander
