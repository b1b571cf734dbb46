// Environment images from files.
#pragma once

#include <memory>
#include <string>

#include "scene/environment_image.h"

namespace meander {

/// Reads a linear latitude-longitude picture; `rotation` in degrees and `scale` as in EnvironmentImage.
/// Errors: Error (input) naming the file, also for display-encoded pictures, crops, and pictures without
/// colour.
[[nodiscard]] std::shared_ptr<const EnvironmentImage> load_environment(const std::string& path,
                                                                       double rotation, double scale);

}  // namespace meander
