// Undo and redo of whole scene documents; one drag is one step.
#pragma once

#include <string>
#include <vector>

#include "io/scene_document.h"

namespace meander {

class EditHistory {
 public:
  explicit EditHistory(SceneDocument document) : now_(std::move(document)) {}

  [[nodiscard]] const SceneDocument& now() const noexcept { return now_; }
  [[nodiscard]] bool can_undo() const noexcept { return !past_.empty(); }
  [[nodiscard]] bool can_redo() const noexcept { return !future_.empty(); }

  /// Makes `next` the document. Within a gesture all changes together are one step.
  void change(SceneDocument next);
  void begin_gesture() noexcept { gesture_ = true; }
  void end_gesture() noexcept { gesture_ = recorded_ = false; }

  /// False when there is nothing to take back, or to do again.
  [[nodiscard]] bool undo();
  [[nodiscard]] bool redo();

 private:
  static constexpr std::size_t kMostSteps = 500;

  SceneDocument now_;
  std::vector<SceneDocument> past_;
  std::vector<SceneDocument> future_;
  bool gesture_ = false;
  bool recorded_ = false;  // this gesture has its step
};

}  // namespace meander
