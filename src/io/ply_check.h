// Whether a PLY file holds all that its header promises.
#pragma once

#include <cstdint>
#include <span>

namespace meander {

/// Follows the header's elements through the file, which assimp reads as far as it goes without a word. A
/// file in a form that is not known here (a type of another name, a list whose count is no whole number) is
/// left to assimp. Throws std::runtime_error: the header does not end, or the file ends before its elements.
void check_ply(std::span<const std::uint8_t> content);

}  // namespace meander
