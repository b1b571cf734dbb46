// Scenes given as text, for the tests of what reads them.
#pragma once

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "io/scene_file.h"

namespace meander {

// A scene file that vanishes with the test.
class TemporaryScene {
 public:
  explicit TemporaryScene(const std::string& text)
      : path_((std::filesystem::temp_directory_path() / ("scene-" + std::to_string(getpid()) + ".toml"))
                  .string()) {
    std::ofstream(path_) << text;
  }
  ~TemporaryScene() { std::filesystem::remove(path_); }
  TemporaryScene(const TemporaryScene&) = delete;
  TemporaryScene& operator=(const TemporaryScene&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline Scene load(const std::string& text, const std::vector<std::string>& edits = {}) {
  const TemporaryScene file(text);
  return load_scene(file.path(), edits).scene;
}

// The message without the temporary path.
inline std::string error_of(const std::string& text, const std::vector<std::string>& edits = {}) {
  const TemporaryScene file(text);
  try {
    (void)load_scene(file.path(), edits);
  } catch (const Error& error) {
    CHECK(error.exit_code() == 2);
    std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    if (message.starts_with(file.path())) message = message.substr(file.path().size());
    return message;
  }
  return "no error";
}

inline const Medium& medium_of(const Scene& scene) {
  return std::get<TranslucentMaterial>(scene.materials.at(0).kind).medium;
}

inline const std::string kWax = "[[material]]\nname = \"wax\"\n";

}  // namespace meander
