// Ctrl-C ends the work, not the program.
#pragma once

#include <atomic>

namespace meander {

/// From now on SIGINT and SIGTERM raise the returned flag; a second one ends the program at once. Call once.
[[nodiscard]] const std::atomic<bool>& watch_interrupts();

}  // namespace meander
