#include "gl/functions.h"

#include <array>
#include <cstdio>

#include "core/error.h"

namespace meander {
namespace {

template <typename Pointer>
void load(Loader loader, Pointer& pointer, const char* name) {
  pointer = reinterpret_cast<Pointer>(loader(name));
  if (pointer == nullptr) throw Error(Fault::runtime, std::string("this OpenGL has no ") + name);
}

void load_objects(Loader loader, Functions& gl) {
  load(loader, gl.attach_shader, "glAttachShader");
  load(loader, gl.bind_buffer, "glBindBuffer");
  load(loader, gl.bind_framebuffer, "glBindFramebuffer");
  load(loader, gl.bind_renderbuffer, "glBindRenderbuffer");
  load(loader, gl.bind_texture, "glBindTexture");
  load(loader, gl.bind_vertex_array, "glBindVertexArray");
  load(loader, gl.buffer_data, "glBufferData");
  load(loader, gl.buffer_sub_data, "glBufferSubData");
  load(loader, gl.check_framebuffer_status, "glCheckFramebufferStatus");
  load(loader, gl.compile_shader, "glCompileShader");
  load(loader, gl.create_program, "glCreateProgram");
  load(loader, gl.create_shader, "glCreateShader");
  load(loader, gl.delete_buffers, "glDeleteBuffers");
  load(loader, gl.delete_framebuffers, "glDeleteFramebuffers");
  load(loader, gl.delete_program, "glDeleteProgram");
  load(loader, gl.delete_renderbuffers, "glDeleteRenderbuffers");
  load(loader, gl.delete_shader, "glDeleteShader");
  load(loader, gl.delete_textures, "glDeleteTextures");
  load(loader, gl.delete_vertex_arrays, "glDeleteVertexArrays");
  load(loader, gl.enable_vertex_attrib_array, "glEnableVertexAttribArray");
  load(loader, gl.framebuffer_renderbuffer, "glFramebufferRenderbuffer");
  load(loader, gl.gen_buffers, "glGenBuffers");
  load(loader, gl.gen_framebuffers, "glGenFramebuffers");
  load(loader, gl.gen_renderbuffers, "glGenRenderbuffers");
  load(loader, gl.gen_textures, "glGenTextures");
  load(loader, gl.gen_vertex_arrays, "glGenVertexArrays");
  load(loader, gl.get_program_info_log, "glGetProgramInfoLog");
  load(loader, gl.get_programiv, "glGetProgramiv");
  load(loader, gl.get_shader_info_log, "glGetShaderInfoLog");
  load(loader, gl.get_shaderiv, "glGetShaderiv");
  load(loader, gl.link_program, "glLinkProgram");
  load(loader, gl.map_buffer_range, "glMapBufferRange");
  load(loader, gl.renderbuffer_storage, "glRenderbufferStorage");
  load(loader, gl.shader_source, "glShaderSource");
  load(loader, gl.unmap_buffer, "glUnmapBuffer");
  load(loader, gl.vertex_attrib_pointer, "glVertexAttribPointer");
}

void load_drawing(Loader loader, Functions& gl) {
  load(loader, gl.active_texture, "glActiveTexture");
  load(loader, gl.blend_equation, "glBlendEquation");
  load(loader, gl.blend_func_separate, "glBlendFuncSeparate");
  load(loader, gl.blit_framebuffer, "glBlitFramebuffer");
  load(loader, gl.clear, "glClear");
  load(loader, gl.clear_color, "glClearColor");
  load(loader, gl.disable, "glDisable");
  load(loader, gl.draw_arrays, "glDrawArrays");
  load(loader, gl.draw_elements_base_vertex, "glDrawElementsBaseVertex");
  load(loader, gl.enable, "glEnable");
  load(loader, gl.finish, "glFinish");
  load(loader, gl.get_error, "glGetError");
  load(loader, gl.get_integerv, "glGetIntegerv");
  load(loader, gl.get_string, "glGetString");
  load(loader, gl.get_uniform_location, "glGetUniformLocation");
  load(loader, gl.pixel_storei, "glPixelStorei");
  load(loader, gl.read_pixels, "glReadPixels");
  load(loader, gl.scissor, "glScissor");
  load(loader, gl.tex_image_2d, "glTexImage2D");
  load(loader, gl.tex_parameteri, "glTexParameteri");
  load(loader, gl.tex_parameteriv, "glTexParameteriv");
  load(loader, gl.tex_sub_image_2d, "glTexSubImage2D");
  load(loader, gl.uniform_1f, "glUniform1f");
  load(loader, gl.uniform_1i, "glUniform1i");
  load(loader, gl.uniform_2f, "glUniform2f");
  load(loader, gl.uniform_4f, "glUniform4f");
  load(loader, gl.use_program, "glUseProgram");
  load(loader, gl.viewport, "glViewport");
}

std::string error_name(GLenum code) {
  switch (code) {
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "invalid framebuffer operation";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    default:
      break;
  }
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "error 0x%04x", code);
  return text.data();
}

}  // namespace

Functions load_functions(Loader loader) {
  Functions gl;
  load_objects(loader, gl);
  load_drawing(loader, gl);
  return gl;
}

void expect_no_error(const Functions& gl, const std::string& doing) {
  const GLenum first = gl.get_error();
  if (first == GL_NO_ERROR) return;
  // Bounded: without a current context some drivers answer with an error for ever.
  for (int i = 0; i < 16 && gl.get_error() != GL_NO_ERROR; ++i) {
  }
  throw Error(Fault::runtime, "OpenGL: " + error_name(first) + " while " + doing);
}

int integer(const Functions& gl, GLenum name) {
  std::array<GLint, 4> values{};  // some names answer with more than one number
  gl.get_integerv(name, values.data());
  return values[0];
}

}  // namespace meander
