// The previewer in a window, and off-screen.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/previewer.h"
#include "app/script.h"
#include "gl/extent.h"
#include "math/image.h"

namespace meander {

struct PlayedScript {
  std::vector<ScriptLine> lines;
  std::string file;
};

/// Opens a window of `width` x `height` points and runs until the user, or the script, closes it. Error
/// (runtime) when there is no display, naming `meander capture`.
void run_in_window(const SceneDocument& document, const PreviewOptions& options, const Extent& size,
                   std::optional<PlayedScript> script);

/// What an off-screen preview is asked for.
struct OffscreenPreview {
  int width = 1280;  // pixels
  int height = 720;
  float scale = 1;  // pixels a point
  std::optional<PlayedScript> script;
};

struct OffscreenFrame {
  Image8 image;
  std::vector<std::string> warnings;  // that the scene gives cause for
};

/// Plays the script, renders until the budget is met, and returns the last frame: what the window would show.
/// Error (runtime) when `stop` became true before the first picture.
[[nodiscard]] OffscreenFrame run_offscreen(const SceneDocument& document, const PreviewOptions& options,
                                           const OffscreenPreview& asked, const std::atomic<bool>& stop);

}  // namespace meander
