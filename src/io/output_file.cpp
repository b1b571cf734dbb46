#include "io/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
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

// A name that was wrong from the start is the caller's fault; a device that is full or broken is nobody's.
Error system_refused(const std::string& path, int error) {
  const bool device = error == ENOSPC || error == EDQUOT || error == EFBIG || error == EIO;
  return Error(device ? Fault::runtime : Fault::input,
               "cannot write " + path + ": " + std::system_category().message(error));
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Where a path leads: what a link points to is written, whether it is there yet or not, and the link stays.
fs::path target_of(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the system follows
  std::error_code failed;
  fs::path target(path);
  for (int links = 0; links < kMostLinks && fs::is_symlink(target, failed); ++links) {
    const fs::path next = fs::read_symlink(target, failed);
    if (failed) break;
    target = folder_of(target) / next;  // which is `next` where that is absolute
  }
  return target;
}

// What temporary names of a path begin with; the process and the extension follow.
std::string partial_prefix(const fs::path& wanted) { return "." + wanted.stem().string() + ".partial-"; }

// Files that killed processes left under temporary names of this path; one whose writer lives is locked.
void remove_abandoned(const fs::path& wanted) {
  std::error_code failed;
  for (fs::directory_iterator entry(folder_of(wanted), failed), end; !failed && entry != end;
       entry.increment(failed)) {
    const fs::path& path = entry->path();
    if (!path.filename().string().starts_with(partial_prefix(wanted))) continue;
    if (path.extension() != wanted.extension()) continue;
    const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0) continue;
    if (flock(file, LOCK_EX | LOCK_NB) == 0) unlink(path.c_str());
    close(file);
  }
}

// The file under its temporary name, locked; removed when it goes away before it was renamed.
class Partial {
 public:
  explicit Partial(const std::string& path) : path_(path), target_(target_of(path)) {
    const std::string name = partial_prefix(target_) + std::to_string(getpid());
    partial_ = (folder_of(target_) / (name + target_.extension().string())).string();
    do {
      if (file_ >= 0) close(file_);
      file_ = open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666);
      if (file_ < 0) throw system_refused(path_, errno);
    } while (lost_before_locked());
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
      if (written < 0) throw system_refused(path_, errno);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  void commit() {
    // EINVAL and ENOTSUP: a file system that knows no flushing.
    if (fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP) {
      throw system_refused(path_, errno);
    }
    if (close(std::exchange(file_, -1)) != 0) throw system_refused(path_, errno);
    if (rename(partial_.c_str(), target_.c_str()) != 0) throw system_refused(path_, errno);
    renamed_ = true;
  }

 private:
  // Whether another process took the file for abandoned between its making and its locking. A file system
  // without locks does not lock.
  [[nodiscard]] bool lost_before_locked() const {
    struct stat status {};
    return flock(file_, LOCK_EX | LOCK_NB) == 0 && fstat(file_, &status) == 0 && status.st_nlink == 0;
  }

  std::string path_;  // as the caller calls it
  fs::path target_;
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
  if (fs::exists(wanted, ignored) && !fs::is_regular_file(wanted, ignored))
    throw cannot_write(path, "it is not a regular file");
  const std::string folder = folder_of(wanted).string();
  if (!fs::exists(folder, ignored)) throw cannot_write(path, "there is no folder " + folder);
  if (!fs::is_directory(folder, ignored)) throw cannot_write(path, folder + " is not a folder");
  if (fs::exists(wanted, ignored) && access(path.c_str(), W_OK) != 0) {
    throw system_refused(path, errno);
  }
  remove_abandoned(target_of(path));
  const Partial probe(path);
}

void refuse_overwriting(std::string_view option, const std::string& path,
                        std::span<const std::string> inputs) {
  for (const std::string& input : inputs) {
    std::error_code error;
    if (fs::equivalent(input, path, error))
      throw Error(Place{path, 0, 0}, std::string(option) + " would overwrite an input; use another name");
  }
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
