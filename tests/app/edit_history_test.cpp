#include "app/edit_history.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "app/preview_desk.h"

using namespace meander;

namespace {

SceneDocument with_width(SceneDocument document, int width) {
  document.apply("film.width=" + std::to_string(width));
  return document;
}

int width_of(const EditHistory& history) { return history.now().scene().scene.film.width; }

}  // namespace

TEST_CASE("undo and redo walk through the documents; a change drops what could be done again") {
  EditHistory history(SceneDocument::open(kKnot));
  CHECK_FALSE(history.undo());
  CHECK_FALSE(history.redo());
  for (const int width : {10, 20, 30}) history.change(with_width(history.now(), width));
  REQUIRE(history.undo());
  REQUIRE(history.undo());
  CHECK(width_of(history) == 10);
  REQUIRE(history.redo());
  CHECK(width_of(history) == 20);
  history.change(with_width(history.now(), 40));
  CHECK_FALSE(history.can_redo());
  REQUIRE(history.undo());
  CHECK(width_of(history) == 20);
  REQUIRE(history.undo());
  REQUIRE(history.undo());
  CHECK(history.now() == SceneDocument::open(kKnot));
  CHECK_FALSE(history.can_undo());
}

TEST_CASE("all changes of a gesture are one step, and an empty gesture is none") {
  EditHistory history(SceneDocument::open(kKnot));
  history.change(with_width(history.now(), 10));
  history.begin_gesture();
  history.end_gesture();
  history.begin_gesture();
  for (int width = 11; width < 40; ++width) history.change(with_width(history.now(), width));
  history.end_gesture();
  history.change(with_width(history.now(), 50));
  REQUIRE(history.undo());
  CHECK(width_of(history) == 39);
  REQUIRE(history.undo());
  CHECK(width_of(history) == 10);
  REQUIRE(history.redo());
  CHECK(width_of(history) == 39);
}

TEST_CASE("five hundred steps are kept, the newest") {
  EditHistory history(SceneDocument::open(kKnot));
  for (int width = 1; width <= 510; ++width) history.change(with_width(history.now(), width));
  int steps = 0;
  while (history.undo()) ++steps;
  CHECK(steps == 500);
  CHECK(width_of(history) == 10);
}

TEST_CASE("of a large scene as many steps are kept as 128 MiB hold") {
  std::string text = "[[material]]\nname = \"wax\"\nalbedo = 0.5\nmean_free_path = 1\n";
  for (int i = 0; i < 5000; ++i)
    text += "[[object]]\nname = \"ball" + std::to_string(i) +
            "\"\nshape = \"sphere\"\nmaterial = \"wax\"\ntransform = { scale = 0.4 }\n";
  EditHistory history(SceneDocument::from_text(text, "balls.toml"));
  const double bytes = static_cast<double>(history.now().bytes());
  const double wanted = std::floor(128 * 1048576.0 / bytes);
  REQUIRE(wanted > 5);
  REQUIRE(wanted < 40);
  for (int width = 1; width <= 50; ++width) history.change(with_width(history.now(), width));
  for (int round = 0; round < 2; ++round) {  // what was taken back and done again counts once
    int steps = 0;
    while (history.undo()) ++steps;
    CHECK(std::abs(steps - wanted) <= 1);
    CHECK(width_of(history) == 50 - steps);
    while (history.redo()) {
    }
    CHECK(width_of(history) == 50);
  }
}
