// The verbs render and capture.
#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "app/command_line.h"
#include "app/render_options.h"
#include "app/run_stats.h"
#include "display/capture.h"
#include "io/image_file.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 1> kExr{".exr"};
constexpr std::array<std::string_view, 1> kPng{".png"};

int render_exr(const RenderOptions& options) {
  const FinishedRun run = run_render(options, kExr);
  const std::array<std::string, 6> channels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};
  const Tile area = area_of(run.job);
  const FilmSize& film = run.job.scene->film;
  write_exr(options.output, resolve(run.rendering.film), channels, image_attributes(run.job, run.rendering),
            {area.x0, area.y0, film.width, film.height});
  print_summary(options, run);
  return 0;
}

// What the command line says instead of the scene.
struct CaptureLook {
  std::optional<double> exposure;
  std::optional<std::string> tone;
};

ViewOptions view_options(const Display& display, const CaptureLook& look) {
  ViewOptions view{.exposure = static_cast<float>(look.exposure.value_or(display.exposure)),
                   .tone = display.tone};
  if (look.tone)
    view.tone = static_cast<Tone>(std::ranges::find(kToneNames, *look.tone) - kToneNames.begin());
  return view;
}

int capture_png(const RenderOptions& options, const CaptureLook& look) {
  const FinishedRun run = run_render(options, kPng);
  const ViewOptions view = view_options(run.job.scene->display, look);
  write_png(options.output, capture_frame(resolve(run.rendering.film), view),
            image_attributes(run.job, run.rendering));
  print_summary(options, run);
  return 0;
}

}  // namespace

void add_render_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("render", "trace a scene into a linear OpenEXR image with its variance");
  const auto options = std::make_shared<RenderOptions>();
  add_render_options(*verb, *options);
  verb->callback([options, &action] { action = [options] { return render_exr(*options); }; });
}

void add_capture_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("capture", "trace a scene and draw it through OpenGL, off-screen, into a PNG");
  const auto options = std::make_shared<RenderOptions>();
  const auto look = std::make_shared<CaptureLook>();
  add_render_options(*verb, *options);
  verb->add_option("--exposure", look->exposure, "stops (the scene's)")->check(CLI::Range(-50.0, 50.0));
  verb->add_option("--tone", look->tone, "tone curve: srgb or filmic (the scene's)")
      ->check(CLI::IsMember({std::string(kToneNames[0]), std::string(kToneNames[1])}));
  verb->callback([=, &action] { action = [=] { return capture_png(*options, *look); }; });
}

}  // namespace meander
