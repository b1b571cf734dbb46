// The colours that other renderers have to be given for a single-scattering albedo, where they publish how
// they come from the one to the other.
#pragma once

namespace meander {

/// The single-scattering albedo that the inversion which OpenPBR 1.1 suggests (Inversion::van_de_hulst) makes
/// of a colour in [0, 1]; |g| < 1. It increases with the colour, from 6e-6 / (1 - g) at black, where its
/// rounded constants do not quite cancel.
[[nodiscard]] double openpbr_albedo(double color, double g);

/// The least colour in [0, 1] of which that makes the albedo in [0, 1], or what comes nearest to it.
[[nodiscard]] double openpbr_color(double albedo, double g);

/// The range of g that Cycles' random walk below a surface takes; it clamps what is outside.
inline constexpr double kCyclesLeastG = 0;
inline constexpr double kCyclesLargestG = 0.9;

/// The albedo at which Cycles cuts what its inversion makes.
inline constexpr double kCyclesLargestAlbedo = 0.999999;

/// The single-scattering albedo that Cycles makes of a colour in [0, 1], g in [0, 0.9]: the fit of Wrenninge,
/// Villemin and Hery 2017, "Path Traced Subsurface Scattering using Anisotropic Phase Functions and
/// Non-Exponential Free Flights", as Blender 4.0 to 5.1 use it for RANDOM_WALK and 5.2 for
/// RANDOM_WALK_LEGACY. Increases strictly with the colour up to kCyclesLargestAlbedo.
[[nodiscard]] double cycles_albedo(double color, double g);

/// The least colour in [0, 1] of which Cycles makes this albedo in [0, 1], or kCyclesLargestAlbedo where it
/// is above that; g in [0, 0.9].
[[nodiscard]] double cycles_color(double albedo, double g);

}  // namespace meander
