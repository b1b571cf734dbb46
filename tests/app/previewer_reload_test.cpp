// Which of what changes on disk the previewer reads again, and which edits it keeps.
#include "app/preview_desk.h"
#include "app/previewer.h"

namespace meander {
namespace {

constexpr double kFrame = 0.02;  // seconds, as the previewer is told and as they pass

std::string scene_text(int fov, const std::string& more = "") {
  return "[film]\nwidth = 8\nheight = 8\n\n[camera]\nlook_from = [0, 0, 5]\nvertical_fov = " +
         std::to_string(fov) + "\n\n[[material]]\nname = \"wax\"\nalbedo = 0.5\nmean_free_path = 1\n" + more;
}

std::string with_mesh(int fov) {
  return scene_text(fov, "\n[[object]]\nname = \"body\"\nmesh = \"body.obj\"\nmaterial = \"wax\"\n");
}

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

// A previewer whose time goes on only as it is watched.
class Watched {
 public:
  explicit Watched(SceneDocument document, std::vector<std::string> edits = {})
      : previewer_(context_.functions(), std::move(document), options(std::move(edits)), 1) {}

  [[nodiscard]] int fov() const {
    return static_cast<int>(previewer_.state().scene->camera.vertical_fov + 0.5);
  }
  // Whether the previewer comes to have this field of view.
  [[nodiscard]] bool comes_to(int wanted) {
    for (int i = 0; i < 100 && fov() != wanted; ++i) pass(kFrame);
    return fov() == wanted;
  }
  void pass(double seconds) {
    for (double end = now_ + seconds; now_ < end; now_ += kFrame) {
      (void)previewer_.update(now_);
      std::this_thread::sleep_for(std::chrono::duration<double>(kFrame));
    }
  }
  void drop(const std::string& path) {
    InputEvent event;
    event.kind = InputKind::drop;
    event.paths = {path};
    previewer_.feed(event);
  }
  [[nodiscard]] bool tells(const std::string& text) const {
    for (const Message& message : previewer_.state().messages)
      if (message.text.find(text) != std::string::npos) return true;
    return false;
  }
  Previewer* operator->() { return &previewer_; }

