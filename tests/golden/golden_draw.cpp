// Draws one picture of drawn.csv through OpenGL on OSMesa, from numbers that are made here, so that no walk
// has a part in it. golden_draw NAME OUT.png [FAULT]
//   ramp_srgb, ramp_filmic     a tone curve on a ramp
//   view_NAME                  a film in a view of display/views.h
//   compare_NAME               two films in a comparison of the same
//   panel_NAME, window         a section of the interface, or all of it
// FAULT is "tone" (a ramp, a view or a comparison through the other tone curve) or "albedo" (a panel whose
// material has 0.99 times the albedo). Exit codes: 0 drawn, 2 wrong use, 3 failure.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "display/capture.h"
#include "display/easel.h"
#include "display/interface_view.h"
#include "io/image_file.h"
#include "ui/draw.h"
#include "ui/sample.h"

namespace meander {
namespace {

constexpr int kSide = 48;
constexpr int kPanelWidth = 340;

// From black over the knees of both curves to beyond white, a cube so that the dark has its share: grey, then
// each channel alone.
Image ramp() {
  Image image(256, 32, 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float t = static_cast<float>(x) / 255;
      for (int c = 0; c < 3; ++c) image.at(x, y)[c] = y < 8 || y / 8 == c + 1 ? 2 * t * t * t : 0;
    }
  }
  return image;
}

// Every plane with its whole range, and beyond it: radiance below 0 and above 1, one that is no number; no
// sample; walks that never scatter; no surface.
FilmPlanes planes() {
  FilmPlanes film{Image(kSide, kSide, 4), Image(kSide, kSide, 4), Image(kSide, kSide, 4)};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const float u = (static_cast<float>(x) + 0.5f) / kSide;
      const float v = (static_cast<float>(y) + 0.5f) / kSide;
      const float colors[3] = {1.3f * u - 0.05f, 1.1f * v, u * (1 - v)};
      std::copy_n(colors, 3, film.radiance.at(x, y));
      film.radiance.at(x, y)[3] = y < 4 ? 0 : std::exp2(14 * u - 1);
      for (int c = 0; c < 3; ++c) {
        const float relative = std::exp2(12 * v - 11);
        film.error.at(x, y)[c] = relative * relative * (colors[c] * colors[c] + 1e-4f);
      }
      film.error.at(x, y)[3] = x < 4 ? 0 : std::exp2(11 * u + 2 * v - 1);
      const float length = x < 4 ? 0 : std::exp2(16 * v - 8);
      const float p = 2.2f * u - 1.1f;
      const float q = 1.1f - 2.2f * v;
      const float rest = 1 - p * p - q * q;
      const float features[4] = {length, rest > 0 ? p : 0, rest > 0 ? q : 0, rest > 0 ? std::sqrt(rest) : 0};
      std::copy_n(features, 4, film.features.at(x, y));
    }
  }
  film.radiance.at(kSide / 3, kSide / 3)[1] = std::numeric_limits<float>::quiet_NaN();
  return film;
}

std::optional<std::size_t> place_in(auto names, std::string_view name) {
  const auto at = std::ranges::find(names, name);
  if (at == names.end()) return std::nullopt;
  return static_cast<std::size_t>(at - names.begin());
}

Tone other(Tone tone) { return tone == Tone::srgb ? Tone::filmic : Tone::srgb; }

Image8 draw_comparison(Comparison comparison, Tone tone) {
  Easel easel(2 * kSide, 2 * kSide);
  easel.a.show(planes(), 1, View::image);
  easel.b.show(gradient(kSide / 2, kSide / 2, 1.2f), 1);
  easel.view.draw_compared(easel.a, easel.b, {comparison, 1.1f * kSide}, {.tone = tone},
                           easel.stage(at_origin(easel.width, easel.height)));
  return easel.read();
}

// The section alone, or the whole interface without one.
Image8 draw_interface_picture(const UiModel& model, std::optional<PanelName> panel) {
  const Offscreen context(1, 1);
  InterfaceView view(context.functions());
  TestWindow window(panel ? kPanelWidth : 800, 500);
  window.model = model;
  window.model.overlay.film = fitted_area(window.layout().image, 960, 540);
  const FontBitmap font = window.interface.font();
  window.interface.set_font_texture(view.upload_font(font.width, font.height, font.coverage));
  for (int settled = 0; settled < 3; ++settled) {
    if (!panel) {
      window.frame();
      continue;
    }
    const Area whole = window.layout().window;
    do {
      window.interface.begin_frame(window.shape);
      (void)draw_panel(*panel, window.model, window.state, whole);
      window.drawn = window.interface.end_frame();
    } while (window.interface.pending());
  }
  const int width = window.shape.pixels_wide;
  const int height = window.shape.pixels_high;
  const Framebuffer target(context.functions(), width, height);
  target.bind(width, height);
  clear(context.functions(), 0.12f);
  view.draw(*window.drawn, width, height);
  return target.read(width, height);
}

// As an edit of the albedo would leave it: sigma_t held.
void darken(MaterialDescription& material) {
  const DVec3 albedo = material.albedo;
  const DVec3 sigma_t = material.sigma_s + material.sigma_a;
  material.albedo = 0.99 * albedo;
  material.sigma_s = material.albedo * sigma_t;
  material.sigma_a = sigma_t - material.sigma_s;
}

std::optional<Image8> draw(std::string_view name, std::string_view fault) {
  const auto tone = [&](Tone right) { return fault == "tone" ? other(right) : right; };
  const std::size_t end = std::min(name.find('_'), name.size());
  const std::string_view kind = name.substr(0, end);
  const std::string_view rest = name.substr(std::min(end + 1, name.size()));
  UiModel model = name == "window" ? busy_model() : sample_model();
  if (name.starts_with("panel_material") || name == "panel_coefficients")
    model.material.now.given = Parametrisation::albedo;
  if (fault == "albedo") darken(model.material.now);
  if (name == "window") return draw_interface_picture(model, std::nullopt);
  if (kind == "ramp")
    if (const auto at = place_in(kToneNames, rest))
      return capture_frame(ramp(), {.tone = tone(static_cast<Tone>(*at))});
  if (kind == "view")
    if (const auto at = place_in(kViewNames, rest))
      return capture_frame(planes(), {.tone = tone(Tone::srgb), .view = static_cast<View>(*at)});
  if (kind == "compare")
    if (const auto at = place_in(kComparisonNames, rest))
      return draw_comparison(static_cast<Comparison>(*at), tone(Tone::srgb));
  if (kind == "panel")
    if (const auto at = place_in(kPanelNames, rest))
      return draw_interface_picture(model, static_cast<PanelName>(*at));
  return std::nullopt;
}

}  // namespace
}  // namespace meander

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fputs("usage: golden_draw NAME OUT.png [tone|albedo]\n", stderr);
    return 2;
  }
  try {
    const auto picture = meander::draw(argv[1], argc == 4 ? argv[3] : "");
    if (!picture) {
      std::fprintf(stderr, "golden_draw: no picture is called '%s'\n", argv[1]);
      return 2;
    }
    meander::write_png(argv[2], *picture, {});
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "golden_draw: %s\n", error.what());
    return 3;
  }
}
