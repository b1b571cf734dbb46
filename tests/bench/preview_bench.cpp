// The previewer's own speed, off-screen with software OpenGL at 1280 x 720: from an edit to the first new
// picture drawn, pictures a second under a camera drag, frames a second of the interface while all threads
// trace. The noise reached stands beside. Never a test: timings are for reading.
//   preview_bench [SCENE] [EDITS]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "app/previewer.h"
#include "core/timer.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "render/parallel.h"

using namespace meander;

namespace {

constexpr int kWidth = 1280;
constexpr int kHeight = 720;

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

void report(const char* what, const std::vector<double>& milliseconds) {
  std::printf("%-46s median %7.1f ms   p95 %7.1f ms   max %7.1f ms   of %zu\n", what,
              quantile(milliseconds, 0.5), quantile(milliseconds, 0.95), quantile(milliseconds, 1),
              milliseconds.size());
}

class Bench {
 public:
  explicit Bench(const std::string& scene)
      : context_(1, 1),
        target_(context_.functions(), kWidth, kHeight),
        previewer_(context_.functions(), SceneDocument::open(scene), options(), 1) {}

  void draw() {
    target_.bind(kWidth, kHeight);
    FrameShape shape;
    shape.pixels_wide = kWidth;
    shape.pixels_high = kHeight;
    previewer_.draw(shape);
    context_.functions().finish();
  }
  // As the window's loop does it, for some seconds. Returns the frames drawn.
  int run(double seconds, bool always_draw) {
    const Timer timer;
    int frames = 0;
    while (timer.seconds() < seconds) {
      if (previewer_.update(clock_.seconds()) || always_draw) {
        draw();
        ++frames;
      } else {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    return frames;
  }
  // Milliseconds from an edit until its first picture has been drawn.
  double edit(const std::string& text) {
    const Timer timer;
    previewer_.apply(text);
    for (;;) {
      const bool due = previewer_.update(clock_.seconds());
      if (due) draw();
      if (due && previewer_.first_image_seconds()) return 1000 * timer.seconds();
      if (!due) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void send(InputKind kind, double x, double y, bool down) {
    InputEvent event;
    event.kind = kind;
    event.x = x;
    event.y = y;
    event.down = down;
    previewer_.feed(event);
  }
  [[nodiscard]] const Previewer& previewer() const { return previewer_; }

 private:
  static PreviewOptions options() {
    PreviewOptions options;
    options.settings.threads = hardware_threads();
    options.watches_files = false;
    return options;
  }

  Timer clock_;
  Offscreen context_;
  Framebuffer target_;
  Previewer previewer_;
};

void edits(Bench& bench, int count) {
  std::vector<double> colours;
  std::vector<double> lights;
  for (int i = 0; i < count; ++i) {
    const double red = 0.5 + 0.4 * ((7 * i) % 10) / 10;
    colours.push_back(bench.edit("material.wax.color=[" + std::to_string(red) + ", 0.66, 0.36]"));
    bench.run(0.4, false);  // the full-resolution passes are under way again
    lights.push_back(bench.edit("light.key.radiance=" + std::to_string(1 + i % 7)));
    bench.run(0.4, false);
  }
  report("edit of a colour to its first picture", colours);
  report("edit of a light to its first picture", lights);
}

void drag(Bench& bench) {
  bench.send(InputKind::move, 450, 330, false);
  bench.run(0.1, true);
  bench.send(InputKind::button, 450, 330, true);
  constexpr double kSeconds = 4;
  const Timer timer;
  std::uint64_t pictures = 0;
  int frames = 0;
  int moves = 0;
  std::shared_ptr<const LiveFrame> last;
  while (timer.seconds() < kSeconds) {
    ++moves;
    bench.send(InputKind::move, 450 + 100 * std::sin(0.02 * moves), 330 + 30 * std::cos(0.03 * moves), false);
    frames += bench.run(0.016, false);
    const auto& newest = bench.previewer().pictures().newest();
    pictures += newest != last;
    last = newest;
  }
  bench.send(InputKind::button, 450, 330, false);
  std::printf("camera drag: %.1f new pictures and %.1f frames a second, at a scale of 1/%d\n",
              static_cast<double>(pictures) / kSeconds, frames / kSeconds, last ? last->scale : 0);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string scene = argc > 1 ? argv[1] : MEANDER_SOURCE_DIR "/scenes/wax_knot.toml";
  const int count = argc > 2 ? std::atoi(argv[2]) : 50;
  const Timer timer;
  Bench bench(scene);
  while (!bench.previewer().first_image_seconds()) bench.run(0.002, false);
  std::printf("%s, %d threads\nstart to the first picture: %.0f ms\n", scene.c_str(), hardware_threads(),
              1000 * timer.seconds());
  bench.run(2, false);
  edits(bench, count);
  drag(bench);
  bench.run(1, false);
  const int frames = bench.run(3, true);
  const auto& newest = bench.previewer().pictures().newest();
  std::printf(
      "interface while all threads trace: %.1f frames a second; the picture then: %llu spp, noise %.0f %%\n",
      frames / 3.0, static_cast<unsigned long long>(newest->spp), 100 * newest->noise);
  return 0;
}
