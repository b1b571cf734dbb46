// The child process that reads hostile files: what it may do, and what its end is called.
#include "io/child_reader.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace meander {
namespace {

namespace fs = std::filesystem;

class SmallFile {
 public:
  SmallFile() : path_((fs::temp_directory_path() / ("meander-child-" + std::to_string(getpid()))).string()) {
    std::ofstream(path_) << "hostile";
  }
  ~SmallFile() { fs::remove(path_); }
  SmallFile(const SmallFile&) = delete;
  SmallFile& operator=(const SmallFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

ReaderWords words() {
  const auto refuse = [](const std::string& kind) {
    return [kind](const std::string& reason) { return Error(Fault::input, kind + ": " + reason); };
  };
  return {"the reader", refuse("file"), refuse("content")};
}

// The error of reading, none when a byte comes.
std::string error_of(const ReadShutIn& read) {
  const SmallFile file;
  try {
    ChildReader child(file.path(), words(), read);
    (void)child.receive<char>();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

double children_seconds() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
}

}  // namespace

TEST_CASE("a child sends what it has read, and how it fails or ends is said") {
  CHECK(error_of([](const FileBytes& content, Answer& answer) { answer.put(content.at(6)); }).empty());
  CHECK(error_of([](const FileBytes&, Answer&) { throw std::runtime_error("no\nend.\n"); }) ==
        "content: no end");
  CHECK(error_of([](const FileBytes&, Answer&) { throw 1; }) == "content: unknown error");
  CHECK(error_of([](const FileBytes&, Answer&) {}) ==
        "file: the reader broke off; the file is damaged or hostile");
  CHECK(error_of([](const FileBytes&, Answer&) { std::_Exit(3); }) ==
        "file: the reader failed (exit code 3); the file is damaged or hostile");
  CHECK(error_of([](const FileBytes&, Answer&) { std::raise(SIGKILL); }) ==
        "file: the reader crashed (signal 9); the file is damaged or hostile");
}

TEST_CASE("a child that does not come to an end is stopped within a second of processor time") {
  const double before = children_seconds();
  const std::string error = error_of([](const FileBytes& content, Answer&) {
    volatile bool on = !content.empty();
    while (on) {
    }
  });
  CHECK(error == "file: the reader used more than 0.9 s of processor time; the file is damaged or hostile");
  CHECK(children_seconds() - before < 1);
}

TEST_CASE("a child opens nothing") {
  CHECK(error_of([](const FileBytes&, Answer& answer) {
          if (open("/dev/null", O_RDONLY) >= 0 || open("/etc/passwd", O_RDONLY) >= 0) std::_Exit(4);
          answer.put('x');
        }).empty());
}

#ifndef __SANITIZE_ADDRESS__  // whose shadow leaves no room for limits
TEST_CASE("a child of a small file takes less than a gigabyte") {
  CHECK(reading_limits(7).memory_bytes < std::uint64_t{1} << 30);
  CHECK(error_of([](const FileBytes&, Answer& answer) {
          const FileBytes large(std::size_t{1} << 30);
          answer.put(large[0]);
        }) == "content: it needs more memory than reading it may take");
}
#endif

TEST_CASE("what reading may use grows with the file, up to a limit") {
  constexpr std::size_t kMiB = std::size_t{1} << 20;
  CHECK(reading_limits(0).processor_seconds == doctest::Approx(0.9));
  CHECK(reading_limits(10 * kMiB).processor_seconds == doctest::Approx(10.9));
  CHECK(reading_limits(2048 * kMiB).processor_seconds == doctest::Approx(60));
  CHECK(reading_limits(kMiB).memory_bytes == 576 * kMiB);
  CHECK(reading_limits(2048 * kMiB).memory_bytes == 8192 * kMiB);
}

}  // namespace meander
