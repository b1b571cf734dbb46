#include "app/preview_model.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "io/material_export.h"
#include "render/parallel.h"
#include "scene/camera_moves.h"
#include "scene/object_measures.h"
#include "stats/rectangle.h"

namespace meander {
namespace {

ToolbarModel toolbar_model(const PreviewState& state, bool paused) {
  ToolbarModel model;
  model.scene_name = std::filesystem::path(state.history.now().path()).filename().string();
  model.modified = !(state.history.now() == state.original);
  model.can_undo = state.history.can_undo();
  model.can_redo = state.history.can_redo();
  model.paused = paused;
  model.renderers.assign(kRendererNames.begin(), kRendererNames.end());
  return model;
}

double thickness_of(const Scene& scene, const std::string& material) {
  for (const Object& object : scene.objects)
    if (scene.materials[object.material].name == material) return mean_chord(object);
  return 1;
}

MaterialModel material_model(const PreviewState& state) {
  MaterialModel model;
  for (const Material& material : state.scene->materials) {
    const bool selected = material.name == state.material;
    if (!selected && !std::holds_alternative<TranslucentMaterial>(material.kind)) continue;
    if (selected) model.selected = static_cast<int>(model.names.size());
    model.names.push_back(material.name);
  }
  if (model.names.empty()) return model;
  model.now = state.history.now().material(state.material);
  try {
    model.original = state.original.material(state.material);
  } catch (const std::exception&) {
    model.original = model.now;  // the file had no such material
  }
  model.thickness = thickness_of(*state.scene, state.material);
  model.millimetres_per_unit = state.scene->millimetres_per_unit;
  return model;
}

struct LightWords {
  const char* kind;
  const char* key;
  Rgb value;
};

LightWords words_of(const Light& light) {
  if (const auto* rectangle = std::get_if<RectangleLight>(&light.shape))
    return {"rectangle", "radiance", rectangle->radiance};
  if (const auto* sphere = std::get_if<SphereLight>(&light.shape))
    return {"sphere", "radiance", sphere->radiance};
  if (const auto* point = std::get_if<PointLight>(&light.shape))
    return {"point", "intensity", point->intensity};
  return {"directional", "irradiance", std::get<DirectionalLight>(light.shape).irradiance};
}

EnvironmentItem environment_item(const EnvironmentDescription& description) {
  EnvironmentItem item;
  item.image = std::filesystem::path(description.image).filename().string();
  if (!description.image.empty()) item.kind = EnvironmentKind::image;
  if (description.sky)
    item.kind = *description.sky == Sky::softbox ? EnvironmentKind::softbox : EnvironmentKind::overcast;
  item.radiance = description.radiance;
  item.scale = description.scale;
  item.rotation = description.rotation;
  item.visible = description.visible;
  return item;
}

LightModel light_model(const PreviewState& state) {
  LightModel model;
  for (const Light& light : state.scene->lights) {
    const LightWords words = words_of(light);
    LightItem item;
    item.name = light.name;
    item.kind = words.kind;
    item.key = words.key;
    item.value = item.original = DVec3(words.value);
    item.visible = light.visible;
    item.can_be_seen = words.key == std::string("radiance");
    for (const Light& before : state.original_scene->lights)
      if (before.name == light.name) item.original = DVec3(words_of(before).value);
    model.lights.push_back(std::move(item));
  }
  model.environment = environment_item(state.history.now().environment());
  model.original = environment_item(state.original.environment());
  return model;
}

RenderModel render_model(const PreviewState& state) {
  const PreviewSettings& settings = state.settings;
  RenderModel model;
  const FilmSize film = scaled_film(state.scene->film, settings.scale);
  model.scale = settings.scale;
  model.film_width = film.width;
  model.film_height = film.height;
  model.threads = settings.threads;
  model.available_threads = hardware_threads();
  model.estimator = static_cast<int>(settings.estimator);
  model.estimators = {"analog", "implicit"};
  model.budget_spp = settings.budget.spp.value_or(0);
  model.budget_noise = settings.budget.error.value_or(0);
  model.budget_seconds = settings.budget.seconds.value_or(0);
  model.region_only = settings.region_only;
  return model;
}

// A box at 100 % in the pixels of a frame's planes.
PixelRectangle on_planes(const PixelBox& box, const LiveFrame& frame, const FilmSize& film) {
  const double x = static_cast<double>(frame.film_width) / film.width / frame.scale;
  const double y = static_cast<double>(frame.film_height) / film.height / frame.scale;
  const int dx = frame.area.x0 / frame.scale;
  const int dy = frame.area.y0 / frame.scale;
  return {static_cast<int>(std::floor(box.x0 * x)) - dx, static_cast<int>(std::floor(box.y0 * y)) - dy,
          static_cast<int>(std::ceil(box.x1 * x)) - dx, static_cast<int>(std::ceil(box.y1 * y)) - dy};
}

std::optional<RectangleReading> rectangle_reading(const PreviewState& state, const LiveFrame& frame) {
  if (!state.look.region) return std::nullopt;
  const PixelRectangle area = on_planes(*state.look.region, frame, state.scene->film);
  const RectangleMean mean = rectangle_mean(frame.planes.radiance, frame.planes.error, area);
  if (mean.pixels == 0) return std::nullopt;
  RectangleReading reading;
  reading.box = *state.look.region;
  for (int c = 0; c < 3; ++c) {
    reading.mean[c] = mean.mean[static_cast<std::size_t>(c)];
    reading.interval[c] = mean.half_width[static_cast<std::size_t>(c)];
  }
  return reading;
}

StatisticsModel statistics_model(const PreviewState& state, const ModelInputs& inputs) {
  StatisticsModel model;
  model.estimator = state.settings.estimator == Estimator::analog ? "analog" : "implicit";
  const auto& frame = inputs.pictures.newest();
  if (!frame) return model;
  model.kernel = describe_media(*frame->scene);
  if (inputs.pointed)
    model.pixel = read_pixel(*frame, state.scene->film, *inputs.pointed, state.scene->millimetres_per_unit);
  model.rectangle = rectangle_reading(state, *frame);
  model.mean_scatterings = inputs.pictures.mean_scatterings();
  if (frame->generation != inputs.generation || frame->scale != 1) return model;
  model.spp = frame->spp;
  model.seconds = frame->seconds;
  model.noise = std::isfinite(frame->noise) ? frame->noise : 0;
  model.noise_reliable = model.noise == 0 || frame->noise_reliable;
  model.walks = frame->counters.walks;
  model.leaked_walks = frame->counters.leaked_walks;
  model.non_finite = frame->non_finite;
  if (frame->seconds > 0) {
    model.walks_per_second = static_cast<double>(frame->counters.walks) / frame->seconds;
    model.steps_per_second = static_cast<double>(frame->counters.steps) / frame->seconds;
  }
  for (const NoisePoint& point : frame->history)
    model.history.push_back({point.seconds, point.spp, point.noise});
  return model;
}

SnapshotStrip snapshot_model(const PreviewState& state, const PreviewPictures& pictures) {
  SnapshotStrip strip;
  strip.a = state.look.a;
  strip.b = state.look.b;
  for (const Snapshot& snapshot : pictures.snapshots()) {
    SnapshotItem item;
    item.texture = snapshot.thumbnail->id();
    item.width = snapshot.thumbnail->width();
    item.height = snapshot.thumbnail->height();
    item.label = snapshot.label;
    item.has_scene = snapshot.document.has_value();
    strip.items.push_back(std::move(item));
  }
  return strip;
}

ViewModel view_model(const PreviewState& state) {
  ViewModel model;
  model.view = static_cast<int>(state.look.view);
  model.names.assign(kViewNames.begin(), kViewNames.end());
  model.exposure = state.scene->display.exposure;
  model.original_exposure = state.original_scene->display.exposure;
  model.tone = state.scene->display.tone;
  model.comparison = static_cast<CompareMode>(state.look.comparison);
  model.wipe = state.look.wipe;
  return model;
}

std::optional<LegendModel> legend_model(View view, double millimetres_per_unit) {
  if (!has_scale(view)) return std::nullopt;
  const ViewRange range = default_range(view);
  LegendModel legend;
  legend.title = view == View::noise         ? "relative standard error"
                 : view == View::samples     ? "samples a pixel"
                 : view == View::scatterings ? "mean number of scatterings"
                                             : "mean walk length, mm";
  const double unit = view == View::length ? millimetres_per_unit : 1;
  legend.low = unit * static_cast<double>(range.low);
  legend.high = unit * static_cast<double>(range.high);
  legend.percent = view == View::noise;
  return legend;
}

std::string title_of(const PreviewPictures& pictures, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= pictures.snapshots().size()) return "live";
  return std::to_string(index + 1) + " · " + pictures.snapshots()[static_cast<std::size_t>(index)].label;
}

OverlayModel overlay_model(const PreviewState& state, const ModelInputs& inputs,
                           const MaterialModel& material) {
  OverlayModel model;
  const Scene& scene = *state.scene;
  model.film = inputs.film;
  model.film_width = scene.film.width;
  model.film_height = scene.film.height;
  model.points_per_mm = inputs.film.height / (view_height(scene.camera) * scene.millimetres_per_unit);
  if (material.now.translucent && !material.now.lambertian && !material.names.empty()) {
    const auto mean = [](const DVec3& v) { return (v.x + v.y + v.z) / 3; };
    model.mean_free_path_mm = mean(material.now.mean_free_path) * scene.millimetres_per_unit;
    model.diffusion_length_mm = mean(material.now.diffusion_length) * scene.millimetres_per_unit;
  }
  model.region = state.look.region;
  model.selecting = state.look.selecting;
  model.legend = legend_model(state.look.view, scene.millimetres_per_unit);
  if (state.look.comparison != Comparison::none) {
    model.title_a = title_of(inputs.pictures, state.look.a);
    model.title_b = title_of(inputs.pictures, state.look.b);
  }
  model.pixel_tooltip = inputs.pointed.has_value();
  model.busy = inputs.pictures.live() ? "" : "first image …";
  return model;
}

}  // namespace

