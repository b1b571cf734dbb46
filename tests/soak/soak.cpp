#include "soak/soak.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/error.h"
#include "ui/layout.h"

namespace meander {
namespace {

constexpr int kLeastSeconds = 10;  // of processor time, all threads together
constexpr int kAttempts = 3;       // at a picture that is not replaced while it is looked at
constexpr double kAlike = 0.75;    // of the film's pixels: messages and handles lie over some

void write_at_once(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

std::string text_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The part of the pixels within the placement whose levels agree within one.
double likeness(const Image8& a, const Image8& b, const FilmPlacement& film) {
  const auto x0 = static_cast<int>(std::ceil(film.x));
  const auto y0 = static_cast<int>(std::ceil(film.y));
  const auto x1 = static_cast<int>(film.x + film.width);
  const auto y1 = static_cast<int>(film.y + film.height);
  std::size_t alike = 0;
  std::size_t all = 0;
  for (int y = std::max(y0, 0); y < std::min(y1, a.height); ++y) {
    for (int x = std::max(x0, 0); x < std::min(x1, a.width); ++x) {
      bool same = true;
      for (int c = 0; c < 3; ++c) same = same && std::abs(a.at(x, y)[c] - b.at(x, y)[c]) <= 1;
      alike += same;
      ++all;
    }
  }
  return all == 0 ? 1 : static_cast<double>(alike) / static_cast<double>(all);
}

}  // namespace

// False when it does not come about within kMostFrames, unless the process had hardly any processor.
template <class Done>
bool Soak::wait_until(const Done& done) {
  const std::clock_t begin = std::clock();
  for (int frames = 0; frames <= kMostFrames || std::clock() - begin < kLeastSeconds * CLOCKS_PER_SEC;
       ++frames) {
    if (done()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    storm_.frame();
    longest_wait = std::max(longest_wait, frames);
  }
  return false;
}

void Soak::await_current() {
  CHECK(wait_until([&] { return storm_.previewer().first_image_seconds().has_value(); }));
}

// The scene as it is, one value changed, as an editor beside the previewer would save it.
std::string Soak::edited_text() {
  SceneDocument document = state().history.now();
  const double value = 0.05 * whole(1, 20);
  document.apply("camera.vertical_fov=" + std::to_string(20 + 40 * value));
  if (!state().material.empty())
    document.apply("material." + state().material + ".g=" + std::to_string(value - 0.5));
  return document.text();
}

// Saved whole, broken, or in two halves with frames between, now and then as soon as it was opened; in the
// end it is whole and what is shown.
void Soak::rewrite_scene() {
  if (whole(0, 3) == 0)
    storm_.carry_out(
        {CommandKind::open, 0, 0, {}, folder_.at(whole(0, 1) == 0 ? "scene.toml" : "other.toml")});
  const std::string path = state().history.now().path();
  if (!path.ends_with(".toml")) return;
  std::string text;
  try {
    text = edited_text();
  } catch (const Error&) {
    return;  // a medium of which no g can be set
  }
  if (text == text_of(path)) return;  // no change, which the previewer need not notice
  const int kind = whole(0, 2);
  CAPTURE(path);
  CAPTURE(kind);
  if (kind == 1) {
    storm_.settle();
    const std::string before = state().history.now().text();
    write_at_once(path, "[camera\n" + text);
    const auto told = [&] {
      return std::any_of(state().messages.begin(), state().messages.end(), [&](const Message& message) {
        return message.kind == MessageKind::error && message.text.starts_with(path);
      });
    };
    CHECK(wait_until(told));
    CHECK(state().history.now().text() == before);
  }
  if (kind == 2) {
    write_at_once(path, text.substr(0, text.size() / 2));
    for (int i = whole(1, 80); i > 0; --i) storm_.frame();
  }
  write_at_once(path, text);
  const bool read = wait_until([&] { return state().history.now().text() == text; });
  CAPTURE(text);
  CAPTURE(state().history.now().path());
  CAPTURE(state().history.now().text());
  CHECK(read);
  ++reloads;
}

// The mesh that may have been dropped on the window: another size, or cut off for a while.
void Soak::rewrite_mesh() {
  const std::string path = folder_.at("tetra.obj");
  const std::string size = std::to_string(whole(1, 9));
  const std::string text =
      "v 0 0 0\nv " + size + " 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
  if (whole(0, 1) == 0) {
    write_at_once(path, text.substr(0, 20));
    for (int i = whole(1, 80); i > 0; --i) storm_.frame();
  }
  write_at_once(path, text);
  for (int i = 0; i < 60; ++i) {  // more than two looks at the files
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    storm_.frame();
  }
  ++reloads;
}

void Soak::step() {
  const int kind = ++steps_ == 2 ? 0 : whole(0, 39);
  if (kind < 2) {
    rewrite_scene();
  } else if (kind == 2) {
    rewrite_mesh();
  } else {
    storm_.step();
  }
  await_current();
}

// No comparison, no snapshot and no message over it.
void Soak::show_live_picture() {
  using enum CommandKind;
  const PreviewLook& look = state().look;
  if (look.comparison == Comparison::only_b) storm_.carry_out({swap_ab, 0, 0, {}, {}});
  if (look.comparison == Comparison::wipe) storm_.carry_out({wipe, 0, 0, {}, {}});
  if (look.comparison == Comparison::difference) storm_.carry_out({difference, 0, 0, {}, {}});
  while (!storm_.previewer().pictures().snapshots().empty()) storm_.carry_out({drop_snapshot, 0, 0, {}, {}});
  while (!state().messages.empty())
    storm_.carry_out({dismiss, static_cast<std::int64_t>(state().messages.front().id), 0, {}, {}});
  storm_.carry_out({set_a, -1, 0, {}, {}});
  storm_.carry_out({set_b, -1, 0, {}, {}});
  for (int i = 0; i < 4; ++i) storm_.frame();
}

// What the window shows against what a display that has shown nothing before makes of the same frame, and,
// to see that the comparison can tell, of the frame of the time before.
void Soak::check_screen(const std::shared_ptr<const LiveFrame>& frame) {
  const Image8 shown = storm_.screen();
  const Scene& scene = *state().scene;
  const auto drawn_alike = [&](const std::shared_ptr<const LiveFrame>& picture) {
    double best = 0;
    for (const bool hidden : {false, true}) {
      const Area& area =
          layout_of(static_cast<float>(storm_.width()), static_cast<float>(storm_.height()), hidden).image;
      const Region room{static_cast<int>(std::ceil(area.x)), static_cast<int>(std::ceil(area.y)),
                        static_cast<int>(area.width), static_cast<int>(area.height)};
      const FilmPlacement film = fitted(scene.film.width, scene.film.height, room);
      PreviewPictures fresh(storm_.gl());
      (void)fresh.take(picture);
      Framebuffer target(storm_.gl(), storm_.width(), storm_.height());
      target.bind(storm_.width(), storm_.height());
      fresh.draw(state().look, scene.display, {film, room, storm_.width(), storm_.height()});
      best = std::max(best, likeness(shown, target.read(storm_.width(), storm_.height()), film));
    }
    return best;
  };
  const double alike = drawn_alike(frame);
  CHECK(alike >= kAlike);
  ++screens;
  if (state().look.view != View::image || !before_ || before_ == frame) return;
  ++compared;
  told_apart += drawn_alike(before_) < kAlike;
}

// In the view that is set, and as the image, by which pictures differ more than by their samples.
// False when a file was reloaded meanwhile: there is another picture then.
bool Soak::check_screens(const std::shared_ptr<const LiveFrame>& frame) {
  const View view = state().look.view;
  if (view != View::image) check_screen(frame);
  storm_.carry_out({CommandKind::view, static_cast<std::int64_t>(View::image), 0, {}, {}});
  for (int i = 0; i < 2; ++i) storm_.frame();
  const bool stays = storm_.previewer().pictures().newest() == frame;
  if (stays) check_screen(frame);
  storm_.carry_out({CommandKind::view, static_cast<std::int64_t>(view), 0, {}, {}});
  if (stays) before_ = frame;
  return stays;
}

bool Soak::verified() {
  storm_.calm_down();
  storm_.resize(960, 540);  // room for a picture beside panels
  show_live_picture();
  const std::shared_ptr<const LiveFrame> frame = storm_.previewer().pictures().newest();
  REQUIRE(frame);
  if (storm_.previewer().spp() != 8) return false;  // likewise
  const FilmPlanes fresh = fresh_planes(state(), 8);
  CAPTURE(state().history.now().text());
  CAPTURE(frame->generation);
  CHECK(frame->planes.radiance.values == fresh.radiance.values);
  CHECK(frame->planes.error.values == fresh.error.values);
  CHECK(frame->planes.features.values == fresh.features.values);
  ++pictures;
  return state().settings.region_only || check_screens(frame);
}

void Soak::verify() {
  bool done = false;
  for (int attempt = 0; attempt < kAttempts && !done; ++attempt) done = verified();
  REQUIRE(done);
}

}  // namespace meander
