#include "io/scene_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "io/document_state.h"
#include "io/key_depth.h"
#include "io/scene_edit.h"
#include "io/scene_reader.h"
#include "io/studio.h"

namespace meander {
namespace {

constexpr std::uintmax_t kLargestText = std::uintmax_t{16} << 20;

void check_is_file(const std::string& path) {
  std::error_code code;
  if (std::filesystem::is_directory(path, code))
    throw Error(Place{path, 0, 0}, "is a folder, not a scene file");
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    throw Error(Place{path, 0, 0}, "is not a regular file");
}

std::string read_text(const std::string& path) {
  check_is_file(path);
  std::error_code code;
  if (const auto bytes = std::filesystem::file_size(path, code); !code && bytes > kLargestText)
    throw Error(Place{path, 0, 0}, "is larger than 16 MiB, too large for a scene file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(Place{path, 0, 0}, "cannot open: No such file or directory");
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// The lines at the top that begin with #.
std::string leading_comment(const std::string& text) {
  std::string comment;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line) && line.starts_with('#');) {
    if (line.ends_with('\r')) line.pop_back();
    comment += line + '\n';
  }
  return comment;
}

bool is_scene_file(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension == ".toml";
}

}  // namespace

DocumentState parse_document(const std::string& text, const std::string& path) {
  if (const auto deep = find_deep_key(text, path)) throw deep_key(*deep);
  try {
    return {toml::parse(text, path), path, leading_comment(text), {path}};
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    throw Error(Place{path, static_cast<int>(begin.line), static_cast<int>(begin.column)},
                std::string(error.description()));
  }
}

DocumentState open_document(const std::string& path, SceneCache& cache) {
  if (is_scene_file(path)) {
    FileStamp stamp = stamp_before_reading(path);
    DocumentState state = parse_document(read_text(path), path);
    state.stamp = std::move(stamp);
    return state;
  }
  check_is_file(path);
  const auto cached = cache.mesh(path, false);
  return {toml::parse(studio_text(*cached->mesh, path)), path, {}, {path}};
}

SceneFile load_scene(const std::string& path, std::span<const std::string> edits) {
  SceneCache cache;
  DocumentState document = open_document(path, cache);
  for (const std::string& edit : edits) apply_edit(document.table, edit, path, cache.color_maps());
  return read_scene(document.table, path, cache);
}

}  // namespace meander
