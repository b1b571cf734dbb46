// Surrounds that need no picture file.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "math/image.h"

namespace meander {

enum class Sky : std::uint8_t { softbox, overcast };
inline constexpr std::array<std::string_view, 2> kSkyNames{"softbox", "overcast"};

/// A latitude-longitude picture as EnvironmentImage takes it, 256 x 128, linear, always the same.
/// overcast: the CIE standard overcast sky, L = (1 + 2 sin elevation) / 3 with zenith 1 (Moon & Spencer 1942;
/// CIE S 011), whose irradiance on the horizontal is 7/9 pi; below the horizon what a ground of reflectance
/// 0.2 sends back.
/// softbox: large soft rectangular panels about a dim surround: the strongest behind the subject, as seen
/// along -z, a weaker one before it on the right and a narrow one on the left.
[[nodiscard]] Image make_sky(Sky sky);

}  // namespace meander
