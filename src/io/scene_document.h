// A scene that is being edited: the scene file as a value, to read, change by name, compare, and write.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/file_stamp.h"
#include "io/scene_file.h"
#include "scene/environment_description.h"
#include "scene/material_description.h"

namespace meander {

struct DocumentState;
class SceneCache;

/// A value: a copy costs two pointers, an edit a copy of the text's tables (bytes()). Whatever is done to it,
/// a document holds a scene that could be read; an edit that would not leave one throws Error and leaves the
/// document as it was. Copies share the files they have read: a mesh, a picture or a shape that did not
/// change is the same object from one scene() to the next, also between copies, and a file that changed on
/// disk is read anew. Different copies may be used from different threads.
class SceneDocument {
 public:
  /// Reads a scene file, or wraps a bare mesh file in the built-in studio (`path` as in load_scene), and
  /// applies the edits. Errors: Error with file, line and column.
  [[nodiscard]] static SceneDocument open(const std::string& path, std::span<const std::string> edits = {});
  /// The same from the text of a scene file; names of files in it are relative to the folder of `path`.
  [[nodiscard]] static SceneDocument from_text(const std::string& text, const std::string& path);

  /// Another scene, as open reads it; of what both name there is one object.
  [[nodiscard]] SceneDocument open_another(const std::string& path) const;

  /// The scene file, or the studio about the bare mesh file, as it is on disk now: no edits, but what copies
  /// share. Errors: as open.
  [[nodiscard]] SceneDocument reopened() const;

  /// One edit, `PATH=VALUE` as in scene_edit.h.
  void apply(const std::string& edit);

  /// The scene, read anew. Errors: Error when a file that it names has become unreadable.
  [[nodiscard]] SceneFile scene() const;

  /// The scene file in canonical form: the leading comment of the original, then sections and keys in the
  /// order in which the scene file is documented, numbers in the fewest digits that read back exactly.
  /// Reading it gives an equal scene.
  [[nodiscard]] std::string text() const;
  /// The text for a file at another path: relative names of files lead to the same files from there.
  [[nodiscard]] std::string text_for(const std::string& target_path) const;
  /// As text_for, and makes `target_path` the document's own path: what saving under a new name does.
  void move_to(const std::string& target_path);

  /// Of the scene file, or of the bare mesh file that was opened.
  [[nodiscard]] const std::string& path() const;
  /// The scene file and every mesh and picture that it names, each once, as they were before they were read
  /// last: what has another stamp now has changed since. That of no file where that cannot be told.
  [[nodiscard]] std::vector<FileStamp> watched_files() const;
  /// The same of the scene file as it is on disk now, which may be one that cannot be read for the sake of a
  /// file that it names. Empty when it is no scene file at all.
  [[nodiscard]] std::vector<FileStamp> reopened_files() const;

  /// An orthographic camera is written without its field of view.
  void set_camera(const Camera& camera);
  /// These lights instead of all.
  void set_lights(const std::vector<Light>& lights);
  /// This light instead of the one of that name (without a name in the file, "light1" is the first). Error
  /// when there is none.
  void set_light(const std::string& name, const Light& light);
  /// The environments exclude one another; `visible` is held. A picture keeps the rotation and scale of the
  /// picture before it, a sky those of the sky before it. `path` is relative to the working directory, and is
  /// written as an absolute one.
  void set_environment_image(const std::string& path);
  void set_environment_sky(const std::string& name);  // one of kSkyNames (scene/sky.h)
  void set_environment_radiance(const DVec3& radiance);
  /// A mesh file (path as above) in place of the object's shape, scaled to the same radius about the centre
  /// of its bounds and resting where the old one did: same centre in x and z, same lowest y. Material and
  /// lengths are held. In place of a mesh it keeps up_axis and rotation, else it stands as its file says.
  /// Error for an unbounded slab.
  void set_object_mesh(const std::string& object, const std::string& path);

  /// About what the document holds in memory besides the files it names, which copies share: bytes.
  [[nodiscard]] std::size_t bytes() const;

  /// Error when there is no material of this name.
  [[nodiscard]] MaterialDescription material(const std::string& name) const;
  [[nodiscard]] EnvironmentDescription environment() const;

  /// Whether the two would be saved as the same text at the same path.
  [[nodiscard]] bool operator==(const SceneDocument& other) const;

 private:
  SceneDocument(std::shared_ptr<const DocumentState> state, std::shared_ptr<SceneCache> cache);
  void adopt(DocumentState&& state);  // once it reads
  [[nodiscard]] std::vector<FileStamp> files_of_state(const DocumentState& state) const;

  std::shared_ptr<const DocumentState> state_;
  std::shared_ptr<SceneCache> cache_;
};

/// The camera as the `[camera]` section of a scene file.
[[nodiscard]] std::string camera_text(const Camera& camera);

}  // namespace meander
