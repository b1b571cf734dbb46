// Files that appear whole or not at all: written under a temporary name beside their own, then renamed.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace meander {

/// Refuses before long work what write_file would refuse after it. `extensions` are the file types allowed,
/// in lower case with their dot (".exr"), none for any; the path's may be in any case. Leaves nothing behind,
/// and removes what a killed process left under a temporary name of this path. Error (input): unknown type,
/// no such folder, a folder that cannot be written, an existing directory, an existing read-only file,
/// anything else that is not a regular file.
void check_writable(const std::string& path, std::span<const std::string_view> extensions);

/// Error (input) where `path`, which the named option gives, is one of the files that are read: by whatever
/// name or link.
void refuse_overwriting(std::string_view option, const std::string& path,
                        std::span<const std::string> inputs);

/// Replaces or creates `path`, through `.<stem>.partial-<pid><extension>` in the same folder, flushed to the
/// device before it is renamed; where `path` is a link, what it points to, in that folder. Error with the
/// system's reason, and no file of either name made, when it fails: (runtime) the device is full or broken,
/// or the file grows beyond what the process may write; (input) anything else.
void write_file(const std::string& path, std::span<const std::byte> bytes);

/// The same of parts that follow one another in the file.
void write_file(const std::string& path, std::span<const std::span<const std::byte>> parts);

}  // namespace meander
