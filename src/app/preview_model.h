// What the interface shows, made anew for every frame from what the previewer holds.
#pragma once

#include "app/preview_pictures.h"
#include "app/preview_state.h"
#include "ui/models.h"

namespace meander {

/// Where the pointer is over the picture, as a pixel of the film at 100 %.
struct PointedPixel {
  int x = 0;
  int y = 0;
};

/// What a model is made from besides the state.
struct ModelInputs {
  const PreviewPictures& pictures;
  std::uint64_t generation = 0;  // the newest that was asked for
  Area film;                     // the picture's place in the window, points
  std::optional<PointedPixel> pointed;
  bool paused = false;
};

[[nodiscard]] UiModel make_model(const PreviewState& state, const ModelInputs& inputs);

/// The pixel of the newest frame under a film pixel at 100 %; nothing where it has none.
[[nodiscard]] std::optional<PixelReading> read_pixel(const LiveFrame& frame, const FilmSize& film,
                                                     const PointedPixel& at, double millimetres_per_unit);

}  // namespace meander
