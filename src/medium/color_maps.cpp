#include "medium/color_maps.h"

#include <algorithm>

namespace meander {
namespace {

constexpr std::size_t kKept = 32;

}  // namespace

ColorMap ColorMaps::of(double g, Surface surface) {
  // A matched surface has no index, whatever stands there.
  if (surface.boundary == Boundary::matched) surface = {};
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return entry.map.g() == g && entry.surface == surface;
  });
  if (found != entries_.end()) {
    std::rotate(found, found + 1, entries_.end());
    return entries_.back().map;
  }
  if (entries_.size() == kKept) entries_.erase(entries_.begin());
  entries_.push_back({surface, ColorMap(g, surface)});
  return entries_.back().map;
}

}  // namespace meander
