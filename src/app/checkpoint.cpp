#include "app/checkpoint.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "app/run_stats.h"
#include "core/digest.h"
#include "core/error.h"
#include "io/checkpoint_file.h"
#include "scene/scene_digest.h"

namespace meander {
namespace {

// The name of a scene comes from a file's, and may hold anything.
std::string one_line(std::string text) {
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c == 0x7f; }, '?');
  return text;
}

std::string size_text(const FilmSize& film) {
  return std::to_string(film.width) + " x " + std::to_string(film.height);
}

std::string crop_text(const Job& job) {
  if (!job.crop) return "none";
  const Tile& crop = *job.crop;
  return std::to_string(crop.x0) + ',' + std::to_string(crop.y0) + ',' + std::to_string(crop.x1) + ',' +
         std::to_string(crop.y1);
}

// What a run must share with its checkpoint, and the words for it; in this order they are checked.
CheckpointFields identity_of(const Job& job) {
  return {{"version", version_text()},
          {"size", size_text(job.scene->film)},
          {"crop", crop_text(job)},
          {"seed", std::to_string(job.seed)},
          {"first_sample", std::to_string(job.first_sample)},
          {"estimator", job.estimator == Estimator::analog ? "analog" : "implicit"},
          {"walk", uses_lanes(job) ? "batch" : "scalar"},
          {"isa", std::string(uses_lanes(job) ? name_of(job.instruction_set) : "any")},
          {"scene_digest", hex_text(digest_of(*job.scene))}};
}

std::array<std::pair<const char*, std::uint64_t>, 6> counts_of(const Rendering& r) {
  return {{{"spp", r.spp},
           {"walks", r.counters.walks},
           {"steps", r.counters.steps},
           {"rays", r.counters.rays},
           {"leaked_walks", r.counters.leaked_walks},
           {"non_finite", r.non_finite}}};
}

// Enough digits to read back as the same number.
std::string exact_text(double value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

template <class Number>
Number number_field(const std::string& path, const CheckpointFields& fields, std::string_view name) {
  const std::string* text = find_field(fields, name);
  Number value{};
  if (text) {
    const char* end = text->data() + text->size();
    const auto [parsed, failed] = std::from_chars(text->data(), end, value);
    if (failed == std::errc() && parsed == end) return value;
  }
  throw Error(Place{path, 0, 0}, "is damaged: its '" + std::string(name) + "' is no number");
}

void check_identity(const std::string& path, const CheckpointFields& fields, const Job& job) {
  for (const auto& [name, own] : identity_of(job)) {
    const std::string* held = find_field(fields, name);
    if (held && *held == own) continue;
    if (held && name == "scene_digest") {
      const std::string* scene = find_field(fields, "scene");
      throw Error(Place{path, 0, 0}, "is a checkpoint of another scene, or of other values of it (it was '" +
                                         (scene ? *scene : "?") + "'), than this run's '" +
                                         one_line(job.scene->name) + "'");
    }
    throw Error(Place{path, 0, 0}, "is a checkpoint of a run with " + name + " " +
                                       (held ? *held : "unknown") + "; this one has " + own);
  }
}

}  // namespace

void save_checkpoint(const std::string& path, const Job& job, const Rendering& rendering) {
  CheckpointFields fields = identity_of(job);
  fields.emplace_back("scene", one_line(job.scene->name));
  for (const auto& [name, count] : counts_of(rendering)) fields.emplace_back(name, std::to_string(count));
  fields.emplace_back("seconds", exact_text(rendering.seconds));
  write_checkpoint(path, fields, rendering.film);
}

Rendering load_checkpoint(const std::string& path, const Job& job, const Budget& budget) {
  Checkpoint checkpoint = read_checkpoint(path);
  const CheckpointFields& fields = checkpoint.fields;
  check_identity(path, fields, job);
  const auto count = [&](std::string_view name) { return number_field<std::uint64_t>(path, fields, name); };
  Rendering rendering;
  rendering.spp = count("spp");
  rendering.counters = {count("walks"), count("steps"), count("rays"), count("leaked_walks")};
  rendering.non_finite = count("non_finite");
  rendering.seconds = number_field<double>(path, fields, "seconds");
  rendering.film = std::move(checkpoint.film);
  const Tile area = area_of(job);
  const bool fits = rendering.film.width == area.x1 - area.x0 && rendering.film.height == area.y1 - area.y0;
  const bool counted = std::ranges::all_of(rendering.film.pixels,
                                           [&](const Pixel& pixel) { return pixel.count == rendering.spp; });
  if (!fits || !counted || rendering.spp == 0 || !(rendering.seconds >= 0) ||
      !std::isfinite(rendering.seconds))
    throw Error(Place{path, 0, 0}, "is damaged: its numbers contradict one another");
  if (budget.spp && rendering.spp > *budget.spp)
    throw Error(Place{path, 0, 0}, "holds " + std::to_string(rendering.spp) +
                                       " samples a pixel, more than --spp " + std::to_string(*budget.spp));
  return rendering;
}

CheckpointKeeper::CheckpointKeeper(const Job& job, std::string path, double every_seconds)
    : job_(job), path_(std::move(path)), every_(every_seconds) {}

void CheckpointKeeper::keep(const Rendering& rendering) {
  if (since_.seconds() >= every_) save(rendering);
}

bool CheckpointKeeper::keep_last(const Rendering& rendering) {
  if (rendering.spp != kept_spp_) save(rendering);
  return rendering.spp == kept_spp_;
}

void CheckpointKeeper::save(const Rendering& rendering) {
  if (path_.empty()) return;
  try {
    save_checkpoint(path_, job_, rendering);
    kept_spp_ = rendering.spp;
    said_.clear();
  } catch (const Error& error) {
    if (said_ != error.what()) std::fprintf(stderr, "meander: warning: no checkpoint: %s\n", error.what());
    said_ = error.what();
  }
  since_ = Timer();
}

}  // namespace meander
