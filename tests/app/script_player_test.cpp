#include "app/script_player.h"

#include <doctest/doctest.h>

#include "core/error.h"

using namespace meander;

namespace {

// Writes down what a script does to it.
struct Witness {
  std::vector<std::string> told;
  std::vector<InputEvent> events;
  bool image = true;
  bool ends = false;  // nothing is rendered any more
  std::uint64_t samples = 0;

  ScriptStage stage() {
    ScriptStage stage;
    stage.apply = [this](const std::string& edit) {
      if (edit == "refused") throw Error(Fault::input, "no such thing");
      told.push_back("set " + edit);
    };
    stage.feed = [this](const InputEvent& event) {
      told.emplace_back("event");
      events.push_back(event);
    };
    stage.shows_edits = [this] { return image; };
    stage.spp = [this] { return samples; };
    if (ends) stage.idle = [] { return true; };
    stage.write_snapshot = [this](const std::string& path) { told.push_back("snapshot " + path); };
    stage.resize = [this](int width, int height) {
      told.push_back("size " + std::to_string(width) + ' ' + std::to_string(height));
    };
    stage.quit = [this] { told.emplace_back("quit"); };
    return stage;
  }
};

using Told = std::vector<std::string>;

ScriptPlayer player(const std::string& text) { return {parse_script(text, "s.txt"), "s.txt"}; }

}  // namespace

TEST_CASE("a frame takes any number of edits, but one event") {
  Witness witness;
  ScriptPlayer script = player("set a\nset b\nkey F\nset c\nsize 9 8\nquit\n");
  const ScriptStage stage = witness.stage();
  script.play(stage, 0);
  CHECK(witness.told == Told{"set a", "set b", "event"});
  script.play(stage, 0);
  CHECK(witness.told.size() == 4);
  script.play(stage, 0);
  CHECK(witness.told.back() == "size 9 8");
  CHECK_FALSE(script.done());
  script.play(stage, 0);
  CHECK(witness.told.back() == "quit");
  CHECK(script.done());
}

TEST_CASE("waits hold what comes after them") {
  Witness witness;
  witness.image = false;
  ScriptPlayer script = player("wait-image\nset a\nwait-spp 16\nset b\nwait 2\nset c\n");
  const ScriptStage stage = witness.stage();
  script.play(stage, 0);
  CHECK(witness.told.empty());
  witness.image = true;
  witness.samples = 15;
  script.play(stage, 1);
  CHECK(witness.told == Told{"set a"});
  witness.samples = 16;
  script.play(stage, 10);
  CHECK(witness.told == Told{"set a", "set b"});
  script.play(stage, 11.9);
  CHECK(witness.told.size() == 2);
  script.play(stage, 12);
  CHECK(witness.told.back() == "set c");
}

TEST_CASE("a snapshot waits for three frames after the step before it") {
  Witness witness;
  ScriptPlayer script = player("set a\nsnapshot x.png\n");
  const ScriptStage stage = witness.stage();
  for (int frame = 1; frame <= 4; ++frame) {
    CHECK(witness.told.size() == (frame > 1 ? 1 : 0));
    script.play(stage, frame);
  }
  CHECK(witness.told == Told{"set a", "snapshot x.png"});
}

TEST_CASE("a wait for a picture lets the interface take the click before it") {
  for (const char* wait : {"wait-image", "wait-spp 4"}) {
    Witness witness;
    witness.samples = 16;
    ScriptPlayer script = player("click 10 10\n" + std::string(wait) + "\nset a\n");
    const ScriptStage stage = witness.stage();
    while (witness.events.size() < 3) script.play(stage, 0);
    script.play(stage, 0);
    CHECK(witness.told.back() == "event");  // the old picture does not end it
    witness.image = false;                  // by now the click has changed the scene
    witness.samples = 0;
    for (int frame = 0; frame < 9; ++frame) script.play(stage, 0);
    CHECK(witness.told.back() == "event");
    witness.image = true;
    witness.samples = 4;
    script.play(stage, 0);
    CHECK(witness.told.back() == "set a");
  }
}

TEST_CASE("buttons and drops are where the pointer is") {
  Witness witness;
  ScriptPlayer script = player("click 30 40\ndrag left 1 2 61 82\nmove 7 8\npress right\ndrop a.png\n");
  while (!script.done()) script.play(witness.stage(), 0);
  const std::vector<InputEvent>& events = witness.events;
  REQUIRE(events.size() == 3 + 15 + 3);
  const auto is_at = [&](std::size_t i, double x, double y) { return events[i].x == x && events[i].y == y; };
  CHECK(is_at(1, 30, 40));
  CHECK(is_at(2, 30, 40));
  CHECK(is_at(4, 1, 2));
  CHECK(is_at(17, 61, 82));
  CHECK(is_at(19, 7, 8));
  CHECK(is_at(20, 7, 8));
}

TEST_CASE("a wait that would never end is an error, but only where no user can end it") {
  for (const char* text : {"set a\nwait-spp 8\n", "set a\nwait-image\n"}) {
    Witness witness;
    witness.image = false;
    const auto wait = [&] {
      ScriptPlayer script = player(text);
      for (int frame = 0; frame < 1000; ++frame) script.play(witness.stage(), frame);
    };
    CHECK_NOTHROW(wait());
    witness.ends = true;
    CHECK_THROWS_WITH_AS(wait(), doctest::Contains("s.txt:2: "), Error);
  }
}

TEST_CASE("a refused edit is an error with the script's line") {
  Witness witness;
  ScriptPlayer script = player("set a\n\nset refused\n");
  try {
    script.play(witness.stage(), 0);
    FAIL("nothing was refused");
  } catch (const Error& error) {
    CHECK(std::string(error.what()) == "s.txt:3: no such thing");
    CHECK(error.exit_code() == 2);
  }
}
