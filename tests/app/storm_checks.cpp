// What must hold in a storm over the previewer, in every frame and when it is over.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "app/storm.h"
#include "gl/state.h"
#include "render/first_hits.h"

namespace meander {
namespace {

constexpr std::uint8_t kBackdrop = 27;  // around the picture

}  // namespace

// Every state shows its first picture, also a paused one.
void Storm::await_picture() {
  const Timer timer;
  while (!previewer_.first_image_seconds() && timer.seconds() < 60) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    frame();
  }
  CHECK(previewer_.first_image_seconds().has_value());
}

// The picture lies in the middle of the image area, whatever its shape; or in that of the whole window. How
// many of the pixels around either differ from what is around the picture.
int Storm::count_drawn(const Image8& shown) const {
  const Area& image = layout_of(static_cast<float>(width_), static_cast<float>(height_), false).image;
  const std::array<std::array<int, 2>, 2> middles{
      {{static_cast<int>(image.x + image.width / 2), static_cast<int>(image.y + image.height / 2)},
       {width_ / 2, height_ / 2}}};
  int drawn = 0;
  for (const auto& [x, y] : middles) {
    for (int i = 0; i < 9; ++i) {
      const int px = std::clamp(x + i % 3 - 1, 0, width_ - 1);
      const int py = std::clamp(y + i / 3 - 1, 0, height_ - 1);
      const std::uint8_t* rgb =
          &shown.rgb[3 * (static_cast<std::size_t>(py) * static_cast<std::size_t>(width_) +
                          static_cast<std::size_t>(px))];
      drawn += rgb[0] != kBackdrop || rgb[1] != kBackdrop || rgb[2] != kBackdrop;
    }
  }
  return drawn;
}

// A picture may happen to have the grey of what is around it, but not in two views.
void Storm::check_picture() {
  if (count_drawn(screen()) > 0) return;
  const View view = previewer_.state().look.view;
  const auto show = [&](View wanted) {
    previewer_.carry_out({CommandKind::view, static_cast<int>(wanted), 0, {}, {}});
    draw();
  };
  show(view == View::samples ? View::normals : View::samples);
  INFO("view ", static_cast<int>(view), ", window ", width_, " x ", height_, ", film ",
       previewer_.state().scene->film.width, " x ", previewer_.state().scene->film.height, ", comparison ",
       static_cast<int>(previewer_.state().look.comparison));
  CHECK(count_drawn(screen()) > 0);
  ++grey;
  show(view);
}

void Storm::draw() {
  target_->bind(width_, height_);
  FrameShape shape;
  shape.pixels_wide = width_;
  shape.pixels_high = height_;
  previewer_.draw(shape);
}

void Storm::frame() {
  (void)previewer_.update(timer_.seconds());
  draw();
  CHECK(context_.functions().get_error() == GL_NO_ERROR);
  const auto& newest = previewer_.pictures().newest();
  if (!newest) return;
  CHECK(newest->generation >= generation_);
  generation_ = newest->generation;
  pictures += newest.get() != last_;
  last_ = newest.get();
  if (previewer_.pictures().live()) check_picture();
}

void Storm::settle() {
  for (int i = 0; i < 10; ++i) frame();
}

// Lets go of everything and waits for the picture of all that was asked.
void Storm::calm_down() {
  for (int button = 0; button < 3; ++button) send(InputKind::button, 0, 0, button, false);
  send(InputKind::focus, 0, 0, 0, false);
  resize(320, 240);
  settle();  // the last event may be one of the budget's
  previewer_.carry_out({CommandKind::budget_noise, 0, 0, {}, {}});
  previewer_.carry_out({CommandKind::budget_seconds, 0, 0, {}, {}});
  previewer_.carry_out({CommandKind::budget_spp, 8, 0, {}, {}});
  const Timer timer;
  while (timer.seconds() < 300) {
    const bool rested = previewer_.idle();  // before it looks for the newest picture
    frame();
    if (rested && previewer_.spp() == 8 && previewer_.idle()) return;
    // A picture of more samples is begun anew: a field or slider of the budget may have asked for them, or a
    // pass have been under way.
    if (previewer_.spp() > 8) {
      previewer_.carry_out({CommandKind::threads, 2, 0, {}, {}});
      for (int i = 0; i < 100 && previewer_.spp() > 8; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
        frame();
      }
    }
    const bool paused = previewer_.spp() < 8 && previewer_.idle() && timer.seconds() > 2;
    if (paused) {
      previewer_.carry_out({CommandKind::pause, 0, 0, {}, {}});
      for (int i = 0; i < 200 && previewer_.idle(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

FilmPlanes fresh_planes(const PreviewState& state, std::uint64_t spp) {
  Scene scene = state.history.now().scene().scene;
  const FilmSize film = scene.film;
  scene.film = scaled_film(film, state.settings.scale);
  Job job;
  if (state.settings.region_only && state.look.region) {
    const PixelBox box = scaled_box(*state.look.region, film, state.settings.scale);
    job.crop = Tile{box.x0, box.y0, box.x1, box.y1};
  }
  job.scene = std::make_shared<const Scene>(std::move(scene));
  job.geometry = std::make_shared<const Geometry>(*job.scene, 2);
  job.seed = state.settings.seed;
  job.estimator = state.settings.estimator;
  job.threads = 2;
  const std::atomic<bool> never{false};
  Budget budget;
  budget.spp = spp;
  const Rendering rendering = render(job, budget, never, [](const Rendering&) {});
  const Image normals = first_hits(job, never).normals;
  return resolve_planes(rendering.film, &normals);
}

}  // namespace meander
