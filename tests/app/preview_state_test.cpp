#include "app/preview_state.h"

#include <doctest/doctest.h>

using namespace meander;

TEST_CASE("a pixel is read only where the live picture is seen") {
  PreviewLook look;
  CHECK(shows_live(look, 0.9));
  look.b = 0;
  look.comparison = Comparison::wipe;
  look.wipe = 0.6f;
  CHECK(shows_live(look, 0.5));
  CHECK_FALSE(shows_live(look, 0.7));
  look.a = 1;
  look.b = -1;
  CHECK_FALSE(shows_live(look, 0.5));
  CHECK(shows_live(look, 0.7));
  look.comparison = Comparison::only_b;
  CHECK(shows_live(look, 0.5));
  look.comparison = Comparison::difference;
  CHECK_FALSE(shows_live(look, 0.5));
}

TEST_CASE("the selected material is that of the first translucent object, else the first translucent one") {
  const std::string wax = "[[material]]\nname = \"wax\"\ncolor = 0.8\nradius = 0.1\n";
  const std::string jade = "[[material]]\nname = \"jade\"\npreset = \"marble\"\n";
  const std::string grey = "[[material]]\nname = \"grey\"\ntype = \"diffuse\"\ncolor = 0.5\n";
  const auto selected = [&](const std::string& object_of) {
    const std::string object =
        "[[object]]\nname = \"ball\"\nshape = \"sphere\"\nmaterial = \"" + object_of + "\"\n";
    return PreviewState(
               SceneDocument::from_text(grey + wax + jade + (object_of.empty() ? "" : object), "s.toml"))
        .material;
  };
  CHECK(selected("jade") == "jade");
  CHECK(selected("grey") == "wax");
  CHECK(selected("") == "wax");
  CHECK(PreviewState(SceneDocument::from_text(grey, "s.toml")).material.empty());
}

TEST_CASE("messages that nobody dismisses do not pile up") {
  PreviewState state(SceneDocument::from_text("", "s.toml"));
  for (int i = 0; i < 1000; ++i) state.tell(MessageKind::error, "error " + std::to_string(i));
  REQUIRE(state.messages.size() == PreviewState::kMostMessages);
  CHECK(state.messages.back().text == "error 999");
  CHECK(state.messages.back().id == 1000);
}
