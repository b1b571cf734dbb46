// Similarity: media of different g that look nearly, or exactly, alike.
#pragma once

#include "medium/coefficients.h"

namespace meander {

class ColorMaps;

/// What a change of g holds, per channel.
/// look: the colour of the half-space under the material's surface (ColorMap) and the reduced extinction
/// sigma_t' = sigma_a + sigma_s (1 - g).
/// sigma_t: the extinction and the single-scattering albedo, as numbers; the colour follows g.
/// sigma_s_reduced: sigma_a and sigma_s' = sigma_s (1 - g), and so sigma_t' too; the colour moves by what
/// similarity errs (up to 0.01 in the albedo at a given colour).
enum class GLock { look, sigma_t, sigma_s_reduced };

/// The medium with another g, |g| < 1. `look` needs two ColorMaps, tens of milliseconds at most, and is as
/// exact as they are.
[[nodiscard]] Coefficients with_g(const Coefficients& medium, double g, GLock lock, Surface surface);
/// The same with maps that are kept for the next time.
[[nodiscard]] Coefficients with_g(const Coefficients& medium, double g, GLock lock, Surface surface,
                                  ColorMaps& maps);
/// The same, within what floats keep of an albedo near 1.
[[nodiscard]] Medium with_g(const Medium& medium, double g, GLock lock, Surface surface);

/// The similar isotropic medium: sigma_s' = sigma_s (1 - g), the same sigma_a, g = 0.
[[nodiscard]] Coefficients reduced(const Coefficients& medium);
[[nodiscard]] Medium reduced(const Medium& medium);

/// The medium of this g, |g| < 1, whose reduced form is the given isotropic one: sigma_s = sigma_s' / (1 -
/// g).
[[nodiscard]] Coefficients unreduced(const Coefficients& isotropic, double g);
[[nodiscard]] Medium unreduced(const Medium& isotropic, double g);

}  // namespace meander
