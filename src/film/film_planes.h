// What a display shows of a film.
#pragma once

#include "math/image.h"

namespace meander {

/// Four channels each. radiance: R G B and the number of samples; error: the variance of the mean R G B and
/// the mean number of scatterings; features: the mean walk length (scene units) and the normal x y z (0 where
/// nothing is hit).
struct FilmPlanes {
  Image radiance;
  Image error;
  Image features;
};

}  // namespace meander
