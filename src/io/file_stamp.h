// Whether a file is still the one that was read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace meander {

/// A file at one time: another time or size means that it changed. As it is made, the stamp of no file.
struct FileStamp {
  std::string path;
  std::filesystem::file_time_type time = std::filesystem::file_time_type::min();
  std::uintmax_t bytes = static_cast<std::uintmax_t>(-1);

  bool operator==(const FileStamp&) const = default;
  [[nodiscard]] bool is_there() const noexcept { return bytes != static_cast<std::uintmax_t>(-1); }
};

/// The file as it is now; the stamp of no file where there is none.
[[nodiscard]] FileStamp stamp_of(const std::string& path);

/// False within 30 ms of the last write, longer than the clock that stamps files takes for a step: what is
/// written next might leave the file the same time. A time to come is another machine's, and tells nothing.
[[nodiscard]] bool is_settled(const FileStamp& stamp);

/// For a file that is about to be read, to be compared with later ones: what is written after this call has
/// another stamp. Where its own is not settled, that of no file.
[[nodiscard]] FileStamp stamp_before_reading(const std::string& path);

}  // namespace meander
