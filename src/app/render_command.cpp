// The verbs render and capture.
#include <array>
#include <memory>

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

int capture_png(const RenderOptions& options, const std::optional<double>& exposure) {
  const FinishedRun run = run_render(options, kPng);
  const ViewOptions view{static_cast<float>(exposure.value_or(run.job.scene->display.exposure))};
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
  const auto exposure = std::make_shared<std::optional<double>>();
  add_render_options(*verb, *options);
  verb->add_option("--exposure", *exposure, "stops (the scene's)")->check(CLI::Range(-50.0, 50.0));
  verb->callback([=, &action] { action = [=] { return capture_png(*options, *exposure); }; });
}

}  // namespace meander
