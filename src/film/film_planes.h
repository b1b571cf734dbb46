// What a display shows of a film: images of floats, ready for a texture.
#pragma once

#include "math/image.h"

namespace meander {

/// What a display shows of a film, four channels each. radiance: R G B and the number of samples. error:
/// variance of the mean R G B, and the mean number of scatterings. features: mean walk length (scene units)
/// and the normal x y z (0 where nothing is hit). The means weigh every contribution by its luminance, and
/// are 0 where no light was found.
struct FilmPlanes {
  Image radiance;
  Image error;
  Image features;
};

}  // namespace meander
