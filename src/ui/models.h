// Everything the interface shows, as plain data: the previewer fills it for every frame, nobody here changes
// it. Lengths are in scene units where no unit is named; places in the window are points from its top left.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "math/tone.h"
#include "scene/material_description.h"
#include "scene/scene.h"

namespace meander {

/// A rectangle of the window.
struct Area {
  float x = 0;
  float y = 0;
  float width = 0;
  float height = 0;

  bool operator==(const Area&) const = default;
};

/// Pixels x0 <= x < x1, y0 <= y < y1 of a film.
struct PixelBox {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;

  bool operator==(const PixelBox&) const = default;
};

/// The translucent materials, the selected one, and what a double click brings back: the material as the
/// scene file has it.
struct MaterialModel {
  std::vector<std::string> names;
  int selected = 0;
  MaterialDescription now;
  MaterialDescription original;
  double thickness = 1;  // mean chord of the object that has it
  double millimetres_per_unit = 1;
};

/// A light of the scene. `key` is what its strength is called in the scene file: radiance, intensity or
/// irradiance.
struct LightItem {
  std::string name;
  std::string kind;  // rectangle, sphere, point, directional
  std::string key = "radiance";
  DVec3 value{1};     // under that key
  DVec3 original{1};  // as the scene file has it
  bool visible = false;
  bool can_be_seen = true;  // point and directional lights cannot
};

enum class EnvironmentKind : std::uint8_t { constant, softbox, overcast, image };
inline constexpr std::array<std::string_view, 4> kEnvironmentNames{"constant", "softbox", "overcast",
                                                                   "image"};

struct EnvironmentItem {
  EnvironmentKind kind = EnvironmentKind::constant;
  std::string image;  // name of the file
  DVec3 radiance{0};  // of a constant one
  double scale = 1;   // of the others
  double rotation = 0;
  bool visible = true;
};

struct LightModel {
  std::vector<LightItem> lights;
  EnvironmentItem environment;
  EnvironmentItem original;
};

struct CameraModel {
  Camera camera;
  Camera original;
};

/// Directions of the camera's views, in the order of kCameraViewNames.
inline constexpr std::array<std::string_view, 6> kCameraViewNames{"front", "back", "left",
                                                                  "right", "top",  "bottom"};

/// What is rendered and for how long. Zero in a budget is no limit.
struct RenderModel {
  int scale = 100;       // percent of the film's size: 100, 50 or 25
  int film_width = 960;  // as it is rendered: at that scale
  int film_height = 540;
  int threads = 0;  // 0 is all
  int available_threads = 1;
  int estimator = 0;
  std::vector<std::string> estimators;
  std::uint64_t budget_spp = 0;
  double budget_noise = 0;
  double budget_seconds = 0;
  bool region_only = false;  // only the rectangle is rendered
};

struct NoiseSample {
  double seconds = 0;
  std::uint64_t spp = 0;
  double noise = 0;
};

/// The mean of the pixels of a rectangle, with the half width of its 95 % interval.
struct RectangleReading {
  PixelBox box;
  DVec3 mean{0};
  DVec3 interval{0};
};

/// What is known of one pixel; `error` is the standard error of the value.
struct PixelReading {
  int x = 0;
  int y = 0;
  DVec3 value{0};
  DVec3 error{0};
  double samples = 0;
  double scatterings = 0;
  double length_mm = 0;  // of the walks inside bodies
};

struct StatisticsModel {
  std::uint64_t spp = 0;
  double seconds = 0;
  double noise = 0;  // 0 while unknown
  bool noise_reliable = true;
  double walks_per_second = 0;
  double steps_per_second = 0;
  double mean_scatterings = 0;
  std::uint64_t walks = 0;
  std::uint64_t leaked_walks = 0;
  std::uint64_t non_finite = 0;
  std::string kernel;     // the model that the walks were chosen for
  std::string estimator;  // in use
  std::vector<NoiseSample> history;
  std::optional<RectangleReading> rectangle;
  std::optional<PixelReading> pixel;
};

/// `texture` is what GL calls the thumbnail; 0 draws none.
struct SnapshotItem {
  std::uintptr_t texture = 0;
  int width = 0;
  int height = 0;
  std::string label;
  bool has_scene = true;  // false for a picture that was dropped: nothing to restore
};

/// Indices of A and B into the items; -1 is the live picture.
struct SnapshotStrip {
  std::vector<SnapshotItem> items;
  int a = -1;
  int b = -1;
};

enum class CompareMode : std::uint8_t { none, wipe, difference, only_b };

/// How the film is looked at. Names of the views come in the order of their numbers.
struct ViewModel {
  int view = 0;
  std::vector<std::string> names;
  double exposure = 0;
  double original_exposure = 0;
  Tone tone = Tone::srgb;
  CompareMode comparison = CompareMode::none;
  float wipe = 0.5f;  // of the width of the picture
};

struct ToolbarModel {
  std::string scene_name;
  bool modified = false;
  bool can_undo = false;
  bool can_redo = false;
  bool paused = false;
  std::vector<std::string> renderers;  // for "copy as", in the order of their numbers
};

/// The colour scale of a false-colour view.
struct LegendModel {
  std::string title;
  double low = 0.001;
  double high = 1;
  bool percent = false;
};

/// What lies over the picture. The film's picture takes `film`, which may reach beyond the image area.
struct OverlayModel {
  Area film;
  int film_width = 960;
  int film_height = 540;
  double points_per_mm = 0;        // at the subject; 0 hides the ruler
  double mean_free_path_mm = 0;    // 0 where there is no medium: no ruler then
  double diffusion_length_mm = 0;  // infinite without absorption
  std::optional<PixelBox> region;
  bool selecting = false;  // the next drag in the picture draws the rectangle
  std::optional<LegendModel> legend;
  std::string title_a;
  std::string title_b;
  bool pixel_tooltip = false;  // statistics.pixel is under the pointer
  std::string busy;            // what is going on that the picture does not show yet
};

enum class MessageKind : std::uint8_t { note, warning, error };

/// A message that stays until its time is over or the user closes it; errors stay until then. `id` is unique.
struct Message {
  std::uint64_t id = 0;
  MessageKind kind = MessageKind::note;
  std::string text;
  std::vector<std::string> details;  // one line each
  double age = 0;                    // seconds
};

struct BrowserEntry {
  std::string name;
  bool folder = false;
  std::uint64_t bytes = 0;
};

/// A folder as the previewer has listed it.
struct BrowserModel {
  std::string folder;  // absolute
  std::vector<BrowserEntry> entries;
  std::string error;  // why there is no listing
};

/// All of it.
struct UiModel {
  ToolbarModel toolbar;
  MaterialModel material;
  LightModel light;
  CameraModel camera;
  RenderModel render;
  StatisticsModel statistics;
  SnapshotStrip snapshots;
  ViewModel view;
  OverlayModel overlay;
  BrowserModel browser;
  std::vector<Message> messages;
};

}  // namespace meander
