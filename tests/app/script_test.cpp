#include "app/script.h"

#include <doctest/doctest.h>

#include "core/error.h"

using namespace meander;

namespace {

std::string error_of(const std::string& text) {
  try {
    (void)parse_script(text, "s.txt");
  } catch (const Error& error) {
    CHECK(error.exit_code() == 2);
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a script is a list of steps with their lines") {
  const auto script = parse_script(
      "# a comment\n"
      "set material.wax.color=[0.8, 0.3, 0.2]   \n"
      "\n"
      "wait-spp 16 # and another\n"
      "wait 0.5\n"
      "size 960 540\n"
      "snapshot out file.PNG\n"
      "quit\n",
      "s.txt");
  REQUIRE(script.size() == 6);
  CHECK(std::get<SetStep>(script[0].step).edit == "material.wax.color=[0.8, 0.3, 0.2]");
  CHECK(script[0].line == 2);
  CHECK(std::get<WaitSppStep>(script[1].step).spp == 16);
  CHECK(std::get<WaitStep>(script[2].step).seconds == 0.5);
  CHECK(std::get<SizeStep>(script[3].step).width == 960);
  CHECK(std::get<SnapshotStep>(script[4].step).path == "out file.PNG");
  CHECK(std::holds_alternative<QuitStep>(script[5].step));
}

TEST_CASE("keys are pressed with their modifiers, and all are released") {
  const auto script = parse_script("key Ctrl+Shift+z\nkey F12\nkey ?\nkey space\nkey +", "s.txt");
  REQUIRE(script.size() == 10);
  const InputEvent& undo = std::get<EventStep>(script[0].step).event;
  CHECK(undo.code == 'Z');
  CHECK(undo.down);
  CHECK(undo.modifiers == Modifiers{true, true, false, false});
  CHECK_FALSE(std::get<EventStep>(script[1].step).event.down);
  CHECK(std::get<EventStep>(script[1].step).event.modifiers == Modifiers{});
  CHECK(std::get<EventStep>(script[2].step).event.code == key::kF12);
  CHECK(std::get<EventStep>(script[4].step).event.code == '?');
  CHECK(std::get<EventStep>(script[6].step).event.code == key::kSpace);
  CHECK(std::get<EventStep>(script[8].step).event.code == '+');
}

TEST_CASE("a drag presses, moves to its end and releases") {
  const auto script = parse_script("drag right 10 20 110 70", "s.txt");
  REQUIRE(script.size() > 4);
  const auto event = [&](std::size_t i) { return std::get<EventStep>(script[i].step).event; };
  CHECK(event(0).x == 10);
  CHECK(event(1).kind == InputKind::button);
  CHECK(event(1).code == 1);
  CHECK(event(1).down);
  CHECK(event(script.size() - 2).x == 110);
  CHECK(event(script.size() - 2).y == 70);
  CHECK_FALSE(event(script.size() - 1).down);
}

TEST_CASE("what is wrong is named with its place") {
  CHECK(error_of("set a=b\nsnapshoot x.png") ==
        "s.txt:2:1: there is no command 'snapshoot'; did you mean 'snapshot'?");
  CHECK(error_of("wait-spp none") == "s.txt:1:10: 'none' is not a number of samples, 1 or more");
  CHECK(error_of("wait-spp 0").find("'0' is not a number") != std::string::npos);
  CHECK(error_of("wait nan").find("'nan' is not") != std::string::npos);
  CHECK(error_of("key Hyper+Z").find("'hyper' is no modifier") != std::string::npos);
  CHECK(error_of("key banana").find("'banana' is no key") != std::string::npos);
  CHECK(error_of("key F13").find("'F13' is no key") != std::string::npos);
  CHECK(error_of("move 3").find("expected a position") != std::string::npos);
  CHECK(error_of("move 3 4 5").find("'5' is more than") != std::string::npos);
  CHECK(error_of("press third").find("no mouse button") != std::string::npos);
  CHECK(error_of("snapshot x.exr").find("must end in .png") != std::string::npos);
  CHECK(error_of("set").find("expected PATH=VALUE") != std::string::npos);
}
