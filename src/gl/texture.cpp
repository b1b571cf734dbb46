#include "gl/texture.h"

#include <cassert>

#include "core/error.h"

namespace meander {
namespace {

GLuint new_texture(const Functions& gl) {
  GLuint id = 0;
  gl.gen_textures(1, &id);
  return id;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

}  // namespace

Texture::Texture(const Functions& gl) : name_(gl, new_texture(gl)) {
  bind(0);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);  // complete without mipmaps
  expect_no_error(gl, "making a texture");
}

void Texture::upload(int width, int height, int channels, const float* pixels) {
  assert(width > 0 && height > 0 && (channels == 3 || channels == 4));
  const Functions& gl = name_.gl();
  const int limit = integer(gl, GL_MAX_TEXTURE_SIZE);
  if (width > limit || height > limit) {
    throw Error(Fault::runtime, "an image of " + size_text(width, height) +
                                    " pixels is too large for this OpenGL, whose limit is " +
                                    size_text(limit, limit));
  }
  bind(0);
  gl.pixel_storei(GL_UNPACK_ALIGNMENT, 4);
  gl.pixel_storei(GL_UNPACK_ROW_LENGTH, 0);
  gl.tex_image_2d(GL_TEXTURE_2D, 0, channels == 3 ? GL_RGB32F : GL_RGBA32F, width, height, 0,
                  channels == 3 ? GL_RGB : GL_RGBA, GL_FLOAT, pixels);
  expect_no_error(gl, "uploading an image of " + size_text(width, height) + " pixels");
  width_ = width;
  height_ = height;
}

void Texture::bind(int unit) const {
  name_.gl().active_texture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  name_.gl().bind_texture(GL_TEXTURE_2D, name_.id());
}

}  // namespace meander
