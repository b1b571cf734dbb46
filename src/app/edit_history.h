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

  /// Makes `next` the document. The oldest steps are forgotten: 500 are kept, or as many as 128 MiB hold.
  /// Within a gesture all changes together are one step.
  void change(SceneDocument next);
  void begin_gesture() noexcept { gesture_ = true; }
  /// A gesture that comes back to where it began leaves no step.
  void end_gesture();
  /// Makes the gesture that has begun one with the last, as the second click of a double one is. Nothing
  /// where the last changed nothing, or was followed by something else.
  void resume_gesture() noexcept { recorded_ = recorded_ || (gesture_ && resumable_); }

  /// False when there is nothing to take back, or to do again.
  [[nodiscard]] bool undo();
  [[nodiscard]] bool redo();

 private:
  static constexpr std::size_t kMostSteps = 500;
  static constexpr std::size_t kMostBytes = std::size_t{128} << 20;  // of what can be taken back

  void push(SceneDocument step);
  [[nodiscard]] SceneDocument pop();

  SceneDocument now_;
  std::vector<SceneDocument> past_;
  std::size_t past_bytes_ = 0;
  std::vector<SceneDocument> future_;
  bool gesture_ = false;
  bool recorded_ = false;   // this gesture has its step
  bool resumable_ = false;  // the last step is that of the gesture that ended last
};

}  // namespace meander
