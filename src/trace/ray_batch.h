// Many rays at once, see packet_rays.h.
#pragma once

#include <span>

#include "trace/packet_rays.h"

namespace meander {

/// The most rays of one call.
inline constexpr std::size_t kRayBatch = 128;

/// Rays in rows.
struct alignas(64) GridRays {
  float origin[3][kRayBatch];
  float direction[3][kRayBatch];
  float distance[kRayBatch];
};

/// What find_exit finds for each of the first rays, as many as there are exits (at most kRayBatch); the same
/// bits. Up to 15 rays beyond are read too: they must hold numbers.
void find_exits(const Packets& packets, const SurfaceCells& cells, const GridRays& rays,
                std::span<GridExit> exits) noexcept;

}  // namespace meander
