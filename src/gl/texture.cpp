#include "gl/texture.h"

#include <cassert>
#include <cstddef>
#include <cstring>
#include <string>

#include "core/error.h"

namespace meander {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height);
}

// Copies into new memory of the buffer, which stays bound. A driver may lose what was mapped (a change of the
// screen mode, on some), and says so; then it is written the plain way.
void fill(const Functions& gl, const Buffer& buffer, std::size_t bytes, const void* data) {
  buffer.renew(bytes);
  void* memory = gl.map_buffer_range(GL_PIXEL_UNPACK_BUFFER, 0, static_cast<GLsizeiptr>(bytes),
                                     GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
  if (memory != nullptr) {
    std::memcpy(memory, data, bytes);
    if (gl.unmap_buffer(GL_PIXEL_UNPACK_BUFFER) == GL_TRUE) return;
  }
  buffer.write(0, bytes, data);
}

}  // namespace

GLuint new_texture(const Functions& gl, GLint filter) {
  GLuint id = 0;
  gl.gen_textures(1, &id);
  gl.active_texture(GL_TEXTURE0);
  gl.bind_texture(GL_TEXTURE_2D, id);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  gl.tex_parameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);  // complete without mipmaps
  expect_no_error(gl, "making a texture");
  return id;
}

void expect_texture_size(const Functions& gl, int width, int height) {
  const int limit = integer(gl, GL_MAX_TEXTURE_SIZE);
  if (width <= limit && height <= limit) return;
  throw Error(Fault::runtime, "an image of " + size_text(width, height) +
                                  " pixels is too large for this OpenGL, whose limit is " +
                                  size_text(limit, limit));
}

Texture::Texture(const Functions& gl)
    : name_(gl, new_texture(gl, GL_NEAREST)),
      staging_{Buffer(gl, GL_PIXEL_UNPACK_BUFFER), Buffer(gl, GL_PIXEL_UNPACK_BUFFER)} {}

void Texture::allocate(int width, int height, int channels) {
  if (width == width_ && height == height_ && channels == channels_) return;
  const Functions& gl = name_.gl();
  expect_texture_size(gl, width, height);
  gl.tex_image_2d(GL_TEXTURE_2D, 0, channels == 3 ? GL_RGB32F : GL_RGBA32F, width, height, 0,
                  channels == 3 ? GL_RGB : GL_RGBA, GL_FLOAT, nullptr);
  expect_no_error(gl, "making room for an image of " + size_text(width, height) + " pixels");
  width_ = width;
  height_ = height;
  channels_ = channels;
}

void Texture::upload(int width, int height, int channels, const float* pixels) {
  assert(width > 0 && height > 0 && (channels == 3 || channels == 4));
  const Functions& gl = name_.gl();
  bind(0);
  allocate(width, height, channels);
  const Buffer& buffer = staging_[static_cast<std::size_t>(next_)];
  next_ = 1 - next_;
  fill(gl, buffer, static_cast<std::size_t>(width) * height * channels * sizeof(float), pixels);
  gl.pixel_storei(GL_UNPACK_ALIGNMENT, 4);
  gl.pixel_storei(GL_UNPACK_ROW_LENGTH, 0);
  gl.tex_sub_image_2d(GL_TEXTURE_2D, 0, 0, 0, width, height, channels == 3 ? GL_RGB : GL_RGBA, GL_FLOAT,
                      nullptr);
  buffer.unbind();
  expect_no_error(gl, "uploading an image of " + size_text(width, height) + " pixels");
}

void Texture::bind(int unit) const {
  name_.gl().active_texture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  name_.gl().bind_texture(GL_TEXTURE_2D, name_.id());
}

}  // namespace meander
