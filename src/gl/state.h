// The parts of a context's state that drawers share.
#pragma once

#include "gl/functions.h"
#include "math/image.h"

namespace meander {

/// Turns off whatever another drawer may have left on: blending, clipping, depth, dithering, sRGB conversion.
void reset_state(const Functions& gl);

/// Fills the bound framebuffer with one display-encoded grey.
void clear(const Functions& gl, float grey);

/// The `width` x `height` pixels at the lower left of the bound framebuffer, as RGB, top row first.
[[nodiscard]] Image8 read_pixels(const Functions& gl, int width, int height);

}  // namespace meander
