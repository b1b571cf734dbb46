// The live session's latencies, as JSON: how long an edit takes to show, how long a stop takes, how many
// images a second a drag shows, and what the walkers leave to a thread that draws. Never a test: timings are
// for reading.   session_bench SCENE.toml [SECTION…]
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "core/timer.h"
#include "io/scene_file.h"
#include "render/session.h"

using namespace meander;

namespace {

using namespace std::chrono_literals;

constexpr int kThreads = 2;

void sleep_seconds(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

// Milliseconds, sorted on the way in.
struct Distribution {
  std::vector<double> values;

  explicit Distribution(std::vector<double> seconds) : values(std::move(seconds)) {
    std::sort(values.begin(), values.end());
  }
  [[nodiscard]] double at(double quantile) const {
    return 1e3 * values[static_cast<std::size_t>(quantile * static_cast<double>(values.size() - 1) + 0.5)];
  }
  void print(const char* name) const {
    std::printf(
        "\"%s\": {\"min_ms\": %.2f, \"median_ms\": %.2f, \"p95_ms\": %.2f, \"max_ms\": %.2f, \"count\": "
        "%zu},\n",
        name, at(0), at(0.5), at(0.95), at(1), values.size());
    std::fflush(stdout);
  }
};

SessionRequest request_of(const Scene& scene) {
  SessionRequest request;
  request.scene = std::make_shared<const Scene>(scene);
  return request;
}

// The i-th edit of a colour slider.
Scene edited(const Scene& scene, int i) {
  Scene copy = scene;
  for (Material& material : copy.materials)
    if (auto* body = std::get_if<TranslucentMaterial>(&material.kind))
      body->medium.albedo *= Rgb(Real(1 - 0.0005 * (i % 7)));
  return copy;
}

Scene dense(const Scene& scene) {
  Scene copy = scene;
  for (Material& material : copy.materials)
    if (auto* body = std::get_if<TranslucentMaterial>(&material.kind))
      body->medium = {Rgb(1000), Rgb(Real(0.9999)), 0};
  return copy;
}

std::shared_ptr<const LiveFrame> wait_for_generation(const Session& session, std::uint64_t generation) {
  for (;;) {
    const auto frame = session.latest();
    if (frame && frame->generation >= generation) return frame;
    std::this_thread::sleep_for(100us);
  }
}

// Edits while the full-resolution passes run: when the new image is there, and how long the stop took.
void measure_edits(const Scene& scene, int count, double pause, const std::string& name) {
  Session session(kThreads);
  (void)wait_for_generation(session, session.submit(request_of(scene)));
  std::vector<double> first;
  std::vector<double> stops;
  std::vector<double> scales;
  for (int i = 0; i < count; ++i) {
    sleep_seconds(pause * (1 + 0.37 * (i % 5)));
    const Timer timer;
    const auto frame = wait_for_generation(session, session.submit(request_of(edited(scene, i))));
    first.push_back(timer.seconds());
    stops.push_back(frame->waited_seconds);
    scales.push_back(frame->scale);
  }
  Distribution(std::move(first)).print((name + "_edit_to_image").c_str());
  Distribution(std::move(stops)).print((name + "_stop").c_str());
  std::printf("\"%s_scale_median\": %.0f,\n", name.c_str(), Distribution(std::move(scales)).at(0.5) / 1e3);
}

// A submit every 16 ms for some seconds, the camera going round.
void measure_drag(const Scene& scene) {
  Session session(kThreads);
  (void)wait_for_generation(session, session.submit(request_of(scene)));
  sleep_seconds(1);
  constexpr double kSeconds = 5;
  int images = 0;
  std::uint64_t shown = session.latest()->generation;
  std::vector<double> ages;
  double next = 0;
  const DVec3 arm = scene.camera.look_from - scene.camera.look_at;
  for (const Timer timer; timer.seconds() < kSeconds; std::this_thread::sleep_for(500us)) {
    if (timer.seconds() >= next) {
      Scene turned = scene;
      const double a = 0.5 * timer.seconds();
      turned.camera.look_from = scene.camera.look_at + DVec3(std::cos(a) * arm.x + std::sin(a) * arm.z, arm.y,
                                                             std::cos(a) * arm.z - std::sin(a) * arm.x);
      SessionRequest request = request_of(turned);
      request.interactive = true;
      (void)session.submit(std::move(request));
      next += 0.016;
    }
    const auto frame = session.latest();
    if (frame->generation == shown) continue;
    shown = frame->generation;
    ages.push_back(frame->first_image_seconds);
    ++images;
  }
  std::printf("\"drag_images_per_second\": %.1f,\n\"drag_scale\": %d,\n", images / kSeconds,
              session.latest()->scale);
  Distribution(std::move(ages)).print("drag_submit_to_image");
}

// The relative noise of one sample a pixel at each coarse scale, and what the image costs.
void measure_coarse(const Scene& scene) {
  Job job;
  job.scene = std::make_shared<const Scene>(scene);
  job.geometry = std::make_shared<const Geometry>(scene, kThreads);
  job.threads = kThreads;
  const std::atomic<bool> stop{false};
  for (const int scale : {32, 16, 8, 4, 2, 1}) {
    job.scale = scale;
    const std::uint64_t spp = scale > 2 ? 64 : 4;
    const Rendering rendering = render(job, {spp, {}, {}}, stop, [](const Rendering&) {});
    const double samples = static_cast<double>(spp);
    std::printf("\"scale_%d\": {\"noise_1spp\": %.3f, \"ms_per_spp\": %.2f},\n", scale,
                rendering.noise.noise * std::sqrt(samples), 1e3 * rendering.seconds / samples);
  }
}

void measure_geometry(const Scene& scene) {
  const Timer fresh;
  const Geometry geometry(scene, kThreads);
  std::printf("\"geometry_fresh_ms\": %.2f,\n", 1e3 * fresh.seconds());
  std::vector<double> seconds;
  for (int i = 0; i < 50; ++i) {
    const Scene scene_i = edited(scene, i);
    const Timer timer;
    const Geometry again(scene_i, kThreads, &geometry);
    seconds.push_back(timer.seconds());
  }
  Distribution(std::move(seconds)).print("geometry_edit");
}

void burn(double seconds) {
  const auto used = [] {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  for (const double end = used() + seconds; used() < end;) {
  }
}

// How many frames a second a program draws that needs 8 ms of each of `drawers` threads and sleeps 1 ms,
// while all cores work at that priority.
double frames_beside(Priority priority, int drawers) {
  std::atomic<bool> done{false};
  std::thread work([&] {
    while (!done)
      parallel_for(
          kThreads, 200, [&](std::size_t) { burn(0.0005); }, priority);
  });
  sleep_seconds(0.2);
  int frames = 0;
  const Timer timer;
  for (; timer.seconds() < 2; ++frames) {
    sleep_seconds(0.001);
    std::vector<std::future<void>> helpers;
    for (int i = 1; i < drawers; ++i) helpers.push_back(std::async(std::launch::async, [] { burn(0.008); }));
    burn(0.008);
  }
  const double rate = frames / timer.seconds();
  done = true;
  work.join();
  return rate;
}

void measure_priority() {
  for (const int drawers : {1, 2}) {
    // Niceness stays with TBB's threads: the normal case is measured first, by threads of its own.
    if (drawers == 1) {
      std::printf("\"drawn_beside_normal_1\": %.1f,\n", frames_beside(Priority::normal, 1));
      std::printf("\"drawn_beside_normal_2\": %.1f,\n", frames_beside(Priority::normal, 2));
    }
    std::printf("\"drawn_beside_background_%d\": %.1f,\n", drawers,
                frames_beside(Priority::background, drawers));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const Timer start;
  const Scene scene = load_scene(argv[1], {}).scene;
  const double loaded = start.seconds();
  {
    Session session(kThreads);
    (void)wait_for_generation(session, session.submit(request_of(scene)));
    std::printf("{\"load_ms\": %.1f,\n\"start_to_image_ms\": %.1f,\n", 1e3 * loaded, 1e3 * start.seconds());
  }
  const std::vector<std::string> sections(argv + 2, argv + argc);
  const auto wanted = [&](const char* section) {
    return sections.empty() || std::find(sections.begin(), sections.end(), section) != sections.end();
  };
  if (wanted("priority")) measure_priority();
  if (wanted("geometry")) measure_geometry(scene);
  if (wanted("edits")) measure_edits(scene, 50, 0.4, "default");
  if (wanted("stops")) measure_edits(scene, 200, 0.07, "default_stops");
  if (wanted("stops")) measure_edits(dense(scene), 200, 0.07, "dense_stops");
  if (wanted("drag")) measure_drag(scene);
  if (wanted("coarse")) measure_coarse(scene);
  std::printf("\"threads\": %d}\n", kThreads);
  return 0;
}
