// Checkpoints: a film in full precision, and what is known of it, in a file of its own format.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "film/film.h"

namespace meander {

/// Names and values, in one order; no name holds a blank, and neither holds a line end.
using CheckpointFields = std::vector<std::pair<std::string, std::string>>;

struct Checkpoint {
  CheckpointFields fields;
  Film film;
};

/// The file: a line "meander checkpoint 1" (the number is the format's), a line "name value" for each field,
/// a line "film WIDTH HEIGHT", an empty line; then row by row each pixel as it is held (mean and m2 of R, G,
/// B, count, sums of luminance, order and length, mean and count of three strata; 128 bytes, little-endian);
/// then the digest (core/digest.h) of the text and that of the pixels, 8 bytes each. Text that says what it
/// is of, for people; doubles bit for bit, written as they lie in memory, since a resumed run must give the
/// same bytes; not OpenEXR, whose channels hold no doubles. Error (input) as write_file.
void write_checkpoint(const std::string& path, const CheckpointFields& fields, const Film& film);

/// Error (input) with the path: it cannot be read, is no checkpoint, one of a newer format, cut short, or
/// damaged.
[[nodiscard]] Checkpoint read_checkpoint(const std::string& path);

/// As check_writable for any file type, and refuses to replace a file that is no checkpoint.
void check_checkpoint_writable(const std::string& path);

/// The value of that name; nullptr when there is none.
[[nodiscard]] const std::string* find_field(const CheckpointFields& fields, std::string_view name) noexcept;

}  // namespace meander
