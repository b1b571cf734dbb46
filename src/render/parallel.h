// The one door to oneTBB.
#pragma once

#include <cstddef>
#include <functional>

namespace meander {

/// `background`: threads that work on it yield to the rest of the process, from then on and for good.
enum class Priority { normal, background };

/// Calls body(i) once for every i < count, on at most `threads` threads (>= 1, and never more than the
/// hardware has), and returns when all have ended. The order is unspecified; body must not throw.
void parallel_for(int threads, std::size_t count, const std::function<void(std::size_t)>& body,
                  Priority priority = Priority::normal);

/// The number of hardware threads this process may use, at least 1.
[[nodiscard]] int hardware_threads();

}  // namespace meander
