// Plays a script, a few steps a frame.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/script.h"

namespace meander {

/// What a script acts on, in the window and off-screen alike.
struct ScriptStage {
  std::function<void(const std::string&)> apply;  // an edit; throws Error
  std::function<void(const InputEvent&)> feed;    // an event of keyboard or mouse
  std::function<bool()> shows_edits;              // whether the picture is of all edits so far
  std::function<std::uint64_t()> spp;  // samples a pixel of the picture that all edits so far ask for
  std::function<bool()> idle;  // whether nothing is being rendered; empty where a user may change that
  std::function<void(const std::string&)> write_snapshot;  // the frame last drawn, to a PNG
  std::function<void(int, int)> resize;
  std::function<void()> quit;
};

class ScriptPlayer {
 public:
  /// `file` is what messages call the script.
  ScriptPlayer(std::vector<ScriptLine> script, std::string file)
      : script_(std::move(script)), file_(std::move(file)) {}

  /// Plays what this frame may take: any number of edits, but one event, so that the interface sees each; a
  /// snapshot waits for kSettle frames without another step, so that it shows what went before, and a wait
  /// for a picture as long after an event, which the interface may turn into an edit. `now` in seconds. Error
  /// (input) with the script's line when an edit is refused, or a wait would never end.
  void play(const ScriptStage& stage, double now);
  [[nodiscard]] bool done() const noexcept { return next_ == script_.size(); }

 private:
  static constexpr int kSettle = 3;
  static constexpr int kHopeless = 200;  // frames of waiting while nothing is rendered
  enum class Outcome { taken, taken_frame, waiting };

  [[nodiscard]] Outcome wait_for(bool reached, const ScriptStage& stage, const char* what) const;
  [[nodiscard]] Outcome play_step(const ScriptStep& step, const ScriptStage& stage, double now);

  std::vector<ScriptLine> script_;
  std::string file_;
  std::size_t next_ = 0;
  int frames_ = 0;  // since the last step
  int frames_since_event_ = kSettle;
  std::optional<double> wait_until_;
  std::array<double, 2> pointer_{};  // where the last move went: buttons and drops are there
};

}  // namespace meander
