#include "app/previewer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <utility>

#include "app/preview_commands.h"
#include "core/error.h"
#include "display/shaders.h"
#include "gl/state.h"
#include "render/parallel.h"
#include "ui/draw.h"

namespace meander {
namespace {

constexpr double kRefineSeconds = 0.15;  // a held drag that rests this long is refined
constexpr double kTickSeconds = 0.1;     // the status line's pace while the session works
constexpr double kLeastFrameSeconds = 1.0 / 40;
constexpr double kMessageSeconds = 6;
constexpr float kBackdrop = 0.105f;  // around the picture

std::vector<FileStamp> shader_stamps() {
  std::vector<FileStamp> stamps;
  for (const std::string& file : shader_files()) stamps.push_back(stamp_before_reading(file));
  return stamps;
}

int threads_of(const PreviewSettings& settings) {
  return settings.threads > 0 ? settings.threads : hardware_threads();
}

// Everything that an image depends on, as text: what the display does with it is left out.
std::string trace_text(const PreviewState& state) {
  std::string text = state.history.now().text();
  if (const std::size_t begin = text.find("[display]"); begin != std::string::npos) {
    const std::size_t end = text.find("\n[", begin);
    text.erase(begin, end == std::string::npos ? std::string::npos : end - begin);
  }
  const PreviewSettings& settings = state.settings;
  text += std::to_string(settings.scale) + ' ' + std::to_string(static_cast<int>(settings.estimator));
  if (settings.region_only && state.look.region) {
    const PixelBox& box = *state.look.region;
    for (const int edge : {box.x0, box.y0, box.x1, box.y1}) text += ' ' + std::to_string(edge);
  }
  return text;
}

}  // namespace

Previewer::Previewer(const Functions& gl, SceneDocument document, PreviewOptions options, float scale)
    : shader_stamps_(shader_stamps()),
      gl_(&gl),
      state_(std::move(document)),
      options_(std::move(options)),
      interface_(scale),
      interface_view_(gl),
      pictures_(gl) {
  state_.settings = options_.settings;
  state_.look = options_.look;
  state_.asked = {state_.history.now().path(), options_.edits};
  ui_.hidden = options_.hidden;
  session_ = std::make_unique<Session>(threads_of(state_.settings));
  clipboard_ = {[] { return std::string(); }, [](const std::string&) {}};
  files_.watch(state_.history.now().watched_files());
  shaders_.watch(shader_stamps_);
  submitted_ = trace_text(state_);
  submit(false);
}

void Previewer::set_clipboard(ClipboardAccess clipboard) {
  interface_.set_clipboard(clipboard);
  clipboard_ = std::move(clipboard);
}

PointerShape Previewer::pointer_shape() const {
  return state_.look.selecting ? PointerShape::crosshair : interface_.pointer_shape();
}

std::string Previewer::title() const {
  const std::string name = std::filesystem::path(state_.history.now().path()).filename().string();
  return (state_.history.now() == state_.original ? "" : "*") + name + " – meander";
}

std::uint64_t Previewer::spp() const {
  if (interactive_) return 0;
  const auto& frame = pictures_.newest();
  return frame && frame->generation == generation_ && frame->scale == 1 ? frame->spp : 0;
}

std::optional<double> Previewer::first_image_seconds() const {
  const auto& frame = pictures_.newest();
  if (!frame || frame->generation != generation_) return std::nullopt;
  return frame->first_image_seconds;
}

void Previewer::submit(bool interactive) {
  if (!interactive) tell_warnings();
  Scene scene = *state_.scene;
  const FilmSize film = scene.film;
  scene.film = scaled_film(film, state_.settings.scale);
  SessionRequest request;
  if (state_.settings.region_only && state_.look.region) {
    const PixelBox box = scaled_box(*state_.look.region, film, state_.settings.scale);
    request.region = Tile{box.x0, box.y0, box.x1, box.y1};
  }
  request.scene = std::make_shared<const Scene>(std::move(scene));
  request.budget = state_.settings.budget;
  request.seed = state_.settings.seed;
  request.estimator = state_.settings.estimator;
  request.walk = state_.settings.walk;
  request.instruction_set = state_.settings.instruction_set;
  request.interactive = interactive;
  generation_ = session_->submit(std::move(request));
  interactive_ = interactive;
}

void Previewer::submit_if_changed(double now) {
  std::string wanted = trace_text(state_);
  if (wanted != submitted_) {
    submitted_ = std::move(wanted);
    last_change_ = now;
    submit(gesture_);
    return;
  }
  if (interactive_ && (!gesture_ || now - last_change_ > kRefineSeconds)) submit(false);
}

void Previewer::feed(const InputEvent& event) {
  frames_due_ = kSettleFrames;
  if (event.kind == InputKind::drop) return take_drop(event);
  interface_.feed(event);
  const auto command = command_of(event, held_);
  if (command) chords_.push_back(*command);
  pressed_ |= event.kind == InputKind::button;
  if (!pressed_) carry_out_chords();
  InputEvent in_points = event;
  in_points.x *= event.kind == InputKind::scroll ? 1 : pointer_scale_;
  in_points.y *= event.kind == InputKind::scroll ? 1 : pointer_scale_;
  for (const PictureMove& move : navigate(navigation_, in_points, picture_area())) {
    try {
      move_picture(move);
    } catch (const Error& error) {
      state_.tell(MessageKind::error, error.what());
    }
  }
}

void Previewer::apply(const std::string& edit) {
  SceneDocument document = state_.history.now();
  document.apply(edit);
  state_.change(std::move(document));
  frames_due_ = kSettleFrames;
  submit_if_changed(now_);
}

void Previewer::take_drop(const InputEvent& event) {
  PreviewTools tools{*gl_, state_, pictures_, *session_, generation_, clipboard_};
  const double x = event.x * pointer_scale_;
  const double y = event.y * pointer_scale_;
  const bool on_panel = contains(layout_.panel, static_cast<float>(x), static_cast<float>(y));
  for (const std::string& path : event.paths) {
    try {
      open_file(tools, path, on_panel);
    } catch (const Error& error) {
      state_.tell(MessageKind::error, error.what());
    }
  }
}

// What keys ask for while no text is being typed. Asked where the interface has seen every press before them:
// one may have been a click into a field.
void Previewer::carry_out_chords() {
  for (const Command& command : std::exchange(chords_, {}))
    if (!interface_.wants_keyboard()) carry_out(command);
}

bool Previewer::update(double now) {
  const double passed = now - now_;
  now_ = now;
  const std::size_t messages = state_.messages.size();
  for (Message& message : state_.messages) message.age += passed;
  std::erase_if(state_.messages, [](const Message& message) {
    return message.kind != MessageKind::error &&
           message.age > kMessageSeconds * (1 + !message.details.empty());
  });
  if (wheel_end_ && now > *wheel_end_) set_gesture(false);
  watch_files(now);
  submit_if_changed(now);
  if (const auto error = session_->take_error()) state_.tell(MessageKind::error, *error);
  const bool fresh = pictures_.take(session_->latest());
  if (fresh && pictures_.newest()->overlaps) tell_warnings();
  if (fresh) frames_due_ = std::max(frames_due_, 1);
  if (state_.messages.size() != messages) frames_due_ = std::max(frames_due_, kSettleFrames);
  if (interface_.pending()) frames_due_ = std::max(frames_due_, 1);
  if (session_->working() && now - last_draw_ > kTickSeconds) frames_due_ = std::max(frames_due_, 1);
  // Software OpenGL draws on the cores that trace: frames without a new picture would cost pictures.
  return fresh || (frames_due_ > 0 && now - last_draw_ >= kLeastFrameSeconds);
}

FilmPlacement Previewer::place_film(const PreviewSurface& surface) const {
  const Area& image = layout_.image;
  const float s = surface.scale;
  const Region room{static_cast<int>(std::ceil(image.x * s)), static_cast<int>(std::ceil(image.y * s)),
                    static_cast<int>(image.width * s), static_cast<int>(image.height * s)};
  return fitted(state_.scene->film.width, state_.scene->film.height, room);
}

void Previewer::draw_interface_over(const PreviewSurface& surface) {
  const std::optional<PointedPixel> pixel = pointed();
  interface_.begin_frame(surface);
  if (interface_.font_changed()) {
    const FontBitmap font = interface_.font();
    interface_.set_font_texture(interface_view_.upload_font(font.width, font.height, font.coverage));
  }
  ModelInputs inputs{pictures_, generation_, film_area_, pixel, paused_};
  const UiModel model = make_model(state_, inputs);
  const UiActions actions = options_.only_panel ? draw_panel(*options_.only_panel, model, ui_, layout_.window)
                                                : draw_interface(model, ui_, layout_);
  const ImDrawData* data = interface_.end_frame();
  interface_view_.draw(*data, surface.pixels_wide, surface.pixels_high);
  carry_out_all(actions);
  if (interface_.pending()) return;
  pressed_ = false;
  carry_out_chords();
}

void Previewer::draw(const PreviewSurface& surface) {
  frames_due_ = std::max(frames_due_ - 1, 0);
  last_draw_ = now_;
  pointer_scale_ = surface.pointer_scale;
  layout_ = layout_of(surface.width(), surface.height(), ui_.hidden);
  if (options_.only_panel) layout_.image = {};
  const FilmPlacement film = place_film(surface);
  film_area_ = {film.x / surface.scale, film.y / surface.scale, film.width / surface.scale,
                film.height / surface.scale};
  clear(*gl_, kBackdrop);
  const Area& image = layout_.image;
  const Region clip{static_cast<int>(image.x * surface.scale), static_cast<int>(image.y * surface.scale),
                    static_cast<int>(image.width * surface.scale),
                    static_cast<int>(image.height * surface.scale)};
  pictures_.draw(state_.look, state_.scene->display, {film, clip, surface.pixels_wide, surface.pixels_high});
  draw_interface_over(surface);
}

// The folder of the last listing, or of the scene.
void Previewer::list_folder_for_browser() {
  if (!state_.browser.folder.empty()) {
    state_.browser = list_folder(state_.browser.folder);
    return;
  }
  const std::filesystem::path folder = std::filesystem::path(state_.history.now().path()).parent_path();
  state_.browser = list_folder(folder.empty() ? "." : folder.string());
}

void Previewer::carry_out_all(const UiActions& actions) {
  if (actions.gesture_started) set_gesture(true);
  if (actions.gesture_resumed) state_.history.resume_gesture();
  for (const std::string& edit : actions.edits) {
    try {
      SceneDocument document = state_.history.now();
      document.apply(edit);
      state_.change(std::move(document));
    } catch (const Error& error) {
      state_.tell(MessageKind::error, error.what());
    }
  }
  for (const Command& command : actions.commands) carry_out(command);
  if (actions.gesture_ended) set_gesture(false);
  if (!actions.edits.empty() || !actions.commands.empty() || actions.gesture_ended)
    frames_due_ = kSettleFrames;
}

// Escape is pressed easily: edits that are not saved ask for it twice.
bool Previewer::may_quit() {
  const bool asked = now_ - quit_asked_ < kMessageSeconds;
  if (asked || state_.history.now() == state_.original) return true;
  quit_asked_ = now_;
  state_.tell(MessageKind::warning, "there are edits that are not saved: Escape again leaves, Ctrl+S saves");
  return false;
}

void Previewer::carry_out(const Command& command) {
  try {
    if (command.kind == CommandKind::quit && state_.look.selecting) {
      state_.look.selecting = false;
      return;
    }
    const bool was_closed = ui_.browser == BrowserUse::closed;
    if (meander::carry_out(ui_, command)) {
      if (was_closed && ui_.browser != BrowserUse::closed) list_folder_for_browser();
      return;
    }
    if (command.kind == CommandKind::quit && !may_quit()) return;
    if (command.kind == CommandKind::pause) {
      paused_ = !paused_;
      session_->set_paused(paused_);
    } else if (command.kind == CommandKind::reload) {
      reload_parts();
      reload_scene(true);
      reload_shaders();
    } else if (command.kind == CommandKind::threads) {
      state_.settings.threads = static_cast<int>(command.index);
      session_ = std::make_unique<Session>(threads_of(state_.settings), generation_);
      session_->set_paused(paused_);
      submit(false);
    } else {
      PreviewTools tools{*gl_, state_, pictures_, *session_, generation_, clipboard_};
      const auto before = state_.settings.budget;
      meander::carry_out(tools, command);
      const auto& after = state_.settings.budget;
      if (before.spp != after.spp || before.error != after.error || before.seconds != after.seconds)
        session_->set_budget(after);
    }
  } catch (const Error& error) {
    state_.tell(MessageKind::error, error.what());
  }
}

}  // namespace meander
