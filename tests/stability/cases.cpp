#include "stability/cases.h"

#include "stability/bodies.h"

namespace meander {
namespace {

void edit_media(Scene& scene, const std::function<void(Medium&)>& edit) {
  for (Material& material : scene.materials)
    if (auto* translucent = std::get_if<TranslucentMaterial>(&material.kind)) edit(translucent->medium);
}

void edit_meshes(Scene& scene, const std::function<Mesh(const Mesh&)>& edit) {
  for (Object& object : scene.objects)
    if (const auto* mesh = std::get_if<std::shared_ptr<const Mesh>>(&object.shape))
      object.shape = shape_of(edit(**mesh));
}

}  // namespace

Scene white_surround(const Shape& shape, const TranslucentMaterial& material, double height) {
  Scene scene;
  scene.camera = {{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 40, height};
  scene.film = {16, 16};
  scene.environment.radiance = Rgb(1);
  scene.materials.push_back({"m", material});
  scene.objects.push_back({"body", shape, 0, {}});
  return scene;
}

Medium grey(double mean_free_path, double albedo, double g) {
  return medium_from_albedo(DVec3(albedo), DVec3(mean_free_path), g);
}

Shape shape_of(Mesh mesh) { return std::make_shared<const Mesh>(std::move(mesh)); }

Scene with_fault(Scene scene, Fault fault) {
  switch (fault) {
    case Fault::albedo:
      edit_media(scene, [](Medium& medium) { medium.albedo *= Real(0.98); });
      break;
    case Fault::doubled:
      edit_media(scene, [](Medium& medium) { medium.sigma_t *= Real(2); });
      break;
    case Fault::dense:
      edit_media(scene, [](Medium& medium) { medium.sigma_t *= Real(1e4); });
      break;
    case Fault::diluted:
      edit_media(scene, [](Medium& medium) { medium.sigma_t *= Real(1e-3); });
      break;
    case Fault::triangle:
      edit_meshes(scene, [](const Mesh& mesh) { return without_triangle(mesh, mesh.triangles.size() / 2); });
      break;
    case Fault::aside:
      scene.objects[0].transform.translate += 0.1 * scene.objects[0].transform.scale.x;
      break;
    case Fault::closed:
      edit_meshes(scene, [](const Mesh&) { return make_cube(); });
      break;
    case Fault::alone:
      scene.objects.resize(1);
      break;
  }
  return scene;
}

}  // namespace meander
