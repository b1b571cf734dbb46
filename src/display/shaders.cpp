#include "display/shaders.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <system_error>
#include <vector>

#include "core/error.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> shader_folders() {
  std::vector<fs::path> folders;
  if (const char* chosen = std::getenv("MEANDER_SHADERS"); chosen != nullptr && *chosen != '\0') {
    folders.emplace_back(chosen);
  }
  std::error_code unknown;
  const fs::path executable = fs::read_symlink("/proc/self/exe", unknown);
  if (!unknown) {
    folders.push_back(executable.parent_path().parent_path() / "share" / "meander" / "shaders");
  }
  folders.emplace_back(MEANDER_SHADER_DIR);
  return folders;
}

std::optional<std::string> whole_file(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || text.empty()) return std::nullopt;
  return text;
}

}  // namespace

ShaderSource shader_source(const std::string& name) {
  std::string looked_in;
  for (const fs::path& folder : shader_folders()) {
    if (auto text = whole_file(folder / name)) return {(folder / name).string(), std::move(*text)};
    looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
  }
  throw Error(Fault::runtime, "no shader " + name + " in " + looked_in +
                                  "; set MEANDER_SHADERS to the folder of meander's shaders");
}

std::vector<std::string> shader_files() {
  std::vector<std::string> files;
  for (const fs::path& folder : shader_folders()) {
    std::error_code failed;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed))
      if (entry.path().extension() == ".frag" || entry.path().extension() == ".vert")
        files.push_back(entry.path().string());
    if (!files.empty()) break;
  }
  return files;
}

}  // namespace meander
