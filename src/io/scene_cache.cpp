#include "io/scene_cache.h"

#include "core/error.h"
#include "io/environment_file.h"

namespace meander {
namespace {

constexpr std::size_t kOldMeshes = 6;  // kept besides those of the scene that was read last
constexpr std::size_t kPictures = 3;

}  // namespace

// A file that is not there has no stamp either: reading it will say more.
FileStamp SceneCache::about_to_read(const std::string& path) {
  FileStamp stamp = stamp_before_reading(path);
  stamps_.insert_or_assign(path, stamp);
  return stamp;
}

FileStamp SceneCache::stamp(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  const auto found = stamps_.find(path);
  return found == stamps_.end() ? FileStamp{path} : found->second;
}

std::shared_ptr<const CachedMesh> SceneCache::mesh(const std::string& path, bool z_up) {
  const std::lock_guard lock(mutex_);
  const MeshKey key{about_to_read(path), z_up};
  if (const auto* found = meshes_.find(key)) return *found;
  MeshFile file = load_mesh(path, z_up);
  auto cached = std::make_shared<CachedMesh>();
  const Bounds bounds = bounds_of(file.mesh);
  cached->size = glm::length(bounds.high - bounds.low);
  cached->volume = signed_volume(file.mesh);
  cached->report = file.report;
  cached->mesh = std::make_shared<const Mesh>(std::move(file.mesh));
  return key.file.is_there() ? meshes_.add(key, std::move(cached)) : cached;
}

std::shared_ptr<const Mesh> SceneCache::torus_knot() {
  const std::lock_guard lock(mutex_);
  if (!torus_knot_) torus_knot_ = std::make_shared<const Mesh>(make_torus_knot());
  return torus_knot_;
}

std::shared_ptr<const EnvironmentImage> SceneCache::turned(Surround& surround, double rotation,
                                                           double scale) {
  if (surround.rotation == rotation && surround.scale == scale) return surround.image;
  surround.image = std::make_shared<const EnvironmentImage>(*surround.image, rotation, scale);
  surround.rotation = rotation;
  surround.scale = scale;
  return surround.image;
}

std::shared_ptr<const EnvironmentImage> SceneCache::picture(const std::string& path, double rotation,
                                                            double scale) {
  const std::lock_guard lock(mutex_);
  const FileStamp key = about_to_read(path);
  Surround* found = pictures_.find(key);
  if (!found) {
    Surround loaded{rotation, scale, load_environment(path, rotation, scale)};
    return key.is_there() ? pictures_.add(key, std::move(loaded)).image : loaded.image;
  }
  try {
    return turned(*found, rotation, scale);
  } catch (const Error& error) {
    throw Error(Place{path, 0, 0}, error.what());
  }
}

std::shared_ptr<const EnvironmentImage> SceneCache::sky(Sky sky, double rotation, double scale) {
  const std::lock_guard lock(mutex_);
  const FileStamp key{std::string(kSkyNames[static_cast<std::size_t>(sky)])};
  Surround* found = skies_.find(key);
  if (!found) found = &skies_.add(key, {0, 1, std::make_shared<const EnvironmentImage>(make_sky(sky))});
  return turned(*found, rotation, scale);
}

void SceneCache::trim(std::size_t meshes) {
  const std::lock_guard lock(mutex_);
  meshes_.trim(meshes + kOldMeshes);
  pictures_.trim(kPictures);
}

}  // namespace meander
