// A mesh's balls, made when they are first needed.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

#include "trace/empty_balls.h"

namespace meander {

/// Safe to use from several threads at a time. `body` must outlive it.
class LazyBalls {
 public:
  explicit LazyBalls(const MeshBody& body) noexcept : body_(body) {}

  [[nodiscard]] bool ready() const noexcept { return made_.load(std::memory_order_acquire) != nullptr; }

  /// Makes them, on at most `threads` threads; false when `stop` came before they were made. Must not be
  /// called from within a parallel loop. Errors: std::bad_alloc.
  [[nodiscard]] bool make(int threads, const std::atomic<bool>& stop) const;

  /// They must be ready.
  [[nodiscard]] const EmptyBalls& get() const noexcept { return *made_.load(std::memory_order_acquire); }

 private:
  const MeshBody& body_;
  mutable std::mutex making_;
  mutable std::unique_ptr<const EmptyBalls> balls_;
  mutable std::atomic<const EmptyBalls*> made_{nullptr};
};

}  // namespace meander
