#include "display/film_view.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "display/shaders.h"
#include "gl/state.h"
#include "math/color_scale.h"

namespace meander {
namespace {

constexpr int kNearest = 0;  // as film.frag numbers them
constexpr int kBilinear = 1;
constexpr int kArea = 2;
constexpr int kColors = 256;

bool whole(float value) { return std::abs(value - std::round(value)) < 1e-3f; }

int filter_of(const FilmTextures& film, const FilmPlacement& placement, bool smooth) {
  const float x = placement.width / static_cast<float>(film.width());
  const float y = placement.height / static_cast<float>(film.height());
  if (x < 0.999f || y < 0.999f) return kArea;
  const bool aligned = whole(x) && whole(y) && whole(placement.x) && whole(placement.y);
  const bool enlarged = x > 1.5f || y > 1.5f;
  return aligned && !(smooth && enlarged) ? kNearest : kBilinear;
}

std::array<float, 4> shader_placement(const FilmTextures& film, const Stage& stage) {
  const FilmPlacement& at = stage.film;
  return {at.x, static_cast<float>(stage.height) - at.y - at.height,
          static_cast<float>(film.width()) / at.width, static_cast<float>(film.height()) / at.height};
}

Region intersection(const Region& a, const Region& b) {
  const int x = std::max(a.x, b.x);
  const int y = std::max(a.y, b.y);
  return {x, y, std::min(a.x + a.width, b.x + b.width) - x, std::min(a.y + a.height, b.y + b.height) - y};
}

// The pixels whose centres are in the film, in the framebuffer and in the clip rectangle.
Region visible(const Stage& stage) {
  const auto first_center = [](float edge, int limit) {
    return static_cast<int>(std::ceil(std::clamp(edge, -1.0f, static_cast<float>(limit) + 1) - 0.5f));
  };
  const FilmPlacement& at = stage.film;
  const int x = first_center(at.x, stage.width);
  const int y = first_center(at.y, stage.height);
  const Region film{x, y, first_center(at.x + at.width, stage.width) - x,
                    first_center(at.y + at.height, stage.height) - y};
  const Region seen = intersection(film, {0, 0, stage.width, stage.height});
  return stage.clip ? intersection(seen, *stage.clip) : seen;
}

Stage clipped(Stage stage, const Region& region) {
  stage.clip = stage.clip ? intersection(*stage.clip, region) : region;
  return stage;
}

Image8 scale_colors() {
  Image8 colors(kColors, 1);
  for (int i = 0; i < kColors; ++i) {
    std::ranges::copy(color_scale(static_cast<double>(i) / (kColors - 1)), colors.at(i, 0));
  }
  return colors;
}

ViewRange range_of(const ViewOptions& options) {
  if (options.low > 0 && options.high > options.low) return {options.low, options.high};
  return default_range(options.view);
}

}  // namespace

FilmPlacement fitted(int width, int height, const Region& into) {
  assert(width > 0 && height > 0);
  const float w = static_cast<float>(width);
  const float h = static_cast<float>(height);
  float scale = std::min(static_cast<float>(into.width) / w, static_cast<float>(into.height) / h);
  if (scale >= 1) scale = std::floor(scale);
  FilmPlacement at{0, 0, std::max(scale * w, 1.0f), std::max(scale * h, 1.0f)};
  at.x = std::floor(static_cast<float>(into.x) + 0.5f * (static_cast<float>(into.width) - at.width));
  at.y = std::floor(static_cast<float>(into.y) + 0.5f * (static_cast<float>(into.height) - at.height));
  return at;
}

const Program& FilmView::program(const Functions& gl, Shaders& shaders, const Variant& variant) {
  if (const Program* found = shaders.programs.find(variant)) return *found;
  const auto define = [](const char* name, int value) {
    return std::string("#define ") + name + " " + std::to_string(value) + "\n";
  };
  const std::string defines =
      define("VIEW", variant.view) + define("TONE", variant.tone) + define("FILTER", variant.filter) +
      define("OTHER_FILTER", variant.other_filter) + define("DIFFERENCE", variant.difference) + "#line 2\n";
  ShaderSource fragment = shaders.fragment;
  const std::size_t second_line = fragment.text.find('\n');  // a version comes before all else
  fragment.text.insert(second_line == std::string::npos ? fragment.text.size() : second_line + 1, defines);
  Program made(gl, shaders.vertex, fragment);
  shaders.programs.trim(kPrograms - 1);
  return shaders.programs.add(variant, std::move(made));
}

FilmView::Shaders FilmView::load(const Functions& gl) {
  Shaders shaders{shader_source("film.vert"), shader_source("film.frag"), {}};
  (void)program(gl, shaders, {});
  return shaders;
}

FilmView::FilmView(const Functions& gl) : gl_(&gl), shaders_(load(gl)), colors_(gl), triangle_(gl) {
  colors_.upload(scale_colors());
}

void FilmView::reload() {
  Shaders fresh = load(*gl_);
  for (int view = 0; view < static_cast<int>(kViewNames.size()); ++view) {
    (void)program(*gl_, fresh, {.view = view});
  }
  (void)program(*gl_, fresh, {.tone = 1});  // with these each line of the shader is compiled
  (void)program(*gl_, fresh, {.difference = 1});
  for (const auto& [variant, old] : shaders_.programs.entries()) (void)program(*gl_, fresh, variant);
  shaders_ = std::move(fresh);
  shown_.reset();
}

const Program& FilmView::begin(const FilmTextures& film, const Variant& variant, const Stage& stage) {
  reset_state(*gl_);
  const Program& shader = program(*gl_, shaders_, variant);
  shader.use();
  const std::array<const char*, 3> planes{"radiance", "error", "features"};
  for (int unit = 0; unit < 3; ++unit) {
    shader.set(planes[static_cast<std::size_t>(unit)], unit);
    film.bind(unit, unit);
  }
  shader.set("colors", 3);
  gl_->active_texture(GL_TEXTURE3);
  gl_->bind_texture(GL_TEXTURE_2D, colors_.id());
  shader.set("placement", shader_placement(film, stage));
  return shader;
}

void FilmView::fill(const Program& shader, const ViewOptions& options, const Stage& stage) const {
  const Region seen = visible(stage);
  if (seen.width <= 0 || seen.height <= 0) return;
  const Functions& gl = *gl_;
  const ViewRange range = range_of(options);
  const float low = std::log2(range.low);
  shader.set("range", std::array{low, 1 / (std::log2(range.high) - low)});
  // Within the exponents of a float: beyond them a zero pixel would become 0 times infinity.
  shader.set("scale", std::exp2(std::clamp(options.exposure, -126.0f, 127.0f)));
  gl.enable(GL_SCISSOR_TEST);
  gl.scissor(seen.x, stage.height - seen.y - seen.height, seen.width, seen.height);
  triangle_.bind();
  gl.draw_arrays(GL_TRIANGLES, 0, 3);
  gl.disable(GL_SCISSOR_TEST);
  expect_no_error(gl, "drawing the film");
}

void FilmView::draw_film(const FilmTextures& film, const ViewOptions& options, const Stage& stage) {
  assert(!film.empty() && std::isfinite(options.exposure) && stage.film.width > 0 && stage.film.height > 0);
  const View view = film.has(options.view) ? options.view : View::image;
  const Variant variant{.view = static_cast<int>(view),
                        .tone = static_cast<int>(options.tone),
                        .filter = filter_of(film, stage.film, options.smooth)};
  fill(begin(film, variant, stage), options, stage);
}

void FilmView::prepare(const FilmTextures& film, const ViewOptions& options) {
  const auto target = static_cast<GLuint>(integer(*gl_, GL_DRAW_FRAMEBUFFER_BINDING));
  shown_.reset();
  if (!picture_) picture_.emplace(*gl_, 1, 1);
  picture_->bind(1, 1);
  for (const float zoom : {1.0f, 1.5f, 0.9f}) {  // one for each filter
    const FilmPlacement placement{0, 0, zoom * static_cast<float>(film.width()),
                                  zoom * static_cast<float>(film.height())};
    draw_film(film, options, {placement, 1, 1, {}});
  }
  gl_->bind_framebuffer(GL_FRAMEBUFFER, target);
}

void FilmView::draw_difference(const FilmTextures& a, const FilmTextures& b, const ViewOptions& options,
                               const Stage& stage) {
  const Variant variant{.tone = static_cast<int>(options.tone),
                        .filter = filter_of(a, stage.film, options.smooth),
                        .other_filter = filter_of(b, stage.film, options.smooth),
                        .difference = 1};
  const Program& shader = begin(a, variant, stage);
  shader.set("other", 4);
  shader.set("other_placement", shader_placement(b, stage));
  b.bind(0, 4);
  fill(shader, options, stage);
}

void FilmView::draw_anew(const FilmTextures& a, const FilmTextures& b, const Compared& how,
                         const ViewOptions& options, const Stage& stage) {
  const int line = static_cast<int>(std::round(std::clamp(how.line, 0.0f, static_cast<float>(stage.width))));
  switch (how.kind) {
    case Comparison::none:
      return draw_film(a, options, stage);
    case Comparison::only_b:
      return draw_film(b, options, stage);
    case Comparison::wipe:
      draw_film(a, options, clipped(stage, {0, 0, line, stage.height}));
      return draw_film(b, options, clipped(stage, {line, 0, stage.width - line, stage.height}));
    case Comparison::difference:
      return draw_difference(a, b, options, stage);
  }
}

void FilmView::draw(const FilmTextures& film, const ViewOptions& options, const Stage& stage) {
  draw_compared(film, film, {}, options, stage);
}

void FilmView::draw_compared(const FilmTextures& a, const FilmTextures& b, const Compared& how,
                             const ViewOptions& options, const Stage& stage) {
  const Region seen = visible(stage);
  if (seen.width <= 0 || seen.height <= 0) return;
  const auto target = static_cast<GLuint>(integer(*gl_, GL_DRAW_FRAMEBUFFER_BINDING));
  Shown wanted{a.content(), b.content(), how, options, stage};
  if (!picture_ || picture_->width() < stage.width || picture_->height() < stage.height) {
    shown_.reset();
    picture_.reset();
    picture_.emplace(*gl_, stage.width, stage.height);
  }
  if (shown_ != wanted) {
    shown_.reset();
    picture_->bind(stage.width, stage.height);
    draw_anew(a, b, how, options, stage);
    shown_ = std::move(wanted);
  }
  reset_state(*gl_);
  picture_->copy_to(target, {seen.x, stage.height - seen.y - seen.height, seen.width, seen.height});
  gl_->viewport(0, 0, stage.width, stage.height);
  expect_no_error(*gl_, "drawing the film");
}

}  // namespace meander
