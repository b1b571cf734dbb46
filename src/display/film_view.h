// Draws films: linear radiance in, display-encoded pixels out, in whatever framebuffer is bound.
#pragma once

#include <optional>

#include "core/recent_values.h"
#include "display/film_textures.h"
#include "display/views.h"
#include "gl/framebuffer.h"
#include "gl/picture.h"
#include "gl/program.h"
#include "gl/vertex_array.h"

namespace meander {

/// A rectangle of whole pixels, row 0 at the top.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  bool operator==(const Region&) const = default;
};

/// The rectangle that the whole picture takes in the framebuffer: pixels, y down from the top. It may reach
/// beyond the framebuffer: that is zoom and pan.
struct FilmPlacement {
  float x = 0;
  float y = 0;
  float width = 0;
  float height = 0;

  bool operator==(const FilmPlacement&) const = default;
};

/// The largest centred placement of a `width` x `height` picture in a region: whole pixels for each film
/// pixel where there is room for them, smaller as need be.
[[nodiscard]] FilmPlacement fitted(int width, int height, const Region& into);

/// Where to draw: the picture's place in a framebuffer of `width` x `height` pixels, and what of it is drawn.
struct Stage {
  FilmPlacement film;
  int width = 0;
  int height = 0;
  std::optional<Region> clip;

  bool operator==(const Stage&) const = default;
};

struct Compared {
  Comparison kind = Comparison::none;
  float line = 0;  // of the wipe: framebuffer pixels from the left

  bool operator==(const Compared&) const = default;
};

class FilmView {
 public:
  /// Needs its context current, here and in every call. Error (runtime) when the shaders are missing or do
  /// not compile.
  explicit FilmView(const Functions& gl);

  /// Draws `film` (not empty) into the bound framebuffer, which is of the stage's size. Values are
  /// multiplied by 2^exposure, go through the tone curve, are clamped to [0, 1], sRGB-encoded (IEC 61966-2-1)
  /// and rounded to 8 bits; NaN shows as 0, +infinity as 1. A view whose planes are not there is drawn as the
  /// image. Where a film pixel covers n x n whole pixels it has one colour; else values are interpolated, or
  /// averaged over each pixel where the film is shrunk, before the tone curve. Drawing again what was drawn
  /// last is a mere copy.
  void draw(const FilmTextures& film, const ViewOptions& options, const Stage& stage);

  /// The same for two films, of any sizes, stretched over the same rectangle.
  void draw_compared(const FilmTextures& a, const FilmTextures& b, const Compared& how,
                     const ViewOptions& options, const Stage& stage);

  /// Has the driver make ready what it needs to draw `film` so at any size, by drawing single pixels out of
  /// sight: a software rasteriser takes tens of milliseconds when it meets a shader first. For a moment when
  /// nobody waits.
  void prepare(const FilmTextures& film, const ViewOptions& options);

  /// Compiles the shaders anew from their files. Error (runtime) with the file and the driver's log; the old
  /// ones go on then.
  void reload();

 private:
  // One program for each way of drawing: a software rasteriser runs every branch of a shader, taken or not.
  struct Variant {
    int view = 0;
    int tone = 0;
    int filter = 0;
    int other_filter = 0;
    int difference = 0;

    bool operator==(const Variant&) const = default;
  };
  // A software rasteriser holds a megabyte and more for each: those that were used last are kept.
  static constexpr std::size_t kPrograms = 16;
  struct Shaders {
    ShaderSource vertex;
    ShaderSource fragment;
    RecentValues<Variant, Program> programs;
  };
  [[nodiscard]] static Shaders load(const Functions& gl);
  [[nodiscard]] static const Program& program(const Functions& gl, Shaders& shaders, const Variant& variant);
  const Program& begin(const FilmTextures& film, const Variant& variant, const Stage& stage);
  void fill(const Program& shader, const ViewOptions& options, const Stage& stage) const;
  void draw_film(const FilmTextures& film, const ViewOptions& options, const Stage& stage);
  void draw_difference(const FilmTextures& a, const FilmTextures& b, const ViewOptions& options,
                       const Stage& stage);
  void draw_anew(const FilmTextures& a, const FilmTextures& b, const Compared& how,
                 const ViewOptions& options, const Stage& stage);

  // What the picture shows.
  struct Shown {
    FilmTextures::Content a;
    FilmTextures::Content b;
    Compared how;
    ViewOptions options;
    Stage stage;

    bool operator==(const Shown&) const = default;
  };

  const Functions* gl_;
  Shaders shaders_;
  Picture colors_;
  VertexArray triangle_;
  std::optional<Framebuffer> picture_;
  std::optional<Shown> shown_;
};

}  // namespace meander
