// What the child process does that reads an image file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "io/image_file.h"
#include "io/shut_in.h"

namespace meander {

inline constexpr std::int64_t kMostPixels = std::int64_t{1} << 30;
inline constexpr int kMostChannels = 64;

/// What the child sends first. Then follow, as Answer::put_text has it: the names of the channels; name and
/// text of so many attributes; name and std::int64_t of so many integers. Then bands of rows: the number of
/// values, and these as floats; or 0, and in place of the rest the text of an error.
struct ImageImportHeader {
  int width = 0;
  int height = 0;
  int channels = 0;
  Placement placement;
  std::uint64_t texts = 0;
  std::uint64_t integers = 0;
  bool encoded = false;
};

[[nodiscard]] std::uint64_t value_count(const ImageImportHeader& header) noexcept;

/// Whether a file of that length may hold so much: whatever takes 256 MiB, and else 256 times its length. A
/// picture of one colour packs to less, and is refused.
[[nodiscard]] bool fits_file(const ImageImportHeader& header, std::size_t file_bytes) noexcept;

/// Reads the file with the library's reader of that name. Throws std::exception.
void import_image(const FileBytes& content, const std::string& reader, Answer& answer);

}  // namespace meander
