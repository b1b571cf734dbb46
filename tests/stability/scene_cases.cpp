// Whole scenes: scaled and moved with their lights, bodies in bodies, open bodies, the camera inside, films.
#include "render/small_scene.h"
#include "stability/bodies.h"
#include "stability/cases.h"

namespace meander {
namespace {

const std::string kInDouble = "a walk in double precision";
constexpr double kHeight = 2.5;

// small_scene.h's, every length times `scale`, then moved.
Scene placed_scene(double scale, const DVec3& by) {
  Scene scene = mixed_scene();
  scene.film = {24, 16};
  const auto place = [&](DVec3& p) { p = scale * p + by; };
  place(scene.camera.look_from);
  place(scene.camera.look_at);
  for (Object& object : scene.objects) {
    object.transform.scale *= scale;
    place(object.transform.translate);
  }
  for (Material& material : scene.materials)
    if (auto* body = std::get_if<TranslucentMaterial>(&material.kind))
      body->medium.sigma_t /= static_cast<Real>(scale);
  auto& key = std::get<RectangleLight>(scene.lights[0].shape);
  place(key.center);
  place(key.look_at);
  key.width *= scale;
  key.height *= scale;
  auto& point = std::get<PointLight>(scene.lights[1].shape);
  place(point.position);
  point.intensity *= static_cast<Real>(scale * scale);
  return scene;
}

void add_placed_cases(std::vector<Case>& rows) {
  const auto add = [&](const std::string& group, const std::string& name, const Scene& scene) {
    rows.push_back({group, name, "the same scene, unscaled at the origin", scene, 300,
                    Same{placed_scene(1, DVec3(0))}, Fault::aside});
  };
  add("scale", "lit knot and ball 1e-4", placed_scene(1e-4, DVec3(0)));
  add("scale", "lit knot and ball 1e5", placed_scene(1e5, DVec3(0)));
  add("far from the origin", "lit knot and ball", placed_scene(1, {2e4, 1e4, -5e3}));
}

void add_overlaps(std::vector<Case>& rows) {
  const auto add = [&](const std::string& name, const Shape& first, const Shape& second,
                       const Transform& transform) {
    for (const bool white : {true, false}) {
      const TranslucentMaterial one{grey(0.3, white ? 1 : 0.9), Boundary::matched, 1, 0};
      const TranslucentMaterial other{grey(0.1, white ? 1 : 0.8), Boundary::diffuse, 1.4, 0};
      Scene scene = white_surround(first, one, 3.6);
      scene.materials.push_back({"other", other});
      scene.objects.push_back({"second", second, 1, transform});
      Case row{"overlapping, nested",
               name + (white ? ", white" : ""),
               white ? "furnace, and a warning" : "finite, and a warning",
               scene,
               20,
               Furnace{},
               Fault::alone};
      if (!white) row.oracle = Stated{};
      row.overlaps = true;
      rows.push_back(std::move(row));
    }
  };
  const Shape cube = shape_of(make_cube(4, 4));
  add("two balls", SphereShape{}, SphereShape{}, {{1.2, 0, 0}, {}, DVec3(1)});
  add("ball in a ball", SphereShape{}, SphereShape{}, {{}, {}, DVec3(0.5)});
  add("cube mesh in a ball", SphereShape{}, cube, {{0.1, 0, 0}, {10, 20, 30}, DVec3(0.4)});
  add("ball in a cube mesh", cube, SphereShape{}, {{}, {}, DVec3(0.5)});
  add("the same cube mesh twice", cube, cube, {});
}

void add_open_cases(std::vector<Case>& rows) {
  for (const Boundary boundary : {Boundary::matched, Boundary::diffuse})
    for (const bool white : {true, false}) {
      Mesh open = make_cube();
      open.triangles.resize(12);
      const TranslucentMaterial material{grey(0.5, white ? 1 : 0.9), boundary, 1, 0};
      Scene scene = white_surround(shape_of(open), material, 3.6);
      scene.objects[0].transform.rotate = {20, 30, 40};
      const std::string name = boundary == Boundary::matched ? "matched cube mesh" : "diffuse cube mesh";
      Case row{
          "open mesh",  name + (white ? ", white" : ""), white ? "furnace" : "finite", scene, 50, Furnace{},
          Fault::closed};
      if (!white) row.oracle = Stated{};
      row.leaks = true;
      rows.push_back(std::move(row));
    }
}

void add_cameras_inside(std::vector<Case>& rows) {
  const Shape shapes[]{SphereShape{}, BoxShape{}, shape_of(make_cube(4, 4))};
  const char* const names[]{"ball", "box", "cube mesh"};
  for (int i = 0; i < 3; ++i) {
    Scene scene = white_surround(shapes[i], {grey(0.4, 0.9, 0.3), Boundary::matched, 1, 0}, 1);
    scene.camera = {{0.3, 0.2, 0.4}, {0, 0, -1}, {0, 1, 0}, 70, {}};
    rows.push_back({"camera inside", names[i], kInDouble, scene, 150, InDouble{}});
    for (const Boundary boundary : {Boundary::diffuse, Boundary::dielectric}) {
      scene.materials[0] = {"m", TranslucentMaterial{grey(0.4, 1, 0.3), boundary, 1.4, 0}};
      rows.push_back(
          {"camera inside",
           std::string(names[i]) + (boundary == Boundary::diffuse ? ", white diffuse" : ", white dielectric"),
           "furnace", scene, 10, Furnace{}});
    }
  }
}

void add_films(std::vector<Case>& rows) {
  Scene scene = white_surround(SphereShape{}, {grey(0.5, 0.9, 0.5), Boundary::matched, 1, 0}, kHeight);
  scene.film = {1, 1};
  rows.push_back({"film", "1 x 1", kInDouble, scene, 40000, InDouble{}});
}

}  // namespace

void add_scene_cases(std::vector<Case>& rows) {
  add_placed_cases(rows);
  add_overlaps(rows);
  add_open_cases(rows);
  add_cameras_inside(rows);
  add_films(rows);
}

}  // namespace meander
