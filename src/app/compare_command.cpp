// The verb compare.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/command_line.h"
#include "app/comparison.h"
#include "app/linear_picture.h"
#include "core/error.h"
#include "io/image_file.h"
#include "io/output_file.h"
#include "math/color.h"
#include "stats/error_picture.h"

namespace meander {
namespace {

struct CompareOptions {
  std::string a;
  std::string b;
  std::string mask;
  std::string output;
  CompareLimits limits;
  std::optional<double> scale;
  bool absolute = false;
  bool json = false;
  bool quiet = false;
};

constexpr std::array<std::string_view, 2> kOutputs{".exr", ".png"};

std::string size_text(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

// check_writable lets the type be in any case.
bool is_png(const std::string& path) { return CLI::detail::to_lower(path).ends_with(".png"); }

using Mask = std::vector<std::uint8_t>;

// A pixel counts where a colour is above 0; alpha, the last of two or four channels, is none.
Mask read_mask(const std::string& path, const Image& like) {
  if (path.empty()) return {};
  const Image image = read_image(path).image;
  if (image.width != like.width || image.height != like.height)
    throw Error(Place{path, 0, 0},
                "the mask has " + size_text(image) + " pixels, but the images have " + size_text(like));
  const int colors = image.channels < 3 ? 1 : 3;
  Mask mask;
  for (int y = 0; y < like.height; ++y)
    for (int x = 0; x < like.width; ++x)
      mask.push_back(std::any_of(image.at(x, y), image.at(x, y) + colors, [](float v) { return v > 0; }));
  if (std::all_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m == 0; }))
    throw Error(Place{path, 0, 0}, "the mask is black everywhere: no pixel would be compared");
  return mask;
}

bool counts(const Mask& mask, std::size_t pixel) { return mask.empty() || mask[pixel] != 0; }

// d = A - B or |d|, times the scale; 0 where the mask leaves a pixel out.
Image difference(const Image& a, const Image& b, const Mask& mask, const CompareOptions& options) {
  const auto scale = static_cast<float>(options.scale.value_or(1));
  Image result(a.width, a.height, 3);
  for (std::size_t pixel = 0; pixel < result.values.size() / 3; ++pixel) {
    if (!counts(mask, pixel)) continue;
    for (int c = 0; c < 3; ++c) {
      const float d = scale * (a.values[pixel * a.channels + c] - b.values[pixel * b.channels + c]);
      result.values[pixel * 3 + c] = options.absolute ? std::abs(d) : d;
    }
  }
  return result;
}

constexpr double kPictureScale = 10;  // full colour at a relative error of a tenth

// What the colours of the picture say.
std::string picture_text(const CompareOptions& options) {
  std::array<char, 40> full{};
  std::snprintf(full.data(), full.size(), "%.6g", 1 / options.scale.value_or(kPictureScale));
  return std::string(options.absolute ? "|A - B|" : "(A - B)") + " / (|B| + 0.01) of the luminance: " +
         (options.absolute ? "dark violet 0, light yellow "
                           : "grey 0, orange A brighter, blue A darker, full colour at ") +
         full.data() + "; green not finite";
}

void write_picture(const Image& a, const Image& b, const Mask& mask, const CompareOptions& options) {
  Image8 picture = error_picture(a, b, 1 / options.scale.value_or(kPictureScale), options.absolute);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i)
    if (!counts(mask, i / 3)) picture.rgb[i] = 0;
  ImageAttributes attributes;
  attributes.text = {{"meander/picture", picture_text(options)}};
  write_png(options.output, picture, attributes);
}

void write_output(const Image& a, const Image& b, const Mask& mask, const CompareOptions& options) {
  if (is_png(options.output)) {
    write_picture(a, b, mask, options);
    return;
  }
  const std::array<std::string, 3> channels{"R", "G", "B"};
  write_exr(options.output, difference(a, b, mask, options), channels, {});
}

// The report on standard output; what fails, and unless --quiet what is only worth a warning, on the other.
void print(const Comparison& comparison, const CompareOptions& options) {
  if (!options.quiet) {
    std::string text = options.json ? comparison_json(comparison) : comparison_text(comparison);
    if (!options.json && is_png(options.output)) text += "picture           " + picture_text(options) + "\n";
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
  }
  for (const std::string& line : comparison.failures) std::fprintf(stderr, "failed: %s\n", line.c_str());
  if (options.quiet) return;
  for (const std::string& line : comparison.warnings) std::fprintf(stderr, "warning: %s\n", line.c_str());
}

struct Picture {
  Image image;
  ImageAttributes attributes;
};

