// A window on the user's display with an OpenGL 3.3 core context in it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/functions.h"
#include "gl/input.h"

namespace meander {

/// The shape of the pointer over the window.
enum class Cursor { arrow, text, crosshair, hand, horizontal, vertical };

struct Extent {
  int width = 0;
  int height = 0;

  bool operator==(const Extent&) const = default;
};

/// One at a time, made and used by the main thread; GL objects must go before it does. A display that goes
/// away while the window is open ends the process with one line and exit code 3: Xlib cannot go on.
class Window {
 public:
  /// No smaller than this, times the content scale, can a user make it.
  static constexpr Extent kSmallest{640, 400};

  /// Opens a window of `size` points times the monitor's content scale, its context current. Error (runtime)
  /// naming `meander capture` when there is no display, or none with an OpenGL 3.3 core context.
  Window(const Extent& size, const std::string& title);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window();

  [[nodiscard]] const Functions& functions() const noexcept;
  /// Every GL call of this thread goes to this window from now on.
  void make_current() const;
  /// Drawing goes to the window itself from now on, over all its pixels.
  void bind() const;
  /// Shows what was drawn.
  void swap();

  /// What has happened since the last call, in order. Waits for something to happen, `wait_seconds` at most
  /// (0 for not at all).
  [[nodiscard]] std::vector<InputEvent> poll(double wait_seconds);
  /// Ends a wait of poll() early; any thread may call it as long as the window lives.
  void wake() const;

  /// The user asked to close the window, or the program did.
  [[nodiscard]] bool should_close() const;
  void set_should_close(bool close);

  [[nodiscard]] Extent size() const;              // points, the unit of the pointer
  [[nodiscard]] Extent framebuffer_size() const;  // pixels; 0 x 0 when minimised
  void set_size(const Extent& size);
  /// How much larger than on a plain monitor text and controls should be drawn.
  [[nodiscard]] float content_scale() const;
  void set_title(const std::string& title);
  void set_cursor(Cursor cursor);
  [[nodiscard]] std::string clipboard() const;
  void set_clipboard(const std::string& text);
  /// The driver has lost the context (a reset): nothing that is drawn will be seen, no GL object is left.
  [[nodiscard]] bool context_lost() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace meander
