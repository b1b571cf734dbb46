// Owner of the name (the integer) of one GL object: what textures, programs and framebuffers are made of.
#pragma once

#include <utility>

#include "gl/functions.h"

namespace meander {

/// Move-only. The context that made the object must be current when its owner goes away, and `gl` must
/// outlive it.
template <void (*Destroy)(const Functions&, GLuint)>
class Name {
 public:
  Name() = default;
  Name(const Functions& gl, GLuint id) noexcept : gl_(&gl), id_(id) {}
  Name(Name&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  Name& operator=(Name&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~Name() {
    if (id_ != 0) Destroy(*gl_, id_);
  }

  [[nodiscard]] const Functions& gl() const noexcept { return *gl_; }
  [[nodiscard]] GLuint id() const noexcept { return id_; }

 private:
  const Functions* gl_ = nullptr;
  GLuint id_ = 0;
};

}  // namespace meander
