// Albedo, phase function, mean free path and the ratio of the channels at their ends.
#include <cmath>

#include "stability/bodies.h"
#include "stability/cases.h"
#include "support/csv.h"

namespace meander {
namespace {

constexpr double kHeight = 2.5;  // of the view of a ball of radius 1
const DVec3 kTurn(20, 30, 40);

Scene turned_cube(const Shape& shape, const TranslucentMaterial& material) {
  Scene scene = white_surround(shape, material, 3.6);
  scene.objects[0].transform.rotate = kTurn;
  return scene;
}

// What a ball takes of the light that its disc receives: what is missing in the picture, per area of the
// disc.
void state_absorbed(Case& row) {
  row.offset = 1;
  row.scale = -kHeight * kHeight / glm::pi<double>();
}

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

void add_albedo_cases(std::vector<Case>& rows) {
  const std::string group = "albedo";
  const TranslucentMaterial white{grey(0.1, 1), Boundary::matched, 1, 0};
  const Shape cube = shape_of(make_cube(4, 4));
  rows.push_back({group, "1 ball", "furnace", white_surround(SphereShape{}, white, kHeight), 20, Furnace{}});
  rows.push_back({group, "1 cube mesh of ior 1.5", "furnace",
                  turned_cube(cube, {grey(0.2, 1, 0.8), Boundary::diffuse, 1.5, 0}), 10, Furnace{}});
  rows.push_back({group, "1 cube mesh of rough glass", "furnace",
                  turned_cube(cube, {grey(0.2, 1, -0.8), Boundary::dielectric, 1.5, 0.3}), 10, Furnace{}});
  // So little is absorbed that it goes with the mean path 4V/S, up to a part of 5.3 (1 - albedo) 10^2 at an
  // optical radius of 50 (the rows of f1_sphere_iso.csv at 0.9999 and 0.999).
  const double lost = 1 - double{static_cast<Real>(1 - 1e-6)};
  Case almost{group,
              "1 - 1e-6 ball, absorbed",
              "(1 - albedo) sigma_t 4V/S",
              white_surround(SphereShape{}, {grey(0.02, 1 - 1e-6), Boundary::matched, 1, 0}, kHeight),
              300,
              Exact{lost * 50 * 4 / 3 * (1 - 530 * lost), 50 * lost * 1e-3},
              Fault::doubled};
  state_absorbed(almost);
  rows.push_back(std::move(almost));
}

void add_phase_cases(std::vector<Case>& rows) {
  for (const double g : {0.0, 1e-7, -1e-7, 0.999, -0.999, 0.9999, -0.9999}) {
    const bool sharp = std::abs(g) > 0.5;
    const TranslucentMaterial material{sharp ? grey(0.02, 0.98, g) : grey(0.2, 0.9, g), Boundary::matched, 1,
                                       0};
    const std::uint64_t spp = sharp ? 60 : 200;
    rows.push_back({"g", text(g) + " ball", "a walk in double precision",
                    white_surround(SphereShape{}, material, kHeight), spp, InDouble{}});
    if (sharp)
      rows.push_back({"g", text(g) + " cube mesh", "a walk in double precision",
                      turned_cube(shape_of(make_cube(4, 4)), material), spp, InDouble{}});
  }
}

// A ball of diameter 2 without scattering: what it lets through is exact.
double absorbed_by_ball(double tau) {
  if (tau < 1e-3) return 4.0 / 3 * tau - tau * tau + 8.0 / 15 * tau * tau * tau;
  return 1 - (1 - (1 + 2 * tau) * std::exp(-2 * tau)) / (2 * tau * tau);
}

void add_path_cases(std::vector<Case>& rows) {
  const std::string group = "mean free path";
  for (const double ratio : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
    const TranslucentMaterial material{grey(2 * ratio, 0.9), Boundary::matched, 1, 0};
    Case ball{group,
              text(ratio) + " ball, absorbed",
              "a walk in double precision",
              white_surround(SphereShape{}, material, kHeight),
              300,
              InDouble{}};
    state_absorbed(ball);
    rows.push_back(std::move(ball));
    rows.push_back({group, text(ratio) + " cube mesh", "a walk in double precision",
                    turned_cube(shape_of(make_cube(4, 4)), material), 250, InDouble{}});
  }
  for (const double ratio : {1e1, 1e2}) {
    Case ball{group,
              text(ratio) + " ball, absorbed",
              "unscattered fraction",
              white_surround(SphereShape{}, {grey(2 * ratio, 0), Boundary::matched, 1, 0}, kHeight),
              1000,
              Exact{absorbed_by_ball(0.5 / ratio), 0, true},
              Fault::doubled};
    state_absorbed(ball);
    rows.push_back(std::move(ball));
  }
  // Where one pass rarely collides the light is kept inside: the mean path under ior 4 is 16 times 4V/S.
  for (const double ratio : {1e4, 1e6}) {
    const double absorbed = 16 * 4.0 / 3 * 0.5 / ratio;
    Case ball{group,
              text(ratio) + " ball of ior 4, absorbed",
              "ior^2 sigma_t 4V/S",
              white_surround(SphereShape{}, {grey(2 * ratio, 0), Boundary::diffuse, 4, 0}, kHeight),
              ratio < 1e5 ? 500u : 200u,
              Exact{absorbed, absorbed * absorbed, true},
              Fault::doubled};
    state_absorbed(ball);
    ball.rare = ratio > 1e5;
    if (ball.rare) ball.long_spp = 150;
    rows.push_back(std::move(ball));
  }
}

// Light from the side: single scattering, in proportion to the depth.
void add_side_cases(std::vector<Case>& rows) {
  for (const double ratio : {1e2, 1e4}) {
    const double sigma = 0.5 / ratio;
    Scene scene = white_surround(shape_of(make_cube()), {grey(2 * ratio, 0.8), Boundary::matched, 1, 0}, 0.4);
    scene.environment.radiance = Rgb(0);
    scene.lights.push_back({"sun", DirectionalLight{{-1, 0, 0}, Rgb(static_cast<Real>(ratio))}, false});
    const double once = 0.8 / (4 * glm::pi<double>()) * 0.5 * 2;
    Case row{"mean free path",
             text(ratio) + " cube mesh lit from the side",
             "single scattering, per sigma_t 4V/S",
             std::move(scene),
             ratio < 1e3 ? 400u : 1000u,
             Exact{once, 3 * sigma * once},
             Fault::doubled};
    row.rare = ratio > 1e3;
    if (row.rare) row.long_spp = 150;
    rows.push_back(std::move(row));
  }
}

// The middle of a face, where a body is a half-space; the reflectance of that under normal incidence.
Scene face_of(const Shape& shape, double ratio) {
  return white_surround(shape, {grey(2 * ratio, 0.9), Boundary::matched, 1, 0}, 0.4);
}
double face_value() {
  const CsvTable table = reference_table("b2_halfspace_iso_vs_albedo.csv");
  std::size_t row = 0;
  while (table.number(row, "alpha") != 0.9) ++row;
  return table.number(row, "R_mu0_1");
}

void add_face_cases(std::vector<Case>& rows) {
  const std::string group = "mean free path";
  const Shape cube = shape_of(make_cube(4, 4));
  for (const double ratio : {1e-3, 1e-4, 5e-5, 1e-5})
    for (const bool mesh : {false, true}) {
      Case row{group,        text(ratio) + (mesh ? " face of a cube mesh" : " face of a box"),
               "half-space", face_of(mesh ? cube : Shape(BoxShape{}), ratio),
               200,          Exact{face_value(), 0}};
      row.inaccurate = ratio < 2e-5;
      if (row.inaccurate && mesh) {
        row.held_against = "half-space, stated";
        row.oracle = Stated{face_value(), false, 0.01};
        row.fault = Fault::diluted;
      }
      rows.push_back(std::move(row));
    }
  // Through an interface, where a walk that is reflected inside sets out anew: the same at any mean free
  // path.
  const auto behind = [](Scene scene, Boundary boundary, double roughness) {
    auto& body = std::get<TranslucentMaterial>(scene.materials[0].kind);
    body.boundary = boundary;
    body.ior = 1.4;
    body.roughness = roughness;
    return scene;
  };
  const auto add = [&](const std::string& name, Boundary boundary, double roughness) {
    rows.push_back({group, "0.0001 face of a cube mesh, " + name, "a box, mean free path 0.01",
                    behind(face_of(cube, 1e-4), boundary, roughness), 200,
                    Same{behind(face_of(BoxShape{}, 1e-2), boundary, roughness)}});
  };
  add("diffuse", Boundary::diffuse, 0);
  add("dielectric", Boundary::dielectric, 0);
  add("rough", Boundary::dielectric, 0.3);
}

// Below what single precision tells apart.
void add_shortest_paths(std::vector<Case>& rows) {
  const Shape knot = shape_of(make_torus_knot(200, 24));
  const Shape cube = shape_of(make_cube(4, 4));
  const std::string group = "mean free path 1e-6";
  const auto add = [&](const std::string& name, const Scene& scene) {
    Case row{group, name, "furnace, and a warning", scene, 1, Furnace{}, Fault::diluted};
    row.inaccurate = true;
    row.long_spp = 1;
    rows.push_back(std::move(row));
  };
  for (const Boundary boundary : {Boundary::matched, Boundary::diffuse}) {
    const TranslucentMaterial white{grey(2e-6, 1), boundary, 1, 0};
    const std::string of = boundary == Boundary::matched ? "matched " : "diffuse ";
    add(of + "ball", white_surround(SphereShape{}, white, kHeight));
    add(of + "cube mesh", turned_cube(cube, white));
    add(of + "knot", white_surround(knot, white, 2.2));
  }
  Case absorbing{
      group, "cube mesh, albedo 0.9",          "half-space, stated", face_of(shape_of(make_cube(4, 4)), 1e-6),
      100,   Stated{face_value(), false, 0.2}, Fault::diluted};
  absorbing.inaccurate = true;
  rows.push_back(std::move(absorbing));
}

void add_channel_cases(std::vector<Case>& rows) {
  const auto add = [&](const std::string& name, const Scene& scene, std::uint64_t spp) {
    rows.push_back({"sigma ratio 1e4", name, "a walk in double precision", scene, spp, InDouble{}});
  };
  const DVec3 paths(20, 0.2, 0.002);
  const TranslucentMaterial even{medium_from_albedo(DVec3(0.9), paths, 0), Boundary::matched, 1, 0};
  const TranslucentMaterial uneven{medium_from_albedo({0.99, 0.3, 0.95}, paths, 0.7), Boundary::matched, 1,
                                   0};
  const TranslucentMaterial white{medium_from_albedo(DVec3(1), {2, 0.02, 0.0002}, 0), Boundary::matched, 1,
                                  0};
  add("ball", white_surround(SphereShape{}, even, kHeight), 300);
  add("ball of uneven albedo", white_surround(SphereShape{}, uneven, kHeight), 300);
  add("cube mesh of uneven albedo", turned_cube(shape_of(make_cube(4, 4)), uneven), 150);
  rows.push_back(
      {"sigma ratio 1e4", "white ball", "1", white_surround(SphereShape{}, white, kHeight), 10, Exact{1, 0}});
}

}  // namespace

void add_medium_cases(std::vector<Case>& rows) {
  add_albedo_cases(rows);
  add_phase_cases(rows);
  add_path_cases(rows);
  add_side_cases(rows);
  add_face_cases(rows);
  add_shortest_paths(rows);
  add_channel_cases(rows);
}

}  // namespace meander
