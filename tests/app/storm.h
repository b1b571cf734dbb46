// A storm over the previewer, off-screen: edits, keys, drags, drops and resizes in an order that a seed
// decides.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <string>

#include "app/previewer.h"
#include "core/timer.h"
#include "gl/framebuffer.h"
#include "gl/offscreen.h"
#include "io/image_file.h"
#include "support/temporary_folder.h"

namespace meander {

namespace fs = std::filesystem;

// The default scene with a small film, and files to drop, in a folder of their own: the storm saves, too.
class Folder {
 public:
  Folder() {
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
  [[nodiscard]] std::string at(const std::string& name) const { return files_.at(name); }

 private:
  TemporaryFolder files_;
};

inline PreviewOptions storm_options() {
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
  /// Frames in which what was typed, pressed or dragged last does what it does.
  void settle();
  void calm_down();
  void resize(int width, int height);
  void carry_out(const Command& command) { previewer_.carry_out(command); }
  [[nodiscard]] const Previewer& previewer() const { return previewer_; }
  [[nodiscard]] const Functions& gl() const { return context_.functions(); }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  /// What the last frame showed.
  [[nodiscard]] Image8 screen() { return target_->read(width_, height_); }
  int refused = 0;   // edits that no scene allows
  int pictures = 0;  // frames that showed another picture than the frame before
  int grey = 0;      // frames whose picture happened to be as grey as what is around it

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
  void send(InputKind kind, double x, double y, int code = 0, bool down = false, Modifiers modifiers = {});
  void draw();
  [[nodiscard]] int count_drawn(const Image8& shown) const;
  void check_picture();

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

/// The picture of the previewer's state, rendered at once.
[[nodiscard]] FilmPlanes fresh_planes(const PreviewState& state, std::uint64_t spp);

}  // namespace meander
