#include "app/edit_history.h"

#include <utility>

namespace meander {

void EditHistory::change(SceneDocument next) {
  if (!gesture_ || !recorded_) {
    if (past_.size() == kMostSteps) past_.erase(past_.begin());
    past_.push_back(now_);
    recorded_ = gesture_;
  }
  future_.clear();
  now_ = std::move(next);
}

bool EditHistory::undo() {
  if (past_.empty()) return false;
  end_gesture();
  future_.push_back(std::move(now_));
  now_ = std::move(past_.back());
  past_.pop_back();
  return true;
}

bool EditHistory::redo() {
  if (future_.empty()) return false;
  end_gesture();
  past_.push_back(std::move(now_));
  now_ = std::move(future_.back());
  future_.pop_back();
  return true;
}

}  // namespace meander
