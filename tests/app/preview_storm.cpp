// A storm over the previewer, off-screen: hundreds of edits, keys, drags, drops and resizes in a row, in an
// order that a seed decides. Run it under the sanitizers too.
#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "app/previewer.h"
#include "core/error.h"
#include "core/timer.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "gl/state.h"
#include "io/image_file.h"
#include "medium/presets.h"
#include "render/first_hits.h"

using namespace meander;

namespace {

namespace fs = std::filesystem;

constexpr std::uint8_t kBackdrop = 27;  // around the picture

// The default scene with a small film, and files to drop, in a folder of their own: the storm saves, too.
class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("meander-storm-" + std::to_string(getpid()))) {
    fs::create_directory(path_);
    const fs::path scenes = fs::path(MEANDER_SOURCE_DIR) / "scenes";
    SceneDocument document = SceneDocument::open((scenes / "wax_knot.toml").string());
    document.apply("film.width=64");
    document.apply("film.height=36");
    std::ofstream(at("scene.toml")) << document.text();
    std::ofstream(at("other.toml")) << document.text() << "\n[display]\nexposure = 0.5\n";
    std::ofstream(at("broken.toml")) << "[camera\n";
    std::ofstream(at("notes.txt")) << "nothing for a previewer\n";
    std::ofstream(at("empty.ply"));
    std::ofstream(at("tetra.obj"))
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    std::ofstream(at("open.obj")) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
    Image light(16, 8, 3);
    for (std::size_t i = 0; i < light.values.size(); ++i)
      light.values[i] = 0.1f + 0.01f * static_cast<float>(i % 97);
    const std::array<std::string, 3> names{"R", "G", "B"};
    write_exr(at("light.exr"), light, names, {});
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string at(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

PreviewOptions storm_options() {
  PreviewOptions options;
  options.settings.threads = 2;
  options.settings.budget.spp = 8;
  return options;
}

class Storm {
 public:
  Storm(const Folder& folder, unsigned seed)
      : folder_(folder),
        random_(seed),
        context_(1, 1),
        previewer_(context_.functions(), SceneDocument::open(folder.at("scene.toml")), storm_options(), 1) {
    resize(320, 240);
  }

  void step();
  void frame();
  void await_picture();
  void calm_down();
  [[nodiscard]] const Previewer& previewer() const { return previewer_; }
  int refused = 0;   // edits that no scene allows
  int pictures = 0;  // frames that showed another picture than the frame before

 private:
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 8) / (1 << 24);
  }
  int whole(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
  }
  template <std::size_t N>
  std::string one_of(const std::array<std::string_view, N>& words) {
    return std::string(words[static_cast<std::size_t>(whole(0, N - 1))]);
  }
  std::string rgb(double low, double high);
  std::string a_material_edit();
  std::string an_edit();
  Command a_command();
  void edit();
  void key();
  void click(int times);
  void drag();
  void wheel();
  void drop();
  void undo_run();
  void resize(int width, int height);
  void send(InputKind kind, double x, double y, int code = 0, bool down = false, Modifiers modifiers = {});
  void check_picture(const Image8& shown) const;

  const Folder& folder_;
  std::mt19937 random_;
  Offscreen context_;
  Previewer previewer_;
  std::unique_ptr<Framebuffer> target_;
  int width_ = 0;
  int height_ = 0;
  Timer timer_;
  std::uint64_t generation_ = 0;
  const LiveFrame* last_ = nullptr;
};

void Storm::send(InputKind kind, double x, double y, int code, bool down, Modifiers modifiers) {
  InputEvent event;
  event.kind = kind;
  event.x = x;
  event.y = y;
  event.code = code;
  event.down = down;
  event.modifiers = modifiers;
  previewer_.feed(event);
}

void Storm::resize(int width, int height) {
  target_ = std::make_unique<Framebuffer>(context_.functions(), width, height);
  width_ = width;
  height_ = height;
  send(InputKind::redraw, 0, 0);
}

std::string Storm::rgb(double low, double high) {
  std::string text = "[";
  for (int c = 0; c < 3; ++c) text += (c > 0 ? ", " : "") + std::to_string(number(low, high));
  return text + "]";
}

std::string Storm::a_material_edit() {
  constexpr std::array<std::string_view, 3> kBoundaries{"matched", "diffuse", "dielectric"};
  constexpr std::array<std::string_view, 3> kLocks{"look", "sigma_t", "sigma_s_reduced"};
  const std::string path = "material." + previewer_.state().material + '.';
  switch (whole(0, 9)) {
    case 0:
      return path + "albedo=" + rgb(0, 1);
    case 1:
      return path + "mean_free_path=" + rgb(0.01, 0.4);
    case 2:
      return path + "g=" + std::to_string(number(-1.1, 1.1));
    case 3:
      return path + "boundary=" + one_of(kBoundaries);
    case 4:
      return path + "ior=" + std::to_string(number(0.9, 2));
    case 5:
      return path + "roughness=" + std::to_string(number(0, 1));
    case 6:
      return path + "preset=" + std::string(presets()[static_cast<std::size_t>(whole(0, 9))].name);
    case 7:
      return path + "sigma_s=" + rgb(0.5, 20);
    case 8:
      return path + "g_lock=" + one_of(kLocks);
    default:
      return path + "color=" + rgb(-0.05, 1.02);
  }
}

