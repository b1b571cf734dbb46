// One pass over one tile: by scalar paths, or by paths in lanes. Either way every pixel takes its samples in
// order.
#pragma once

#include "render/empty_pixels.h"

namespace meander {

/// What one tile adds to the statistics of a pass.
struct TileResult {
  PathCounters counters;
  std::uint64_t non_finite = 0;
  bool complete = false;
};

/// One pass over an image: reads one film, writes another.
struct TilePass {
  const Job& job;
  const CameraRays& camera;
  const EmptyPixels& empty;
  Tile area;
  PathOptions options;
  std::uint64_t samples;
  const Rendering& before;  // its film counts for nothing while it has no samples
  Film& after;
  bool lanes;

  /// Tiles may be rendered at the same time.
  [[nodiscard]] TileResult render(const Tile& tile) const;
};

}  // namespace meander
