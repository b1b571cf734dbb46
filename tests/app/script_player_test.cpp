#include "app/script_player.h"

#include <doctest/doctest.h>

using namespace meander;

TEST_CASE("a wait for a picture lets the interface take what went before") {
  // A click changes the scene a frame after it was fed: until then the old picture is up to date.
  int frames_since_click = -1;
  bool ended = false;
  ScriptStage stage;
  stage.feed = [&](const InputEvent& event) {
    if (event.kind == InputKind::button && !event.down) frames_since_click = 0;
  };
  stage.spp = [&]() -> std::uint64_t { return frames_since_click < 2 ? 16 : 0; };
  stage.shows_edits = [&] { return frames_since_click < 2; };
  stage.quit = [&] { ended = true; };
  for (const char* wait : {"wait-spp 4", "wait-image"}) {
    frames_since_click = -1;
    ended = false;
    ScriptPlayer player(parse_script("click 10 10\n" + std::string(wait) + "\nquit", "s.txt"), "s.txt");
    for (int frame = 0; frame < 50; ++frame) {
      player.play(stage, 0.01 * frame);
      if (frames_since_click >= 0) ++frames_since_click;
    }
    CHECK(frames_since_click > 2);
    CHECK_FALSE(ended);
    CHECK_FALSE(player.done());
  }
}
