#include "app/edit_history.h"

#include <utility>

namespace meander {

void EditHistory::push(SceneDocument step) {
  past_bytes_ += step.bytes();
  past_.push_back(std::move(step));
  while (past_.size() > kMostSteps || (past_bytes_ > kMostBytes && past_.size() > 1)) {
    past_bytes_ -= past_.front().bytes();
    past_.erase(past_.begin());
  }
}

SceneDocument EditHistory::pop() {
  SceneDocument step = std::move(past_.back());
  past_.pop_back();
  past_bytes_ -= step.bytes();
  return step;
}

void EditHistory::change(SceneDocument next) {
  if (!gesture_ || !recorded_) {
    push(now_);
    recorded_ = gesture_;
    resumable_ = false;
  }
  future_.clear();
  now_ = std::move(next);
}

void EditHistory::end_gesture() {
  if (recorded_ && now_ == past_.back()) {
    (void)pop();
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
  now_ = pop();
  return true;
}

bool EditHistory::redo() {
  end_gesture();
  resumable_ = false;
  if (future_.empty()) return false;
  push(std::move(now_));
  now_ = std::move(future_.back());
  future_.pop_back();
  return true;
}

}  // namespace meander
