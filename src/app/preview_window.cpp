// The previewer in a window.
#include <array>
#include <cmath>

#include "app/interrupt.h"
#include "app/preview_loops.h"
#include "app/script_player.h"
#include "core/error.h"
#include "core/timer.h"
#include "gl/framebuffer.h"
#include "gl/window.h"
#include "io/image_file.h"

namespace meander {
namespace {

constexpr double kPollSeconds = 0.004;  // how soon a new picture is noticed

Cursor cursor_of(PointerShape shape) {
  switch (shape) {
    case PointerShape::text:
      return Cursor::text;
    case PointerShape::hand:
      return Cursor::hand;
    case PointerShape::horizontal:
      return Cursor::horizontal;
    case PointerShape::vertical:
      return Cursor::vertical;
    case PointerShape::crosshair:
      return Cursor::crosshair;
    default:
      return Cursor::arrow;
  }
}

// Pixels, pixels to a point of the interface, and how that compares with the window's own points: on some
// systems a scaled monitor has more pixels than points, on others larger fonts are asked for.
FrameShape shape_of(const Window& window, double seconds) {
  const Extent pixels = window.framebuffer_size();
  const Extent points = window.size();
  FrameShape shape;
  shape.pixels_wide = pixels.width;
  shape.pixels_high = pixels.height;
  const float density =
      points.width > 0 ? static_cast<float>(pixels.width) / static_cast<float>(points.width) : 1;
  shape.scale = density * window.content_scale();
  shape.pointer_scale = density / shape.scale;
  shape.seconds = seconds;
  return shape;
}

// A copy of what the window shows, as drawn into a target of our own.
void write_window(Previewer& previewer, const Functions& gl, const FrameShape& shape,
                  const std::string& path) {
  const Framebuffer target(gl, shape.pixels_wide, shape.pixels_high);
  target.bind(shape.pixels_wide, shape.pixels_high);
  previewer.draw(shape);
  write_png(path, target.read(shape.pixels_wide, shape.pixels_high), {});
}

ScriptStage stage_of(Previewer& previewer, Window& window, bool& quit) {
  ScriptStage stage;
  stage.apply = [&](const std::string& edit) { previewer.apply(edit); };
  stage.feed = [&](const InputEvent& event) { previewer.feed(event); };
  stage.shows_edits = [&] { return previewer.first_image_seconds().has_value(); };
  stage.spp = [&] { return previewer.spp(); };
  stage.write_snapshot = [&](const std::string& path) {
    write_window(previewer, window.functions(), shape_of(window, 1.0 / 60), path);
    window.bind();
  };
  stage.resize = [&](int width, int height) { window.set_size({width, height}); };
  stage.quit = [&quit] { quit = true; };
  return stage;
}

}  // namespace

void run_in_window(const SceneDocument& document, const PreviewOptions& options, const Extent& size,
                   std::optional<PlayedScript> script) {
  Window window(size, "meander");
  Previewer previewer(window.functions(), document, options, shape_of(window, 0).scale);
  previewer.set_clipboard(
      {[&] { return window.clipboard(); }, [&](const std::string& text) { window.set_clipboard(text); }});
  bool quit = false;
  const ScriptStage stage = stage_of(previewer, window, quit);
  std::optional<ScriptPlayer> player;
  if (script) player.emplace(std::move(script->lines), script->file);
  const std::atomic<bool>& interrupted = watch_interrupts();
  const Timer timer;
  double drawn = 0;
  std::string title;
  while (!window.should_close() && !previewer.closing() && !quit && !interrupted) {
    for (const InputEvent& event : window.poll(kPollSeconds)) previewer.feed(event);
    if (window.context_lost())
      throw Error(Fault::runtime,
                  "the graphics driver has lost the window's OpenGL context; `meander capture` needs none");
    if (player) player->play(stage, timer.seconds());
    const bool due = previewer.update(timer.seconds());
    const FrameShape shape = shape_of(window, timer.seconds() - drawn);
    if (!due || shape.pixels_wide == 0 || shape.pixels_high == 0) continue;
    drawn = timer.seconds();
    window.bind();
    previewer.draw(shape);
    expect_no_error(window.functions(), "drawing the preview");
    window.swap();
    window.set_cursor(cursor_of(previewer.pointer_shape()));
    if (std::string now = previewer.title(); now != title) window.set_title(title = std::move(now));
  }
}

}  // namespace meander
