#include "io/child_reader.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <sstream>

namespace meander {

namespace {

constexpr double kDeadlineSeconds = 120;

class Descriptor {
 public:
  explicit Descriptor(int value) noexcept : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) close(value_);
  }
  [[nodiscard]] int get() const noexcept { return value_; }

 private:
  int value_;
};

// Returns the size in bytes of the regular file behind the descriptor.
std::size_t check_file(const ReaderWords& words, const Descriptor& file) {
  struct stat status {};
  if (file.get() < 0 || fstat(file.get(), &status) != 0)
    throw words.refuse(std::string("cannot open: ") + std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw words.refuse("is a directory");
  if (!S_ISREG(status.st_mode)) throw words.refuse("is not a regular file");
  if (status.st_size == 0) throw words.refuse("is empty");
  if (status.st_size > off_t{1} << 31) throw words.refuse("is larger than 2 GiB");
  return static_cast<std::size_t>(status.st_size);
}

// The child's words in one printable line: they may quote the file.
std::string one_line(std::string text) {
  constexpr std::size_t kLongest = 300;
  for (char& c : text) {
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
    if (c < 0x20 || c > 0x7e) c = '?';
  }
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

std::string too_slow(std::size_t bytes) {
  std::ostringstream text;
  text.precision(3);
  text << "used more than " << reading_limits(bytes).processor_seconds << " s of processor time";
  return text.str();
}

}  // namespace

ChildReader::ChildReader(const std::string& path, ReaderWords words, const ReadShutIn& read)
    : path_(path), words_(std::move(words)) {
  // Without O_NONBLOCK a named pipe would keep us here.
  const Descriptor file(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  bytes_ = check_file(words_, file);
  start(file.get(), read);
  try {
    const auto error_bytes = receive<std::uint64_t>();
    if (error_bytes > kMaxReadingErrorBytes) fail_of_nonsense();
    if (error_bytes == 0) return;
    std::string text;
    receive_many(text, error_bytes);
    refuse_content(text);
  } catch (...) {
    bury();
    throw;
  }
}

ChildReader::~ChildReader() { bury(); }

void ChildReader::start(int file, const ReadShutIn& read) {
  std::array<int, 2> ends{-1, -1};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_start();
  answer_ = ends[0];
  const Descriptor far_end(ends[1]);
  child_ = fork();
  if (child_ < 0) {
    bury();
    fail_to_start();
  }
  if (child_ == 0) run_shut_in(file, bytes_, far_end.get(), read);
}

void ChildReader::bury() noexcept {
  close(answer_);
  if (child_ <= 0) return;
  kill(child_, SIGKILL);
  while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

void ChildReader::receive(void* memory, std::size_t bytes) {
  for (std::size_t have = 0; have < bytes;) {
    pollfd readable{answer_, POLLIN, 0};
    const int ready = poll(&readable, 1, milliseconds_left());
    if (ready < 0 && errno == EINTR) continue;
    if (ready < 0) throw Error(Fault::runtime, path_ + ": poll: " + std::strerror(errno));
    if (ready == 0) fail_late();
    const ssize_t got = read(answer_, static_cast<char*>(memory) + have, bytes - have);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail_of_death();
    have += static_cast<std::size_t>(got);
  }
}

std::string ChildReader::receive_text() {
  constexpr std::uint64_t kLongest = std::uint64_t{1} << 28;
  const auto size = receive<std::uint64_t>();
  if (size > kLongest) fail_of_nonsense();
  std::string text;
  receive_many(text, size);
  return text;
}

int ChildReader::milliseconds_left() const {
  return static_cast<int>(std::max(0.0, std::ceil((kDeadlineSeconds - since_start_.seconds()) * 1000)));
}

void ChildReader::fail_to_start() const {
  throw Error(Fault::runtime, path_ + ": cannot start " + words_.name + ": " + std::strerror(errno));
}

void ChildReader::fail_late() const {
  throw words_.refuse(words_.name + " took longer than " + std::to_string(int(kDeadlineSeconds)) +
                      " s and was stopped; the file is damaged or hostile");
}

void ChildReader::refuse_content(const std::string& text) const {
  throw words_.refuse_content(one_line(text));
}

void ChildReader::fail_of_nonsense() const {
  throw words_.refuse(words_.name + " sent nonsense; the file is damaged or hostile");
}

// The answer broke off: says how the child ended, which may take it a moment.
void ChildReader::fail_of_death() {
  int status = 0;
  pid_t ended = 0;
  while ((ended = waitpid(child_, &status, WNOHANG)) == 0 || (ended < 0 && errno == EINTR)) {
    if (milliseconds_left() == 0) fail_late();
    poll(nullptr, 0, 1);
  }
  child_ = -1;
  std::string how = "broke off";
  if (ended > 0 && WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    how = signal == SIGPROF || signal == SIGXCPU ? too_slow(bytes_)
                                                 : "crashed (signal " + std::to_string(signal) + ")";
  } else if (ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) != 0) {
    how = "failed (exit code " + std::to_string(WEXITSTATUS(status)) + ")";
  }
  throw words_.refuse(words_.name + ' ' + how + "; the file is damaged or hostile");
}

}  // namespace meander
