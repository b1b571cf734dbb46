// What the previewer holds that is no picture: the scene under edit and how it is looked at.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/edit_history.h"
#include "display/views.h"
#include "film/plan.h"
#include "render/progressive.h"
#include "scene/scene.h"
#include "ui/models.h"
#include "walk/random_walk.h"

namespace meander {

/// How the picture is rendered; a change of it, budget and threads aside, restarts the picture.
struct PreviewSettings {
  int scale = 100;  // percent of the film's size
  int threads = 1;  // 0: all
  std::uint64_t seed = 0;
  Estimator estimator = Estimator::implicit;
  WalkCode walk = WalkCode::batch;
  InstructionSet instruction_set = instruction_sets().back();
  Budget budget;
  bool region_only = false;
};

/// How the picture is looked at; nothing of it restarts anything.
struct PreviewLook {
  View view = View::image;
  Comparison comparison = Comparison::none;
  float wipe = 0.5f;  // of the picture's width
  int a = -1;         // snapshot that is A; -1 is the live picture
  int b = -1;
  bool selecting = false;          // the next drag draws the rectangle
  std::optional<PixelBox> region;  // in film pixels at 100 %
};

/// Whether what is seen that far across the picture, of its width, is the live picture and nothing else.
[[nodiscard]] bool shows_live(const PreviewLook& look, double across);

struct PreviewState {
  static constexpr std::size_t kMostMessages = 32;

  explicit PreviewState(SceneDocument document);

  EditHistory history;
  SceneDocument original;  // as the file of history.now() was opened, or last saved
  std::shared_ptr<const Scene> original_scene;
  std::shared_ptr<const Scene> scene;  // of history.now(), at 100 %
  std::vector<std::string> warnings;   // of its reading
  PreviewSettings settings;
  PreviewLook look;
  std::string material;  // the selected one
  BrowserModel browser;
  std::vector<Message> messages;
  std::uint64_t next_message = 1;
  bool quit = false;
  std::map<std::string, SceneDocument> settled;  // by path: what each file said last, see settle
  /// Edits of the command line, made again whenever the file that they were given for is read again, until it
  /// is saved with them in it.
  struct {
    std::string path;
    std::vector<std::string> edits;
  } asked;

  /// Errors stay until they are dismissed, the newest kMostMessages of them all.
  void tell(MessageKind kind, std::string text, std::vector<std::string> details = {}) {
    if (messages.size() >= kMostMessages) messages.erase(messages.begin());
    messages.push_back({next_message++, kind, std::move(text), std::move(details), 0});
  }
  /// Takes back the message of that number, if it is still there.
  void withdraw(std::uint64_t id) {
    std::erase_if(messages, [id](const Message& message) { return message.id == id; });
  }
  /// Makes this document the one under edit, as a step of undo. Error when it does not read any more.
  void change(SceneDocument next);
  /// Takes history.now() for what its file says: after opening, saving and reading again.
  void settle();
  /// Resolves history.now() anew: after undo and redo, which may lead to another file, and when files have
  /// changed. Selects a material that is there.
  void resolve();
};

/// The film of a scene at a percentage of its size, at least one pixel.
[[nodiscard]] FilmSize scaled_film(const FilmSize& film, int percent);

/// A box at 100 % as the box of whole pixels that it touches on a film at that percentage.
[[nodiscard]] PixelBox scaled_box(const PixelBox& box, const FilmSize& film, int percent);

}  // namespace meander
