#include "display/film_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "display/shaders.h"
#include "gl/state.h"

namespace meander {
FilmView::FilmView(const Functions& gl)
    : gl_(&gl),
      program_(gl, shader_source("film.vert"), shader_source("film.frag")),
      texture_(gl),
      triangle_(gl) {}

void FilmView::upload(const Image& linear, const Region& region) {
  assert(linear.channels >= 3 && region.x >= 0 && region.y >= 0);
  assert(region.x + region.width <= linear.width && region.y + region.height <= linear.height);
  std::vector<float> rgb(static_cast<std::size_t>(region.width) * region.height * 3);
  float* to = rgb.data();
  for (int y = 0; y < region.height; ++y) {
    const float* from = linear.at(region.x, region.y + y);
    for (int x = 0; x < region.width; ++x, from += linear.channels) to = std::copy_n(from, 3, to);
  }
  texture_.upload(region.width, region.height, 3, rgb.data());
}

void FilmView::draw(const ViewOptions& options) const {
  assert(texture_.width() > 0 && std::isfinite(options.exposure));
  reset_state(*gl_);
  program_.use();
  texture_.bind(0);
  program_.set("film", 0);
  // Within the exponents of a float: beyond them a zero pixel would become 0 times infinity.
  program_.set("scale", std::exp2(std::clamp(options.exposure, -126.0f, 127.0f)));
  triangle_.bind();
  gl_->draw_arrays(GL_TRIANGLES, 0, 3);
  expect_no_error(*gl_, "drawing the film");
}

}  // namespace meander
