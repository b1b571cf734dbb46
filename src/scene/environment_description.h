// The surround as people look at it: what kind it is, not only what it shines.
#pragma once

#include <optional>
#include <string>

#include "math/types.h"
#include "scene/sky.h"

namespace meander {

/// Constant where neither `sky` nor `image` is there. `image` is as the scene file names it; `rotation`
/// (degrees) and `scale` belong to a sky or an image.
struct EnvironmentDescription {
  DVec3 radiance{0};
  std::optional<Sky> sky;
  std::string image;
  double rotation = 0;
  double scale = 1;
  bool visible = true;
};

}  // namespace meander