 private:
  static PreviewOptions options(std::vector<std::string> edits) {
    PreviewOptions options;
    options.edits = std::move(edits);
    options.settings.budget.spp = 1;
    return options;
  }
  Offscreen context_{1, 1};
  Previewer previewer_;
  double now_ = 0;
};

// Files that have rested.
void write_settled(const Folder& folder, const char* name, const std::string& text) {
  folder.write(name, text);
  fs::last_write_time(folder.at(name), fs::file_time_type::clock::now() - std::chrono::seconds(10));
}

}  // namespace

TEST_CASE("a scene that is written again as soon as it was opened is read again") {
  const Folder folder;
  write_settled(folder, "a.toml", scene_text(20));
  write_settled(folder, "b.toml", scene_text(30));
  SceneDocument document = SceneDocument::open(folder.at("a.toml"));
  folder.write("a.toml", scene_text(21));
  Watched previewer(std::move(document));
  CHECK(previewer.comes_to(21));
  previewer.drop(folder.at("b.toml"));
  CHECK(previewer.fov() == 30);
  folder.write("b.toml", scene_text(31));
  CHECK(previewer.comes_to(31));
  // Back to the scene before, whose change was not watched.
  folder.write("a.toml", scene_text(22));
  for (int i = 0; i < 2; ++i) previewer->carry_out({CommandKind::undo, 0, 0, {}, {}});
  CHECK(previewer.fov() == 21);
  CHECK(previewer.comes_to(22));
}

TEST_CASE("a scene that was edited elsewhere as it was here is read when it goes back to what it was") {
  const Folder folder;
  write_settled(folder, "a.toml", scene_text(20));
  Watched previewer(SceneDocument::open(folder.at("a.toml")));
  previewer->apply("camera.vertical_fov=30");
  CHECK(previewer->title().starts_with("*"));
  folder.write("a.toml", previewer->state().history.now().text());
  previewer.pass(1);
  CHECK(previewer.fov() == 30);
  CHECK_FALSE(previewer->title().starts_with("*"));  // the file says so too
  folder.write("a.toml", scene_text(20));
  CHECK(previewer.comes_to(20));
}

TEST_CASE(
    "edits stay when the file they were made to is written with its same words, also after undo leads back") {
  const Folder folder;
  write_settled(folder, "a.toml", scene_text(20));
  write_settled(folder, "b.toml", scene_text(30));
  Watched previewer(SceneDocument::open(folder.at("a.toml")));
  previewer->apply("camera.vertical_fov=25");
  previewer.drop(folder.at("b.toml"));
  CHECK(previewer.fov() == 30);
  CHECK_FALSE(previewer->title().starts_with("*"));
  previewer->carry_out({CommandKind::undo, 0, 0, {}, {}});
  CHECK(previewer.fov() == 25);
  CHECK(previewer->title().starts_with("*a.toml"));
  CHECK(previewer->state().original_scene->camera.vertical_fov == 20);
  folder.write("a.toml", scene_text(20));
  previewer.pass(1);
  CHECK(previewer.fov() == 25);
  folder.write("a.toml", scene_text(21));
  CHECK(previewer.comes_to(21));
  for (const int before : {25, 20}) {
    previewer->carry_out({CommandKind::undo, 0, 0, {}, {}});
    CHECK(previewer.fov() == before);
  }
}

TEST_CASE("edits of the command line are made again to their own file, and not once they are saved in it") {
  const std::vector<std::string> edits{"camera.vertical_fov=30"};
  const Folder folder;
  write_settled(folder, "a.toml", scene_text(20));
  write_settled(folder, "b.toml", scene_text(40));
  const std::string path = folder.at("a.toml");
  Watched previewer(SceneDocument::open(path, edits), edits);
  const auto width = [&] { return previewer->state().scene->film.width; };
  const auto widened = [](int fov, int film) {
    std::string text = scene_text(fov);
    text.replace(text.find("width = 8"), 9, "width = " + std::to_string(film));
    return text;
  };
  folder.write("a.toml", widened(20, 9));
  previewer.pass(1);
  CHECK(width() == 9);
  CHECK(previewer.fov() == 30);
  // Another program writes what is shown.
  previewer->apply("camera.vertical_fov=25");
  folder.write("a.toml", previewer->state().history.now().text());
  previewer.pass(1);
  CHECK(previewer.fov() == 25);
  CHECK_FALSE(previewer->title().starts_with("*"));
  // Not to another file.
  previewer.drop(folder.at("b.toml"));
  folder.write("b.toml", scene_text(41));
  CHECK(previewer.comes_to(41));
  previewer->carry_out({CommandKind::undo, 0, 0, {}, {}});
  previewer->carry_out({CommandKind::undo, 0, 0, {}, {}});
  CHECK(previewer.fov() == 25);
  // Saved, they are the file's.
  previewer->apply("camera.vertical_fov=26");
  previewer->carry_out({CommandKind::save, 0, 0, {}, {}});
  folder.write("a.toml", widened(26, 10));
  previewer.pass(1);
  CHECK(width() == 10);
  CHECK(previewer.fov() == 26);
}

TEST_CASE("what others write over a saved scene is read, and what was saved here is not") {
  const Folder folder;
  write_settled(folder, "a.toml", scene_text(20));
  Watched previewer(SceneDocument::open(folder.at("a.toml")));
  previewer->apply("camera.vertical_fov=30");
  previewer->carry_out({CommandKind::save, 0, 0, {}, {}});
  const auto saved = fs::last_write_time(folder.at("a.toml"));
  const std::string text = previewer->state().history.now().text();
  previewer->apply("camera.vertical_fov=40");
  previewer.pass(1);
  CHECK(previewer.fov() == 40);
  // The same words again are no change either.
  folder.write("a.toml", text);
  previewer.pass(1);
  CHECK(previewer.fov() == 40);
  previewer->carry_out({CommandKind::save, 0, 0, {}, {}});
  CHECK(fs::last_write_time(folder.at("a.toml")) > saved);
  // Within the same step of the clock, and of one size.
  std::string other = previewer->state().history.now().text();
  const auto time = fs::last_write_time(folder.at("a.toml"));
  other.replace(other.find("= 40"), 4, "= 50");
  folder.write("a.toml", other);
  fs::last_write_time(folder.at("a.toml"), time);
  CHECK(previewer.comes_to(50));
  // Asked for, the file counts.
  previewer->apply("camera.vertical_fov=60");
  previewer->carry_out({CommandKind::reload, 0, 0, {}, {}});
  CHECK(previewer.fov() == 50);
}

TEST_CASE("a scene with comments, saved beside itself, is still watched") {
  const Folder folder;
  write_settled(folder, "a.toml", scene_text(20, "# of the wax\n"));
  Watched previewer(SceneDocument::open(folder.at("a.toml")));
  previewer->apply("camera.vertical_fov=30");
  folder.write("a.toml", scene_text(40, "# of the wax\n"));
  previewer->carry_out({CommandKind::save, 0, 0, {}, {}});
  CHECK(fs::exists(folder.at("a-look.toml")));
  CHECK(previewer.comes_to(40));
}

TEST_CASE("a scene that names a mesh which is not there yet is read when it is") {
  const Folder folder;
  write_settled(folder, "a.toml", scene_text(20));
  Watched previewer(SceneDocument::open(folder.at("a.toml")));
  folder.write("a.toml", with_mesh(30));
  previewer.pass(1);
  CHECK(previewer.fov() == 20);
  CHECK(previewer.tells("body.obj"));
  folder.write("body.obj", kTetrahedron.substr(0, 20));
  previewer.pass(1);
  CHECK(previewer.tells("body.obj"));
  folder.write("body.obj", kTetrahedron);
  CHECK(previewer.comes_to(30));
  CHECK_FALSE(previewer.tells("body.obj"));
}

TEST_CASE("a mesh that breaks before its picture is there is an error that is told, and ends nothing") {
  const Folder folder;
  write_settled(folder, "scene.toml", with_mesh(40));
  write_settled(folder, "body.obj", kTetrahedron);
  Watched previewer(SceneDocument::open(folder.at("scene.toml")));
  folder.write("body.obj", "v 0 0 0\n");
  CHECK_NOTHROW(previewer.pass(1));
  CHECK(previewer.tells("body.obj"));
  CHECK(previewer->first_image_seconds().has_value());
}

}  // namespace meander
