#include "gl/program.h"

#include <cstddef>

#include "core/error.h"

namespace meander {
namespace {

void destroy_shader(const Functions& gl, GLuint id) { gl.delete_shader(id); }

using Shader = Name<destroy_shader>;

// A driver's log in one line: line ends become "; ", the padding goes.
std::string one_line(const std::string& log) {
  std::string line;
  bool broken = false;
  for (const char c : log) {
    if (c == '\0' || c == '\n' || c == '\r') {
      broken = true;
      continue;
    }
    if (broken && !line.empty()) line += "; ";
    broken = false;
    line += c;
  }
  return line.empty() ? "the driver gave no reason" : line;
}

std::string shader_log(const Functions& gl, GLuint id) {
  GLint length = 0;
  gl.get_shaderiv(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  if (length > 0) gl.get_shader_info_log(id, length, nullptr, log.data());
  return one_line(log);
}

std::string program_log(const Functions& gl, GLuint id) {
  GLint length = 0;
  gl.get_programiv(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  if (length > 0) gl.get_program_info_log(id, length, nullptr, log.data());
  return one_line(log);
}

Shader compile(const Functions& gl, GLenum stage, const ShaderSource& source) {
  Shader shader(gl, gl.create_shader(stage));
  const char* text = source.text.c_str();
  gl.shader_source(shader.id(), 1, &text, nullptr);
  gl.compile_shader(shader.id());
  GLint compiled = GL_FALSE;
  gl.get_shaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    throw Error(Fault::runtime, source.name + " does not compile: " + shader_log(gl, shader.id()));
  }
  return shader;
}

}  // namespace

Program::Program(const Functions& gl, const ShaderSource& vertex, const ShaderSource& fragment)
    : name_(gl, gl.create_program()) {
  const Shader first = compile(gl, GL_VERTEX_SHADER, vertex);
  const Shader second = compile(gl, GL_FRAGMENT_SHADER, fragment);
  gl.attach_shader(name_.id(), first.id());
  gl.attach_shader(name_.id(), second.id());
  gl.link_program(name_.id());
  GLint linked = GL_FALSE;
  gl.get_programiv(name_.id(), GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) {
    throw Error(Fault::runtime,
                vertex.name + " and " + fragment.name + " do not link: " + program_log(gl, name_.id()));
  }
  expect_no_error(gl, "making a program of " + vertex.name + " and " + fragment.name);
}

void Program::use() const { name_.gl().use_program(name_.id()); }

void Program::set(const char* uniform, float value) const { name_.gl().uniform_1f(location(uniform), value); }

void Program::set(const char* uniform, int value) const { name_.gl().uniform_1i(location(uniform), value); }

void Program::set(const char* uniform, const std::array<float, 2>& value) const {
  name_.gl().uniform_2f(location(uniform), value[0], value[1]);
}

void Program::set(const char* uniform, const std::array<float, 4>& value) const {
  name_.gl().uniform_4f(location(uniform), value[0], value[1], value[2], value[3]);
}

GLint Program::location(const char* uniform) const {
  return name_.gl().get_uniform_location(name_.id(), uniform);
}

}  // namespace meander
