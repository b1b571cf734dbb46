// The previewer without a display.
#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include "app/preview_loops.h"
#include "app/script_player.h"
#include "core/error.h"
#include "core/timer.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "io/image_file.h"

namespace meander {
namespace {

constexpr int kHopeless = 200;
constexpr double kFadedIn = 0.2;  // seconds after which a message is as it stays

// The frame that is drawn into, which a script may resize.
class Easel {
 public:
  Easel(const Functions& gl, int width, int height, float scale) : gl_(&gl), scale_(scale) {
    resize(width, height);
  }

  void resize(int width, int height) {
    target_ = std::make_unique<Framebuffer>(*gl_, width, height);
    width_ = width;
    height_ = height;
  }
  void draw(Previewer& previewer, double seconds) const {
    target_->bind(width_, height_);
    FrameShape shape;
    shape.pixels_wide = width_;
    shape.pixels_high = height_;
    shape.scale = scale_;
    shape.seconds = seconds;
    previewer.draw(shape);
    expect_no_error(*gl_, "drawing the preview");
  }
  [[nodiscard]] Image8 read() const { return target_->read(width_, height_); }

 private:
  const Functions* gl_;
  std::unique_ptr<Framebuffer> target_;
  int width_ = 0;
  int height_ = 0;
  float scale_;
};

// A paused preview shows what it has; otherwise there is a reason for no picture.
void refuse_nothing(const Previewer& previewer, bool stopped) {
  if (stopped)
    throw Error(Fault::runtime, "interrupted before the first pass was complete; nothing was written");
  if (previewer.first_image_seconds()) return;
  std::string reason = "there is no picture";
  for (const Message& message : previewer.state().messages)
    if (message.kind == MessageKind::error) reason = message.text;
  throw Error(Fault::runtime, reason);
}

}  // namespace

OffscreenFrame run_offscreen(const SceneDocument& document, const PreviewOptions& options,
                             const OffscreenPreview& asked, const std::atomic<bool>& stop) {
  const Offscreen context(1, 1);
  const Functions& gl = context.functions();
  Previewer previewer(gl, document, options, asked.scale);
  std::string clipboard;
  previewer.set_clipboard({[&] { return clipboard; }, [&](const std::string& text) { clipboard = text; }});
  Easel easel(gl, asked.width, asked.height, asked.scale);
  bool quit = false;
  ScriptStage stage;
  stage.apply = [&](const std::string& edit) { previewer.apply(edit); };
  stage.feed = [&](const InputEvent& event) { previewer.feed(event); };
  stage.shows_edits = [&] { return previewer.first_image_seconds().has_value(); };
  stage.spp = [&] { return previewer.spp(); };
  stage.idle = [&] { return previewer.idle(); };
  stage.write_snapshot = [&](const std::string& path) { write_png(path, easel.read(), {}); };
  stage.resize = [&](int width, int height) { easel.resize(width, height); };
  stage.quit = [&quit] { quit = true; };
  std::optional<ScriptPlayer> player;
  if (asked.script) player.emplace(asked.script->lines, asked.script->file);
  const Timer timer;
  double drawn = 0;
  int hopeless =
      0;          // looks at a session that does nothing, and has no full picture either: paused, or failed
  int still = 0;  // frames drawn since the last picture arrived: the interface comes to rest
  while (!quit && !stop && !previewer.closing()) {
    const bool due = previewer.update(timer.seconds());
    const bool resting = previewer.idle() && (!player || player->done());
    const bool done = resting && (previewer.spp() > 0 || ++hopeless > kHopeless);
    if (!resting) hopeless = 0;
    if (due || player || done) {
      easel.draw(previewer, timer.seconds() - drawn);
      drawn = timer.seconds();
    }
    if (player) player->play(stage, timer.seconds());
    still = done ? still + 1 : 0;
    const bool faded_in = std::ranges::all_of(previewer.state().messages,
                                              [](const Message& message) { return message.age > kFadedIn; });
    if (still > 3 && faded_in) break;
    if (!due) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (previewer.spp() == 0 && !quit && !previewer.closing()) refuse_nothing(previewer, stop);
  return {easel.read(), previewer.warnings()};
}

}  // namespace meander
