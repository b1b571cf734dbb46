// A vertex array without attributes: core GL draws nothing without one bound.
#pragma once

#include "gl/name.h"

namespace meander {

class VertexArray {
 public:
  explicit VertexArray(const Functions& gl) : name_(gl, make(gl)) {}
  void bind() const { name_.gl().bind_vertex_array(name_.id()); }

 private:
  static void destroy(const Functions& gl, GLuint id) { gl.delete_vertex_arrays(1, &id); }
  static GLuint make(const Functions& gl) {
    GLuint id = 0;
    gl.gen_vertex_arrays(1, &id);
    return id;
  }

  Name<destroy> name_;
};

}  // namespace meander
