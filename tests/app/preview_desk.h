// What commands of the previewer work on, off-screen: a small film that has been rendered.
#pragma once

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include "app/preview_commands.h"
#include "core/error.h"
#include "core/timer.h"
#include "gl/offscreen.h"
#include "support/temporary_folder.h"

namespace meander {

namespace fs = std::filesystem;
using Folder = TemporaryFolder;

inline const std::string kKnot = std::string(MEANDER_SOURCE_DIR) + "/scenes/wax_knot.toml";

struct Desk {
  explicit Desk(const std::string& path) : state(small(path)), pictures(context.functions()) { render(); }

  [[nodiscard]] static SceneDocument small(const std::string& path) {
    SceneDocument document = SceneDocument::open(path);
    document.apply("film.width=32");
    document.apply("film.height=18");
    return document;
  }
  // Traces what the state is now, to four samples a pixel.
  void render() {
    SessionRequest request;
    request.scene = state.scene;
    request.budget.spp = 4;
    generation = session.submit(std::move(request));
    for (const Timer timer; timer.seconds() < 60; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      (void)pictures.take(session.latest());
      const auto& frame = pictures.newest();
      if (frame && frame->generation == generation && frame->complete) return;
    }
    FAIL("no picture");
  }
  [[nodiscard]] PreviewTools tools() {
    return {context.functions(), state, pictures, session, generation, clipboard};
  }
  void carry_out(CommandKind kind, std::int64_t index = 0, const std::string& text = {}) {
    PreviewTools all = tools();
    meander::carry_out(all, {kind, index, 0, {}, text});
  }
  [[nodiscard]] const SceneDocument& now() const { return state.history.now(); }

  Offscreen context{1, 1};
  PreviewState state;
  PreviewPictures pictures;
  Session session{2};
  std::uint64_t generation = 0;
  std::string copied;
  ClipboardAccess clipboard{[this] { return copied; }, [this](const std::string& text) { copied = text; }};
};

}  // namespace meander
