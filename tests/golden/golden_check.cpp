// Compares a picture with its golden one, leaves evidence where they differ, and plants faults for the tests
// of the tests. golden_check statistical RENDER.exr GOLDEN.exr FOLDER TESTS
//            golden_check drawn DRAWN.png GOLDEN.png FOLDER TOLERANCE
//            golden_check fault NAME IN.exr|png OUT.exr|png
// Exit codes: 0 they agree, 1 they differ (the last line names the page in FOLDER), 2 wrong use or unreadable
// files.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "app/linear_picture.h"
#include "golden/evidence.h"
#include "golden/faults.h"
#include "io/image_file.h"
#include "stats/distributions.h"
#include "stats/error_picture.h"
#include "stats/image_error.h"

namespace meander {
namespace {

namespace fs = std::filesystem;

constexpr double kAlpha = 0.01;      // chance that any of the TESTS fails for no reason
constexpr double kErrorScale = 0.2;  // relative error of the last colour

std::string text(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.4g", value);
  return buffer.data();
}

std::string summary(const ZTest& test) {
  return "p " + text(test.p) + " (values " + text(test.pixels_p) + ", blocks " + text(test.block_p) +
         ", image " + text(test.image_p) + "); values beyond: " + text(100 * test.failed_fraction) +
         " %; worst value z " + text(test.worst_pixel_z) + ", block z " + text(test.worst_block_z) +
         ", image z " + text(test.image_z[0]) + " " + text(test.image_z[1]) + " " + text(test.image_z[2]);
}

std::vector<std::pair<std::string, std::string>> numbers(const ZTest& test) {
  return {{"p of the whole test", text(test.p)},
          {"p of the values (99.75 % must agree)", text(test.pixels_p)},
          {"p of the blocks of 8 x 8", text(test.block_p)},
          {"p of the image's means", text(test.image_p)},
          {"values that do not agree", text(100 * test.failed_fraction) + " %"},
          {"worst value, z (limit)", text(test.worst_pixel_z) + " (" + text(test.pixel_threshold) + ")"},
          {"worst block, z (limit)", text(test.worst_block_z) + " (" + text(test.block_threshold) + ")"},
          {"image, z of R G B (limit)", text(test.image_z[0]) + " " + text(test.image_z[1]) + " " +
                                            text(test.image_z[2]) + " (" + text(test.image_threshold) + ")"},
          {"values that are not finite", std::to_string(test.non_finite)}};
}

// The render under a name that is not the golden's.
std::string beside(const std::string& folder, const std::string& file, const std::string& name) {
  fs::create_directories(folder);
  const fs::path copy = fs::path(folder) / (name + fs::path(file).extension().string());
  fs::copy_file(file, copy, fs::copy_options::overwrite_existing);
  return copy.string();
}

void say_where(const std::string& page) { std::printf("FAILED: see %s\n", fs::absolute(page).c_str()); }

int check_statistical(const std::vector<std::string>& args) {
  const Image render = linear_picture(read_image(args[0]), args[0]);
  const Image golden = linear_picture(read_image(args[1]), args[1]);
  ZTestOptions options;
  options.alpha = sidak_level(kAlpha, std::stoul(args[3]));
  const ZTest test = z_test(render, golden, {}, options);
  std::printf("%s: %s\n", fs::path(args[1]).stem().c_str(), summary(test).c_str());
  if (test.passed) return 0;
  const ZScores scores = z_scores(render, golden);
  fs::create_directories(args[2]);
  Evidence evidence;
  evidence.title = fs::path(args[1]).stem().string() + ": a golden image";
  evidence.verdict = "Noise does not explain the difference: " + summary(test);
  evidence.numbers = numbers(test);
  evidence.pictures = {
      {"render_shown", "the render", developed(render)},
      {"golden_shown", "the golden image", developed(golden)},
      {"difference", "difference of luminance: orange brighter than golden, blue darker, full colour at 20 %",
       error_picture(render, golden, kErrorScale, false)},
      {"p_values", "p of every value alone: dark violet 1, light yellow 1e-10",
       p_value_picture(scores.values)},
      {"p_blocks", "p of every block alone: the same colours", p_value_picture(scores.blocks)}};
  write_exr(args[2] + "/z.exr", scores.values, std::array<std::string, 3>{"R", "G", "B"}, {});
  evidence.files = {beside(args[2], args[0], "render"), beside(args[2], args[1], "golden"),
                    args[2] + "/z.exr"};
  say_where(write_evidence(evidence, args[2]));
  return 1;
}

// A PNG's levels, 0 to 255.
Image8 levels(const std::string& path) {
  const Image image = read_image(path).image;
  Image8 picture(image.width, image.height);
  for (std::size_t pixel = 0; pixel < picture.rgb.size() / 3; ++pixel)
    for (std::size_t c = 0; c < 3; ++c)
      picture.rgb[3 * pixel + c] = static_cast<std::uint8_t>(std::lround(
          255 * image.values[pixel * image.channels + std::min<std::size_t>(c, image.channels - 1)]));
  return picture;
}

struct LevelDifference {
  int largest = 0;
  std::size_t beyond = 0;  // pixels
  Image8 picture;          // eight times the difference
};

LevelDifference level_difference(const Image8& a, const Image8& b, int tolerance) {
  LevelDifference found{0, 0, Image8(b.width, b.height)};
  for (std::size_t pixel = 0; pixel < b.rgb.size() / 3; ++pixel) {
    int largest = 0;
    for (std::size_t at = 3 * pixel; at < 3 * pixel + 3; ++at) {
      const int off = std::abs(int{a.rgb[at]} - int{b.rgb[at]});
      largest = std::max(largest, off);
      found.picture.rgb[at] = static_cast<std::uint8_t>(std::min(255, 8 * off));
    }
    found.largest = std::max(found.largest, largest);
    found.beyond += largest > tolerance;
  }
  return found;
}

int check_drawn(const std::vector<std::string>& args) {
  const Image8 drawn = levels(args[0]);
  const Image8 golden = levels(args[1]);
  const int tolerance = std::stoi(args[3]);
  const bool same_size = drawn.width == golden.width && drawn.height == golden.height;
  const LevelDifference found = same_size ? level_difference(drawn, golden, tolerance) : LevelDifference{};
  const std::string verdict = same_size ? "largest difference " + std::to_string(found.largest) +
                                              " levels, allowed " + args[3] +
                                              "; pixels beyond that: " + std::to_string(found.beyond)
                                        : std::string("the sizes differ");
  std::printf("%s: %s\n", fs::path(args[1]).stem().c_str(), verdict.c_str());
  if (same_size && found.beyond == 0) return 0;
  Evidence evidence;
  evidence.title = fs::path(args[1]).stem().string() + ": a drawn golden image";
  evidence.verdict = verdict;
  evidence.pictures = {{"drawn_shown", "as drawn now", drawn}, {"golden_shown", "the golden image", golden}};
  if (same_size)
    evidence.pictures.push_back({"difference", "eight times the difference of levels", found.picture});
  evidence.files = {beside(args[2], args[0], "drawn"), beside(args[2], args[1], "golden")};
  say_where(write_evidence(evidence, args[2]));
  return 1;
}

// A drawn picture's fault is planted in its levels.
int make_fault(const std::vector<std::string>& args) {
  LoadedImage loaded = read_image(args[1]);
  const bool drawn = loaded.encoded;
  Image image = drawn ? loaded.image : linear_picture(loaded, args[1]);
  if (!plant_fault(image, args[0])) {
    std::fprintf(stderr,
                 "golden_check: no fault is called '%s': pixel, shift, blur, block (of an EXR) or tone\n",
                 args[0].c_str());
    return 2;
  }
  if (drawn) {
    Image8 picture(image.width, image.height);
    std::ranges::transform(image.values, picture.rgb.begin(),
                           [](float v) { return static_cast<std::uint8_t>(std::lround(255 * v)); });
    write_png(args[2], picture, {});
    return 0;
  }
  const std::array<std::string, 6> channels{"R", "G", "B", "variance.R", "variance.G", "variance.B"};
  write_exr(args[2], image, channels, loaded.attributes);
  return 0;
}

int run(const std::vector<std::string>& args) {
  const std::string verb = args.empty() ? "" : args.front();
  const std::vector<std::string> rest(args.begin() + (args.empty() ? 0 : 1), args.end());
  if (verb == "statistical" && rest.size() == 4) return check_statistical(rest);
  if (verb == "drawn" && rest.size() == 4) return check_drawn(rest);
  if (verb == "fault" && rest.size() == 3) return make_fault(rest);
  std::fputs(
      "usage: golden_check statistical RENDER.exr GOLDEN.exr FOLDER TESTS | drawn DRAWN.png GOLDEN.png "
      "FOLDER "
      "TOLERANCE | fault NAME IN OUT\n",
      stderr);
  return 2;
}

}  // namespace
}  // namespace meander

int main(int argc, char** argv) {
  try {
    return meander::run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "golden_check: %s\n", error.what());
    return 2;
  }
}
