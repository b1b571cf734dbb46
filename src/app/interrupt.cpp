#include "app/interrupt.h"

#include <csignal>

namespace meander {
namespace {

// A signal handler can reach nothing but static storage.
std::atomic<bool>& flag() {
  static std::atomic<bool> raised{false};
  return raised;
}

void raise_flag(int signal) {
  if (flag().exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

const std::atomic<bool>& watch_interrupts() {
  static_assert(std::atomic<bool>::is_always_lock_free);
  (void)flag();
  std::signal(SIGINT, raise_flag);
  std::signal(SIGTERM, raise_flag);
  return flag();
}

}  // namespace meander
