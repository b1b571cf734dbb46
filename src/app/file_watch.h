// Notices files that change on disk: asked now and then, no thread of its own.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/file_stamp.h"

namespace meander {

class FileWatch {
 public:
  /// Watches these files from now on, and no others. The stamps are those of before they were read. Of a file
  /// that was ever watched the memory is kept: what was noticed once is noticed, whichever reading of the
  /// file one goes back to.
  void watch(const std::vector<FileStamp>& files);

  /// The watched files that are not as they were read, or as they were reported, once each. A file that is
  /// gone, as while an editor replaces it, is not reported until it is back, and one that was written just
  /// now (is_settled) not before the next time: it may be half a file.
  [[nodiscard]] std::vector<std::string> changed();

 private:
  std::set<std::string> watched_;
  std::map<std::string, FileStamp> seen_;
};

}  // namespace meander
