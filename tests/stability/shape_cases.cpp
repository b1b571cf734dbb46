// Scaled and moved bodies, sheets, needles, and meshes that a modeller would be ashamed of.
#include <cmath>

#include "stability/bodies.h"
#include "stability/cases.h"
#include "support/csv.h"

namespace meander {
namespace {

const DVec3 kTurn(20, 30, 40);
const std::string kInDouble = "a walk in double precision";

// Everything of a scene of one body times `scale`, mean free paths too.
Scene scaled(Scene scene, double scale) {
  scene.camera.look_from *= scale;
  scene.camera.look_at *= scale;
  if (scene.camera.orthographic_height) *scene.camera.orthographic_height *= scale;
  for (Object& object : scene.objects) object.transform.scale *= scale;
  for (Object& object : scene.objects) object.transform.translate *= scale;
  for (Material& material : scene.materials)
    if (auto* body = std::get_if<TranslucentMaterial>(&material.kind))
      body->medium.sigma_t /= static_cast<Real>(scale);
  return scene;
}

Scene moved(Scene scene, const DVec3& by) {
  scene.camera.look_from += by;
  scene.camera.look_at += by;
  for (Object& object : scene.objects) object.transform.translate += by;
  return scene;
}

Scene turned(const Shape& shape, const TranslucentMaterial& material) {
  Scene scene = white_surround(shape, material, 3.6);
  scene.objects[0].transform.rotate = kTurn;
  return scene;
}

const TranslucentMaterial kMatched{grey(0.3, 0.9, 0.3), Boundary::matched, 1, 0};

void add_size_cases(std::vector<Case>& rows) {
  const std::pair<std::string, Scene> bodies[]{{"ball", white_surround(SphereShape{}, kMatched, 2.5)},
                                               {"cube mesh", turned(shape_of(make_cube(4, 4)), kMatched)}};
  for (const auto& [name, scene] : bodies) {
    for (const double scale : {1e-4, 1e5})
      rows.push_back({"scale", name + (scale < 1 ? " 1e-4" : " 1e5"), kInDouble, scaled(scene, scale), 150,
                      InDouble{}, Fault::aside});
    rows.push_back({"far from the origin", name, kInDouble, moved(scene, {1e4, -2e4, 5e3}), 150, InDouble{},
                    Fault::aside});
  }
  // Seen along lines through its middle: where steps go that are taken for steps in a ball of radius 0 there.
  Scene hollow = white_surround(shape_of(make_hollow_cube(1e-4)),
                                TranslucentMaterial{grey(0.5, 0.5), Boundary::matched, 1, 0}, 1e-4);
  hollow.camera.look_from = {0.75, 0.5, 10};
  rows.push_back({"scale", "hollow cube 1e6, through its middle", "the same scene, unscaled",
                  scaled(hollow, 1e6), 300, Same{hollow}, Fault::dense});
  // The distance in the positions of the mesh, and not in its transform.
  const DVec3 by(2e4, -1e4, 5e3);
  Scene far = white_surround(shape_of(shifted(make_cube(4, 4), by)), kMatched, 3);
  far.camera.look_from += by;
  far.camera.look_at += by;
  rows.push_back({"far from the origin", "cube mesh whose positions are far", kInDouble, far, 150, InDouble{},
                  Fault::albedo});
}

void add_sheet_cases(std::vector<Case>& rows) {
  const CsvTable table = reference_table("a_slab.csv");
  const Shape shapes[]{BoxShape{}, shape_of(make_cube(4, 4)), SlabShape{}};
  const char* const names[]{"box", "cube mesh", "slab"};
  for (const std::size_t row : {0u, 60u}) {  // lines 2 and 62 of the file
    const double eta = table.number(row, "eta");
    TranslucentMaterial material{
        grey(2e-4 / table.number(row, "tau"), table.number(row, "alpha"), table.number(row, "g")),
        eta == 1 ? Boundary::matched : Boundary::dielectric, eta, 0};
    for (int i = 0; i < 3; ++i)
      for (const bool turn : {false, true}) {
        if (turn && i == 2) continue;
        Scene scene = white_surround(shapes[i], material, 0.2);
        Transform& transform = scene.objects[0].transform;
        transform.scale = {1, 1e-4, 1};
        transform.rotate = turn ? kTurn : DVec3(0);
        const DMat3 map = linear_part({{}, transform.rotate, DVec3(1)});
        scene.camera.look_from = 10.0 * map[1];
        scene.camera.up = map[2];
        rows.push_back({"sheet 1e-4 thick",
                        std::string(names[i]) + (turn ? ", turned" : "") + (eta == 1 ? "" : ", dielectric"),
                        "adding-doubling", scene, eta == 1 ? 150u : 400u,
                        Exact{table.number(row, "R_total") + table.number(row, "T_total"), 0}});
      }
  }
}

void add_needle_cases(std::vector<Case>& rows) {
  const TranslucentMaterial thin{grey(1e-4, 0.8, 0.3), Boundary::matched, 1, 0};
  for (const bool mesh : {false, true})
    for (const bool turn : {false, true}) {
      Scene scene = white_surround(mesh ? shape_of(make_cube(4, 4)) : Shape(BoxShape{}), thin, 4e-4);
      scene.objects[0].transform = {{}, turn ? DVec3(0, 20, 40) : DVec3(0), {1, 1e-4, 1e-4}};
      rows.push_back({"needle",
                      std::string(mesh ? "cube mesh" : "box") + " 1 x 1e-4 x 1e-4" + (turn ? ", turned" : ""),
                      kInDouble, scene, 150, InDouble{}});
    }
}

void add_mesh_cases(std::vector<Case>& rows) {
  const std::string group = "hard meshes";
  const auto add = [&](const std::string& name, const Mesh& mesh, Fault fault) {
    rows.push_back({group, name, kInDouble, turned(shape_of(mesh), kMatched), 150, InDouble{}, fault});
  };
  add("cube of triangles 1000 times as long as wide", make_cube(1, 2000), Fault::triangle);
  add("cube of coplanar triangles", make_cube(16, 16), Fault::triangle);
  add("cube, its triangles twice", doubled(make_cube(4, 4)), Fault::albedo);
  // A leaf is an exit and an entry at one place: what leaves by the one goes on inside.
  rows.push_back({group, "cube that holds a leaf of no volume", "the same without the leaf",
                  turned(shape_of(with_leaf(make_cube(4, 4))), kMatched), 400,
                  Same{turned(shape_of(make_cube(4, 4)), kMatched)}, Fault::triangle});
  add("cube of two fans of 1000 triangles", make_cube(250), Fault::triangle);
  const Mesh pyramid = make_pyramid(1000);
  Scene above = white_surround(shape_of(pyramid), kMatched, 2.2);
  above.camera.look_from = {0, 10, 0};
  above.camera.up = {0, 0, 1};
  rows.push_back(
      {group, "tip of 1000 triangles, from above", kInDouble, above, 60, InDouble{}, Fault::triangle});
  rows.push_back({group, "tip of 1000 triangles", kInDouble, turned(shape_of(pyramid), kMatched), 60,
                  InDouble{}, Fault::triangle});
  for (const double edge : {1e-1, 1e-3}) {
    const std::string angle = edge > 1e-2 ? "0.1" : "0.001";
    const Mesh wedge = make_prism({{-1, -edge}, {1, 0}, {-1, edge}});
    const TranslucentMaterial thin{grey(edge, 0.8, 0.3), Boundary::matched, 1, 0};
    Scene scene = white_surround(shape_of(wedge), thin, 2.2);
    scene.camera.look_from = {0, 10, 0};
    scene.camera.up = {0, 0, 1};
    rows.push_back({group, "wedge of " + angle, kInDouble, scene, 150, InDouble{}, Fault::triangle});
    for (const double view : {0.2, 0.02}) {
      Scene tip = scene;
      tip.camera.look_from.x = tip.camera.look_at.x = 1;
      tip.camera.orthographic_height = view;
      tip.materials[0] = {"m",
                          TranslucentMaterial{grey(0.5 * view * edge, 0.8, 0.3), Boundary::matched, 1, 0}};
      // Within 0.02 of the edge the sharper one is 2e-5 thick and less, ten times what a mesh is known to,
      // and the mean free path half of that: the warning says so.
      const bool beyond = edge * view < 1e-4;
      Case row{group,
               "within " + std::string(view > 0.1 ? "0.2" : "0.02") + " of the edge of the wedge of " + angle,
               beyond ? "a walk in double precision, stated" : kInDouble,
               tip,
               400,
               InDouble{}};
      row.inaccurate = beyond;
      if (beyond) row.oracle = Stated{0, true, 0.005};
      if (beyond) row.fault = Fault::diluted;
      rows.push_back(std::move(row));
    }
  }
}

void add_furnace_cases(std::vector<Case>& rows) {
  const std::pair<std::string, Mesh> meshes[]{
      {"cube of needle triangles", make_cube(1, 500)},
      {"cube, its triangles twice", doubled(make_cube(4, 4))},
      {"tip of 1000 triangles", make_pyramid(1000)},
      {"wedge of 0.001", make_prism({{-1, -1e-3}, {1, 0}, {-1, 1e-3}})}};
  const TranslucentMaterial whites[]{{grey(0.1, 1, 0.5), Boundary::matched, 1, 0},
                                     {grey(0.1, 1, 0.5), Boundary::diffuse, 1.5, 0},
                                     {grey(0.1, 1, 0.5), Boundary::dielectric, 1.5, 0}};
  const char* const names[]{"matched", "diffuse", "dielectric"};
  for (const auto& [name, mesh] : meshes)
    for (int i = 0; i < 3; ++i)
      rows.push_back({"hard meshes", name + ", white and " + names[i], "furnace",
                      turned(shape_of(mesh), whites[i]), 8, Furnace{}});
  // Few walks enter where a groove is so narrow that rounding tells on which of its sides they are.
  Scene star = white_surround(shape_of(make_star(200)), {grey(0.02, 1), Boundary::matched, 1, 0}, 2);
  star.camera.look_from = {3.5, 2.8, 9};
  rows.push_back({"hard meshes", "star of 200 points, white and matched", "furnace", star, 800, Furnace{}});
  rows.back().long_spp = 2;
  rows.push_back({"hard meshes", "two blocks face to face in one mesh, white and dielectric", "furnace",
                  turned(shape_of(joined(make_touching_cubes())), whites[2]), 8, Furnace{}});
}

// What leaves one of them at their common face enters the other.
void add_touching_cases(std::vector<Case>& rows) {
  const auto [left, right] = make_touching_cubes();
  const std::pair<std::string, TranslucentMaterial> materials[]{
      {"matched", {grey(0.3, 0.8), Boundary::matched, 1, 0}},
      {"diffuse", {grey(0.3, 0.8), Boundary::diffuse, 1, 0}},
      {"diffuse of index 1.5", {grey(0.3, 0.8), Boundary::diffuse, 1.5, 0}},
      {"smooth dielectric", {grey(0.3, 0.8), Boundary::dielectric, 1.5, 0}},
      {"rough dielectric", {grey(0.3, 0.8), Boundary::dielectric, 1.5, 0.4}}};
  for (const auto& [name, material] : materials) {
    Scene two = turned(shape_of(left), material);
    two.objects.push_back(two.objects[0]);
    two.objects[1].shape = shape_of(right);
    rows.push_back({"hard meshes", "two blocks face to face in one mesh, " + name, "the same as two objects",
                    turned(shape_of(joined({left, right})), material), 2000, Same{std::move(two)}});
  }
  Scene eight = turned(shape_of(make_divided_cube()), kMatched);
  Scene one = turned(shape_of(make_cube()), kMatched);
  rows.push_back({"hard meshes", "eight blocks that meet in a point in one mesh, matched",
                  "the same as one block", eight, 2000, Same{one}});
  for (Scene* scene : {&eight, &one}) {
    scene->environment.radiance = Rgb(0);
    scene->lights.push_back(
        {"lamp", RectangleLight{{2, 3, 2}, {0, 0, 0}, {0, 1, 0}, 1.5, 1.5, Rgb(20)}, false});
  }
  rows.push_back({"hard meshes", "eight blocks that meet in a point in one mesh, under a lamp",
                  "the same as one block", eight, 2000, Same{one}});
}

}  // namespace

void add_shape_cases(std::vector<Case>& rows) {
  add_size_cases(rows);
  add_sheet_cases(rows);
  add_needle_cases(rows);
  add_mesh_cases(rows);
  add_furnace_cases(rows);
  add_touching_cases(rows);
}

}  // namespace meander
