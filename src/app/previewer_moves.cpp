// What the pointer does over the picture.
#include <algorithm>
#include <cmath>

#include "app/previewer.h"
#include "scene/camera_moves.h"
#include "scene/light_rigs.h"
#include "scene/object_measures.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr double kWheelSeconds = 0.4;  // between two steps of one gesture
constexpr double kTurn = 180;          // degrees of light for a drag over the picture's height

}  // namespace

PictureArea Previewer::picture_area() const {
  PictureArea area{layout_.image.x, layout_.image.y, layout_.image.width, std::max(film_area_.height, 1.0f)};
  area.blocked = interface_.wants_mouse(static_cast<float>(navigation_.x), static_cast<float>(navigation_.y));
  return area;
}

void Previewer::drag_camera(const CameraDrag& drag) {
  const Camera& camera = state_.scene->camera;
  SceneDocument document = state_.history.now();
  if (drag.kind == DragKind::orbit) document.set_camera(orbit(camera, drag.dx, drag.dy));
  if (drag.kind == DragKind::pan) document.set_camera(pan(camera, drag.dx, drag.dy));
  if (drag.kind == DragKind::dolly) document.set_camera(dolly(camera, -10 * drag.dy));
  state_.change(std::move(document));
}

void Previewer::drag_light(const LightDrag& drag) {
  SceneDocument document = state_.history.now();
  if (drag.environment) {
    const EnvironmentDescription environment = document.environment();
    if (!environment.sky && environment.image.empty()) return;
    double turned = std::fmod(environment.rotation + kTurn * drag.dx, 360);
    if (turned < 0) turned += 360;
    document.apply(edit_text("environment.rotation", turned));
  } else {
    const auto& lights = state_.scene->lights;
    if (lights.empty()) return;
    auto key =
        std::find_if(lights.begin(), lights.end(), [](const Light& light) { return light.name == "key"; });
    if (key == lights.end()) key = lights.begin();
    const Bounds bounds = subject_bounds(*state_.scene);
    document.set_light(
        key->name, orbit_light(*key, 0.5 * (bounds.low + bounds.high), kTurn * drag.dx, -kTurn * drag.dy));
  }
  state_.change(std::move(document));
}

void Previewer::move_picture(const PictureMove& move) {
  if (const auto* camera = std::get_if<CameraDrag>(&move)) return drag_camera(*camera);
  if (const auto* light = std::get_if<LightDrag>(&move)) return drag_light(*light);
  if (const auto* wheel = std::get_if<WheelDolly>(&move)) {
    // Wheel steps that follow on one another are one gesture, which update() ends.
    set_gesture(true);
    wheel_end_ = now_ + kWheelSeconds;
    SceneDocument document = state_.history.now();
    document.set_camera(dolly(state_.scene->camera, wheel->steps));
    return state_.change(std::move(document));
  }
  set_gesture(std::holds_alternative<GestureBegin>(move));
}

void Previewer::set_gesture(bool on) {
  wheel_end_.reset();
  if (on == gesture_) return;
  gesture_ = on;
  if (on)
    state_.history.begin_gesture();
  else
    state_.history.end_gesture();
}

std::optional<PointedPixel> Previewer::pointed() const {
  const auto x = static_cast<float>(navigation_.x);
  const auto y = static_cast<float>(navigation_.y);
  if (interface_.wants_mouse(x, y) || film_area_.width <= 0) return std::nullopt;
  if (!contains(film_area_, x, y) || !contains(layout_.image, x, y)) return std::nullopt;
  const double across = static_cast<double>((x - film_area_.x) / film_area_.width);
  if (!shows_live(state_.look, across)) return std::nullopt;
  const FilmSize& film = state_.scene->film;
  return PointedPixel{
      static_cast<int>((x - film_area_.x) / film_area_.width * static_cast<float>(film.width)),
      static_cast<int>((y - film_area_.y) / film_area_.height * static_cast<float>(film.height))};
}

}  // namespace meander
