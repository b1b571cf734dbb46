#include "app/file_watch.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <fstream>

using namespace meander;

TEST_CASE("a watched file is reported once when it changes, and not while it is gone") {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("meander-watch-" + std::to_string(getpid()));
  fs::create_directory(folder);
  const std::string file = (folder / "a.toml").string();
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  write("one");
  FileWatch watch;
  watch.watch({file, (folder / "missing").string()});
  CHECK(watch.changed().empty());
  write("longer");
  CHECK(watch.changed() == std::vector<std::string>{file});
  CHECK(watch.changed().empty());
  fs::remove(file);
  CHECK(watch.changed().empty());
  write("back again");
  CHECK(watch.changed() == std::vector<std::string>{file});
  write("our own words");
  watch.wrote(file);
  watch.wrote("never watched");
  CHECK(watch.changed().empty());
  write("unseen by the next list");
  watch.watch({});
  CHECK(watch.changed().empty());
  fs::remove_all(folder);
}
