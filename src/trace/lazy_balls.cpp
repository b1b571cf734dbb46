#include "trace/lazy_balls.h"

#include <utility>

namespace meander {

bool LazyBalls::make(int threads, const std::atomic<bool>& stop) const {
  if (ready()) return true;
  const std::lock_guard lock(making_);
  if (ready()) return true;
  auto made = make_empty_balls(body_, threads, kDefaultCells, stop);
  if (!made) return false;
  balls_ = std::make_unique<const EmptyBalls>(std::move(*made));
  made_.store(balls_.get(), std::memory_order_release);
  return true;
}

}  // namespace meander
