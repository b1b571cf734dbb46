// Notices files that change on disk: asked now and then, no thread of its own.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace meander {

class FileWatch {
 public:
  /// Watches these files from now on, and no others; a file that was watched already keeps its memory.
  void watch(const std::vector<std::string>& files);

  /// The watched files whose time or size is another than when last seen, once each. A file that is gone, as
  /// while an editor replaces it, is not reported until it is back, and one that was written within the last
  /// 30 ms not before the next time: it may be half a file, and what is written next might leave it the same
  /// time.
  [[nodiscard]] std::vector<std::string> changed();

  /// A watched file that we have written ourselves: its change is none.
  void wrote(const std::string& file);

 private:
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    [[nodiscard]] bool operator==(const Stamp&) const = default;
  };
  [[nodiscard]] static bool stamp_of(const std::string& file, Stamp& stamp);

  std::map<std::string, Stamp> seen_;
};

}  // namespace meander
