#include "app/report_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/linear_picture.h"
#include "app/progress.h"
#include "app/run_stats.h"
#include "core/error.h"

namespace meander {
namespace {

constexpr std::uint64_t kTimesLarger = 16;
constexpr std::uint64_t kMostSpp = std::uint64_t{1} << 31;
constexpr const char* kReference = "meander/reference";  // the file that it came from

std::string size_text(int width, int height) {
  return std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

// Whether the file says that it holds samples of the job's own streams.
bool shares_samples(const ImageAttributes& attributes, const Job& job, const Budget& budget) {
  const auto held = samples_of(attributes);
  if (!held) return false;
  const std::uint64_t most = budget.spp.value_or(std::uint64_t{1} << 33);
  return shared_samples(*held, {{job.seed, job.first_sample, job.first_sample + most - 1}}).has_value();
}

// What meander's own files say of themselves, to be said again.
ImageAttributes own_attributes(const ImageAttributes& attributes, const std::string& path) {
  ImageAttributes own;
  for (const auto& [name, value] : attributes.text)
    if (name.starts_with("meander/") && name != kReference) own.text.emplace_back(name, value);
  for (const auto& [name, value] : attributes.integers)
    if (name.starts_with("meander/")) own.integers.emplace_back(name, value);
  own.text.emplace_back(kReference, path);
  return own;
}

}  // namespace

ReportReference read_reference(const std::string& path, const Job& job, const Budget& budget,
                               std::span<const std::uint8_t> mask) {
  const LoadedImage loaded = read_image(path);
  const Tile area = area_of(job);
  const int width = area.x1 - area.x0;
  const int height = area.y1 - area.y0;
  if (loaded.image.width != width || loaded.image.height != height)
    throw Error(Place{path, 0, 0}, "the reference has " + size_text(loaded.image.width, loaded.image.height) +
                                       ", but the report's images have " + size_text(width, height));
  if (shares_samples(loaded.attributes, job, budget))
    throw Error(Place{path, 0, 0}, "the reference holds the very samples of seed " +
                                       std::to_string(job.seed) +
                                       " that the report would draw; use another --seed");
  ReportReference reference;
  reference.image = linear_picture(loaded, path);
  refuse_bad_values(reference.image, path, "the reference ");
  reference.attributes = own_attributes(loaded.attributes, path);
  reference.source = path;
  if (const auto spp = find_integer(loaded.attributes, "meander/spp"); spp && *spp > 0) {
    reference.spp = static_cast<std::uint64_t>(*spp);
    reference.source += ", " + std::to_string(*spp) + " samples a pixel";
  }
  if (reference.image.channels < 6) {
    reference.source += ", without variance: its own error is unknown and not subtracted";
    return reference;
  }
  reference.noise = estimate_noise(reference.image, mask);
  reference.doubt = estimate_noise(reference.image, {}).doubt;
  return reference;
}

ReportReference make_reference(Job job, const Budget& budget, bool quiet, const std::atomic<bool>& stop) {
  job.seed += 1;
  job.estimator = Estimator::implicit;
  if (!quiet)
    std::fprintf(stderr, "reference, implicit, seed %llu\n", static_cast<unsigned long long>(job.seed));
  ProgressReport progress(budget, quiet);
  ReportReference reference;
  reference.rendering = render(job, budget, stop, [&](const Rendering& done) { progress.show(done); });
  progress.finish();
  if (stop) throw Error(Fault::runtime, "interrupted before the reference was complete; nothing was written");
  reference.image = resolve(reference.rendering.film);
  reference.doubt = estimate_noise(reference.rendering.film, {}).doubt;
  reference.rendering.film = {};
  reference.noise = reference.rendering.noise;
  reference.spp = reference.rendering.spp;
  reference.attributes = image_attributes(job, reference.rendering);
  reference.source = "implicit, " + std::to_string(reference.rendering.spp) + " samples a pixel, seed " +
                     std::to_string(job.seed);
  return reference;
}

Budget reference_budget(const Budget& budget, std::optional<std::uint64_t> spp) noexcept {
  if (spp) return {spp, {}, {}};
  Budget larger = budget;
  if (larger.spp) larger.spp = std::min(*larger.spp * kTimesLarger, kMostSpp);
  if (larger.seconds) *larger.seconds *= static_cast<double>(kTimesLarger);
  if (larger.error) *larger.error /= 4;
  return larger;
}

}  // namespace meander
