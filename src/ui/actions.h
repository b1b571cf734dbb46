// What the user has asked for, as plain data: the previewer carries it out.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ui/models.h"

namespace meander {

/// What a command uses of its operands stands behind it: text, index, value or box.
enum class CommandKind : std::uint8_t {
  open,          // text: a scene, mesh, environment or picture; as if dropped on the window
  save,          // the scene, under its own name
  save_scene,    // text: path of a .toml
  save_picture,  // text: path of an .exr or .png
  browse,        // text: the folder to list in BrowserModel
  copy_as,       // index: the renderer
  copy_text,     // text: into the clipboard
  copy_camera,
  undo,
  redo,
  reload,
  snapshot,
  restore,          // index: the snapshot
  drop_snapshot,    // index
  set_a,            // index: the snapshot, -1 for the live picture
  set_b,            // index
  swap_ab,          // shows the other of A and B
  wipe,             // comparison by wipe, on or off
  difference,       // comparison by difference, on or off
  set_wipe,         // value: of the picture's width
  view,             // index: the view
  exposure_step,    // value: stops to add
  pause,            // or go on
  select_material,  // index
  rig,              // index into kRigNames
  environment,      // index: EnvironmentKind; text: the file of an image
  frame,            // the camera sees the whole subject
  reset_camera,
  camera_view,    // index into kCameraViewNames
  orthographic,   // index: 1 to, 0 from
  select_region,  // the next drag in the picture draws it; again: not
  set_region,     // box
  clear_region,
  region_only,     // index: 1 render only the rectangle, 0 all
  render_scale,    // index: percent
  threads,         // index
  estimator,       // index
  budget_spp,      // index; 0 no limit
  budget_noise,    // value
  budget_seconds,  // value
  dismiss,         // index: the id of a message
  help,            // the rest is for the interface alone: see carry_out (ui/state.h)
  hide_interface,
  open_browser,
  save_browser,
  save_picture_browser,
  quit  // what Escape means at this moment: close what is open, else the window
};

struct Command {
  CommandKind kind = CommandKind::quit;
  std::int64_t index = 0;
  double value = 0;
  PixelBox box;
  std::string text;

  bool operator==(const Command&) const = default;
};

/// Of one frame. Each edit is `PATH=VALUE`, exactly as --set takes it. All edits between gesture_started and
/// gesture_ended are one step of undo (both may come in one frame: a click); the edits of the frame in which
/// it ends belong to it. A gesture that is resumed is one with the gesture before it: a double click.
struct UiActions {
  std::vector<std::string> edits;
  std::vector<Command> commands;
  bool gesture_started = false;
  bool gesture_ended = false;
  bool gesture_resumed = false;
};

}  // namespace meander
