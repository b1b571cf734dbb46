#include "render/session.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "core/timer.h"
#include "render/first_hits.h"
#include "render/live_image.h"
#include "render/small_scene.h"

using namespace meander;

namespace {

using namespace std::chrono_literals;

SessionRequest request(Scene scene, std::uint64_t spp, int width = 160, int height = 96) {
  scene.film = {width, height};
  SessionRequest made;
  made.scene = std::make_shared<const Scene>(std::move(scene));
  made.budget.spp = spp;
  return made;
}

using FramePtr = std::shared_ptr<const LiveFrame>;

// Polls until a frame satisfies the test; null after a minute.
template <class F>
FramePtr wait_for(const Session& session, const F& satisfies) {
  for (const Timer timer; timer.seconds() < 60; std::this_thread::sleep_for(200us))
    if (FramePtr frame = session.latest(); frame && satisfies(*frame)) return frame;
  return nullptr;
}

FramePtr wait_complete(const Session& session, std::uint64_t generation) {
  return wait_for(session, [&](const LiveFrame& f) { return f.generation == generation && f.complete; });
}

// Every frame of a generation that polling catches, up to the complete one.
std::vector<FramePtr> collect(const Session& session, std::uint64_t generation) {
  std::vector<FramePtr> frames;
  const FramePtr last = wait_for(session, [&](const LiveFrame& frame) {
    if (frame.generation == generation && (frames.empty() || frames.back().get() != &frame))
      frames.push_back(session.latest());
    return frame.generation == generation && frame.complete;
  });
  if (last) frames.push_back(last);
  return frames;
}

bool same_film(const Film& a, const Film& b) {
  if (a.width != b.width || a.height != b.height) return false;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    if (a.pixels[i].mean != b.pixels[i].mean || a.pixels[i].m2 != b.pixels[i].m2 ||
        a.pixels[i].count != b.pixels[i].count)
      return false;
  return true;
}

Job job_of(const SessionRequest& request) {
  Job job;
  job.scene = request.scene;
  job.geometry = std::make_shared<const Geometry>(*request.scene, 2);
  job.crop = request.region;
  job.seed = request.seed;
  job.threads = 2;
  return job;
}

// A body so dense that a walk in it all but never ends.
Scene endless_scene() {
  Scene scene = mixed_scene();
  scene.materials[0] = translucent("dense", {Rgb(1000000), Rgb(1), 0}, Boundary::diffuse);
  scene.camera.look_at = {-1, 0, 0};
  return scene;
}

}  // namespace

TEST_CASE(
    "coarse images come first and get finer, then samples add up, and the film is render()'s to the byte") {
  Session session(2);
  CHECK(session.latest() == nullptr);
  CHECK_FALSE(session.working());
  SessionRequest asked = request(mixed_scene(), 6, 320, 192);
  asked.seed = 7;
  const std::uint64_t generation = session.submit(asked);
  CHECK(session.working());
  const std::vector<FramePtr> frames = collect(session, generation);
  REQUIRE(frames.size() > 2);
  CHECK(frames.front()->scale > 1);
  CHECK(std::isinf(frames.front()->noise));
  for (std::size_t i = 1; i < frames.size(); ++i) {
    CHECK(frames[i]->scale <= frames[i - 1]->scale);
    CHECK(frames[i]->spp >= frames[i - 1]->spp);
  }
  const LiveFrame& last = *frames.back();
  CHECK(last.scale == 1);
  CHECK(last.spp == 6);
  CHECK(last.area == Tile{0, 0, 320, 192});
  CHECK(last.first_image_seconds > 0);
  CHECK(last.first_image_seconds == frames.front()->first_image_seconds);
  REQUIRE_FALSE(last.history.empty());
  CHECK(last.history.back().spp == 6);
  CHECK(last.history.back().noise == last.noise);

  const Job job = job_of(asked);
  const Rendering rendered = render_spp(job, 6);
  const auto film = session.rendering(generation);
  REQUIRE(film);
  CHECK(same_film(film->film, rendered.film));
  CHECK(film->noise.noise == rendered.noise.noise);
  CHECK(last.counters.steps == rendered.counters.steps);
  CHECK(session.rendering(generation + 1) == nullptr);
  const std::atomic<bool> stop{false};
  const Image normals = first_hits(job, stop).normals;
  const FilmPlanes planes = resolve_planes(rendered.film, &normals);
  CHECK(last.planes.radiance.values == planes.radiance.values);
  CHECK(last.planes.error.values == planes.error.values);
  CHECK(last.planes.features.values == planes.features.values);
  CHECK_FALSE(session.working());
}

