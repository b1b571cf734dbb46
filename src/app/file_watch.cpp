#include "app/file_watch.h"

#include <utility>

namespace meander {

void FileWatch::watch(const std::vector<FileStamp>& files) {
  std::set<std::string> next;
  for (const FileStamp& file : files) {
    FileStamp& seen = seen_.try_emplace(file.path, file).first->second;
    if (!watched_.contains(file.path) && seen.time < file.time) seen = file;
    next.insert(file.path);
  }
  watched_ = std::move(next);
}

std::vector<std::string> FileWatch::changed() {
  std::vector<std::string> files;
  for (const std::string& file : watched_) {
    FileStamp stamp = stamp_of(file);
    FileStamp& seen = seen_.at(file);
    if (!stamp.is_there() || stamp == seen || !is_settled(stamp)) continue;
    seen = std::move(stamp);
    files.push_back(file);
  }
  return files;
}

}  // namespace meander
