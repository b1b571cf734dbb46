// Scripts for the previewer: edits, keys and mouse moves from a file, played in a window and off-screen
// alike.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "gl/input.h"

namespace meander {

struct SetStep {
  std::string edit;  // PATH=VALUE, as --set
};
struct WaitSppStep {
  std::uint64_t spp;  // until the picture has at least this many samples a pixel
};
struct WaitImageStep {};  // until the picture shows all edits so far, however coarsely
struct WaitStep {
  double seconds;
};
struct EventStep {
  InputEvent event;
};
struct SnapshotStep {
  std::string path;  // the frame as it stands, interface and all, as PNG
};
struct SizeStep {
  int width;
  int height;
};
struct QuitStep {};

using ScriptStep =
    std::variant<SetStep, WaitSppStep, WaitImageStep, WaitStep, EventStep, SnapshotStep, SizeStep, QuitStep>;

/// One step and the line it stands in, for messages.
struct ScriptLine {
  ScriptStep step;
  int line;
};

/// One command a line, `#` starts a comment:
///   set PATH=VALUE         an edit, as --set
///   wait-image             until the picture shows all edits so far, however coarsely
///   wait-spp N | wait S    until the picture has N samples a pixel; S seconds
///   key CHORD              such as `F`, `Shift+E`, `Ctrl+Z`, `Space`; pressed and released
///   move X Y               the mouse, in window points from the top left
///   press B | release B    a mouse button: left, right or middle
///   click X Y | drag B X0 Y0 X1 Y1
///   scroll N               wheel steps, up is positive
///   text TEXT              typed
///   drop PATH              a file dropped on the window
///   size W H               the window's new size
///   snapshot FILE.png      writes the frame as it stands
///   quit
/// Error (input) with file, line and column for anything else.
[[nodiscard]] std::vector<ScriptLine> parse_script(const std::string& text, const std::string& file);

/// Reads and parses a file. Error (input) when it cannot be read.
[[nodiscard]] std::vector<ScriptLine> load_script(const std::string& path);

}  // namespace meander