TEST_CASE("a coarse image's pixels average the film's pixels that they stand for, up to the noise") {
  Job job = job_of(request(mixed_scene(), 1, 101, 61));
  const Rendering fine = render_spp(job, 16);
  job.scale = 8;
  const Rendering coarse = render_spp(job, 256);
  REQUIRE(coarse.film.width == 13);
  REQUIRE(coarse.film.height == 8);
  double chi = 0;
  int terms = 0;
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 12; ++x) {
      double mean = 0;
      double variance = 0;
      for (int i = 0; i < 64; ++i) {
        const Pixel& pixel = fine.film.at(8 * x + i % 8, 8 * y + i / 8);
        mean += pixel.mean[1] / 64;
        variance += pixel.variance_of_mean()[1] / 64 / 64;
      }
      const Pixel& pixel = coarse.film.at(x, y);
      const double sigma2 = variance + pixel.variance_of_mean()[1];
      if (sigma2 < 1e-12) continue;
      chi += (mean - pixel.mean[1]) * (mean - pixel.mean[1]) / sigma2;
      ++terms;
    }
  }
  REQUIRE(terms > 50);
  CHECK(chi / terms < 2);  // 1 expected; a shift by half a coarse pixel gives 10 and more
}

TEST_CASE("a storm of submits never shows an older generation and ends with the last one's image") {
  Session session(2);
  Random random = stream(3, 0, 0);
  std::uint64_t shown = 0;
  SessionRequest asked;
  std::uint64_t generation = 0;
  for (int i = 0; i < 500; ++i) {
    Scene scene = mixed_scene();
    scene.environment.radiance = Rgb(random.next());
    asked = request(std::move(scene), 1 + i % 3, 40 + i % 90, 30 + i % 70);
    asked.interactive = i % 5 == 0 && i != 499;
    generation = session.submit(asked);
    CHECK(generation == static_cast<std::uint64_t>(i) + 1);
    std::this_thread::sleep_for(std::chrono::microseconds(static_cast<int>(random.next() * 4000)));
    const FramePtr frame = session.latest();
    if (shown > 0) REQUIRE(frame);
    if (!frame) continue;
    CHECK(frame->generation >= shown);
    shown = frame->generation;
  }
  REQUIRE(wait_complete(session, generation));
  const auto film = session.rendering(generation);
  REQUIRE(film);
  CHECK(same_film(film->film, render_spp(job_of(asked), 1 + 499 % 3).film));
  CHECK_FALSE(session.take_error());
}

TEST_CASE("submits faster than one image do not starve the display") {
  Session session(2);
  std::uint64_t shown = 0;
  int images = 0;
  for (const Timer timer; timer.seconds() < 1.5; std::this_thread::sleep_for(2ms)) {
    SessionRequest asked = request(mixed_scene(), 1000, 960, 540);
    asked.interactive = true;
    (void)session.submit(std::move(asked));
    const FramePtr frame = session.latest();
    if (!frame || frame->generation == shown) continue;
    shown = frame->generation;
    ++images;
  }
  CHECK(images >= 5);  // on a machine that does other things too; see the benchmark for the speed
}

TEST_CASE("a pause keeps the film, and the session goes on from it") {
  Session session(2);
  const SessionRequest asked = request(mixed_scene(), 100000);
  const std::uint64_t generation = session.submit(asked);
  REQUIRE(wait_for(session, [](const LiveFrame& f) { return f.spp >= 2; }));
  session.set_paused(true);
  for (const Timer timer; session.working() && timer.seconds() < 60;) std::this_thread::sleep_for(1ms);
  CHECK_FALSE(session.working());
  const std::uint64_t held = session.rendering(generation)->spp;
  std::this_thread::sleep_for(60ms);
  CHECK(session.rendering(generation)->spp == held);

  // An edit while paused shows its coarse images, and waits.
  const std::uint64_t edited = session.submit(request(mixed_scene(), 4, 480, 288));
  CHECK(wait_for(session, [&](const LiveFrame& f) { return f.generation == edited && f.scale == 2; }));
  for (const Timer timer; session.working() && timer.seconds() < 60;) std::this_thread::sleep_for(1ms);
  CHECK(session.latest()->scale == 2);
  CHECK(session.rendering(edited) == nullptr);
  // One that is too small for coarse images shows its first sample.
  const std::uint64_t small = session.submit(request(mixed_scene(), 4, 20, 20));
  CHECK(wait_for(session, [&](const LiveFrame& f) { return f.generation == small; }));
  for (const Timer timer; session.working() && timer.seconds() < 60;) std::this_thread::sleep_for(1ms);
  CHECK(session.latest()->spp == 1);
  session.set_paused(false);
  REQUIRE(wait_complete(session, small));
  CHECK(session.latest()->spp == 4);
}

TEST_CASE("under a pause every film shows something of an edit, also one too small for coarse images") {
  Session session(2);
  session.set_paused(true);
  for (const auto& [width, height] : {std::pair{16, 9}, std::pair{160, 96}}) {
    const std::uint64_t generation = session.submit(request(mixed_scene(), 1000000, width, height));
    CHECK(wait_for(session, [&](const LiveFrame& f) { return f.generation == generation; }));
    for (const Timer timer; session.working() && timer.seconds() < 60;) std::this_thread::sleep_for(1ms);
    CHECK_FALSE(session.working());
    CHECK(session.latest()->spp == 1);
  }
}

TEST_CASE("generations go on from those of the session before") {
  Session session(1, 41);
  CHECK(session.submit(request(mixed_scene(), 1, 16, 9)) == 42);
  CHECK(wait_complete(session, 42));
}

