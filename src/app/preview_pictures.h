// The pictures of the previewer: the live one, snapshots and pictures dropped for comparison, and how they
// are drawn.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/preview_state.h"
#include "display/film_view.h"
#include "gl/picture.h"
#include "io/scene_document.h"
#include "render/session.h"

namespace meander {

/// A picture that is kept: of the scene as it then was, or from a file.
struct Snapshot {
  std::string label;
  std::optional<SceneDocument> document;   // none for a file
  std::shared_ptr<const LiveFrame> frame;  // none for a file
  Image linear;                            // of a file: three channels or more
  std::uint64_t version = 0;               // names what it holds to textures
  std::unique_ptr<Picture> thumbnail;
};

class PreviewPictures {
 public:
  /// Needs its context current, here and in every call. Error (runtime) when the shaders do not compile.
  explicit PreviewPictures(const Functions& gl);

  /// Takes the newest frame: the live picture, or the part of it that a region renders. True when it is
  /// another than before.
  bool take(const std::shared_ptr<const LiveFrame>& frame);
  /// The newest frame that covers the whole film, null before the first; and the one of a region after it.
  [[nodiscard]] const std::shared_ptr<const LiveFrame>& live() const noexcept { return live_; }
  [[nodiscard]] const std::shared_ptr<const LiveFrame>& part() const noexcept { return part_; }
  /// The one of these that is newer.
  [[nodiscard]] const std::shared_ptr<const LiveFrame>& newest() const noexcept {
    return part_ ? part_ : live_;
  }

  /// Of the newest frame: the mean number of scatterings over its pixels, weighed by their light.
  [[nodiscard]] double mean_scatterings() const noexcept { return mean_scatterings_; }

  [[nodiscard]] const std::vector<Snapshot>& snapshots() const noexcept { return snapshots_; }
  /// Keeps the live picture. False before there is one.
  bool keep(const SceneDocument& document, const Display& display);
  /// Keeps a linear picture from a file.
  void keep(const std::string& label, Image linear);
  void drop(std::size_t index);

  /// Draws A, and B beside it as `look` says, at `placement` in a framebuffer of `width` x `height` pixels
  /// that is bound; nothing before the first picture.
  struct Target {
    FilmPlacement film;
    Region clip;
    int width = 0;
    int height = 0;
  };
  void draw(const PreviewLook& look, const Display& display, const Target& target);

  /// Compiles the shaders anew; Error (runtime) as FilmView::reload.
  void reload();

 private:
  struct Slot {
    explicit Slot(const Functions& gl) : textures(gl) {}
    FilmTextures textures;
  };
  [[nodiscard]] bool show(Slot& slot, int snapshot, View view);
  void draw_part(const ViewOptions& options, const Target& target);
  void make_thumbnail(Snapshot& snapshot, const FilmPlanes* planes, const Display& display);

  const Functions* gl_;
  FilmView view_;
  FilmView part_view_;
  Slot a_;
  Slot b_;
  Slot part_slot_;
  std::shared_ptr<const LiveFrame> live_;
  std::shared_ptr<const LiveFrame> part_;
  std::uint64_t live_version_ = 0;
  std::uint64_t part_version_ = 0;
  std::uint64_t next_version_ = 1;
  double mean_scatterings_ = 0;
  bool prepared_ = false;  // the driver has met the film's shaders
  std::vector<Snapshot> snapshots_;
};

}  // namespace meander
