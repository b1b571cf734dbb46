// Faults for golden tests to find: each makes a picture wrong in one way.
#pragma once

#include <string_view>

#include "math/image.h"

namespace meander {

/// Plants `fault` in an image of any number of channels, of which the first three are colours and the rest,
/// variances, stay what they are unless the pixels themselves move:
/// - "pixel": the two neighbours of a row that differ most change places;
/// - "shift": every pixel stands one to the right and one down, the first column and row twice;
/// - "blur": colours are the mean over 3 x 3 pixels, fewer at the edge. The variances do not shrink with it,
///   which only makes it harder to see;
/// - "block", where there are variances: a block of 8 x 8 in the middle is brighter by ten standard errors of
/// its
///   sum, which no value of it shows;
/// - "tone": colours went through the filmic tone curve.
/// False when there is no fault of that name.
[[nodiscard]] bool plant_fault(Image& image, std::string_view fault);

}  // namespace meander