TEST_CASE("a budget that is raised goes on with the same film, and one that is lowered completes it") {
  Session session(2);
  const SessionRequest asked = request(mixed_scene(), 3);
  const std::uint64_t generation = session.submit(asked);
  REQUIRE(wait_complete(session, generation));
  session.set_budget({9, {}, {}});
  REQUIRE(wait_for(session, [](const LiveFrame& f) { return f.spp == 9 && f.complete; }));
  CHECK(session.latest()->generation == generation);
  CHECK(same_film(session.rendering(generation)->film, render_spp(job_of(asked), 9).film));
  session.set_budget({10000000, {}, {}});
  REQUIRE(wait_for(session, [](const LiveFrame& f) { return f.spp > 9 && !f.complete; }));
  session.set_budget({1, {}, {}});
  REQUIRE(wait_complete(session, generation));
  CHECK(session.latest()->spp > 9);
}

TEST_CASE("a region renders its rectangle of the film only, and coarsely what the rectangle touches") {
  Session session(2);
  SessionRequest asked = request(mixed_scene(), 4, 480, 288);
  asked.region = Tile{101, 50, 391, 240};
  const std::uint64_t generation = session.submit(asked);
  const std::vector<FramePtr> frames = collect(session, generation);
  REQUIRE(frames.size() > 1);
  for (const FramePtr& frame : frames) {
    const Tile& area = frame->area;
    CHECK(area.x0 % frame->scale == 0);
    CHECK(area.x0 <= 101);
    CHECK(area.x0 > 101 - frame->scale);
    CHECK(area.y1 >= 240);
    CHECK(area.y1 < 240 + frame->scale);
    CHECK(area.x1 - area.x0 == frame->planes.radiance.width * frame->scale);
    CHECK(area.y1 - area.y0 == frame->planes.features.height * frame->scale);
    CHECK(frame->film_width == 480);
  }
  CHECK(frames.front()->scale > 1);
  CHECK(frames.back()->area == *asked.region);
  CHECK(same_film(session.rendering(generation)->film, render_spp(job_of(asked), 4).film));
}

TEST_CASE("what goes wrong is kept for the caller, and the session takes the next request") {
  Session session(2);
  (void)session.submit(request(mixed_scene(), 1, 1 << 24, 1 << 24));
  std::optional<std::string> error;
  for (const Timer timer; !error && timer.seconds() < 60; std::this_thread::sleep_for(1ms))
    error = session.take_error();
  REQUIRE(error);
  CHECK(error->find("the film needs") != std::string::npos);
  CHECK_FALSE(session.take_error());
  CHECK(session.latest() == nullptr);
  CHECK(wait_complete(session, session.submit(request(mixed_scene(), 2))));
}

TEST_CASE("walks without end hold up neither the next request nor the end of the session") {
  const Timer whole;
  {
    Session session(2);
    (void)session.submit(request(endless_scene(), 100));
    std::this_thread::sleep_for(50ms);
    const std::uint64_t generation = session.submit(request(mixed_scene(), 2));
    const FramePtr frame = wait_complete(session, generation);
    REQUIRE(frame);
    CHECK(frame->waited_seconds < 2);
    (void)session.submit(request(endless_scene(), 100));
    std::this_thread::sleep_for(50ms);
  }
  CHECK(whole.seconds() < 30);
}

TEST_CASE("under a drag only coarse images are made, and the session rests after them") {
  Session session(2);
  SessionRequest asked = request(mixed_scene(), 100, 960, 540);
  asked.interactive = true;
  const std::uint64_t generation = session.submit(std::move(asked));
  REQUIRE(wait_for(session, [&](const LiveFrame& f) { return f.generation == generation; }));
  for (const Timer timer; session.working() && timer.seconds() < 60;) std::this_thread::sleep_for(1ms);
  CHECK_FALSE(session.working());
  CHECK(session.latest()->spp == 1);
  CHECK_FALSE(session.latest()->complete);
  CHECK(session.rendering(generation) == nullptr);
}

TEST_CASE("the first image is as coarse as its cost demands") {
  CHECK(coarse_scale(960 * 540, 3e-6, 0.025) == 8);
  CHECK(coarse_scale(960 * 540, 0.7e-6, 0.025) == 4);
  CHECK(coarse_scale(100, 1e-6, 0.025) == 1);
  CHECK(coarse_scale(960 * 540, 1, 0.025) == 64);
}

TEST_CASE("first hits are kept for scenes that show the same surfaces alone") {
  const Scene scene = mixed_scene();
  Scene edited = scene;
  edited.materials[0] = translucent("jade", {Rgb(1), Rgb(1), 0}, Boundary::diffuse);
  edited.lights.clear();
  CHECK(same_first_hits(scene, edited));
  edited.camera.look_from.x += 1;
  CHECK_FALSE(same_first_hits(scene, edited));
  edited = scene;
  edited.objects[1].transform.translate.x += 0.1;
  CHECK_FALSE(same_first_hits(scene, edited));
  edited = scene;
  edited.materials[2] = edited.materials[0];  // the ground becomes an object
  CHECK_FALSE(same_first_hits(scene, edited));
}
