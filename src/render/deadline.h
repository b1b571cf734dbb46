// A time at which work stops.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

namespace meander {

/// A flag that becomes true, and stays so, when `stop` does or the time is up, seen by a thread of its own
/// within 5 ms.
class Deadline {
 public:
  /// No time is set yet. `stop` must outlive it. Error (runtime) when the system gives no thread.
  explicit Deadline(const std::atomic<bool>& stop);

  /// The time is up so many seconds from now, instead of when it was set to be before.
  void set(double seconds_from_now);

  /// What the work asks; valid as long as this is.
  [[nodiscard]] const std::atomic<bool>& reached() const noexcept { return reached_; }

 private:
  using Clock = std::chrono::steady_clock;

  void watch(const std::stop_token& ended);

  const std::atomic<bool>& stop_;
  std::atomic<bool> reached_{false};
  std::mutex mutex_;
  std::condition_variable_any wake_;
  Clock::time_point end_ = Clock::time_point::max();  // guarded by mutex_
  std::jthread watcher_;                              // last: it uses the others
};

}  // namespace meander
