#include "app/file_watch.h"
#include "support/temporary_folder.h"

#include <doctest/doctest.h>

#include <chrono>
#include <fstream>
#include <thread>

using namespace meander;

namespace {

namespace fs = std::filesystem;

void write(const std::string& file, const std::string& text) { std::ofstream(file) << text; }

void settle() { std::this_thread::sleep_for(std::chrono::milliseconds(40)); }

}  // namespace

TEST_CASE("a watched file is reported once when it changes, and not while it is gone") {
  const TemporaryFolder folder;
  const std::string file = folder.at("a.toml");
  write(file, "one");
  FileWatch watch;
  watch.watch({file, folder.at("missing")});
  settle();
  CHECK(watch.changed().empty());
  write(file, "longer");
  settle();
  CHECK(watch.changed() == std::vector<std::string>{file});
  CHECK(watch.changed().empty());
  fs::remove(file);
  CHECK(watch.changed().empty());
  write(file, "back again");
  settle();
  CHECK(watch.changed() == std::vector<std::string>{file});
  write(file, "our own words");
  settle();
  watch.wrote(file);
  watch.wrote("never watched");
  CHECK(watch.changed().empty());
  write(file, "unseen by the next list");
  settle();
  watch.watch({});
  CHECK(watch.changed().empty());
}

TEST_CASE(
    "a file that is still being written is reported when it is done, and none of its last words is missed") {
  const TemporaryFolder folder;
  const std::string file = folder.at("a.toml");
  write(file, "0000");
  FileWatch watch;
  watch.watch({file});
  settle();
  std::string reported = "0000";
  std::string last;
  // Of one size, and so fast that some writes share a time.
  for (int round = 0; round < 40; ++round) {
    for (int k = 0; k < 5; ++k) write(file, last = std::to_string(1000 + 5 * round + k));
    if (round % 8 == 7) settle();
    for (const std::string& changed : watch.changed()) std::ifstream(changed) >> reported;
    if (round % 8 == 7) CHECK(reported == last);
  }
  const auto to_come = fs::file_time_type::clock::now() + std::chrono::hours(1);
  fs::last_write_time(file, to_come);
  CHECK(watch.changed() == std::vector<std::string>{file});
}
