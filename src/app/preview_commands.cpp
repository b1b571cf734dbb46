#include "app/preview_commands.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "scene/camera_moves.h"
#include "scene/light_rigs.h"
#include "scene/object_measures.h"
#include "ui/text.h"

namespace meander {
namespace {

constexpr double kMostStops = 50;

void change_camera(PreviewState& state, const Camera& camera) {
  SceneDocument document = state.history.now();
  document.set_camera(camera);
  state.change(std::move(document));
}

void change_by(PreviewState& state, const std::string& edit) {
  SceneDocument document = state.history.now();
  document.apply(edit);
  state.change(std::move(document));
}

// The directions of kCameraViewNames, from the subject toward the camera.
DVec3 view_direction(std::int64_t index) {
  constexpr std::array<DVec3, 6> kDirections{DVec3(0, 0, 1), DVec3(0, 0, -1), DVec3(-1, 0, 0),
                                             DVec3(1, 0, 0), DVec3(0, 1, 0),  DVec3(0, -1, 0)};
  return kDirections[static_cast<std::size_t>(std::clamp<std::int64_t>(index, 0, 5))];
}

bool camera_command(PreviewState& state, const Command& command) {
  const Scene& scene = *state.scene;
  const double aspect = static_cast<double>(scene.film.width) / scene.film.height;
  Camera camera = scene.camera;
  switch (command.kind) {
    case CommandKind::frame:
      change_camera(state, frame(camera, subject_bounds(scene), aspect));
      return true;
    case CommandKind::reset_camera:
      change_camera(state, state.original_scene->camera);
      return true;
    case CommandKind::camera_view:
      change_camera(state, view_from(camera, subject_bounds(scene), view_direction(command.index), aspect));
      return true;
    case CommandKind::orthographic:
      if (command.index == 1)
        camera.orthographic_height = view_height(camera);
      else
        camera.orthographic_height.reset();
      change_camera(state, camera);
      return true;
    default:
      return false;
  }
}

void change_environment(PreviewState& state, const Command& command) {
  SceneDocument document = state.history.now();
  switch (static_cast<EnvironmentKind>(command.index)) {
    case EnvironmentKind::constant:
      document.set_environment_radiance(DVec3(0.15, 0.17, 0.2));
      break;
    case EnvironmentKind::softbox:
      document.set_environment_sky("softbox");
      break;
    case EnvironmentKind::overcast:
      document.set_environment_sky("overcast");
      break;
    case EnvironmentKind::image:
      document.set_environment_image(command.text);
      break;
  }
  state.change(std::move(document));
}

bool scene_command(PreviewState& state, const Command& command) {
  switch (command.kind) {
    case CommandKind::undo:
      if (state.history.undo()) state.resolve();
      return true;
    case CommandKind::redo:
      if (state.history.redo()) state.resolve();
      return true;
    case CommandKind::rig: {
      SceneDocument document = state.history.now();
      document.set_lights(
          make_rig(static_cast<Rig>(command.index), subject_bounds(*state.scene), state.scene->camera));
      state.change(std::move(document));
      return true;
    }
    case CommandKind::environment:
      change_environment(state, command);
      return true;
    case CommandKind::select_material: {
      std::int64_t index = command.index;
      for (const Material& material : state.scene->materials) {
        const bool counts =
            material.name == state.material || std::holds_alternative<TranslucentMaterial>(material.kind);
        if (counts && index-- == 0) {
          state.material = material.name;
          break;
        }
      }
      return true;
    }
    case CommandKind::exposure_step: {
      const double stops = state.scene->display.exposure + command.value;
      change_by(state, edit_text("display.exposure", std::clamp(stops, -kMostStops, kMostStops)));
      return true;
    }
    default:
      return false;
  }
}

// Turns a comparison on, with something to compare, or off.
void toggle(PreviewTools& tools, Comparison kind) {
  PreviewLook& look = tools.state.look;
  if (look.comparison == kind) {
    look.comparison = Comparison::none;
    return;
  }
  if (look.b < 0 && look.a < 0) {
    if (tools.pictures.snapshots().empty() &&
        !tools.pictures.keep(tools.state.history.now(), tools.state.scene->display))
      return;
    look.b = static_cast<int>(tools.pictures.snapshots().size()) - 1;
  }
  look.comparison = kind;
}

// Snapshots keep their places when one before them is dropped.
void drop_snapshot(PreviewTools& tools, std::int64_t index) {
  if (index < 0 || static_cast<std::size_t>(index) >= tools.pictures.snapshots().size()) return;
  tools.pictures.drop(static_cast<std::size_t>(index));
  PreviewLook& look = tools.state.look;
  for (int* slot : {&look.a, &look.b}) {
    if (*slot == index) *slot = -1;
    if (*slot > index) --*slot;
  }
  if (look.b < 0 && look.a < 0) look.comparison = Comparison::none;
}

void restore_snapshot(PreviewTools& tools, std::int64_t index) {
  const auto& snapshots = tools.pictures.snapshots();
  if (index < 0 || static_cast<std::size_t>(index) >= snapshots.size()) return;
  const auto& document = snapshots[static_cast<std::size_t>(index)].document;
  if (!document) throw Error(Fault::input, "this picture came from a file: it has no parameters to restore");
  tools.state.change(*document);
}

bool comparison_command(PreviewTools& tools, const Command& command) {
  PreviewLook& look = tools.state.look;
  const int count = static_cast<int>(tools.pictures.snapshots().size());
  const int index = static_cast<int>(std::clamp<std::int64_t>(command.index, -1, count - 1));
  switch (command.kind) {
    case CommandKind::snapshot:
      if (!tools.pictures.keep(tools.state.history.now(), tools.state.scene->display))
        throw Error(Fault::input, "there is no picture to keep yet");
      return true;
    case CommandKind::restore:
      restore_snapshot(tools, command.index);
      return true;
    case CommandKind::drop_snapshot:
      drop_snapshot(tools, command.index);
      return true;
    case CommandKind::set_a:
      look.a = index;
      return true;
    case CommandKind::set_b:
      look.b = index;
      if (look.comparison == Comparison::none && index >= 0) look.comparison = Comparison::wipe;
      return true;
    case CommandKind::swap_ab:
      toggle(tools, Comparison::only_b);
      return true;
    case CommandKind::wipe:
      toggle(tools, Comparison::wipe);
      return true;
    case CommandKind::difference:
      toggle(tools, Comparison::difference);
      return true;
    case CommandKind::set_wipe:
      look.wipe = static_cast<float>(std::clamp(command.value, 0.0, 1.0));
      return true;
    default:
      return false;
  }
}

bool region_command(PreviewState& state, const Command& command) {
  PreviewLook& look = state.look;
  switch (command.kind) {
    case CommandKind::select_region:
      look.selecting = !look.selecting;
      return true;
    case CommandKind::set_region:
      look.region = command.box;
      look.selecting = false;
      return true;
    case CommandKind::clear_region:
      look.region.reset();
      look.selecting = false;
      state.settings.region_only = false;
      return true;
    case CommandKind::region_only:
      state.settings.region_only = command.index == 1 && look.region;
      if (command.index == 1 && !look.region) look.selecting = true;
      return true;
    default:
      return false;
  }
}

bool render_command(PreviewState& state, const Command& command) {
  PreviewSettings& settings = state.settings;
  switch (command.kind) {
    case CommandKind::render_scale:
      settings.scale = static_cast<int>(std::clamp<std::int64_t>(command.index, 1, 100));
      return true;
    case CommandKind::estimator:
      settings.estimator = command.index == 0 ? Estimator::analog : Estimator::implicit;
      return true;
    case CommandKind::budget_spp:
      settings.budget.spp.reset();
      if (command.index > 0) settings.budget.spp = static_cast<std::uint64_t>(command.index);
      return true;
    case CommandKind::budget_noise:
      settings.budget.error.reset();
      if (command.value > 0) settings.budget.error = command.value;
      return true;
    case CommandKind::budget_seconds:
      settings.budget.seconds.reset();
      if (command.value > 0) settings.budget.seconds = command.value;
      return true;
    default:
      return false;
  }
}

void file_command(PreviewTools& tools, const Command& command) {
  PreviewState& state = tools.state;
  switch (command.kind) {
    case CommandKind::open:
      return open_file(tools, command.text, false);
    case CommandKind::save:
      return save_scene(tools);
    case CommandKind::save_scene:
      return save_scene_as(tools, command.text);
    case CommandKind::save_picture:
      return save_picture(tools, command.text);
    case CommandKind::browse:
      state.browser = list_folder(command.text);
      return;
    case CommandKind::copy_as:
      return copy_material(tools, static_cast<std::size_t>(command.index));
    case CommandKind::copy_text:
      tools.clipboard.set(command.text);
      return;
    case CommandKind::copy_camera:
      tools.clipboard.set(camera_text(state.scene->camera));
      return state.tell(MessageKind::note, "copied the camera as scene text");
    case CommandKind::view:
      if (command.index >= 0 && command.index < static_cast<std::int64_t>(kViewNames.size()))
        state.look.view = static_cast<View>(command.index);
      return;
    case CommandKind::dismiss:
      std::erase_if(state.messages, [&](const Message& message) {
        return message.id == static_cast<std::uint64_t>(command.index);
      });
      return;
    case CommandKind::quit:
      state.quit = true;
      return;
    default:
      return;
  }
}

}  // namespace

void carry_out(PreviewTools& tools, const Command& command) {
  if (camera_command(tools.state, command) || scene_command(tools.state, command)) return;
  if (comparison_command(tools, command) || region_command(tools.state, command)) return;
  if (render_command(tools.state, command)) return;
  file_command(tools, command);
}

}  // namespace meander
