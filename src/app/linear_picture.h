// A picture from a file as comparisons take it.
#pragma once

#include <string>

#include "io/image_file.h"

namespace meander {

/// R G B in linear light, and the variance of each mean after them where the file has all three; a single
/// channel counts as grey. `path` names the file in errors. Error (input) when a channel is missing.
[[nodiscard]] Image linear_picture(const LoadedImage& loaded, const std::string& path);

}  // namespace meander
