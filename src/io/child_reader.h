// A hostile file read in a child process, seen from the parent.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "core/error.h"
#include "core/timer.h"
#include "io/shut_in.h"

namespace meander {

/// What a reader is and how its errors read: `name` is as "the mesh importer"; `refuse` makes the error of a
/// file that is none or of a child that died, `refuse_content` that of what the child says of the file. The
/// path is no part of the reason.
struct ReaderWords {
  using Refusal = std::function<Error(const std::string& reason)>;
  std::string name;
  Refusal refuse;
  Refusal refuse_content;
};

/// Reads a regular file of at most 2 GiB, opened without following what is no file, under reading_limits and
/// within two minutes. The child is dead and buried when this is gone. Everything throws: as
/// ReaderWords has it for what the file is or does; Error (runtime) where no process can be started.
class ChildReader {
 public:
  /// Starts to read, and waits until the child knows that it can: throws what it says otherwise.
  ChildReader(const std::string& path, ReaderWords words, const ReadShutIn& read);
  ~ChildReader();
  ChildReader(const ChildReader&) = delete;
  ChildReader& operator=(const ChildReader&) = delete;

  [[nodiscard]] std::size_t file_bytes() const noexcept { return bytes_; }

  /// Fills `bytes` of memory from the answer. Throws when the answer ends before, or the deadline comes.
  void receive(void* memory, std::size_t bytes);
  template <typename T>
  [[nodiscard]] T receive() {
    T value{};
    receive(&value, sizeof value);
    return value;
  }
  /// Memory grows with what has really come, not with what was announced.
  template <typename Container>
  void receive_many(Container& values, std::uint64_t count) {
    constexpr std::uint64_t kAtOnce = 1 << 16;
    while (values.size() < count) {
      const std::size_t have = values.size();
      values.resize(std::min<std::uint64_t>(count, have + kAtOnce));
      receive(values.data() + have, (values.size() - have) * sizeof values[0]);
    }
  }
  [[nodiscard]] std::string receive_text();  // as Answer::put_text

  /// What the child says of the file, as an error.
  [[noreturn]] void refuse_content(const std::string& text) const;
  [[noreturn]] void fail_of_nonsense() const;

 private:
  void start(int file, const ReadShutIn& read);
  void bury() noexcept;
  [[nodiscard]] int milliseconds_left() const;
  [[noreturn]] void fail_to_start() const;
  [[noreturn]] void fail_late() const;
  [[noreturn]] void fail_of_death();

  std::string path_;
  ReaderWords words_;
  std::size_t bytes_ = 0;
  Timer since_start_;
  int answer_ = -1;
  int child_ = -1;
};

}  // namespace meander
