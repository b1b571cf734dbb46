// Oracles that render: light that is sampled against light that rays find by themselves, and furnaces.
#include "render/parallel.h"
#include "render/progressive.h"
#include "stats/image_error.h"
#include "verdict.h"

using namespace meander;

namespace {

// A chromatic matched ball in the dark under a ball of light that the camera sees and a window.
Scene lit_ball() {
  Scene scene;
  scene.camera = {{0, 0, 6}, {0, 0, 0}, {0, 1, 0}, 30, {}};
  scene.film = {24, 24};
  const Medium jade{Rgb(1, 2, 4), Rgb(Real(0.95), Real(0.8), Real(0.9)), Real(-0.5)};
  scene.materials.push_back({"jade", TranslucentMaterial{jade, Boundary::matched}});
  scene.objects.push_back({"ball", SphereShape{}, 0, {}});
  scene.lights.push_back({"lamp", SphereLight{{1.1, 1.3, 0.4}, 0.4, Rgb(6, 5, 4)}, true});
  scene.lights.push_back(
      {"window", RectangleLight{{-2, 1.5, 1}, {0, 0, 0}, {0, 1, 0}, 1.5, 1.5, Rgb(3, 4, 5)}, false});
  return scene;
}

// A white ball in a white surround.
Scene white_ball() {
  Scene scene = lit_ball();
  scene.lights.clear();
  scene.environment.radiance = Rgb(1);
  const Medium white{Rgb(1, 3, 9), Rgb(1), Real(0.5)};
  scene.materials[0] = {"white", TranslucentMaterial{white, Boundary::matched}};
  return scene;
}

// One light in a grey medium, so deep in it that most shadow rays are left out.
Scene lamp_over_fog() {
  Scene scene = lit_ball();
  scene.lights.pop_back();
  const Medium fog{Rgb(8), Rgb(Real(0.98)), Real(0.5)};
  scene.materials[0] = {"fog", TranslucentMaterial{fog, Boundary::matched}};
  return scene;
}

// A bright ball in the dark: nothing but its outline.
Scene glowing_ball() {
  Scene scene = lit_ball();
  scene.lights.clear();
  scene.materials[0] = {"glow", EmissiveMaterial{Rgb(1)}};
  return scene;
}

Mesh cuboid(const DVec3& low, const DVec3& high) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

// Between two planes of x, one unit wide.
Mesh block(double low, double high) { return cuboid({low, -0.5, -0.5}, {high, 0.5, 0.5}); }

Mesh joined(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const Triangle& t : mesh.triangles)
      all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

// Bodies of cloudy glass in a white surround.
Scene glass(const std::vector<Mesh>& meshes) {
  Scene scene = white_ball();
  scene.camera = {{3, 1, 1}, {0, 0, 0}, {0, 1, 0}, 30, {}};
  scene.materials[0] = {"glass",
                        TranslucentMaterial{{Rgb(3), Rgb(Real(0.7)), 0}, Boundary::dielectric, 1.5, 0}};
  scene.objects.clear();
  for (const Mesh& mesh : meshes)
    scene.objects.push_back({"block", std::make_shared<const Mesh>(mesh), 0, {}});
  return scene;
}

Film rendered(const Scene& scene, WalkCode code, std::uint64_t spp, std::uint64_t seed = 0) {
  Job job;
  job.seed = seed;
  job.threads = 1;
  job.walk = code;
  job.scene = std::make_shared<const Scene>(scene);
  job.geometry = std::make_shared<const Geometry>(*job.scene, 1);
  const std::atomic<bool> stop{false};
  return render(job, {spp, {}, {}}, stop, [](const Rendering&) {}).film;
}

// By rays alone: no light is sampled, and no pixel, ball or channel is chosen but by the path itself.
Film found(const Scene& scene, std::uint32_t spp) {
  const Geometry geometry(scene, 1);
  const CameraRays camera = make_camera_rays(scene.camera, scene.film.width, scene.film.height);
  PathOptions options;
  options.chromatic = true;
  options.sample_lights = false;
  Film film(scene.film.width, scene.film.height);
  PathTracer<Geometry> tracer(scene, geometry, options);
  for (std::uint32_t i = 0; i < film.pixels.size(); ++i) {
    const int x = static_cast<int>(i) % film.width;
    const int y = static_cast<int>(i) / film.width;
    for (std::uint32_t k = 0; k < spp; ++k) {
      Random random = stream(77, i, k);
      const double u = random.next();
      const double v = random.next();
      RadianceSink sink;
      if (tracer.trace(camera.at((x + u) / film.width, (y + v) / film.height), random, sink))
        film.pixels[i].add(sink.radiance);
    }
  }
  return film;
}

void compare(Verdict& v, const Film& film, const Film& truth) {
  const ZTest z = z_test(resolve(film), resolve(truth), {}, {1e-5});
  v.require("p of single pixels", z.pixels_p, 1e-5, 1);
  v.require("p of blocks", z.block_p, 1e-5, 1);
  v.require("p of the picture", z.image_p, 1e-5, 1);
}

void compare(Verdict& v, const Scene& scene, WalkCode code) {
  compare(v, rendered(scene, code, 600), found(scene, 1500));
}

void picture_lit(Verdict& v, WalkCode code) { compare(v, lit_ball(), code); }
void picture_fog(Verdict& v, WalkCode code) { compare(v, lamp_over_fog(), code); }
void picture_outline(Verdict& v, WalkCode code) { compare(v, glowing_ball(), code); }

// Two blocks that touch are the same whether they are one mesh or two. The thin one keeps light from the
// thick one where it is reflected totally.
void picture_touching(Verdict& v, WalkCode code) {
  const Mesh thin = block(0, 0.1);
  const Mesh both = joined({block(-1, 0), thin});
  compare(v, rendered(glass({both}), code, 2000), rendered(glass({block(-1, 0), thin}), code, 2000, 1));
}

// Eight matched blocks that meet in a point are the same as the cube that they make: who has left one is
// inside of the second, which he leaves before he enters the third.
void picture_divided(Verdict& v, WalkCode code) {
  std::vector<Mesh> blocks;
  const DVec3 middle(0.1, 0.2, -0.15);
  for (int i = 0; i < 8; ++i) {
    const DVec3 corner(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    blocks.push_back(cuboid(glm::min(corner, middle), glm::max(corner, middle)));
  }
  Scene eight = lamp_over_fog();
  eight.camera.look_from = {4, 3, 5};
  eight.materials[0] = {"fog", TranslucentMaterial{{Rgb(2), Rgb(Real(0.9)), 0}, Boundary::matched}};
  eight.objects[0].transform.rotate = {20, 30, 10};  // so that walls at one place are met in either order
  Scene one = eight;
  eight.objects[0].shape = std::make_shared<const Mesh>(joined(blocks));
  one.objects[0].shape = std::make_shared<const Mesh>(cuboid(DVec3(-1), DVec3(1)));
  compare(v, rendered(eight, code, 5000), rendered(one, code, 5000, 1));
}

// A white body in a white surround vanishes.
void picture_furnace(Verdict& v, WalkCode code) {
  const Film film = rendered(white_ball(), code, 600);
  for (std::size_t c = 0; c < 3; ++c) {
    double mean = 0;
    double variance = 0;
    for (const Pixel& pixel : film.pixels) {
      mean += pixel.mean[c];
      variance += pixel.variance_of_mean()[c];
    }
    const auto n = static_cast<double>(film.pixels.size());
    v.score("mean", mean / n, 1, std::sqrt(variance) / n);
  }
}

constexpr Oracle kOracles[]{{"picture_lit", picture_lit},         {"picture_fog", picture_fog},
                            {"picture_outline", picture_outline}, {"picture_touching", picture_touching},
                            {"picture_divided", picture_divided}, {"picture_furnace", picture_furnace}};

}  // namespace

int main(int argc, char** argv) { return answer(kOracles, argc, argv); }
