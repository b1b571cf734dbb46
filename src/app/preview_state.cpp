#include "app/preview_state.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace meander {
namespace {

// Of an object, or else one that no object has; empty when there is none.
std::string first_translucent(const Scene& scene) {
  for (const Object& object : scene.objects)
    if (std::holds_alternative<TranslucentMaterial>(scene.materials[object.material].kind))
      return scene.materials[object.material].name;
  for (const Material& material : scene.materials)
    if (std::holds_alternative<TranslucentMaterial>(material.kind)) return material.name;
  return {};
}

// A material of that name that can be edited here: translucent, or translucent but for a radius of 0.
bool is_there(const Scene& scene, const std::string& name) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [&](const Material& material) { return material.name == name; });
}

void take(PreviewState& state, SceneFile file) {
  state.scene = std::make_shared<const Scene>(std::move(file.scene));
  state.warnings = std::move(file.warnings);
  if (!is_there(*state.scene, state.material)) state.material = first_translucent(*state.scene);
}

}  // namespace

bool shows_live(const PreviewLook& look, double across) {
  switch (look.comparison) {
    case Comparison::none:
      return look.a < 0;
    case Comparison::wipe:
      return (across < static_cast<double>(look.wipe) ? look.a : look.b) < 0;
    case Comparison::only_b:
      return look.b < 0;
    case Comparison::difference:
      return false;
  }
  return false;
}

PreviewState::PreviewState(SceneDocument document) : history(document), original(std::move(document)) {
  resolve();
  settle();
}

void PreviewState::settle() {
  original = history.now();
  original_scene = scene;
  settled.insert_or_assign(original.path(), original);
}

void PreviewState::change(SceneDocument next) {
  SceneFile file = next.scene();
  history.change(std::move(next));
  take(*this, std::move(file));
}

void PreviewState::resolve() {
  take(*this, history.now().scene());
  const auto before = settled.find(history.now().path());
  if (before == settled.end() || before->first == original.path()) return;
  original = before->second;
  try {
    original_scene = std::make_shared<const Scene>(original.scene().scene);
  } catch (const Error&) {
    original_scene = scene;  // a file that it names is gone
  }
}

FilmSize scaled_film(const FilmSize& film, int percent) {
  const auto scaled = [&](int side) { return std::max(1, (side * percent + 50) / 100); };
  return {scaled(film.width), scaled(film.height)};
}

PixelBox scaled_box(const PixelBox& box, const FilmSize& film, int percent) {
  const FilmSize scaled = scaled_film(film, percent);
  const double x = static_cast<double>(scaled.width) / film.width;
  const double y = static_cast<double>(scaled.height) / film.height;
  const auto low = [](double v, int most) {
    return std::clamp(static_cast<int>(std::floor(v)), 0, most - 1);
  };
  const auto high = [](double v, int least, int most) {
    return std::clamp(static_cast<int>(std::ceil(v)), least + 1, most);
  };
  const int x0 = low(box.x0 * x, scaled.width);
  const int y0 = low(box.y0 * y, scaled.height);
  return {x0, y0, high(box.x1 * x, x0, scaled.width), high(box.y1 * y, y0, scaled.height)};
}

}  // namespace meander
