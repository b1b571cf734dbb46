// A picture from a file as comparisons take it.
#pragma once

#include <string>

#include "io/image_file.h"

namespace meander {

/// R G B in linear light, and the variance of each mean after them where the file has all three; a single
/// channel counts as grey. `path` names the file in errors. Error (input) when a channel is missing.
[[nodiscard]] Image linear_picture(const LoadedImage& loaded, const std::string& path);

/// Error (input), with the pixel, when a value is not finite or a variance below 0. `subject` stands before
/// "has the value", "" or "the reference ".
void refuse_bad_values(const Image& image, const std::string& path, const std::string& subject);

}  // namespace meander
