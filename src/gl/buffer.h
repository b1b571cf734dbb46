// Memory of the context: vertices, indices, pixels on their way into a texture.
#pragma once

#include <cstddef>

#include "gl/name.h"

namespace meander {

class Buffer {
 public:
  /// `target` is where it is bound: GL_ARRAY_BUFFER, GL_ELEMENT_ARRAY_BUFFER or GL_PIXEL_UNPACK_BUFFER.
  Buffer(const Functions& gl, GLenum target) : name_(gl, make(gl)), target_(target) {}

  void bind() const { name_.gl().bind_buffer(target_, name_.id()); }
  void unbind() const { name_.gl().bind_buffer(target_, 0); }
  /// Binds it with new memory of `bytes`, so that nobody waits for a draw that still reads the old.
  void renew(std::size_t bytes) const {
    bind();
    name_.gl().buffer_data(target_, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_DRAW);
  }
  /// Copies into it, bound, `bytes` from `data`, at `offset`.
  void write(std::size_t offset, std::size_t bytes, const void* data) const {
    name_.gl().buffer_sub_data(target_, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
  }

 private:
  static void destroy(const Functions& gl, GLuint id) { gl.delete_buffers(1, &id); }
  static GLuint make(const Functions& gl) {
    GLuint id = 0;
    gl.gen_buffers(1, &id);
    return id;
  }

  Name<destroy> name_;
  GLenum target_;
};

}  // namespace meander