std::optional<PixelReading> read_pixel(const LiveFrame& frame, const FilmSize& film, const PointedPixel& at,
                                       double millimetres_per_unit) {
  const PixelRectangle cell = on_planes({at.x, at.y, at.x + 1, at.y + 1}, frame, film);
  const FilmPlanes& planes = frame.planes;
  if (cell.x0 < 0 || cell.y0 < 0 || cell.x0 >= planes.radiance.width || cell.y0 >= planes.radiance.height)
    return std::nullopt;
  const float* radiance = planes.radiance.at(cell.x0, cell.y0);
  const float* error = planes.error.at(cell.x0, cell.y0);
  PixelReading reading;
  reading.x = at.x;
  reading.y = at.y;
  for (int c = 0; c < 3; ++c) {
    reading.value[c] = radiance[c];
    // One sample says nothing of its error.
    reading.error[c] =
        radiance[3] < 2 ? std::numeric_limits<double>::infinity() : std::sqrt(double{error[c]});
  }
  reading.samples = radiance[3];
  reading.scatterings = error[3];
  reading.length_mm = planes.features.at(cell.x0, cell.y0)[0] * millimetres_per_unit;
  return reading;
}

UiModel make_model(const PreviewState& state, const ModelInputs& inputs) {
  UiModel model;
  model.toolbar = toolbar_model(state, inputs.paused);
  model.material = material_model(state);
  model.light = light_model(state);
  model.camera = {state.scene->camera, state.original_scene->camera};
  model.render = render_model(state);
  model.statistics = statistics_model(state, inputs);
  model.snapshots = snapshot_model(state, inputs.pictures);
  model.view = view_model(state);
  model.overlay = overlay_model(state, inputs, model.material);
  model.browser = state.browser;
  model.messages = state.messages;
  return model;
}

}  // namespace meander
