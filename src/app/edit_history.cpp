#include "app/edit_history.h"

#include <utility>

namespace meander {

void EditHistory::change(SceneDocument next) {
  if (!gesture_ || !recorded_) {
    if (past_.size() == kMostSteps) past_.erase(past_.begin());
    past_.push_back(now_);
    recorded_ = gesture_;
    resumable_ = false;
  }
  future_.clear();
  now_ = std::move(next);
}

void EditHistory::end_gesture() {
  if (recorded_ && now_ == past_.back()) {
    past_.pop_back();
    recorded_ = false;
  }
  if (gesture_) resumable_ = recorded_;
  gesture_ = recorded_ = false;
}

bool EditHistory::undo() {
  end_gesture();
  resumable_ = false;
  if (past_.empty()) return false;
  future_.push_back(std::move(now_));
  now_ = std::move(past_.back());
  past_.pop_back();
  return true;
}

bool EditHistory::redo() {
  end_gesture();
  resumable_ = false;
  if (future_.empty()) return false;
  past_.push_back(std::move(now_));
  now_ = std::move(future_.back());
  future_.pop_back();
  return true;
}

}  // namespace meander
