#include "io/file_stamp.h"

#include <chrono>
#include <system_error>

namespace meander {
namespace {

constexpr std::chrono::milliseconds kSettled(30);

}  // namespace

FileStamp stamp_of(const std::string& path) {
  std::error_code failed;
  FileStamp stamp{path, std::filesystem::last_write_time(path, failed)};
  if (failed) return {path};
  stamp.bytes = std::filesystem::file_size(path, failed);
  return failed ? FileStamp{path} : stamp;
}

bool is_settled(const FileStamp& stamp) {
  const auto age = std::filesystem::file_time_type::clock::now() - stamp.time;
  return age < age.zero() || age >= kSettled;
}

FileStamp stamp_before_reading(const std::string& path) {
  FileStamp stamp = stamp_of(path);
  return is_settled(stamp) ? stamp : FileStamp{path};
}

}  // namespace meander
