// Documents to test with: scenes of the project, folders that vanish, and what any edit must obey.
#pragma once

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "io/scene_document.h"
#include "io/scene_dump.h"
#include "support/temporary_folder.h"

namespace meander {

namespace fs = std::filesystem;
using Folder = TemporaryFolder;

inline const std::string kScenes = std::string(MEANDER_SOURCE_DIR) + "/scenes/";
inline const std::string kKnot = kScenes + "wax_knot.toml";
inline const std::string kSoap = kScenes + "soap.toml";
inline const std::string kJade = kScenes + "jade_knot.toml";
inline const std::string kSoapMesh = kScenes + "soap.ply";

// A closed tetrahedron of this size whose lowest corners lie at y = 0.
inline std::string tetrahedron(double size) {
  const std::string s = std::to_string(size);
  return "v 0 0 0\nv " + s + " 0 0\nv 0 0 " + s + "\nv 0 " + s + " 0\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
}

// The names of the files to watch.
inline std::vector<std::string> watched(const SceneDocument& document) {
  std::vector<std::string> names;
  for (const FileStamp& file : document.watched_files()) names.push_back(file.path);
  return names;
}

using MeshPointer = std::shared_ptr<const Mesh>;

inline const Object& object_named(const Scene& scene, const std::string& name) {
  for (const Object& object : scene.objects)
    if (object.name == name) return object;
  FAIL("no object " << name);
  return scene.objects.front();
}

inline const Mesh* mesh_of(const Scene& scene, const std::string& name) {
  return std::get<MeshPointer>(object_named(scene, name).shape).get();
}

// The edit fails with this message and changes nothing.
template <class Edit>
void check_refused(SceneDocument& document, const Edit& edit, const std::string& message) {
  const SceneDocument before = document;
  CAPTURE(message);
  try {
    edit();
    FAIL_CHECK("no error");
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find(message) != std::string::npos);
    INFO(error.what());
    CHECK(error.exit_code() == 2);
  }
  CHECK(document == before);
  CHECK(document.text() == before.text());
}

inline void check_reads_back(const SceneDocument& document) {
  const std::string text = document.text();
  const SceneDocument again = SceneDocument::from_text(text, document.path());
  CHECK(dump(again.scene().scene) == dump(document.scene().scene));
  CHECK(again.text() == text);
  CHECK(again == document);
}

}  // namespace meander
