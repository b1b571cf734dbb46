#include "trace/lazy_balls.h"

namespace meander {

bool LazyBalls::make(int threads, const std::atomic<bool>& stop) const {
  if (ready()) return true;
  const std::lock_guard lock(making_);
  if (ready()) return true;
  if (stop) return false;
  balls_ = std::make_unique<const EmptyBalls>(make_empty_balls(body_, threads));
  made_.store(balls_.get(), std::memory_order_release);
  return true;
}

}  // namespace meander
