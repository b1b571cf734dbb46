// Values that are kept for the next time, and of which those not used for long are forgotten.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace meander {

/// Values by key, the ones used last at the end.
template <class Key, class Value>
class RecentValues {
 public:
  /// Null when there is none; the value counts as used.
  [[nodiscard]] Value* find(const Key& key) {
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
      if (!(entry->first == key)) continue;
      std::pair<Key, Value> used = std::move(*entry);
      entries_.erase(entry);
      entries_.push_back(std::move(used));
      return &entries_.back().second;
    }
    return nullptr;
  }
  Value& add(const Key& key, Value value) {
    entries_.emplace_back(key, std::move(value));
    return entries_.back().second;
  }
  [[nodiscard]] const std::vector<std::pair<Key, Value>>& entries() const noexcept { return entries_; }
  /// Forgets all but the `count` that were used last.
  void trim(std::size_t count) {
    if (entries_.size() > count) entries_.erase(entries_.begin(), entries_.end() - count);
  }

 private:
  std::vector<std::pair<Key, Value>> entries_;
};

}  // namespace meander
