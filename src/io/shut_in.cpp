#include "io/shut_in.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define MEANDER_SHADOW_MEMORY
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define MEANDER_SHADOW_MEMORY
#endif
#endif

namespace meander {

namespace {

constexpr int kFile = 0;
constexpr int kAnswer = 3;
constexpr std::size_t kBufferBytes = 1 << 16;

void limit(int resource, rlim_t value) {
  rlimit limits{};
  if (getrlimit(resource, &limits) != 0) return;
  limits.rlim_max = std::min(limits.rlim_max, value);
  limits.rlim_cur = limits.rlim_max;
  setrlimit(resource, &limits);
}

// The parent's address space was inherited and counts too. A sanitizer's shadow is too large for any limit.
void limit_memory([[maybe_unused]] std::uint64_t allowance) {
#ifndef MEANDER_SHADOW_MEMORY
  std::array<char, 64> text{};
  const int statm = open("/proc/self/statm", O_RDONLY);
  if (statm < 0) return;
  unsigned long pages = 0;
  if (read(statm, text.data(), text.size() - 1) > 0 && std::sscanf(text.data(), "%lu", &pages) == 1) {
    limit(RLIMIT_AS, pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + allowance);
  }
  close(statm);
#endif
}

// The timer knows fractions of a second; the limit, above it, cannot be held off.
void limit_processor_time(double seconds) {
  const double whole = std::floor(seconds);
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(whole);
  timer.it_value.tv_usec = static_cast<suseconds_t>((seconds - whole) * 1e6);
  setitimer(ITIMER_PROF, &timer, nullptr);
  limit(RLIMIT_CPU, static_cast<rlim_t>(whole) + 2);
}

// Leaves the file as descriptor 0, the answer as 3, silence as 1 and 2; the kernel refuses any other.
void shut_in(int from_file, int from_answer, const ReadingLimits& limits) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // the parent's death is the child's
  for (int signal = 1; signal < NSIG; ++signal) std::signal(signal, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  limit_memory(limits.memory_bytes);
  const int file = fcntl(from_file, F_DUPFD, kAnswer + 1);
  const int answer = fcntl(from_answer, F_DUPFD, kAnswer + 1);
  const int silence = open("/dev/null", O_RDWR);
  if (file < 0 || answer < 0 || silence < 0) _exit(1);
  if (dup2(silence, 1) < 0 || dup2(silence, 2) < 0) _exit(1);
  if (dup2(file, kFile) < 0 || dup2(answer, kAnswer) < 0) _exit(1);
  closefrom(kAnswer + 1);
  limit(RLIMIT_NOFILE, 0);
  limit(RLIMIT_CORE, 0);
  limit_processor_time(limits.processor_seconds);
}

void send(const std::uint8_t* bytes, std::size_t count) {
  for (std::size_t sent = 0; sent < count;) {
    const ssize_t written = write(kAnswer, bytes + sent, count - sent);
    if (written < 0 && errno != EINTR) _exit(1);
    if (written > 0) sent += static_cast<std::size_t>(written);
  }
}

[[noreturn]] void send_error(const char* message) {
  const std::uint64_t size =
      std::min<std::uint64_t>(std::max<std::size_t>(std::strlen(message), 1), kMaxReadingErrorBytes);
  send(reinterpret_cast<const std::uint8_t*>(&size), sizeof size);
  send(reinterpret_cast<const std::uint8_t*>(*message == '\0' ? "?" : message), size);
  _exit(0);
}

FileBytes read_file(std::size_t bytes) {
  FileBytes content(bytes);
  std::size_t have = 0;
  while (have < bytes) {
    const ssize_t got = read(kFile, content.data() + have, bytes - have);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::runtime_error(std::strerror(errno));
    if (got == 0) break;
    have += static_cast<std::size_t>(got);
  }
  content.resize(have);
  return content;
}

}  // namespace

ReadingLimits reading_limits(std::size_t file_bytes) noexcept {
  constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
  const double mebibytes = static_cast<double>(file_bytes) / static_cast<double>(kMiB);
  return {std::min(60.0, 0.9 + mebibytes),
          std::min<std::uint64_t>(8192 * kMiB, 512 * kMiB + 64 * std::uint64_t{file_bytes})};
}

Answer::Answer() {
  buffer_.reserve(kBufferBytes);
  put(std::uint64_t{0});  // no error
}

void Answer::put_bytes(const void* bytes, std::size_t count) {
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  if (buffer_.size() + count > kBufferBytes) flush();
  if (count > kBufferBytes) return send(from, count);
  buffer_.insert(buffer_.end(), from, from + count);
}

void Answer::put_text(const std::string& text) {
  put(std::uint64_t{text.size()});
  put_bytes(text.data(), text.size());
}

void Answer::flush() {
  send(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void run_shut_in(int file, std::size_t bytes, int answer, const ReadShutIn& read) {
  try {
    shut_in(file, answer, reading_limits(bytes));
    const FileBytes content = read_file(bytes);
    Answer whole;
    read(content, whole);
    whole.flush();
    _exit(0);
  } catch (const std::bad_alloc&) {
    send_error("it needs more memory than reading it may take");
  } catch (const std::exception& error) {
    send_error(error.what());
  } catch (...) {
    send_error("unknown error");
  }
}

}  // namespace meander