std::string Storm::an_edit() {
  switch (whole(0, 7)) {
    case 0:
      return "film.width=" + std::to_string(whole(24, 96));
    case 1:
      return "film.height=" + std::to_string(whole(16, 64));
    case 2:
      return "display.exposure=" + std::to_string(number(-2, 2));
    case 3:
      return "light.key.radiance=" + rgb(0, 40);
    case 4:
      return "camera.vertical_fov=" + std::to_string(number(10, 80));
    default:
      return a_material_edit();
  }
}

void Storm::edit() {
  const std::string text = an_edit();
  CAPTURE(text);
  try {
    previewer_.apply(text);
  } catch (const Error& error) {
    CHECK(error.exit_code() == 2);
    ++refused;
  }
}

Command Storm::a_command() {
  using enum CommandKind;
  constexpr std::array<int, 4> kScales{100, 50, 25, 100};
  const auto i = static_cast<std::size_t>(whole(0, 3));
  Command command{rig, static_cast<std::int64_t>(i), 0, {}, {}};
  switch (whole(0, 11)) {
    case 0:
      return {environment, whole(0, 2), 0, {}, {}};
    case 1:
      return {environment, 3, 0, {}, folder_.at(i < 2 ? "light.exr" : "missing.hdr")};
    case 2:
      return {render_scale, kScales[i], 0, {}, {}};
    case 3:
      return {set_region, 0, 0, {whole(0, 9), whole(0, 9), whole(10, 120), whole(10, 80)}, {}};
    case 4:
      return {region_only, whole(0, 1), 0, {}, {}};
    case 5:
      return {threads, whole(1, 3), 0, {}, {}};
    case 6:
      return {estimator, whole(0, 1), 0, {}, {}};
    case 7:
      return {camera_view, whole(0, 5), 0, {}, {}};
    case 8:
      return {save_picture, 0, 0, {}, folder_.at(i < 2 ? "out.exr" : "out.png")};
    case 9:
      return {i < 2 ? set_a : set_b, whole(-1, 3), 0, {}, {}};
    case 10:
      return {drop_snapshot, whole(0, 5), 0, {}, {}};
    default:
      return command;
  }
}

// Any key of the table but the last rows of it: Escape ends the previewer, and the file dialogs stay shut, so
// that no later click in them leaves the folder.
void Storm::key() {
  const auto rows = key_table();
  const KeyRow& row = rows[static_cast<std::size_t>(whole(0, static_cast<int>(rows.size()) - 1))];
  if (!row.chord || row.command == CommandKind::quit) return;
  const int code = whole(row.code, row.last_code);
  send(InputKind::key, 0, 0, code, true, row.modifiers);
  if (row.repeats && whole(0, 1) == 0) send(InputKind::key, 0, 0, code, true, row.modifiers);
  frame();
  send(InputKind::key, 0, 0, code, false, row.modifiers);
}

void Storm::click(int times) {
  // Twice only over the panel, where nothing opens a file.
  const double x = times == 1 ? number(0, width_) : number(std::max(width_ - 280, 0), width_);
  const double y = times == 1 ? number(0, height_) : number(60, std::max(height_, 61));
  send(InputKind::move, x, y);
  frame();
  Modifiers modifiers;
  modifiers.control = whole(0, 5) == 0;
  for (int i = 0; i < times; ++i) {
    send(InputKind::button, x, y, whole(0, 9) == 0 ? 1 : 0, true, modifiers);
    frame();
    for (const int button : {0, 1}) send(InputKind::button, x, y, button, false, modifiers);
  }
  if (!modifiers.control) return;
  frame();  // a number, where a field took the click
  for (const char c : std::to_string(number(-2, 2))) {
    InputEvent event;
    event.kind = InputKind::text;
    event.character = static_cast<char32_t>(c);
    previewer_.feed(event);
  }
  for (const bool down : {true, false}) send(InputKind::key, 0, 0, key::kEnter, down);
}

void Storm::drag() {
  double x = number(0, width_);
  double y = number(0, height_);
  const int button = whole(0, 2);
  Modifiers modifiers;
  modifiers.shift = whole(0, 2) == 0;
  const bool light = whole(0, 3) == 0;
  if (light) send(InputKind::key, 0, 0, 'L', true);
  send(InputKind::move, x, y);
  frame();
  send(InputKind::button, x, y, button, true, modifiers);
  for (int i = whole(1, 8); i > 0; --i) {
    x += number(-60, 60);
    y += number(-60, 60);
    send(InputKind::move, x, y);
    if (whole(0, 1) == 0) frame();
    if (whole(0, 15) == 0) undo_run();
  }
  send(InputKind::button, x, y, button, false, modifiers);
  if (light) send(InputKind::key, 0, 0, 'L', false);
}

void Storm::wheel() {
  send(InputKind::move, number(0, width_), number(0, height_));
  frame();
  send(InputKind::scroll, 0, whole(-3, 3));
}

