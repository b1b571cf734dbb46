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

// The stamp of a file that was written so many seconds after an hour ago.
FileStamp set_time(const std::string& file, int seconds) {
  fs::last_write_time(
      file, fs::file_time_type::clock::now() - std::chrono::hours(1) + std::chrono::seconds(seconds));
  return stamp_of(file);
}

}  // namespace

TEST_CASE("a watched file is reported once when it changes, and not while it is gone") {
  const TemporaryFolder folder;
  const std::string file = folder.at("a.toml");
  write(file, "one");
  settle();
  FileWatch watch;
  watch.watch({stamp_of(file), stamp_of(folder.at("missing"))});
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
  write(folder.at("missing"), "here now");
  settle();
  CHECK(watch.changed() == std::vector<std::string>{folder.at("missing")});
  write(file, "unseen by the next list");
  settle();
  watch.watch({});
  CHECK(watch.changed().empty());
}

TEST_CASE("what changes between the reading of a file and its watch is reported") {
  const TemporaryFolder folder;
  const std::string file = folder.at("a.toml");
  write(file, "one");
  const FileStamp read = set_time(file, 0);
  set_time(file, 1);
  FileWatch watch;
  watch.watch({read});
  CHECK(watch.changed() == std::vector<std::string>{file});
  watch.watch({read});  // as of a document that knows nothing of the change
  CHECK(watch.changed().empty());
  FileWatch other;
  other.watch({FileStamp{file}});  // read when it was not settled
  CHECK(other.changed() == std::vector<std::string>{file});
}

TEST_CASE("who goes back to a file that was watched before is told what has changed since, and no more") {
  const TemporaryFolder folder;
  const std::string file = folder.at("a.toml");
  write(file, "one");
  const FileStamp first = set_time(file, 0);
  FileWatch watch;
  watch.watch({first});
  set_time(file, 1);
  CHECK(watch.changed().size() == 1);
  watch.watch({});
  watch.watch({first});  // an old reading, by undo: its change has been told
  CHECK(watch.changed().empty());
  watch.watch({});
  set_time(file, 2);
  watch.watch({first});
  CHECK(watch.changed().size() == 1);
  watch.watch({});
  watch.watch({set_time(file, 3)});  // a new reading
  CHECK(watch.changed().empty());
}

TEST_CASE(
    "a file that is still being written is reported when it is done, and none of its last words is missed") {
  const TemporaryFolder folder;
  const std::string file = folder.at("a.toml");
  write(file, "0000");
  FileWatch watch;
  watch.watch({stamp_before_reading(file)});
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
