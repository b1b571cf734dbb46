#include "app/file_watch.h"

#include <chrono>
#include <system_error>

namespace meander {
namespace {

// Longer than the clock that stamps files takes for a step: what is written later has a later time.
constexpr std::chrono::milliseconds kSettled(30);

// A time to come is another machine's, and tells nothing.
bool is_settled(std::filesystem::file_time_type written) {
  const auto age = std::filesystem::file_time_type::clock::now() - written;
  return age < age.zero() || age >= kSettled;
}

}  // namespace

bool FileWatch::stamp_of(const std::string& file, Stamp& stamp) {
  std::error_code failed;
  stamp.time = std::filesystem::last_write_time(file, failed);
  if (failed) return false;
  stamp.size = std::filesystem::file_size(file, failed);
  return !failed;
}

void FileWatch::watch(const std::vector<std::string>& files) {
  std::map<std::string, Stamp> next;
  for (const std::string& file : files) {
    Stamp stamp;
    if (const auto known = seen_.find(file); known != seen_.end())
      next.insert(*known);
    else if (stamp_of(file, stamp))
      next.emplace(file, stamp);
  }
  seen_ = std::move(next);
}

void FileWatch::wrote(const std::string& file) {
  const auto known = seen_.find(file);
  if (Stamp stamp; known != seen_.end() && stamp_of(file, stamp)) known->second = stamp;
}

std::vector<std::string> FileWatch::changed() {
  std::vector<std::string> files;
  for (auto& [file, seen] : seen_) {
    Stamp stamp;
    if (!stamp_of(file, stamp) || stamp == seen || !is_settled(stamp.time)) continue;
    seen = stamp;
    files.push_back(file);
  }
  return files;
}

}  // namespace meander
