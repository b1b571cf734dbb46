// An OpenGL 3.3 core context with no display behind it, drawn by Mesa on the CPU.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gl/functions.h"

namespace meander {

/// Can be moved, not assigned; a context belongs to the thread in which it is current. GL objects must go
/// before it does.
class Offscreen {
 public:
  /// A context whose own buffer is `width` x `height` pixels (8-bit RGBA, 24-bit depth), made current. Error
  /// (runtime) when Mesa cannot give one, or the process may not have the memory that Mesa needs.
  Offscreen(int width, int height);
  Offscreen(Offscreen&&) noexcept = default;
  Offscreen& operator=(Offscreen&&) = delete;  // the old buffer would go before the old context
  ~Offscreen() = default;

  /// Every GL call of this thread goes to this context from now on. Error (runtime) when Mesa refuses.
  void make_current();
  /// Stays where it is when the context is moved.
  [[nodiscard]] const Functions& functions() const noexcept { return *functions_; }

 private:
  struct Destroy {
    void operator()(void* context) const noexcept;
  };

  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint8_t> buffer_;  // before the context, which draws into it
  std::unique_ptr<void, Destroy> context_;
  std::unique_ptr<Functions> functions_;
};

}  // namespace meander
