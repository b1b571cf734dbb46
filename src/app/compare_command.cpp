// The verb compare.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>

#include "app/command_line.h"
#include "app/linear_picture.h"
#include "core/error.h"
#include "io/image_file.h"
#include "math/color.h"
#include "stats/image_error.h"

namespace meander {
namespace {

struct CompareOptions {
  std::string a;
  std::string b;
  std::string mask;
  std::string output;
  std::optional<double> max_relmse;
  bool z_test = false;
  bool quiet = false;
};

constexpr std::array<std::string_view, 2> kOutputs{".exr", ".png"};

std::vector<std::uint8_t> read_mask(const std::string& path, const Image& like) {
  if (path.empty()) return {};
  const LoadedImage loaded = read_image(path);
  if (loaded.image.width != like.width || loaded.image.height != like.height)
    throw Error(Place{path, 0, 0}, "the mask's size differs from the images'");
  std::vector<std::uint8_t> mask;
  for (int y = 0; y < like.height; ++y)
    for (int x = 0; x < like.width; ++x) mask.push_back(loaded.image.at(x, y)[0] > 0);
  if (std::all_of(mask.begin(), mask.end(), [](std::uint8_t m) { return m == 0; }))
    throw Error(Place{path, 0, 0}, "the mask is black everywhere: no pixel would be compared");
  return mask;
}

Image difference(const Image& a, const Image& b) {
  Image result(a.width, a.height, 3);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int c = 0; c < 3; ++c) result.at(x, y)[c] = a.at(x, y)[c] - b.at(x, y)[c];
  return result;
}

// Red where A is brighter, blue where it is darker; full colour where the relative difference reaches a
// tenth.
Image8 difference_picture(const Image& a, const Image& b) {
  Image8 picture(a.width, a.height);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      const float* pa = a.at(x, y);
      const float* pb = b.at(x, y);
      const Rgb ca(pa[0], pa[1], pa[2]);
      const Rgb cb(pb[0], pb[1], pb[2]);
      const Real relative = (luminance(ca) - luminance(cb)) / (std::abs(luminance(cb)) + Real(0.01));
      const auto strength =
          static_cast<std::uint8_t>(std::lround(255 * std::min(10 * std::abs(relative), Real(1))));
      picture.at(x, y)[relative > 0 ? 0 : 2] = strength;
      picture.at(x, y)[1] = strength / 3;
    }
  return picture;
}

void print_error(const ImageError& e) {
  std::printf("pixels         %zu\nrmse           %.9g\nrelative_rmse  %.9g\nrelmse         %.9g\n", e.pixels,
              e.rmse, e.relative_rmse, e.relmse);
  std::printf(
      "mae            %.9g\npsnr           %.6g dB\nmean_signed    %.9g\nmax_abs        %.9g\nnon_finite     "
      "%zu\n",
      e.mae, e.psnr, e.mean_signed, e.max_abs, e.non_finite);
}

void print_z_test(const ZTest& z) {
  std::printf("z_test         %s\n", z.passed ? "passed" : "FAILED");
  std::printf("  values       %s: %.4f %% beyond |z| %.3f, worst z %.3f\n",
              z.pixels_passed ? "passed" : "FAILED", 100 * z.failed_fraction, z.pixel_threshold,
              z.worst_pixel_z);
  std::printf("  blocks       %s: worst z %.3f, threshold %.3f, p %.3g\n",
              z.blocks_passed ? "passed" : "FAILED", z.worst_block_z, z.block_threshold, z.block_p);
  std::printf("  image        %s: z %.3f %.3f %.3f, threshold %.3f, p %.3g\n",
              z.image_passed ? "passed" : "FAILED", z.image_z[0], z.image_z[1], z.image_z[2],
              z.image_threshold, z.image_p);
}

void write_difference(const std::string& path, const Image& a, const Image& b) {
  if (path.ends_with(".png")) {
    write_png(path, difference_picture(a, b), {});
    return;
  }
  const std::array<std::string, 3> channels{"R", "G", "B"};
  write_exr(path, difference(a, b), channels, {});
}

int run_compare(const CompareOptions& options) {
  if (!options.output.empty()) check_writable(options.output, kOutputs);
  const LoadedImage loaded_a = read_image(options.a);
  const LoadedImage loaded_b = read_image(options.b);
  const Image a = linear_picture(loaded_a, options.a);
  const Image b = linear_picture(loaded_b, options.b);
  if (a.width != b.width || a.height != b.height)
    throw Error(Fault::input, "the images differ in size: " + std::to_string(a.width) + "x" +
                                  std::to_string(a.height) + " and " + std::to_string(b.width) + "x" +
                                  std::to_string(b.height));
  const std::vector<std::uint8_t> mask = read_mask(options.mask, a);
  const ImageError error = image_error(a, b, mask);
  bool differs = error.non_finite > 0;
  if (!options.quiet) print_error(error);
  if (options.max_relmse) differs |= !(error.relmse <= *options.max_relmse);
  if (options.z_test) {
    for (const auto& [image, path] : {std::pair(&a, &options.a), std::pair(&b, &options.b)})
      if (image->channels < 6)
        throw Error(Place{*path, 0, 0}, "carries no variance channels, which --z-test needs");
    const ZTest z = z_test(a, b, mask);
    if (!options.quiet) print_z_test(z);
    differs |= !z.passed;
  }
  if (!options.max_relmse && !options.z_test) differs |= error.max_abs > 0;
  if (!options.output.empty()) write_difference(options.output, a, b);
  return differs ? 1 : 0;
}

}  // namespace

void add_compare_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("compare", "error of image A against the reference B; exit code 1 when they differ");
  const auto o = std::make_shared<CompareOptions>();
  verb->add_option("A", o->a, "image")->required();
  verb->add_option("B", o->b, "reference image")->required();
  verb->add_option("--mask", o->mask, "image whose non-zero pixels are compared");
  verb->add_flag("--z-test", o->z_test,
                 "differ only where noise cannot explain it (both need variance channels)");
  verb->add_option("--max-relmse", o->max_relmse, "differ only above this relative squared error")
      ->check(at_least(0));
  verb->add_option("--output", o->output,
                   "difference A - B (.exr), or its picture (.png: red brighter, blue darker)");
  verb->add_flag("--quiet", o->quiet, "print nothing");
  verb->callback([o, &action] { action = [o] { return run_compare(*o); }; });
}

}  // namespace meander
