// What reading a scene needs from elsewhere and can be kept for the next time: mesh files, pictures, built-in
// shapes and surrounds, colour maps.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/recent_values.h"
#include "io/file_stamp.h"
#include "io/mesh_file.h"
#include "medium/color_maps.h"
#include "scene/environment_image.h"
#include "scene/sky.h"

namespace meander {

/// A mesh as its file has it, and what the scene reader asks of it.
struct CachedMesh {
  std::shared_ptr<const Mesh> mesh;
  MeshReport report;
  double size = 0;    // the diagonal of its bounds
  double volume = 0;  // enclosed
};

/// The same object for the same file until the file changes, for the same shape always; a file that was
/// written just now (is_settled) is read anew until it has rested. Any thread may ask.
class SceneCache {
 public:
  /// As load_mesh.
  [[nodiscard]] std::shared_ptr<const CachedMesh> mesh(const std::string& path, bool z_up);
  [[nodiscard]] std::shared_ptr<const Mesh> torus_knot();
  /// As load_environment.
  [[nodiscard]] std::shared_ptr<const EnvironmentImage> picture(const std::string& path, double rotation,
                                                                double scale);
  [[nodiscard]] std::shared_ptr<const EnvironmentImage> sky(Sky sky, double rotation, double scale);
  [[nodiscard]] ColorMaps& color_maps() noexcept { return color_maps_; }
  /// Of a mesh or a picture, taken before it was asked for last, whether it could be read or not; that of no
  /// file where it was never asked for.
  [[nodiscard]] FileStamp stamp(const std::string& path) const;

  /// Called after a scene with this many meshes was read: forgets files that have long not been used.
  void trim(std::size_t meshes);

 private:
  struct MeshKey {
    FileStamp file;
    bool z_up = false;
    bool operator==(const MeshKey&) const = default;
  };
  // A surround, and how it was turned and scaled last.
  struct Surround {
    double rotation;
    double scale;
    std::shared_ptr<const EnvironmentImage> image;
  };
  using Surrounds = RecentValues<FileStamp, Surround>;

  [[nodiscard]] FileStamp about_to_read(const std::string& path);
  [[nodiscard]] static std::shared_ptr<const EnvironmentImage> turned(Surround& surround, double rotation,
                                                                      double scale);

  mutable std::mutex mutex_;
  std::map<std::string, FileStamp> stamps_;
  RecentValues<MeshKey, std::shared_ptr<const CachedMesh>> meshes_;
  std::shared_ptr<const Mesh> torus_knot_;
  Surrounds pictures_;
  Surrounds skies_;
  ColorMaps color_maps_;
};

}  // namespace meander
