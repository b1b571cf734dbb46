// Many short rays at once, see packet_rays.h.
#pragma once

#include <span>

#include "trace/packet_rays.h"

namespace meander {

/// The most rays of one call.
inline constexpr std::size_t kRayBatch = 128;

/// What find_exit finds for each of the rays, in as many exits; the same bits.
void find_exits(const Packets& packets, const SurfaceCells& cells, std::span<const ShortRay> rays,
                std::span<ShortExit> exits) noexcept;

}  // namespace meander
