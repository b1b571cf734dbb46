// The interface of one window: Dear ImGui's context, its font, and the way of events into it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "gl/input.h"

struct ImDrawData;

namespace meander {

/// The window of a frame. The interface counts in points of its own, of `scale` framebuffer pixels each;
/// `pointer_scale` is how many of these points one unit of the events' pointer is.
struct FrameShape {
  int pixels_wide = 0;
  int pixels_high = 0;
  float scale = 1;
  float pointer_scale = 1;
  double seconds = 1.0 / 60;  // since the frame before

  [[nodiscard]] float width() const noexcept { return static_cast<float>(pixels_wide) / scale; }
  [[nodiscard]] float height() const noexcept { return static_cast<float>(pixels_high) / scale; }
};

/// One byte of coverage a pixel.
struct FontBitmap {
  int width = 0;
  int height = 0;
  const std::uint8_t* coverage = nullptr;
};

enum class PointerShape : std::uint8_t { arrow, text, hand, horizontal, vertical, crosshair };

struct ClipboardAccess {
  std::function<std::string()> get;
  std::function<void(const std::string&)> set;
};

/// Panels are drawn by free functions (ui/draw.h) between begin_frame and end_frame. Several interfaces may
/// live side by side in one thread.
class Interface {
 public:
  /// Error (runtime) when there is no font.
  explicit Interface(float scale);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// To be given to the renderer before the first frame and again whenever `scale` of a frame differs from
  /// the one before: font_changed() says so after begin_frame. Valid until then.
  [[nodiscard]] FontBitmap font() const;
  [[nodiscard]] bool font_changed() const;
  void set_font_texture(void* texture);
  void set_clipboard(ClipboardAccess clipboard);

  /// Takes an event. A button or key that goes down and up between two frames is seen in two frames:
  /// pending() says that another frame is due.
  void feed(const InputEvent& event);
  [[nodiscard]] bool pending() const;

  void begin_frame(const FrameShape& shape);
  /// What is to be drawn, valid until the next frame.
  [[nodiscard]] const ImDrawData* end_frame();

  /// Whether a pointer at x, y points is the interface's business, not the picture's, by what the last frame
  /// showed there: the pointer may have come from elsewhere since. Not to be asked within a frame.
  [[nodiscard]] bool wants_mouse(float x, float y) const;
  /// Likewise the keyboard, as the last frame left it.
  [[nodiscard]] bool wants_keyboard() const;
  [[nodiscard]] PointerShape pointer_shape() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace meander
