#include "gl/picture.h"

#include <array>
#include <cassert>
#include <string>

#include "core/error.h"
#include "gl/texture.h"

namespace meander {
namespace {

void sample_as(const Functions& gl, const std::array<GLint, 4>& channels) {
  gl.tex_parameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, channels.data());
}

}  // namespace

Picture::Picture(const Functions& gl) : name_(gl, new_texture(gl, GL_LINEAR)) {}

void Picture::upload_coverage(int width, int height, const std::uint8_t* coverage) {
  assert(width > 0 && height > 0 && coverage != nullptr);
  const Functions& gl = name_.gl();
  expect_texture_size(gl, width, height);
  gl.active_texture(GL_TEXTURE0);
  gl.bind_texture(GL_TEXTURE_2D, name_.id());
  gl.pixel_storei(GL_UNPACK_ALIGNMENT, 1);
  gl.pixel_storei(GL_UNPACK_ROW_LENGTH, 0);
  gl.tex_image_2d(GL_TEXTURE_2D, 0, GL_R8, width, height, 0, GL_RED, GL_UNSIGNED_BYTE, coverage);
  sample_as(gl, {GL_ONE, GL_ONE, GL_ONE, GL_RED});
  expect_no_error(gl, "uploading a picture of " + std::to_string(width) + " x " + std::to_string(height));
  width_ = width;
  height_ = height;
}

void Picture::upload(const Image8& image) {
  assert(image.width > 0 && image.height > 0);
  const Functions& gl = name_.gl();
  expect_texture_size(gl, image.width, image.height);
  gl.active_texture(GL_TEXTURE0);
  gl.bind_texture(GL_TEXTURE_2D, name_.id());
  gl.pixel_storei(GL_UNPACK_ALIGNMENT, 1);
  gl.pixel_storei(GL_UNPACK_ROW_LENGTH, 0);
  gl.tex_image_2d(GL_TEXTURE_2D, 0, GL_RGB8, image.width, image.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                  image.rgb.data());
  sample_as(gl, {GL_RED, GL_GREEN, GL_BLUE, GL_ONE});
  expect_no_error(
      gl, "uploading a picture of " + std::to_string(image.width) + " x " + std::to_string(image.height));
  width_ = image.width;
  height_ = image.height;
}

}  // namespace meander
