#include "io/output_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

Error cannot_write(const std::string& path, const std::string& reason) {
  return Error(Fault::input, "cannot write " + path + ": " + reason);
}

std::string system_reason(int error) { return std::system_category().message(error); }

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// The file under its temporary name; removed when it goes away before it was renamed.
class Partial {
 public:
  explicit Partial(const std::string& path) : path_(path) {
    const fs::path wanted(path);
    const std::string name = "." + wanted.stem().string() + ".partial-" + std::to_string(getpid());
    partial_ = (folder_of(wanted) / (name + wanted.extension().string())).string();
    file_ = open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (file_ < 0) throw cannot_write(path_, system_reason(errno));
  }
  Partial(const Partial&) = delete;
  Partial& operator=(const Partial&) = delete;
  ~Partial() {
    if (file_ >= 0) close(file_);
    if (!renamed_) unlink(partial_.c_str());
  }

  void write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t written = ::write(file_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) throw cannot_write(path_, system_reason(errno));
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  void commit() {
    // EINVAL and ENOTSUP: a file system that knows no flushing.
    if (fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP) {
      throw cannot_write(path_, system_reason(errno));
    }
    if (close(std::exchange(file_, -1)) != 0) throw cannot_write(path_, system_reason(errno));
    if (rename(partial_.c_str(), path_.c_str()) != 0) throw cannot_write(path_, system_reason(errno));
    renamed_ = true;
  }

 private:
  std::string path_;
  std::string partial_;
  int file_ = -1;
  bool renamed_ = false;
};

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

}  // namespace

void check_writable(const std::string& path, std::span<const std::string_view> extensions) {
  if (path.empty()) throw Error(Fault::input, "cannot write a file without a name");
  const fs::path wanted(path);
  std::error_code ignored;
  if (fs::is_directory(wanted, ignored)) throw cannot_write(path, "it is a directory");
  const std::string extension = lower(wanted.extension().string());
  if (!extensions.empty() && std::ranges::find(extensions, extension) == extensions.end()) {
    throw cannot_write(path, (extension.empty() ? "it has no file type" : "unknown file type " + extension) +
                                 "; use " + list_names(extensions));
  }
  const std::string folder = folder_of(wanted).string();
  if (!fs::exists(folder, ignored)) throw cannot_write(path, "there is no folder " + folder);
  if (!fs::is_directory(folder, ignored)) throw cannot_write(path, folder + " is not a folder");
  if (fs::exists(wanted, ignored) && access(path.c_str(), W_OK) != 0) {
    throw cannot_write(path, system_reason(errno));
  }
  const Partial probe(path);
}

void write_file(const std::string& path, std::span<const std::byte> bytes) {
  write_file(path, std::span(&bytes, 1));
}

void write_file(const std::string& path, std::span<const std::span<const std::byte>> parts) {
  Partial partial(path);
  for (const std::span<const std::byte> part : parts) partial.write(part);
  partial.commit();
}

}  // namespace meander
