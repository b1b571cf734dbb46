// A film, or a plain linear image, on its way to the display: only what the current view looks at.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "display/views.h"
#include "film/film_planes.h"
#include "gl/texture.h"
#include "math/image.h"

namespace meander {

class FilmTextures {
 public:
  /// Needs its context current, here and in every call.
  explicit FilmTextures(const Functions& gl);

  /// Sees to it that what `view` looks at of `planes` is in the textures. `version` is any number that
  /// changes with the planes: what is there of the same version is not copied again. The planes may go when
  /// it returns. Error (runtime) when the context cannot hold them.
  void show(const FilmPlanes& planes, std::uint64_t version, View view);
  /// The same for an image of 3 channels or more, of which the first three are linear Rec. 709; it has the
  /// views image, luminance and clipping.
  void show(const Image& linear, std::uint64_t version);

  /// Whether the planes that `view` looks at are there.
  [[nodiscard]] bool has(View view) const noexcept;
  [[nodiscard]] bool empty() const noexcept { return width_ == 0; }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }

  /// What is in the textures: equal only for the same textures with nothing uploaded in between.
  struct Content {
    std::shared_ptr<const char> textures;  // whoever holds it keeps others from being taken for them
    std::uint64_t uploads = 0;

    bool operator==(const Content&) const = default;
  };
  [[nodiscard]] const Content& content() const noexcept { return content_; }

  /// Makes plane `plane` (0 radiance, 1 error, 2 features) the texture of sampler `unit`.
  void bind(int plane, int unit) const;

 private:
  void begin(int width, int height, std::uint64_t version);

  std::array<Texture, 3> planes_;
  std::array<bool, 3> there_{};
  Content content_;
  bool has_samples_ = false;
  std::uint64_t version_ = 0;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace meander
