// Checkpoints: what was written comes back bit for bit, and nothing else is taken for one.
#include "io/checkpoint_file.h"

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace meander {
namespace {

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

// Values that text would lose.
Film awkward_film() {
  Film film(3, 2);
  std::uint64_t count = 0;
  for (Pixel& pixel : film.pixels) {
    pixel.mean = {1.0 / 3, std::numeric_limits<double>::denorm_min(), -0.0};
    pixel.m2 = {1e300, std::numeric_limits<double>::epsilon(), 7};
    pixel.count = (std::uint64_t{1} << 60) + ++count;
    pixel.paths = {0.1, 0.2, 0.3};
    pixel.strata[1] = {{0.1f, 0.2f, 0.3f}, 9};
  }
  return film;
}

const CheckpointFields kFields{{"version", "1.2"}, {"scene", "a scene with blanks"}, {"empty", ""}};

std::string refusal(const std::string& path) {
  try {
    (void)read_checkpoint(path);
  } catch (const Error& error) {
    CHECK(error.exit_code() == 2);
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    CHECK(message.starts_with(path + ": "));
    return message.substr(path.size() + 2);
  }
  return "";
}

std::string write_refusal(const std::string& path) {
  try {
    check_checkpoint_writable(path);
  } catch (const Error& error) {
    CHECK(error.exit_code() == 2);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a checkpoint comes back bit for bit, and the same one is the same file") {
  const TemporaryFolder folder;
  const Film film = awkward_film();
  write_checkpoint(folder.at("a"), kFields, film);
  write_checkpoint(folder.at("b"), kFields, film);
  CHECK(bytes_of(folder.at("a")) == bytes_of(folder.at("b")));
  const Checkpoint checkpoint = read_checkpoint(folder.at("a"));
  CHECK(checkpoint.fields == kFields);
  REQUIRE(checkpoint.film.width == 3);
  REQUIRE(checkpoint.film.height == 2);
  CHECK(std::memcmp(checkpoint.film.pixels.data(), film.pixels.data(), 6 * sizeof(Pixel)) == 0);
  REQUIRE(find_field(checkpoint.fields, "version"));
  CHECK(*find_field(checkpoint.fields, "version") == "1.2");
  CHECK(find_field(checkpoint.fields, "film") == nullptr);
}

TEST_CASE("a checkpoint cut short anywhere is refused, and so is one that goes on") {
  const TemporaryFolder folder;
  write_checkpoint(folder.at("a"), kFields, awkward_film());
  const std::string whole = bytes_of(folder.at("a"));
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CAPTURE(length);
    put(folder.at("cut"), whole.substr(0, length));
    REQUIRE_FALSE(refusal(folder.at("cut")).empty());
  }
  put(folder.at("cut"), whole + '\0');
  CHECK(refusal(folder.at("cut")).starts_with("is no whole checkpoint: it has "));
}

TEST_CASE("a checkpoint with any byte changed is refused") {
  const TemporaryFolder folder;
  write_checkpoint(folder.at("a"), kFields, awkward_film());
  const std::string whole = bytes_of(folder.at("a"));
  for (std::size_t place = 0; place < whole.size(); ++place)
    for (const char change : {char(1), char(-128), char(-1)}) {
      std::string bytes = whole;
      bytes[place] = static_cast<char>(bytes[place] ^ change);
      put(folder.at("changed"), bytes);
      CAPTURE(place);
      REQUIRE_FALSE(refusal(folder.at("changed")).empty());
    }
}

TEST_CASE("what is no checkpoint says so") {
  const TemporaryFolder folder;
  CHECK(refusal(folder.at("none")) == "there is no such checkpoint");
  CHECK(refusal(folder.path().string()) == "is no checkpoint: it is not a regular file");
  put(folder.at("text"), "a text\nof lines\n\n");
  CHECK(refusal(folder.at("text")) == "is no checkpoint of meander");
  put(folder.at("long"), std::string(1 << 20, 'a'));
  CHECK(refusal(folder.at("long")) == "is no checkpoint of meander");
  put(folder.at("new"), "meander checkpoint 2\nfilm 1 1\n\n");
  CHECK(refusal(folder.at("new")).starts_with("is a checkpoint of format 2, which a newer meander wrote"));
  put(folder.at("huge"), "meander checkpoint 1\nfilm 2147483647 2147483647\n\n");
  CHECK(refusal(folder.at("huge")) == "is damaged: it names a film of 4611686014132420609 pixels");
  put(folder.at("wrapped"), "meander checkpoint 1\nfilm 536870912 268435456\n\n" + std::string(16, 'a'));
  CHECK(refusal(folder.at("wrapped")) == "is damaged: it names a film of 144115188075855872 pixels");
  put(folder.at("filmless"), "meander checkpoint 1\nspp 3\n\n");
  CHECK(refusal(folder.at("filmless")) == "is damaged: it names no film");
}

TEST_CASE("a checkpoint takes the place of another, and of no other file") {
  const TemporaryFolder folder;
  CHECK(write_refusal(folder.at("a")).empty());
  write_checkpoint(folder.at("a"), kFields, awkward_film());
  CHECK(write_refusal(folder.at("a")).empty());
  put(folder.at("thesis"), "years of work");
  CHECK(write_refusal(folder.at("thesis")) ==
        "cannot write " + folder.at("thesis") +
            ": it exists and is no checkpoint of meander; use another name");
  CHECK(bytes_of(folder.at("thesis")) == "years of work");
}

}  // namespace meander
