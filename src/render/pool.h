// Large objects used again rather than freed: fresh memory costs a page fault every four kilobytes.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace meander {

/// Hands out objects that come back by themselves once the last owner, on any thread, lets go.
template <class T>
class Pool {
 public:
  Pool() { store_->spare.reserve(kMostSpare); }

  /// An object in the state that its last owner left it in, or a fresh one.
  [[nodiscard]] std::shared_ptr<T> take() {
    std::unique_ptr<T> item;
    {
      const std::lock_guard lock(store_->mutex);
      if (!store_->spare.empty()) {
        item = std::move(store_->spare.back());
        store_->spare.pop_back();
      }
    }
    if (!item) item = std::make_unique<T>();
    return std::shared_ptr<T>(item.release(), [store = store_](T* returned) {
      std::unique_ptr<T> owned(returned);
      const std::lock_guard lock(store->mutex);
      if (store->spare.size() < kMostSpare) store->spare.push_back(std::move(owned));
    });
  }

 private:
  static constexpr std::size_t kMostSpare = 2;
  struct Store {
    std::mutex mutex;
    std::vector<std::unique_ptr<T>> spare;
  };
  std::shared_ptr<Store> store_ = std::make_shared<Store>();
};

}  // namespace meander
