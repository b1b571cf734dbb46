#include "app/script_player.h"

#include <algorithm>

#include "core/error.h"

namespace meander {

auto ScriptPlayer::wait_for(bool reached, const ScriptStage& stage, const char* what) const -> Outcome {
  if (reached && frames_since_event_ >= kSettle) return Outcome::taken;
  if (stage.idle && stage.idle() && frames_ > kHopeless) throw Error(Fault::input, what);
  return Outcome::waiting;
}

auto ScriptPlayer::play_step(const ScriptStep& step, const ScriptStage& stage, double now) -> Outcome {
  if (const auto* set = std::get_if<SetStep>(&step)) {
    stage.apply(set->edit);
    return Outcome::taken;
  }
  if (const auto* event = std::get_if<EventStep>(&step)) {
    InputEvent told = event->event;
    if (told.kind == InputKind::move) pointer_ = {told.x, told.y};
    if (told.kind == InputKind::button || told.kind == InputKind::drop) {
      told.x = pointer_[0];
      told.y = pointer_[1];
    }
    stage.feed(told);
    frames_since_event_ = 0;
    return Outcome::taken_frame;
  }
  if (const auto* spp = std::get_if<WaitSppStep>(&step))
    return wait_for(stage.spp() >= spp->spp, stage, "rendering ends before that many samples: raise --spp");
  if (std::holds_alternative<WaitImageStep>(step))
    return wait_for(stage.shows_edits(), stage, "there will be no picture to wait for");
  if (const auto* wait = std::get_if<WaitStep>(&step)) {
    if (!wait_until_) wait_until_ = now + wait->seconds;
    if (now < *wait_until_) return Outcome::waiting;
    wait_until_.reset();
    return Outcome::taken;
  }
  if (const auto* snapshot = std::get_if<SnapshotStep>(&step)) {
    if (frames_ < kSettle) return Outcome::waiting;
    stage.write_snapshot(snapshot->path);
    return Outcome::taken;
  }
  if (const auto* size = std::get_if<SizeStep>(&step)) {
    stage.resize(size->width, size->height);
    return Outcome::taken_frame;
  }
  stage.quit();
  return Outcome::taken_frame;
}

void ScriptPlayer::play(const ScriptStage& stage, double now) {
  ++frames_;
  frames_since_event_ = std::min(frames_since_event_ + 1, kSettle);
  while (!done()) {
    const ScriptLine& line = script_[next_];
    Outcome outcome = Outcome::waiting;
    try {
      outcome = play_step(line.step, stage, now);
    } catch (const Error& error) {
      if (error.exit_code() != static_cast<int>(Fault::input)) throw;
      throw Error(Place{file_, line.line, 0}, error.what());
    }
    if (outcome == Outcome::waiting) return;
    ++next_;
    frames_ = 0;
    if (outcome == Outcome::taken_frame) return;
  }
}

}  // namespace meander
