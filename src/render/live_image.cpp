#include "render/live_image.h"

#include <unistd.h>

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/timer.h"
#include "render/parallel.h"
#include "trace/overlaps.h"

namespace meander {
namespace {

constexpr double kFirstImage = 0.025;        // seconds that a first image may take
constexpr double kInteractiveImages = 0.04;  // seconds that all images under a drag may take
constexpr int kCoarsest = 64;
constexpr double kProbePixels = 400;

double pixel_count(const Tile& area) noexcept {
  return static_cast<double>(area.x1 - area.x0) * static_cast<double>(area.y1 - area.y0);
}

// The films of a session and its frames: two renderings and one on show, two frames of twelve floats.
void check_memory(double pixels) {
  const double bytes = pixels * (3 * sizeof(Pixel) + 2 * 12 * sizeof(float));
  const double machine =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes < 0.9 * machine) return;
  const auto mebibytes = [](double b) { return std::to_string(static_cast<std::uint64_t>(b / 0x1p20)); };
  throw Error(Fault::runtime, "the film needs " + mebibytes(bytes) + " MiB, and this machine has " +
                                  mebibytes(machine) + ": choose a smaller film or render scale");
}

void reshape(Image& image, int width, int height) {
  image.width = width;
  image.height = height;
  image.channels = 4;
  image.values.resize(static_cast<std::size_t>(width) * height * 4);
}

}  // namespace

int coarse_scale(double pixels, double seconds_per_pixel, double target) noexcept {
  int scale = 1;
  while (scale < kCoarsest && pixels * seconds_per_pixel > target * scale * scale) scale *= 2;
  return scale;
}

LiveImage::LiveImage(SessionRequest request, LiveStock& stock) : stock_(stock), request_(std::move(request)) {
  job_.scene = request_.scene;
  job_.crop = request_.region;
  job_.seed = request_.seed;
  job_.estimator = request_.estimator;
  job_.walk = request_.walk;
  job_.instruction_set = request_.instruction_set;
  job_.threads = stock_.threads;
  job_.priority = Priority::background;
  pixels_ = pixel_count(area_of(job_));
  check_memory(pixels_);
  stock_.geometry = std::make_shared<const Geometry>(*job_.scene, job_.threads, stock_.geometry.get());
  job_.geometry = stock_.geometry;
  while (scale_ < kCoarsest && pixels_ >= kProbePixels * 4 * scale_ * scale_) scale_ *= 2;
  if (scale_ == 1) stage_ = request_.interactive ? Stage::coarse : Stage::full;
}

bool LiveImage::has_work(bool paused) const noexcept {
  if (stage_ == Stage::finished) return false;
  if (stage_ != Stage::full) return true;
  if (done_ && (next_samples() == 0) != shown_complete_) return true;
  return (!paused || !shown_) && next_samples() > 0;
}

void LiveImage::set_budget(const Budget& budget) noexcept { request_.budget = budget; }

std::shared_ptr<LiveFrame> LiveImage::step(const std::atomic<bool>& stop) {
  std::shared_ptr<LiveFrame> frame = stage_ == Stage::full ? render_pass(stop) : render_coarse(stop);
  shown_ = shown_ || frame;
  return frame;
}

std::shared_ptr<LiveFrame> LiveImage::render_coarse(const std::atomic<bool>& stop) {
  const Timer timer;
  Job job = job_;
  job.scale = scale_;
  if (!job.geometry->is_finished()) job.walk = WalkCode::scalar;  // rather than wait
  Rendering film;
  auto frame = std::make_shared<LiveFrame>();
  const double pixels = pixels_ / (scale_ * scale_);
  const bool traced = Passes(job, stop).advance({}, 1, film);
  const Image normals = traced ? first_hits(job, stop).normals : Image();
  if (!traced || !resolve(job, film, normals, *frame, stop)) {
    stock_.seconds_per_pixel = std::max(stock_.seconds_per_pixel, timer.seconds() / pixels);
    return nullptr;
  }
  frame->seconds = timer.seconds();
  frame->noise = std::numeric_limits<double>::infinity();
  spent_ += frame->seconds;
  const double cost = frame->seconds / pixels;
  if (stage_ != Stage::probe)
    stock_.seconds_per_pixel = cost;
  else if (!judge_probe(cost))
    return nullptr;
  refine();
  shown_ = true;
  return frame;
}