Picture read_picture(const std::string& path) {
  const LoadedImage loaded = read_image(path);
  return {linear_picture(loaded, path), loaded.attributes};
}

int run_compare(const CompareOptions& options) {
  if (!options.output.empty()) check_writable(options.output, kOutputs);
  refuse_overwriting("--output", options.output, std::array{options.a, options.b, options.mask});
  const Picture first = read_picture(options.a);
  const Picture second = read_picture(options.b);
  const Image& a = first.image;
  const Image& b = second.image;
  if (a.width != b.width || a.height != b.height)
    throw Error(Fault::input, "the images differ in size: " + options.a + " has " + size_text(a) + " and " +
                                  options.b + " " + size_text(b) + " pixels; they must be equal");
  for (const auto& [image, path] : {std::pair(&a, &options.a), std::pair(&b, &options.b)})
    if (options.limits.z_test && image->channels < 6)
      throw Error(Place{*path, 0, 0}, "carries no variance channels, which --z-test needs");
  const Mask mask = read_mask(options.mask, a);
  Comparison comparison = compare_images(a, b, mask, options.limits);
  use_stored_noise(first.attributes, comparison.noise_a);
  use_stored_noise(second.attributes, comparison.noise_b);
  warn_of_shared_samples(first.attributes, second.attributes, comparison);
  if (!options.output.empty()) write_output(a, b, mask, options);
  print(comparison, options);
  return comparison.passed() ? 0 : 1;
}

void add_pixel_limits(CLI::App& verb, PixelLimits& limits, const std::string& name) {
  const std::string group = "Limits on pixels, as idiff's, but only those that are given";
  const std::string does = name == "fail" ? "fail" : "warn (exit code 0)";
  verb.add_option("--" + name, limits.each, does + " when pixels differ by more than this in a channel")
      ->check(at_least(0))
      ->group(group);
  verb.add_option("--" + name + "-percent", limits.percent,
                  "allow this percentage of the pixels to exceed --" + name + " (0)")
      ->check(number_between(0, 100))
      ->group(group);
  verb.add_option("--hard-" + name, limits.any, does + " when any pixel differs by more than this")
      ->check(at_least(0))
      ->group(group);
}

void add_metric_limits(CLI::App& verb, CompareLimits& limits) {
  const auto add = [&](const char* name, std::optional<double>& limit, const char* text,
                       const CLI::Validator& check) {
    verb.add_option(name, limit, text)->check(check)->group("Limits on metrics");
  };
  add("--max-rmse", limits.max_rmse, "fail above this RMSE", at_least(0));
  add("--max-relative-rmse", limits.max_relative_rmse, "fail above this RMSE / mean |B|", at_least(0));
  add("--max-relmse", limits.max_relmse, "fail above this mean of (A - B)^2 / (B^2 + 0.0001)", at_least(0));
  add("--max-mae", limits.max_mae, "fail above this mean absolute error", at_least(0));
  add("--min-psnr", limits.min_psnr, "fail below this PSNR (dB, peak 1)", finite_number());
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  CLI::App* verb = app.add_subcommand("compare",
                                      "error of image A against the reference B (EXR, HDR, PFM, PNG, TIFF); "
                                      "exit code 1 when they differ: by more "
                                      "than the options allow, or at all when no option allows anything");
  const auto o = std::make_shared<CompareOptions>();
  verb->add_option("A", o->a, "image")->required()->check(file_name());
  verb->add_option("B", o->b, "reference image")->required()->check(file_name());
  verb->add_option("--mask", o->mask, "image whose non-zero pixels are compared")->check(file_name());
  verb->add_flag("--z-test", o->limits.z_test,
                 "fail where noise cannot explain the difference (both need variance channels)");
  add_metric_limits(*verb, o->limits);
  add_pixel_limits(*verb, o->limits.fail, "fail");
  add_pixel_limits(*verb, o->limits.warn, "warn");
  CLI::Option* output = verb->add_option(
      "-o,--output", o->output,
      "difference A - B (.exr), or picture of the relative error (.png: orange brighter, blue darker)");
  output->check(file_name());
  verb->add_option("--scale", o->scale,
                   "multiply what --output shows (.exr: 1; .png: 10, which is full colour at 10 % error)")
      ->check(greater_than(0))
      ->needs(output);
  verb->add_flag("--abs", o->absolute, "show the absolute difference instead")->needs(output);
  CLI::Option* json = verb->add_flag("--json", o->json, "print JSON");
  verb->add_flag("-q,--quiet", o->quiet, "print nothing but what fails")->excludes(json);
  verb->callback([o, &action] { action = [o] { return run_compare(*o); }; });
}

}  // namespace meander