void Storm::drop() {
  constexpr std::array<std::string_view, 9> kFiles{"other.toml", "broken.toml", "notes.txt",
                                                   "empty.ply",  "tetra.obj",   "open.obj",
                                                   "light.exr",  "scene.toml",  "missing.ply"};
  InputEvent event;
  event.kind = InputKind::drop;
  event.x = number(0, width_);
  event.y = number(0, height_);
  event.paths = {folder_.at(one_of(kFiles))};
  if (whole(0, 3) == 0) event.paths.push_back(folder_.at(one_of(kFiles)));
  previewer_.feed(event);
}

void Storm::undo_run() {
  const CommandKind kind = whole(0, 2) == 0 ? CommandKind::redo : CommandKind::undo;
  for (int i = whole(1, 12); i > 0; --i) previewer_.carry_out({kind, 0, 0, {}, {}});
}

void Storm::step() {
  const int kind = whole(0, 19);
  if (kind < 6) {
    edit();
  } else if (kind < 9) {
    key();
  } else if (kind < 11) {
    drag();
  } else if (kind < 14) {
    click(whole(1, 2));
  } else if (kind == 14) {
    wheel();
  } else if (kind == 15) {
    drop();
  } else if (kind == 16) {
    undo_run();
  } else if (kind == 17) {
    const bool large = whole(0, 9) == 0;
    resize(whole(64, large ? 1600 : 700), whole(64, large ? 900 : 500));
  } else {
    previewer_.carry_out(a_command());
  }
  frame();
  // Shuts a dialog; with none open it would end the previewer, which is not asked here.
  for (const bool down : {true, false}) send(InputKind::key, 0, 0, key::kEscape, down);
  frame();
  if (whole(0, 2) == 0) await_picture();
}

// Every state shows its first picture, also a paused one.
void Storm::await_picture() {
  const Timer timer;
  while (!previewer_.first_image_seconds() && timer.seconds() < 60) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    frame();
  }
  CHECK(previewer_.first_image_seconds().has_value());
}

// The picture lies in the middle of the image area, whatever its shape; or in that of the whole window.
void Storm::check_picture(const Image8& shown) const {
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
  CHECK(drawn > 0);
}

void Storm::frame() {
  (void)previewer_.update(timer_.seconds());
  target_->bind(width_, height_);
  FrameShape shape;
  shape.pixels_wide = width_;
  shape.pixels_high = height_;
  previewer_.draw(shape);
  CHECK(context_.functions().get_error() == GL_NO_ERROR);
  const auto& newest = previewer_.pictures().newest();
  if (!newest) return;
  CHECK(newest->generation >= generation_);
  generation_ = newest->generation;
  pictures += newest.get() != last_;
  last_ = newest.get();
  if (previewer_.pictures().live()) check_picture(target_->read(width_, height_));
}

// Lets go of everything and waits for the picture of all that was asked.
void Storm::calm_down() {
  for (int button = 0; button < 3; ++button) send(InputKind::button, 0, 0, button, false);
  send(InputKind::focus, 0, 0, 0, false);
  resize(320, 240);
  previewer_.carry_out({CommandKind::budget_noise, 0, 0, {}, {}});
  previewer_.carry_out({CommandKind::budget_seconds, 0, 0, {}, {}});
  previewer_.carry_out({CommandKind::budget_spp, 8, 0, {}, {}});
  const Timer timer;
  while (timer.seconds() < 300) {
    frame();
    if (previewer_.spp() == 8) return;
    const bool paused = previewer_.idle() && timer.seconds() > 2;
    if (paused) {
      previewer_.carry_out({CommandKind::pause, 0, 0, {}, {}});
      for (int i = 0; i < 200 && previewer_.idle(); ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

// The picture of the previewer's state, rendered at once.
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

unsigned seed_of_run() {
  const char* asked = std::getenv("MEANDER_STORM_SEED");
  return asked == nullptr ? 1u : static_cast<unsigned>(std::atoi(asked));
}

int steps_of_run() {
  const char* asked = std::getenv("MEANDER_STORM_STEPS");
  return asked == nullptr ? 500 : std::atoi(asked);
}

}  // namespace

TEST_CASE(
    "after a storm of edits and resizes the picture is that of the last state, and none was lost on the "
    "way") {
  const Folder folder;
  Storm storm(folder, seed_of_run());
  for (int i = 0; i < steps_of_run(); ++i) {
    CAPTURE(i);
    REQUIRE_NOTHROW(storm.step());
  }
  storm.calm_down();
  const auto& frame = storm.previewer().pictures().newest();
  REQUIRE(frame);
  REQUIRE(storm.previewer().spp() == 8);
  CHECK(storm.pictures > steps_of_run() / 10);
  const FilmPlanes fresh = fresh_planes(storm.previewer().state(), 8);
  CHECK(frame->planes.radiance.values == fresh.radiance.values);
  CHECK(frame->planes.error.values == fresh.error.values);
  CHECK(frame->planes.features.values == fresh.features.values);
  MESSAGE(storm.pictures << " pictures, " << storm.refused << " edits refused");
}
