// Image files: OpenEXR and PNG out; OpenEXR, Radiance HDR, PFM, PNG and TIFF in.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/output_file.h"
#include "math/image.h"

namespace meander {

/// Named values that travel in an image file, such as "meander/spp".
struct ImageAttributes {
  std::vector<std::pair<std::string, std::string>> text;
  std::vector<std::pair<std::string, std::int64_t>> integers;
};

/// Where a crop sits in the full picture, in pixels from its top left corner. A full size of 0 is the image's
/// own.
struct Placement {
  int x = 0;
  int y = 0;
  int full_width = 0;
  int full_height = 0;
};

/// What a file holds. Integer formats are normalised to [0, 1], never decoded: `encoded` says that the values
/// are display-encoded (every PNG, and 8-bit TIFF) and that the caller must decode them if it wants linear
/// ones.
struct LoadedImage {
  Image image;
  std::vector<std::string> channels;
  ImageAttributes attributes;
  Placement placement;
  bool encoded = false;
};

/// Writes 32-bit floats, bit for bit, with lossless zip compression; the same input gives the same bytes. One
/// name a channel ("R", "variance.R"). Integers outside 32 bits are stored as text. Error (input) as
/// write_file.
void write_exr(const std::string& path, const Image& image, std::span<const std::string> channel_names,
               const ImageAttributes& attributes, const Placement& placement = {});

/// Writes an 8-bit RGB PNG; all attributes become text. Error (input) as write_file.
void write_png(const std::string& path, const Image8& frame, const ImageAttributes& attributes);

/// The bytes of that file.
[[nodiscard]] std::vector<unsigned char> png_bytes(const Image8& frame, const ImageAttributes& attributes);

/// Reads the first picture of a file, row 0 at the top; its extension decides the format. Error (input) of
/// one line when it cannot be read whole or is larger than 2^30 pixels.
[[nodiscard]] LoadedImage read_image(const std::string& path);

/// The integer of that name, whether it is stored as a number or as text; nothing when there is none.
[[nodiscard]] std::optional<std::int64_t> find_integer(const ImageAttributes& attributes,
                                                       const std::string& name);

/// The same of one from 0 to 2^64 - 1, such as a seed.
[[nodiscard]] std::optional<std::uint64_t> find_unsigned(const ImageAttributes& attributes,
                                                         const std::string& name);

/// The finite number that is stored as text under that name; nothing when there is none.
[[nodiscard]] std::optional<double> find_number(const ImageAttributes& attributes, const std::string& name);

}  // namespace meander
