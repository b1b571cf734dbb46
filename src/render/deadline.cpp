#include "render/deadline.h"

#include <algorithm>
#include <system_error>

#include "core/error.h"

namespace meander {

Deadline::Deadline(const std::atomic<bool>& stop) : stop_(stop) {
  try {
    watcher_ = std::jthread([this](const std::stop_token& ended) { watch(ended); });
  } catch (const std::system_error& error) {
    throw Error(Fault::runtime, std::string("cannot watch the time: ") + error.what());
  }
}

void Deadline::set(double seconds_from_now) {
  constexpr double kFarAway = 1e9;
  const std::chrono::duration<double> left(std::min(seconds_from_now, kFarAway));
  const std::scoped_lock lock(mutex_);
  end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(left);
}

void Deadline::watch(const std::stop_token& ended) {
  constexpr std::chrono::milliseconds kBetween(5);
  std::unique_lock lock(mutex_);
  while (!ended.stop_requested() && !stop_ && Clock::now() < end_)
    wake_.wait_for(lock, ended, kBetween, [] { return false; });
  if (!ended.stop_requested()) reached_ = true;
}

}  // namespace meander
