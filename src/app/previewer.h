// The previewer without a window: events and frames in, pictures with their interface out. A window and an
// off-screen context drive the same one.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/file_watch.h"
#include "app/navigation.h"
#include "app/preview_model.h"
#include "app/preview_pictures.h"
#include "app/preview_state.h"
#include "core/error.h"
#include "display/interface_view.h"
#include "render/session.h"
#include "ui/interface.h"
#include "ui/keys.h"
#include "ui/layout.h"
#include "ui/state.h"

namespace meander {

struct PreviewOptions {
  PreviewSettings settings;
  PreviewLook look;
  bool hidden = false;                  // no interface, the picture alone
  std::optional<PanelName> only_panel;  // nothing but this panel
  bool watches_files = true;
  std::vector<std::string> edits;  // of the command line, see PreviewState::asked
};

/// What a frame is drawn into: the bound framebuffer, `pixels_wide` x `pixels_high` pixels, of `scale` pixels
/// to a point of the interface; `pointer_scale` points of it to one of the events.
using PreviewSurface = FrameShape;

class Previewer {
 public:
  /// Starts to render at once. Needs its context current, here and in every call.
  Previewer(const Functions& gl, SceneDocument document, PreviewOptions options, float scale);

  void set_clipboard(ClipboardAccess clipboard);
  void feed(const InputEvent& event);
  /// An edit as --set, by a script. Error when it is refused.
  void apply(const std::string& edit);

  /// What a key or a panel asks for; what is refused becomes a message.
  void carry_out(const Command& command);

  /// Takes what is new; `now` in seconds. True when there is something to draw: after events, when a picture
  /// has arrived, while a message or a gesture is on.
  [[nodiscard]] bool update(double now);
  /// Draws the frame, and carries out what the interface then asks for.
  void draw(const PreviewSurface& surface);

  [[nodiscard]] bool closing() const noexcept { return state_.quit; }
  [[nodiscard]] PointerShape pointer_shape() const;
  /// Samples a pixel of the picture that everything so far asks for; 0 while that is still to come.
  [[nodiscard]] std::uint64_t spp() const;
  /// Whether the session has nothing left to do.
  [[nodiscard]] bool idle() const { return !session_->working(); }
  /// Seconds from asking to the first picture of the newest generation; nothing before it is there.
  [[nodiscard]] std::optional<double> first_image_seconds() const;
  [[nodiscard]] const PreviewState& state() const noexcept { return state_; }
  [[nodiscard]] const PreviewPictures& pictures() const noexcept { return pictures_; }
  /// What the scene gives cause to warn of, as the picture says so far: overlaps come with full resolution.
  [[nodiscard]] std::vector<std::string> warnings() const;
  /// The window's title.
  [[nodiscard]] std::string title() const;

 private:
  static constexpr int kSettleFrames = 3;  // Dear ImGui needs some frames to come to rest

  void submit_if_changed(double now);
  void submit(bool interactive);
  void tell_warnings();
  void watch_files(double now);
  void reload_scene(bool asked);
  void reload_parts();
  std::uint64_t tell_error(const Error& error);
  void reload_shaders();
  void move_picture(const PictureMove& move);
  void drag_camera(const CameraDrag& drag);
  void drag_light(const LightDrag& drag);
  void set_gesture(bool on);
  void list_folder_for_browser();
  [[nodiscard]] bool may_quit();
  void carry_out_chords();
  void take_drop(const InputEvent& event);
  void carry_out_all(const UiActions& actions);
  [[nodiscard]] PictureArea picture_area() const;
  [[nodiscard]] std::optional<PointedPixel> pointed() const;
  [[nodiscard]] FilmPlacement place_film(const PreviewSurface& surface) const;
  void draw_interface_over(const PreviewSurface& surface);

  std::vector<FileStamp> shader_stamps_;  // of before they were read: the members below do
  const Functions* gl_;
  PreviewState state_;
  PreviewOptions options_;
  Interface interface_;
  InterfaceView interface_view_;
  PreviewPictures pictures_;
  std::unique_ptr<Session> session_;
  UiState ui_;
  HeldKeys held_;
  std::vector<Command> chords_;  // of keys, not carried out yet
  bool pressed_ = false;         // a button, since the interface last saw everything
  Navigation navigation_;
  ClipboardAccess clipboard_;
  FileWatch files_;
  FileWatch shaders_;
  std::vector<FileStamp> refused_files_;  // that the scene file names which could not be read again
  std::vector<std::pair<std::string, std::uint64_t>> warnings_;  // told of the scene, and their messages
  std::vector<std::string> overlaps_;  // of bodies, by the newest picture that knows
  std::uint64_t scene_error_ = 0;      // the message that the scene file does not read, until it does
  std::uint64_t part_error_ = 0;       // likewise a mesh or a picture
  std::uint64_t shader_error_ = 0;     // likewise of the shaders
  Layout layout_;
  Area film_area_;  // the film's picture in the window, points of the interface
  float pointer_scale_ = 1;
  std::uint64_t generation_ = 0;
  std::string submitted_;  // what the session was last asked for, as text
  bool interactive_ = false;
  bool gesture_ = false;
  std::optional<double> wheel_end_;  // when a gesture of wheel steps is over
  bool paused_ = false;
  double last_change_ = 0;
  double quit_asked_ = -1e9;
  double last_watch_ = 0;
  double last_draw_ = -1;
  double now_ = 0;
  int frames_due_ = 3;
};

}  // namespace meander
