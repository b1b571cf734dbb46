// The verb capture: the frame that the preview would show, without a display.
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/preview_loops.h"
#include "app/render_options.h"
#include "app/run_stats.h"
#include "app/scene_warnings.h"
#include "core/error.h"
#include "display/capture.h"
#include "io/image_file.h"
#include "io/output_file.h"
#include "render/first_hits.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 1> kPng{".png"};

// What the command line says of how the picture is looked at.
struct CaptureLook {
  std::optional<double> exposure;  // instead of the scene's
  std::optional<std::string> tone;
  std::string view = "image";
  bool interface = false;
  std::string panel;
  std::string script;
  std::vector<int> window;
  double scale = 1;
};

template <std::size_t N>
int index_of(const std::array<std::string_view, N>& names, const std::string& name) {
  return static_cast<int>(std::ranges::find(names, name) - names.begin());
}

template <std::size_t N>
CLI::Validator one_of(const std::array<std::string_view, N>& names) {
  return CLI::IsMember(std::vector<std::string>(names.begin(), names.end()));
}

ViewOptions view_options(const Display& display, const CaptureLook& look) {
  ViewOptions view;
  view.exposure = static_cast<float>(look.exposure.value_or(display.exposure));
  view.tone = look.tone ? static_cast<Tone>(index_of(kToneNames, *look.tone)) : display.tone;
  view.view = static_cast<View>(index_of(kViewNames, look.view));
  return view;
}

// The film alone, of its own size.
int capture_film(const RenderOptions& options, const CaptureLook& look) {
  const FinishedRun run = run_render(options, kPng);
  const ViewOptions view = view_options(run.job.scene->display, look);
  const std::atomic<bool> never{false};
  const Image normals = view.view == View::normals ? first_hits(run.job, never).normals : Image();
  const FilmPlanes planes = resolve_planes(run.rendering.film, normals.width > 0 ? &normals : nullptr);
  write_png(options.output, capture_frame(planes, view), image_attributes(run.job, run.rendering));
  print_summary(options, run);
  return 0;
}

SceneDocument open_document(const RenderOptions& options, const CaptureLook& look) {
  SceneDocument document = SceneDocument::open(options.scene, all_edits(options));
  if (look.exposure) document.apply("display.exposure=" + std::to_string(*look.exposure));
  if (look.tone) document.apply("display.tone=" + *look.tone);
  return document;
}

OffscreenPreview offscreen_of(const CaptureLook& look, const FilmSize& film) {
  OffscreenPreview asked;
  asked.scale = static_cast<float>(look.scale);
  if (!look.window.empty()) {
    asked.width = look.window[0];
    asked.height = look.window[1];
  } else if (!look.interface && look.panel.empty()) {
    asked.width = film.width;
    asked.height = film.height;
  } else if (!look.panel.empty()) {
    asked.width = static_cast<int>(340 * look.scale);
  }
  if (!look.script.empty()) asked.script = PlayedScript{load_script(look.script), look.script};
  return asked;
}

void refuse_what_only_films_have(const RenderOptions& options) {
  const char* option = !options.crop.empty()         ? "--crop"
                       : !options.stats.empty()      ? "--stats"
                       : !options.checkpoint.empty() ? "--checkpoint"
                       : !options.resume.empty()     ? "--resume"
                                                     : nullptr;
  if (option)
    throw Error(Fault::input, std::string(option) +
                                  " does not go with --ui, --panel or --script: those draw a whole "
                                  "window");
}

// The whole window of the previewer.
int capture_window(const RenderOptions& options, const CaptureLook& look) {
  check_writable(options.output, kPng);
  refuse_what_only_films_have(options);
  const SceneDocument document = open_document(options, look);
  refuse_overwriting("--output", options.output, document.scene().files);
  PreviewOptions preview;
  preview.settings = preview_settings(options);
  if (!preview.settings.budget.spp && !preview.settings.budget.seconds && !preview.settings.budget.error)
    preview.settings.budget.spp = 64;
  preview.look.view = static_cast<View>(index_of(kViewNames, look.view));
  preview.hidden = !look.interface && look.panel.empty();
  if (!look.panel.empty()) preview.only_panel = static_cast<PanelName>(index_of(kPanelNames, look.panel));
  preview.watches_files = false;
  const OffscreenPreview asked = offscreen_of(look, document.scene().scene.film);
  const auto [frame, warnings] = run_offscreen(document, preview, asked, watch_interrupts());
  write_png(options.output, frame,
            {{{"meander/scene", options.scene}, {"meander/version", version_text()}}, {}});
  if (options.quiet) return 0;
  for (const std::string& warning : warnings) warn(warning);
  std::fprintf(stderr, "%s: the previewer's window, %d x %d pixels\n", options.output.c_str(), frame.width,
               frame.height);
  return 0;
}

void add_look_options(CLI::App& verb, CaptureLook& look) {
  verb.add_option("--exposure", look.exposure, "stops (the scene's)")->check(number_between(-50, 50));
  verb.add_option("--tone", look.tone, "tone curve: srgb or filmic (the scene's)")->check(one_of(kToneNames));
  verb.add_option("--view", look.view,
                  "image, noise, samples, scatterings, length, normals, luminance or clipping (image)")
      ->check(one_of(kViewNames));
  verb.add_flag("--ui", look.interface, "the whole window, with its panels");
  verb.add_option("--panel", look.panel,
                  "one panel alone: preset, material, light, camera, render, statistics, "
                  "coefficients")
      ->check(one_of(kPanelNames));
  verb.add_option("--script", look.script, "file of edits, keys and mouse moves to play first")
      ->check(file_name());
  verb.add_option("--window", look.window, "W,H: pixels of the window with --ui (1280,720)")
      ->delimiter(',')
      ->expected(2)
      ->transform(whole_number(64, 16384));
  verb.add_option("--ui-scale", look.scale, "size of text and controls (1)")->check(number_between(0.5, 4));
}

}  // namespace

void add_capture_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("capture", "trace a scene and draw it through OpenGL, off-screen, into a PNG");
  const auto options = std::make_shared<RenderOptions>();
  const auto look = std::make_shared<CaptureLook>();
  add_render_options(*verb, *options);
  add_look_options(*verb, *look);
  verb->callback([=, &action] {
    action = [=] {
      const bool window = look->interface || !look->panel.empty() || !look->script.empty();
      return window ? capture_window(*options, *look) : capture_film(*options, *look);
    };
  });
}

}  // namespace meander
