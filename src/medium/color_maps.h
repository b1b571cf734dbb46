// The colour maps that were asked for last.
#pragma once

#include <mutex>
#include <vector>

#include "medium/color_map.h"

namespace meander {

/// Keeps the last few ColorMaps, so that an edit which touches neither g nor the surface does not solve their
/// half-space again. Any thread may ask.
class ColorMaps {
 public:
  /// The same map as ColorMap(g, surface), made where it is not kept.
  [[nodiscard]] ColorMap of(double g, Surface surface);

 private:
  struct Entry {
    Surface surface;
    ColorMap map;
  };
  std::mutex mutex_;
  std::vector<Entry> entries_;  // the last asked for at the end
};

}  // namespace meander
