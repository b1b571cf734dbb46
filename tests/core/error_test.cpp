#include "core/error.h"

#include <doctest/doctest.h>

#include <array>
#include <string>
#include <string_view>

#include "core/timer.h"

using meander::Error;
using meander::Fault;
using meander::list_names;
using meander::nearest_name;
using meander::Place;

namespace {
constexpr std::array<std::string_view, 5> kKeys = {"albedo", "radius", "radius_scale", "mean_free_path", "g"};
}

TEST_CASE("an error carries its line and the exit code of its fault") {
  const Error bad_input(Fault::input, "--spp is -3; it must be at least 1");
  CHECK(std::string(bad_input.what()) == "--spp is -3; it must be at least 1");
  CHECK(bad_input.exit_code() == 2);
  CHECK(Error(Fault::runtime, "out of memory").exit_code() == 3);
}

TEST_CASE("an error at a place names file, line and column, and is bad input") {
  const Error error(Place{"wax.toml", 12, 7}, "unknown key");
  CHECK(std::string(error.what()) == "wax.toml:12:7: unknown key");
  CHECK(error.exit_code() == 2);
}

TEST_CASE("an error in a file as a whole has no line, and one without a file no prefix") {
  CHECK(std::string(Error(Place{"wax.toml"}, "empty").what()) == "wax.toml: empty");
  CHECK(std::string(Error(Place{}, "empty").what()) == "empty");
}

TEST_CASE("a misspelt name suggests the name it is nearest to") {
  CHECK(nearest_name("albdeo", kKeys) == "albedo");  // two letters swapped
  CHECK(nearest_name("radiu", kKeys) == "radius");   // one missing, and not the longer radius_scale
  CHECK(nearest_name("radius_scales", kKeys) == "radius_scale");
  CHECK(nearest_name("mean_free_paht", kKeys) == "mean_free_path");
  CHECK(nearest_name("radius", kKeys) == "radius");
}

TEST_CASE("a name suggests another up to a third of its length plus one edits away, and no further") {
  constexpr std::array<std::string_view, 1> known = {"abcdef"};
  CHECK(nearest_name("abcxyz", known) == "abcdef");  // three edits, of six letters
  CHECK(nearest_name("abwxyz", known).empty());      // four
  CHECK(nearest_name("abcdef", {}).empty());
}

TEST_CASE("of two names equally near the first is suggested") {
  constexpr std::array<std::string_view, 2> known = {"sigma_s", "sigma_a"};
  CHECK(nearest_name("sigma_t", known) == "sigma_s");
}

TEST_CASE("names are listed in order, with commas between them alone") {
  CHECK(list_names(std::array<std::string_view, 3>{"matched", "diffuse", "dielectric"}) ==
        "matched, diffuse, dielectric");
  CHECK(list_names(std::array<std::string_view, 1>{"hg"}) == "hg");
  CHECK(list_names({}).empty());
}

TEST_CASE("a timer counts forward from its making") {
  const meander::Timer timer;
  const double before = timer.seconds();
  CHECK(before >= 0.0);
  double now = before;
  for (int tries = 0; now == before && tries < 100'000'000; ++tries) now = timer.seconds();
  CHECK(now > before);
  CHECK(now < 60.0);
}

TEST_CASE("an error is one line that drives no terminal, whatever it quotes") {
  CHECK(std::string(Error(Place{"a\nb.toml", 1, 2}, "unknown key '\x1b[31m\x7f\t'").what()) ==
        "a\\x0ab.toml:1:2: unknown key '\\x1b[31m\\x7f\\x09'");
  CHECK(std::string(Error(Fault::input, "no 'a\r\n\f' and no 'é'").what()) == "no 'a\\x0d\\x0a\\x0c' and no 'é'");
}
