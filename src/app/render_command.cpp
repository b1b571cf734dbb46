// The verb render.
#include <array>
#include <memory>
#include <string>

#include "app/command_line.h"
#include "app/render_options.h"
#include "app/run_stats.h"
#include "core/error.h"
#include "io/image_file.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 1> kExr{".exr"};

void write_film(const RenderOptions& options, const FinishedRun& run) {
  const std::array<std::string, 6> channels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};
  const Tile area = area_of(run.job);
  const FilmSize& film = run.job.scene->film;
  try {
    write_exr(options.output, resolve(run.rendering.film), channels, image_attributes(run.job, run.rendering),
              {area.x0, area.y0, film.width, film.height});
  } catch (const Error& error) {
    if (!run.kept) throw;
    throw Error(error.fault(), std::string(error.what()) + "; the samples are kept: --resume " +
                                   options.checkpoint + " writes them without rendering again");
  }
}

int render_exr(const RenderOptions& options) {
  const FinishedRun run = run_render(options, kExr);
  write_film(options, run);
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

}  // namespace meander
