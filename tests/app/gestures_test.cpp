#include "app/edit_history.h"

#include <doctest/doctest.h>

using namespace meander;

namespace {

const SceneDocument kSphere = SceneDocument::from_text(
    "[[material]]\nname = \"wax\"\ncolor = 0.8\nradius = 0.1\n"
    "[[object]]\nname = \"ball\"\nshape = \"sphere\"\nmaterial = \"wax\"\n",
    "ball.toml");

SceneDocument with_exposure(const SceneDocument& document, int stops) {
  SceneDocument next = document;
  next.apply("display.exposure=" + std::to_string(stops));
  return next;
}

double exposure(const EditHistory& history) { return history.now().scene().scene.display.exposure; }

// The number of steps that can be taken back.
int steps(EditHistory history) {
  int count = 0;
  while (history.undo()) ++count;
  return count;
}

void drag(EditHistory& history, int stops) {
  history.begin_gesture();
  history.change(with_exposure(history.now(), stops - 1));
  history.change(with_exposure(history.now(), stops));
  history.end_gesture();
}

}  // namespace

TEST_CASE("a drag is one step, and a drag that comes back is none") {
  EditHistory history(kSphere);
  drag(history, 3);
  CHECK(steps(history) == 1);
  drag(history, 3);
  CHECK(steps(history) == 1);
  drag(history, 5);
  CHECK(steps(history) == 2);
  CHECK(history.undo());
  CHECK(exposure(history) == 3);
  CHECK(history.redo());
  CHECK(exposure(history) == 5);
}

TEST_CASE("a resumed gesture is one step with the last, if that changed something and nothing came between") {
  EditHistory history(kSphere);
  drag(history, 3);
  history.begin_gesture();
  history.resume_gesture();
  history.change(with_exposure(history.now(), 7));
  history.end_gesture();
  CHECK(steps(history) == 1);

  history.change(with_exposure(history.now(), 8));
  history.begin_gesture();
  history.resume_gesture();
  history.change(with_exposure(history.now(), 9));
  history.end_gesture();
  CHECK(steps(history) == 3);

  history.begin_gesture();  // a click that changes nothing
  history.end_gesture();
  history.begin_gesture();
  history.resume_gesture();
  history.change(with_exposure(history.now(), 10));
  history.end_gesture();
  CHECK(steps(history) == 4);

  drag(history, 12);
  CHECK(history.undo());
  history.begin_gesture();
  history.resume_gesture();
  history.change(with_exposure(history.now(), 13));
  history.end_gesture();
  CHECK(steps(history) == 5);
}
