#include "app/preview_pictures.h"

#include <algorithm>
#include <cmath>

#include "display/capture.h"
#include "math/color.h"

namespace meander {
namespace {

constexpr int kThumbnailHeight = 90;

bool covers_film(const LiveFrame& frame) {
  return frame.area.x0 <= 0 && frame.area.y0 <= 0 && frame.area.x1 >= frame.film_width &&
         frame.area.y1 >= frame.film_height;
}

// A part of the film's picture, as a placement of its own.
FilmPlacement part_of(const FilmPlacement& film, const LiveFrame& frame) {
  const float x = film.width / static_cast<float>(frame.film_width);
  const float y = film.height / static_cast<float>(frame.film_height);
  const auto width = static_cast<float>(frame.area.x1 - frame.area.x0);
  const auto height = static_cast<float>(frame.area.y1 - frame.area.y0);
  return {film.x + x * static_cast<float>(frame.area.x0), film.y + y * static_cast<float>(frame.area.y0),
          x * width, y * height};
}

// What of the clip lies on the film: a coarse picture reaches beyond its edges.
Region clip_to_film(const Region& clip, const FilmPlacement& film) {
  const int x0 = std::max(clip.x, static_cast<int>(std::floor(film.x)));
  const int y0 = std::max(clip.y, static_cast<int>(std::floor(film.y)));
  const int x1 = std::min(clip.x + clip.width, static_cast<int>(std::ceil(film.x + film.width)));
  const int y1 = std::min(clip.y + clip.height, static_cast<int>(std::ceil(film.y + film.height)));
  return {x0, y0, std::max(x1 - x0, 0), std::max(y1 - y0, 0)};
}

// Every n-th pixel's neighbourhood averaged, n the smallest that makes it at most kThumbnailHeight high.
Image shrunk(const Image& image) {
  const int n = (image.height + kThumbnailHeight - 1) / kThumbnailHeight;
  Image small(std::max(1, image.width / n), std::max(1, image.height / n), 3);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int i = 0; i < n * n; ++i) {
          const int from_x = std::min(n * x + i % n, image.width - 1);
          const int from_y = std::min(n * y + i / n, image.height - 1);
          sum += image.at(from_x, from_y)[c];
        }
        small.at(x, y)[c] = static_cast<float>(sum / (n * n));
      }
    }
  }
  return small;
}

// Mean over the film's translucent pixels of the mean number of scatterings, weighed by their light.
double weighted_scatterings(const FilmPlanes& planes) {
  double sum = 0;
  double weight = 0;
  const std::size_t pixels = planes.radiance.values.size() / 4;
  for (std::size_t i = 0; i < pixels; ++i) {
    const float* rgb = &planes.radiance.values[4 * i];
    const double scatterings = planes.error.values[4 * i + 3];
    if (!(scatterings > 0)) continue;
    const double light = luminance(Rgb(rgb[0], rgb[1], rgb[2]));
    sum += light * scatterings;
    weight += light;
  }
  return weight > 0 ? sum / weight : 0;
}

}  // namespace

PreviewPictures::PreviewPictures(const Functions& gl)
    : gl_(&gl), view_(gl), part_view_(gl), a_(gl), b_(gl), part_slot_(gl) {}

bool PreviewPictures::take(const std::shared_ptr<const LiveFrame>& frame) {
  if (!frame || frame == live_ || frame == part_) return false;
  mean_scatterings_ = weighted_scatterings(frame->planes);
  if (covers_film(*frame)) {
    live_ = frame;
    live_version_ = next_version_++;
    part_.reset();
    return true;
  }
  // A part needs something to lie on.
  if (!live_) {
    live_ = frame;
    live_version_ = next_version_++;
  }
  part_ = frame;
  part_version_ = next_version_++;
  return true;
}

void PreviewPictures::make_thumbnail(Snapshot& snapshot, const FilmPlanes* planes, const Display& display) {
  const Image small = shrunk(planes ? planes->radiance : snapshot.linear);
  FilmPlanes shown;
  shown.radiance = Image(small.width, small.height, 4);
  shown.error = shown.features = shown.radiance;
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) std::copy_n(small.at(x, y), 3, shown.radiance.at(x, y));
  ViewOptions options;
  options.exposure = static_cast<float>(display.exposure);
  options.tone = display.tone;
  snapshot.thumbnail = std::make_unique<Picture>(*gl_);
  snapshot.thumbnail->upload(draw_frame(*gl_, shown, options));
}

bool PreviewPictures::keep(const SceneDocument& document, const Display& display) {
  if (!live_) return false;
  Snapshot snapshot;
  snapshot.label = std::to_string(live_->spp) + " spp";
  snapshot.document = document;
  snapshot.frame = live_;
  snapshot.version = next_version_++;
  make_thumbnail(snapshot, &live_->planes, display);
  snapshots_.push_back(std::move(snapshot));
  return true;
}

void PreviewPictures::keep(const std::string& label, Image linear) {
  Snapshot snapshot;
  snapshot.label = label;
  snapshot.linear = std::move(linear);
  snapshot.version = next_version_++;
  make_thumbnail(snapshot, nullptr, {});
  snapshots_.push_back(std::move(snapshot));
}

void PreviewPictures::drop(std::size_t index) {
  snapshots_.erase(snapshots_.begin() + static_cast<std::ptrdiff_t>(index));
}

bool PreviewPictures::show(Slot& slot, int snapshot, View view) {
  if (snapshot < 0) {
    if (live_) slot.textures.show(live_->planes, live_version_, view);
    return live_ != nullptr;
  }
  if (static_cast<std::size_t>(snapshot) >= snapshots_.size()) return false;
  const Snapshot& kept = snapshots_[static_cast<std::size_t>(snapshot)];
  if (kept.frame)
    slot.textures.show(kept.frame->planes, kept.version, view);
  else
    slot.textures.show(kept.linear, kept.version);
  return true;
}

void PreviewPictures::draw_part(const ViewOptions& options, const Target& target) {
  part_slot_.textures.show(part_->planes, part_version_, options.view);
  ViewOptions part_options = options;
  part_options.smooth = part_->scale > 1;
  part_view_.draw(part_slot_.textures, part_options,
                  {part_of(target.film, *part_), target.width, target.height, target.clip});
}

void PreviewPictures::draw(const PreviewLook& look, const Display& display, const Target& target) {
  const Region clip = clip_to_film(target.clip, target.film);
  if (clip.width == 0 || clip.height == 0) return;
  ViewOptions options;
  options.exposure = static_cast<float>(display.exposure);
  options.tone = display.tone;
  options.view = look.view;
  options.smooth = live_ && live_->scale > 1;
  if (!show(a_, look.a, look.view)) return;
  const FilmPlacement place = look.a < 0 ? part_of(target.film, *live_) : target.film;
  const Stage stage{place, target.width, target.height, clip};
  if (look.comparison == Comparison::none || !show(b_, look.b, look.view)) {
    view_.draw(a_.textures, options, stage);
    if (part_ && part_ != live_ && look.a < 0) draw_part(options, target);
    if (!prepared_ && live_ && live_->scale == 1) {  // the first picture is there: nobody waits
      view_.prepare(a_.textures, options);
      prepared_ = true;
    }
    return;
  }
  const float line = target.film.x + look.wipe * target.film.width;
  view_.draw_compared(a_.textures, b_.textures, {look.comparison, line}, options, stage);
}

void PreviewPictures::reload() {
  view_.reload();
  part_view_.reload();
}

}  // namespace meander
