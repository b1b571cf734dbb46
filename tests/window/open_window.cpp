// Opens a window and draws until it is closed, ending as `meander` does: the message of an Error, and its
// exit code.
//   open_window [SECONDS]
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/error.h"
#include "gl/state.h"
#include "gl/window.h"

int main(int argc, char** argv) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(argc > 1 ? std::atoi(argv[1]) : 60);
  try {
    meander::Window window({700, 500}, "meander");
    std::puts("open");
    std::fflush(stdout);
    while (!window.should_close() && Clock::now() < end) {
      window.bind();
      meander::clear(window.functions(), 0.3f);
      window.swap();
      (void)window.poll(0.02);
    }
  } catch (const meander::Error& error) {
    std::fprintf(stderr, "meander: %s\n", error.what());
    return error.exit_code();
  }
  return 0;
}
