#include <algorithm>
#include <cmath>

#include "ui/plot.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr double kMargin = 0.05;  // of the axis, on either side
constexpr double kLeast = 1.0 / 3;
constexpr double kFewDecades = 2.2;  // up to here 2 and 5 are labelled, too

}  // namespace

PlotAxis plot_axis(const std::vector<double>& values) {
  PlotAxis axis{-1, 1, {}, {}};
  double low = INFINITY;
  double high = -INFINITY;
  for (const double value : values) {
    if (!(value > 0) || !std::isfinite(value)) continue;
    low = std::min(low, std::log10(value));
    high = std::max(high, std::log10(value));
  }
  if (low <= high) {
    const double margin = std::max({kMargin * (high - low), 0.5 * (kLeast - (high - low)), 0.04});
    axis.low = low - margin;
    axis.high = high + margin;
  }
  const bool few = axis.high - axis.low <= kFewDecades;
  for (int decade = static_cast<int>(std::floor(axis.low)); decade <= std::ceil(axis.high); ++decade)
    for (int k = 1; k < 10; ++k) {
      const double position = decade + std::log10(static_cast<double>(k));
      if (position < axis.low || position > axis.high) continue;
      const bool named = k == 1 || (few && (k == 2 || k == 5));
      (named ? axis.labelled : axis.minor).push_back(k * std::pow(10.0, decade));
    }
  return axis;
}

std::string seconds_label(double seconds) {
  if (seconds < 0.9e-3) return significant(1e6 * seconds, 1) + " µs";
  return seconds < 0.9 ? significant(1e3 * seconds, 1) + " ms" : significant(seconds, 1) + " s";
}

std::string percent_label(double fraction) { return significant(100 * fraction, 1) + " %"; }

}  // namespace meander