// What a few hundred pixels cost says how coarse the first image is to be: whether about as much as the last
// images did, which is then believed, or something else altogether. False when the probe itself is not worth
// showing, because a finer image will be there as good as at once.
bool LiveImage::judge_probe(double cost) {
  double& believed = stock_.seconds_per_pixel;
  if (!(cost > believed / 2 && cost < 2 * believed)) believed = cost;
  const int scale = coarse_scale(pixels_, believed, kFirstImage);
  if (scale >= scale_) return true;
  scale_ = scale;
  stage_ = scale_ == 1 && !request_.interactive ? Stage::full : Stage::coarse;
  return false;
}

// On to the image of twice the resolution, or to the passes at full resolution. Each costs four times the one
// before, so that all coarse images together cost a third of the first pass.
void LiveImage::refine() {
  const double next = 4 * pixels_ * stock_.seconds_per_pixel / (scale_ * scale_);
  const bool last = scale_ == 1 || spent_ + next > kInteractiveImages;
  if (request_.interactive && last) {
    stage_ = Stage::finished;
    return;
  }
  scale_ = std::max(1, scale_ / 2);
  stage_ = scale_ == 1 && !request_.interactive ? Stage::full : Stage::coarse;
}

std::uint64_t LiveImage::next_samples() const noexcept {
  if (!done_) return next_pass({}, request_.budget);
  return next_pass(progress_of(*done_), request_.budget, longest_live_pass(done_->seconds));
}

bool LiveImage::find_first_hits(const std::atomic<bool>& stop) {
  const Tile area = area_of(job_);
  if (stock_.hits && stock_.hits_area == area && same_first_hits(*stock_.hits_scene, *job_.scene))
    return true;
  auto hits = std::make_shared<const FirstHits>(first_hits(job_, stop));
  if (stop) return false;
  stock_.hits = std::move(hits);
  stock_.hits_scene = job_.scene;
  stock_.hits_area = area;
  return true;
}

std::shared_ptr<LiveFrame> LiveImage::render_pass(const std::atomic<bool>& stop) {
  if (!find_first_hits(stop) || !prepare_walks(job_, stop)) return nullptr;
  if (const std::uint64_t samples = next_samples(); samples > 0) {
    const Timer timer;
    const Rendering nothing;
    const std::shared_ptr<Rendering> next = stock_.films.take();
    const Rendering& before = done_ ? *done_ : nothing;
    if (!Passes(job_, stop).advance(before, samples, *next)) return nullptr;
    next->noise = estimate_noise(next->film, stock_.hits->mask);
    next->seconds = before.seconds + timer.seconds();
    done_ = next;
    if (done_->spp > 1) history_.push_back({done_->seconds, done_->spp, done_->noise.noise});
  }
  if (!done_) return nullptr;
  const std::shared_ptr<LiveFrame> frame = stock_.frames.take();
  if (!resolve(job_, *done_, stock_.hits->normals, *frame, stop)) return nullptr;
  frame->seconds = done_->seconds;
  frame->noise = done_->noise.noise;
  frame->noise_reliable = done_->noise.reliable();
  frame->history = history_;
  if (!overlaps_) overlaps_ = overlap_warnings(*job_.scene, *job_.geometry);
  frame->overlaps = overlaps_;
  frame->complete = next_samples() == 0;
  shown_complete_ = frame->complete;
  shown_ = true;
  return frame;
}

// Everything of a frame that comes from its film; false when it was interrupted.
bool LiveImage::resolve(const Job& job, const Rendering& film, const Image& normals, LiveFrame& frame,
                        const std::atomic<bool>& stop) const {
  const Tile area = area_of(job);
  frame.scene = job.scene;
  frame.scale = job.scale;
  frame.area = {area.x0 * job.scale, area.y0 * job.scale, area.x1 * job.scale, area.y1 * job.scale};
  frame.film_width = job.scene->film.width;
  frame.film_height = job.scene->film.height;
  frame.spp = film.spp;
  frame.counters = film.counters;
  frame.non_finite = film.non_finite;
  for (Image* plane : {&frame.planes.radiance, &frame.planes.error, &frame.planes.features})
    reshape(*plane, film.film.width, film.film.height);
  parallel_for(
      job.threads, static_cast<std::size_t>(film.film.height),
      [&](std::size_t y) {
        if (!stop) resolve_row(film.film, &normals, static_cast<int>(y), frame.planes);
      },
      job.priority);
  return !stop;
}

}  // namespace meander
