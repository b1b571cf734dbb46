// A linked pair of a vertex and a fragment shader.
#pragma once

#include <array>
#include <string>

#include "gl/name.h"

namespace meander {

/// GLSL text and the file name to blame it by.
struct ShaderSource {
  std::string name;
  std::string text;
};

class Program {
 public:
  /// Compiles and links. Error (runtime) of one line with the file name and the driver's log.
  Program(const Functions& gl, const ShaderSource& vertex, const ShaderSource& fragment);

  void use() const;
  /// Sets a uniform of the program in use; one that its shaders do not look at is left out.
  void set(const char* uniform, float value) const;
  void set(const char* uniform, int value) const;
  void set(const char* uniform, const std::array<float, 2>& value) const;
  void set(const char* uniform, const std::array<float, 4>& value) const;

 private:
  static void destroy(const Functions& gl, GLuint id) { gl.delete_program(id); }
  [[nodiscard]] GLint location(const char* uniform) const;

  Name<destroy> name_;
};

}  // namespace meander
