// What is fuzzed: the readers of files from outside, and what must hold whatever a file holds.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "io/scene_document.h"
#include "support/temporary_folder.h"

namespace meander {

enum class FuzzTarget { scene, ply, obj, glb, stl, image };

inline constexpr std::array<std::string_view, 6> kFuzzTargetNames{"scene", "ply", "obj",
                                                                  "glb",   "stl", "image"};  // as FuzzTarget

[[nodiscard]] std::optional<FuzzTarget> fuzz_target_of(std::string_view name);

/// A folder of the run's own, gone with it: what is fuzzed is written there, beside a mesh and a picture that
/// scenes may name ("tetra.obj", "light.exr").
class FuzzFolder {
 public:
  FuzzFolder();
  [[nodiscard]] std::string at(std::string_view name) const { return files_.at(name); }
  [[nodiscard]] std::string write(std::string_view name, std::string_view bytes) const {
    return files_.write(name, bytes);
  }
  /// The scene file of that text, read with what earlier ones have read already. Errors: Error.
  [[nodiscard]] SceneDocument read_scene(std::string_view text) const;

 private:
  TemporaryFolder files_;
  std::optional<SceneDocument> first_scene_;
};

/// What came of an input, in a few words that tell inputs apart.
struct FuzzOutcome {
  bool read = false;  // else refused
  std::string words;
};

/// Reads the bytes as a file of that kind. Returns what came of it;
/// throws std::logic_error where what must hold does not: the file is read, and what was read is sound and
/// reads back the same; or it is refused with an Error of one printable line and exit code 2. In a scene, a
/// line `# --set PATH=VALUE` is an edit that is tried too. The kind of a picture goes by its first bytes.
[[nodiscard]] FuzzOutcome try_input(FuzzTarget target, const FuzzFolder& folder, std::string_view bytes);

/// Seconds of processor time that this process and its ended children have used.
[[nodiscard]] double processor_seconds();

}  // namespace meander
