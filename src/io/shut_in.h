// The child process that reads a hostile file: it may open nothing, has limits, and may die of what it reads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace meander {

using FileBytes = std::vector<std::uint8_t>;

struct ReadingLimits {
  double processor_seconds = 0;
  std::uint64_t memory_bytes = 0;  // besides what the parent had
};

/// What reading a file of that size may use: 0.9 s and a second a MiB, at most 60; 512 MiB and 64 times the
/// file, at most 8 GiB. The libraries behind it read some 40 MiB a second; a damaged file can keep them busy
/// forever.
[[nodiscard]] ReadingLimits reading_limits(std::size_t file_bytes) noexcept;

inline constexpr std::uint64_t kMaxReadingErrorBytes = 4096;

/// The child's answer: first the number of bytes of an error's text, then that text; or 0, and what was put.
/// Buffered; a parent that is gone ends the process.
class Answer {
 public:
  Answer();

  template <typename T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    put_bytes(&value, sizeof value);
  }
  void put_bytes(const void* bytes, std::size_t count);
  void put_text(const std::string& text);  // its length first
  void flush();

 private:
  std::vector<std::uint8_t> buffer_;
};

/// Reads the file and puts what it holds. Throws std::exception, before it has put anything, where it cannot.
using ReadShutIn = std::function<void(const FileBytes& content, Answer& answer)>;

/// For a child just forked, before anything else: gives up signal handlers, every descriptor but these and
/// the right to open more, limits processor time and memory, reads `bytes` of the file, sends the answer and
/// ends the process.
[[noreturn]] void run_shut_in(int file, std::size_t bytes, int answer, const ReadShutIn& read);

}  // namespace meander
