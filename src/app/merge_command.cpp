// The verb merge.
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/command_line.h"
#include "app/linear_picture.h"
#include "app/run_stats.h"
#include "core/error.h"
#include "film/film_union.h"
#include "io/image_file.h"

namespace meander {
namespace {

constexpr std::array<std::string_view, 1> kExr{".exr"};

struct MergeOptions {
  std::vector<std::string> inputs;
  std::string output;
  bool quiet = false;
};

const std::string* find_text(const ImageAttributes& attributes, const char* name) {
  for (const auto& [key, value] : attributes.text)
    if (key == name) return &value;
  return nullptr;
}

// One image and what it says of itself; all that merge asks of one is checked.
struct Part {
  std::string path;
  Image image;
  Placement placement;
  std::string scene;
  std::string digest;
  std::uint64_t spp = 0;
  SampleRanges samples;
  std::optional<double> noise = {};  // over the object's pixels, as its render knew it
  std::int64_t noise_pixels = 0;
};

std::uint64_t sample_count(const SampleRanges& ranges) {
  std::uint64_t count = 0;
  for (const SampleRange& range : ranges) count += range.last - range.first + 1;
  return count;
}

Part read_part(const std::string& path) {
  const Place place{path, 0, 0};
  const LoadedImage loaded = read_image(path);
  const std::string* digest = find_text(loaded.attributes, kDigestAttribute);
  const auto spp = find_integer(loaded.attributes, "meander/spp");
  const auto samples = samples_of(loaded.attributes);
  if (loaded.encoded || !digest || !spp || *spp < 1 || !samples)
    throw Error(place, std::string("is no image that can be merged: it must be an EXR of meander render or "
                                   "merge, with the attributes meander/spp, meander/seed and ") +
                           kDigestAttribute);
  if (sample_count(joined(*samples)) != static_cast<std::uint64_t>(*spp))
    throw Error(place, "says that it has " + std::to_string(*spp) + " samples a pixel, and that they are " +
                           ranges_text(*samples));
  Part part{path,    linear_picture(loaded, path),     loaded.placement, {},
            *digest, static_cast<std::uint64_t>(*spp), *samples};
  if (const std::string* scene = find_text(loaded.attributes, "meander/scene")) part.scene = *scene;
  part.noise = find_number(loaded.attributes, kNoiseAttribute);
  part.noise_pixels = find_integer(loaded.attributes, kNoisePixelsAttribute).value_or(0);
  if (part.spp > 1 && part.image.channels < 6)
    throw Error(place, "has no variance channels, which merge needs from two samples a pixel on");
  refuse_bad_values(part.image, path, "");
  return part;
}

std::string place_text(const Part& part) {
  return std::to_string(part.image.width) + " x " + std::to_string(part.image.height) + " pixels at " +
         std::to_string(part.placement.x) + "," + std::to_string(part.placement.y);
}

bool same_place(const Part& a, const Part& b) {
  return a.image.width == b.image.width && a.image.height == b.image.height &&
         a.placement.x == b.placement.x && a.placement.y == b.placement.y;
}

// What is kept of the parts that were added; their pixels are in the union.
class Merge {
 public:
  void add(const Part& part) {
    const bool is_first = sum_.samples() == 0;
    if (is_first) first_ = {part.path, Image(), part.placement, part.scene, part.digest, 0, {}};
    if (!is_first) refuse_stranger(part);
    for (const auto& [path, samples] : added_)
      if (const auto shared = shared_samples(samples, part.samples))
        throw Error(Place{part.path, 0, 0}, "shares samples " + std::to_string(shared->first) + " to " +
                                                std::to_string(shared->last) + " of seed " +
                                                std::to_string(shared->seed) + " with " + path +
                                                "; render disjoint ranges (--first-sample) or other seeds");
    add_noise(part, is_first);
    sum_.add(part.image, part.spp);
    added_.emplace_back(part.path, part.samples);
    first_.image.width = part.image.width;
    first_.image.height = part.image.height;
  }

  [[nodiscard]] SampleRanges samples() const {
    SampleRanges all;
    for (const auto& [path, samples] : added_) all.insert(all.end(), samples.begin(), samples.end());
    return joined(std::move(all));
  }

  void write(const std::string& output) const {
    const std::array<std::string, 6> channels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};
    ImageAttributes attributes;
    attributes.text = {{"meander/scene", first_.scene},
                       {kDigestAttribute, first_.digest},
                       {"meander/version", version_text()}};
    add_samples(samples(), attributes);
    if (noise_known_) {
      const double noise = std::sqrt(squared_noise_) / static_cast<double>(sum_.samples());
      meander::add_noise(noise, first_.noise_pixels, attributes);
    }
    write_exr(output, sum_.resolve(), channels, attributes, first_.placement);
  }

 private:
  void refuse_stranger(const Part& part) const {
    const Place place{part.path, 0, 0};
    if (!same_place(part, first_))
      throw Error(place, "has " + place_text(part) + ", but " + first_.path + " has " + place_text(first_) +
                             "; they must be equal");
    if (part.digest != first_.digest)
      throw Error(place, "shows another scene, or other values of it ('" + part.scene + "', digest " +
                             part.digest + "), than " + first_.path + " ('" + first_.scene + "', digest " +
                             first_.digest + ")");
  }

  // The parts are independent: their variances add up, each by the square of its samples.
  void add_noise(const Part& part, bool is_first) {
    const bool known = part.noise && *part.noise >= 0 && part.noise_pixels > 0;
    if (is_first) first_.noise_pixels = part.noise_pixels;
    noise_known_ = (is_first || noise_known_) && known && part.noise_pixels == first_.noise_pixels;
    if (!noise_known_) return;
    const double own = *part.noise * static_cast<double>(part.spp);
    squared_noise_ += own * own;
  }

  Part first_;  // its pixels aside
  bool noise_known_ = false;
  double squared_noise_ = 0;  // times the square of the samples
  std::vector<std::pair<std::string, SampleRanges>> added_;
  FilmUnion sum_;
};

int run_merge(const MergeOptions& options) {
  if (options.inputs.size() < 2) throw Error(Fault::input, "merge needs two images or more");
  check_writable(options.output, kExr);
  refuse_overwriting("--output", options.output, options.inputs);
  Merge merge;
  for (const std::string& input : options.inputs) merge.add(read_part(input));
  merge.write(options.output);
  if (!options.quiet) {
    const SampleRanges samples = merge.samples();
    std::fprintf(stderr, "%s: %llu spp of %zu images, samples %s\n", options.output.c_str(),
                 static_cast<unsigned long long>(sample_count(samples)), options.inputs.size(),
                 ranges_text(samples).c_str());
  }
  return 0;
}

}  // namespace

void add_merge_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand(
      "merge", "the union of images of one scene with disjoint samples, as if one run had made them");
  const auto o = std::make_shared<MergeOptions>();
  verb->add_option("IN", o->inputs, "images of meander render or merge (.exr)")
      ->required()
      ->check(file_name());
  verb->add_option("-o,--output", o->output, "image file to write (.exr)")->required()->check(file_name());
  verb->add_flag("--quiet", o->quiet, "say nothing but errors");
  verb->callback([=, &action] { action = [=] { return run_merge(*o); }; });
}

}  // namespace meander
