#include "app/run_stats.h"

#include <sys/resource.h>

#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/digest.h"
#include "scene/scene_digest.h"

namespace meander {
namespace {

std::uint64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

constexpr const char* kSamplesAttribute = "meander/samples";

// JSON has no infinity: what is not finite is null.
nlohmann::ordered_json finite(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

// The fewest digits that read back as the same number.
std::string shortest(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace

std::string version_text() { return MEANDER_VERSION; }

std::string stats_json(const Job& job, const Rendering& rendering, const char* ended_by) {
  const PathCounters& counters = rendering.counters;
  nlohmann::ordered_json stats;
  stats["version"] = version_text();
  stats["scene"] = job.scene->name;
  stats["seed"] = job.seed;
  stats["first_sample"] = job.first_sample;
  stats["threads"] = job.threads;
  stats["isa"] = uses_lanes(job) ? name_of(job.instruction_set) : "baseline";
  stats["width"] = rendering.film.width;
  stats["height"] = rendering.film.height;
  stats["spp"] = rendering.spp;
  stats["seconds"] = rendering.seconds;
  stats["ended_by"] = ended_by;
  stats["walks"] = counters.walks;
  stats["steps"] = counters.steps;
  stats["rays"] = counters.rays;
  stats["walks_per_second"] = finite(static_cast<double>(counters.walks) / rendering.seconds);
  stats["steps_per_second"] = finite(static_cast<double>(counters.steps) / rendering.seconds);
  stats["mean"] = mean_of(rendering.film);
  stats["relative_noise"] = finite(rendering.noise.noise);
  stats["noise_standard_error"] = finite(rendering.noise.standard_error);
  stats["noise_reliable"] = rendering.noise.reliable();
  stats["leaked_walks"] = counters.leaked_walks;
  stats["non_finite"] = rendering.non_finite;
  stats["peak_memory_bytes"] = peak_memory_bytes();
  stats["model"] = describe_model(job);
  stats["estimator"] = job.estimator == Estimator::analog ? "analog" : "implicit";
  return stats.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

ImageAttributes image_attributes(const Job& job, const Rendering& rendering) {
  ImageAttributes attributes;
  attributes.text = {{"meander/scene", job.scene->name},
                     {kDigestAttribute, hex_text(digest_of(*job.scene))},
                     {"meander/version", version_text()}};
  add_samples({{job.seed, job.first_sample, job.first_sample + rendering.spp - 1}}, attributes);
  const NoiseEstimate& noise = rendering.noise;
  if (noise.pixels > 0 && std::isfinite(noise.noise))
    add_noise(noise.noise, static_cast<std::int64_t>(noise.pixels), attributes);
  return attributes;
}

void add_noise(double noise, std::int64_t pixels, ImageAttributes& attributes) {
  attributes.text.emplace_back(kNoiseAttribute, shortest(noise));
  attributes.integers.emplace_back(kNoisePixelsAttribute, pixels);
}

void add_samples(const SampleRanges& samples, ImageAttributes& attributes) {
  std::uint64_t spp = 0;
  for (const SampleRange& range : samples) spp += range.last - range.first + 1;
  attributes.integers.emplace_back("meander/spp", static_cast<std::int64_t>(spp));
  if (samples.size() != 1) {
    attributes.text.emplace_back(kSamplesAttribute, ranges_text(samples));
    return;
  }
  const auto [seed, first, last] = samples.front();
  attributes.integers.emplace_back("meander/first_sample", static_cast<std::int64_t>(first));
  // Seeds beyond what an attribute's integer holds travel as text.
  if (seed <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max()))
    attributes.integers.emplace_back("meander/seed", static_cast<std::int64_t>(seed));
  else
    attributes.text.emplace_back("meander/seed", std::to_string(seed));
}

std::optional<SampleRanges> samples_of(const ImageAttributes& attributes) {
  for (const auto& [name, value] : attributes.text)
    if (name == kSamplesAttribute) return read_ranges(value);
  const auto seed = find_unsigned(attributes, "meander/seed");
  const auto spp = find_unsigned(attributes, "meander/spp");
  if (!seed || !spp || *spp == 0) return std::nullopt;
  const std::uint64_t first = find_unsigned(attributes, "meander/first_sample").value_or(0);
  return SampleRanges{{*seed, first, first + *spp - 1}};
}

}  // namespace meander
