#include "stability/readings.h"

#include <algorithm>
#include <cmath>

namespace meander {

void fill_whole(Readings& readings) {
  for (std::size_t c = 0; c < 3; ++c) {
    Reading sum;
    for (std::size_t region = 0; region < kWhole; ++region) {
      sum.value += readings[region][c].value / kWhole;
      sum.error = std::hypot(sum.error, readings[region][c].error / kWhole);
    }
    readings[kWhole][c] = sum;
  }
}

Readings readings_of(const Film& film) {
  Readings readings;
  std::array<double, kRegions> counts{};
  for (int y = 0; y < film.height; ++y)
    for (int x = 0; x < film.width; ++x) {
      const std::size_t quarter = (2 * y >= film.height ? 2 : 0) + (2 * x >= film.width ? 1 : 0);
      for (const std::size_t region : {quarter, std::size_t{kWhole}}) {
        const Pixel& pixel = film.at(x, y);
        const std::array<double, 3> variance = pixel.variance_of_mean();
        ++counts[region];
        for (std::size_t c = 0; c < 3; ++c) {
          readings[region][c].value += pixel.mean[c];
          readings[region][c].error += variance[c];
        }
      }
    }
  for (std::size_t region = 0; region < kRegions; ++region)
    for (Reading& reading : readings[region]) {
      const double count = std::max(counts[region], 1.0);
      reading = {reading.value / count, std::sqrt(reading.error) / count};
    }
  return readings;
}

Readings rescaled(Readings readings, double offset, double scale) {
  for (auto& region : readings)
    for (Reading& reading : region)
      reading = {scale * (reading.value - offset), std::abs(scale) * reading.error};
  return readings;
}

double worst_z(const Readings& a, const Readings& b, bool grey, bool whole, double floor) {
  double worst = 0;
  for (std::size_t region = whole ? kWhole : 0; region < kRegions; ++region)
    for (std::size_t c = 0; c < (grey ? 1 : 3); ++c) {
      const Reading& x = a[region][c];
      const Reading& y = b[region][c];
      const double z = (x.value - y.value) / std::hypot(std::hypot(x.error, y.error), floor);
      if (!(std::abs(z) <= std::abs(worst))) worst = z;  // NaN stays
    }
  return worst;
}

}  // namespace meander
