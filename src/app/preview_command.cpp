// The verb preview.
#include <filesystem>
#include <memory>

#include "app/command_line.h"
#include "app/preview_loops.h"
#include "app/render_options.h"
#include "core/error.h"

namespace meander {
namespace {

struct WindowOptions {
  std::string script;
  std::vector<int> window;
};

// The scene that is shown when none is named: beside the program's installation, or in the source tree.
std::string default_scene() {
  namespace fs = std::filesystem;
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  const fs::path installed =
      program.parent_path().parent_path() / "share" / "meander" / "scenes" / "wax_knot.toml";
  if (!unknown && fs::is_regular_file(installed, unknown)) return installed.string();
  return std::string(MEANDER_SCENE_DIR) + "/wax_knot.toml";
}

int preview(const RenderOptions& options, const WindowOptions& asked) {
  SceneDocument document =
      SceneDocument::open(options.scene.empty() ? default_scene() : options.scene, all_edits(options));
  PreviewOptions preview_options;
  preview_options.settings = preview_settings(options);
  preview_options.edits = all_edits(options);
  Extent size{1280, 720};
  if (!asked.window.empty()) size = {asked.window[0], asked.window[1]};
  std::optional<PlayedScript> script;
  if (!asked.script.empty()) script = PlayedScript{load_script(asked.script), asked.script};
  run_in_window(document, preview_options, size, std::move(script));
  return 0;
}

}  // namespace

void add_preview_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("preview", "open a window in which a scene converges while it is tuned");
  const auto options = std::make_shared<RenderOptions>();
  const auto asked = std::make_shared<WindowOptions>();
  verb->add_option("SCENE", options->scene,
                   "scene file (.toml), or a bare mesh (a knot of wax when none is given)")
      ->check(file_name());
  add_budget_options(*verb, *options);
  verb->add_option("--script", asked->script, "file of edits, keys and mouse moves to play")
      ->check(file_name());
  verb->add_option("--window", asked->window, "W,H: size of the window (1280,720)")
      ->delimiter(',')
      ->expected(2)
      ->transform(whole_number(64, 16384));
  verb->callback([=, &action] { action = [=] { return preview(*options, *asked); }; });
}

}  // namespace meander
