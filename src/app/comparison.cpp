#include "app/comparison.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/run_stats.h"

namespace meander {
namespace {

using Json = nlohmann::ordered_json;
using Lines = std::vector<std::string>;

constexpr std::array<const char*, 3> kChannel{"R", "G", "B"};

std::string number(double value, const char* format = "%.9g") {
  if (std::isnan(value)) return "undefined";
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

// Far out, the normal's tail is below what a double holds.
std::string p_value(double p) { return p > 0 ? "p " + number(p, "%.3g") : std::string("p below 1e-300"); }

void check_metrics(const ImageError& error, const CompareLimits& limits, Lines& lines) {
  struct Upper {
    const char* name;
    double value;
    std::optional<double> limit;
    const char* option;
  };
  const std::array<Upper, 4> uppers{
      Upper{"rmse", error.rmse, limits.max_rmse, "--max-rmse"},
      Upper{"relative_rmse", error.relative_rmse, limits.max_relative_rmse, "--max-relative-rmse"},
      Upper{"relmse", error.relmse, limits.max_relmse, "--max-relmse"},
      Upper{"mae", error.mae, limits.max_mae, "--max-mae"}};
  for (const Upper& u : uppers) {
    if (u.limit && !(u.value <= *u.limit))
      lines.push_back(std::string(u.name) + " is " + number(u.value) + ", above " + u.option + " " +
                      number(*u.limit));
  }
  if (limits.min_psnr && !(error.psnr >= *limits.min_psnr))
    lines.push_back("psnr is " + number(error.psnr) + " dB, below --min-psnr " + number(*limits.min_psnr));
}

std::string largest(const ImageError& error) {
  return number(error.max_abs) + " (pixel " + std::to_string(error.max_x) + "," +
         std::to_string(error.max_y) + " " + kChannel[error.max_channel] + ")";
}

// `name` is that of the options: fail or warn.
void check_pixels(const Comparison& c, const PixelLimits& limits, const std::string& name, Lines& lines) {
  const std::optional<std::size_t> beyond = name == "fail" ? c.beyond_fail : c.beyond_warn;
  const double percent = limits.percent.value_or(0);
  const double pixels = static_cast<double>(c.error.pixels);
  if (beyond && static_cast<double>(*beyond) > percent / 100 * pixels) {
    lines.push_back(std::to_string(*beyond) + " of " + std::to_string(c.error.pixels) + " pixels (" +
                    number(100 * static_cast<double>(*beyond) / pixels, "%.4g") +
                    " %) differ by more than --" + name + " " + number(limits.each.value_or(0)) +
                    ", above --" + name + "-percent " + number(percent));
  }
  if (limits.any && c.error.max_abs > *limits.any)
    lines.push_back("the largest difference is " + largest(c.error) + ", above --hard-" + name + " " +
                    number(*limits.any));
}

double worst_of(const std::array<double, 3>& z) {
  double worst = 0;
  for (const double value : z) worst = std::abs(value) > std::abs(worst) ? value : worst;
  return worst;
}

std::string bias(const char* what, double z, double threshold, double p) {
  return std::string("z-test: ") + what + " is " + (z > 0 ? "brighter" : "darker") + " in A, z " +
         number(z, "%.3f") + " beyond " + number(threshold, "%.3f") + " (" + p_value(p) + ")";
}

void check_z_test(const ZTest& z, Lines& lines) {
  if (z.non_finite > 0)
    lines.push_back("z-test: values without a finite mean and a variance of 0 or more: " +
                    std::to_string(z.non_finite));
  if (!z.pixels_passed)
    lines.push_back("z-test: " + number(100 * z.failed_fraction, "%.4g") +
                    " % of the values are beyond |z| " + number(z.pixel_threshold, "%.3f") + ", above " +
                    number(100 - 100 * ZTestOptions{}.pixels_passing, "%.4g") + " %");
  if (!z.blocks_passed) lines.push_back(bias("a block", z.worst_block_z, z.block_threshold, z.block_p));
  if (!z.image_passed)
    lines.push_back(bias("the whole image", worst_of(z.image_z), z.image_threshold, z.image_p));
}

const char* source_text(ErrorSource source) {
  switch (source) {
    case ErrorSource::both_variances:
      return "variances of A and B";
    case ErrorSource::variance_of_a:
      return "variance of A alone";
    case ErrorSource::variance_of_b:
      return "variance of B alone";
    case ErrorSource::spread:
      return "spread over pixels";
  }
  return "";
}

ImageNoise noise_of(const Image& image, std::span<const std::uint8_t> mask) {
  const NoiseEstimate estimate = estimate_noise(image, mask);
  const bool all = estimate.pixels == static_cast<std::size_t>(image.width) * image.height;
  return {estimate.noise, estimate.pixels, all ? NoisePixels::all : NoisePixels::mask, estimate.doubt};
}

// A value or a variance that is not finite leaves no estimate at all.
std::string doubt_text(const ImageNoise& noise) {
  return std::isfinite(noise.relative) ? describe(noise.doubt) : "not all values and variances are finite";
}

bool is_doubted(const std::optional<ImageNoise>& noise) { return noise && !doubt_text(*noise).empty(); }

bool has_rare_samples(const std::optional<ImageNoise>& noise) {
  return noise && noise->doubt == NoiseDoubt::rare_bright_samples;
}

// "the object's 5012 pixels"
std::string pixels_text(const ImageNoise& noise) {
  const std::string count = std::to_string(noise.pixels) + " pixels";
  if (noise.over == NoisePixels::all) return "all " + count;
  return (noise.over == NoisePixels::mask ? "the mask's " : "the object's ") + count;
}

const char* verdict(bool passed) { return passed ? "passed" : "FAILED"; }

void row(std::string& text, std::string name, const std::string& value) {
  constexpr std::size_t kColumn = 18;
  if (name.size() < kColumn) name.resize(kColumn, ' ');
  text += name + value + "\n";
}

std::string with_error(double value, double error) { return number(value) + " +- " + number(error, "%.3g"); }

void put_noise(std::string& text, char image, const std::optional<ImageNoise>& noise) {
  if (!noise) return;
  row(text, std::string("relative_noise_") + image,
      number(noise->relative, "%.6g") + " (" + pixels_text(*noise) + ")");
  row(text, std::string("variance_") + image,
      is_doubted(noise) ? "not reliable: " + doubt_text(*noise) : "reliable");
}

void put_z_test(std::string& text, const Comparison& c) {
  const ZTest& z = *c.z;
  const bool rare = has_rare_samples(c.noise_a) || has_rare_samples(c.noise_b);
  row(text, "z_test",
      verdict(z.passed) + (z.non_finite > 0 ? "" : ", " + p_value(z.p)) +
          (rare ? ", by variances that rare bright samples carry" : ""));
  row(text, "  values",
      verdict(z.pixels_passed) + (": " + number(100 * z.failed_fraction, "%.4f")) + " % beyond |z| " +
          number(z.pixel_threshold, "%.3f") + ", worst z " + number(z.worst_pixel_z, "%.3f") + ", " +
          p_value(z.pixels_p));
  row(text, "  blocks",
      verdict(z.blocks_passed) + (": worst z " + number(z.worst_block_z, "%.3f")) + ", threshold " +
          number(z.block_threshold, "%.3f") + ", " + p_value(z.block_p));
  row(text, "  image",
      verdict(z.image_passed) + (": z " + number(z.image_z[0], "%.3f")) + " " + number(z.image_z[1], "%.3f") +
          " " + number(z.image_z[2], "%.3f") + ", threshold " + number(z.image_threshold, "%.3f") + ", " +
          p_value(z.image_p));
}

// JSON has no infinity and no NaN: what is not finite is null.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json estimate(double value, double error) {
  return {{"value", finite(value)}, {"standard_error", finite(error)}};
}

Json relative_noise(const std::optional<ImageNoise>& noise) {
  return noise ? finite(noise->relative) : Json(nullptr);
}

Json noise_json(const std::optional<ImageNoise>& noise) {
  if (!noise) return nullptr;
  constexpr std::array<const char*, 3> kOver{"all", "mask", "object"};
  Json json;
  json["over"] = kOver[static_cast<std::size_t>(noise->over)];
  json["pixels"] = noise->pixels;
  return json;
}

Json variance_json(const std::optional<ImageNoise>& noise) {
  if (!noise) return nullptr;
  const bool doubted = is_doubted(noise);
  return {{"reliable", !doubted}, {"doubt", doubted ? Json(doubt_text(*noise)) : Json(nullptr)}};
}

Json z_test_json(const ZTest& z) {
  Json json;
  json["passed"] = z.passed;
  json["p"] = finite(z.p);
  json["non_finite"] = z.non_finite;
  json["values"] = {{"passed", z.pixels_passed},
                    {"count", z.values},
                    {"failed_fraction", finite(z.failed_fraction)},
                    {"worst_z", finite(z.worst_pixel_z)},
                    {"threshold", finite(z.pixel_threshold)},
                    {"p", finite(z.pixels_p)}};
  json["blocks"] = {{"passed", z.blocks_passed},
                    {"worst_z", finite(z.worst_block_z)},
                    {"threshold", finite(z.block_threshold)},
                    {"p", finite(z.block_p)}};
  json["image"] = {{"passed", z.image_passed},
                   {"z", {finite(z.image_z[0]), finite(z.image_z[1]), finite(z.image_z[2])}},
                   {"threshold", finite(z.image_threshold)},
                   {"p", finite(z.image_p)}};
  return json;
}

Json beyond_json(const std::optional<std::size_t>& pixels) { return pixels ? Json(*pixels) : Json(nullptr); }

}  // namespace

Comparison compare_images(const Image& a, const Image& b, std::span<const std::uint8_t> mask,
                          const CompareLimits& limits) {
  Comparison c;
  c.error = image_error(a, b, mask);
  c.mean = mean_difference(a, b, mask);
  if (a.channels >= 6) c.noise_a = noise_of(a, mask);
  if (b.channels >= 6) c.noise_b = noise_of(b, mask);
  if (limits.fail.counts()) c.beyond_fail = pixels_beyond(a, b, limits.fail.each.value_or(0), mask);
  if (limits.warn.counts()) c.beyond_warn = pixels_beyond(a, b, limits.warn.each.value_or(0), mask);
  if (limits.z_test) c.z = z_test(a, b, mask);

  if (c.error.non_finite > 0)
    c.failures.push_back("values that are not finite in A or B: " + std::to_string(c.error.non_finite));
  check_metrics(c.error, limits, c.failures);
  check_pixels(c, limits.fail, "fail", c.failures);
  if (c.z) check_z_test(*c.z, c.failures);
  if (!limits.decide() && c.error.max_abs > 0)
    c.failures.push_back("the images differ, at most by " + largest(c.error) +
                         ", and no threshold allows it");
  check_pixels(c, limits.warn, "warn", c.warnings);
  return c;
}

void warn_of_shared_samples(const ImageAttributes& a, const ImageAttributes& b, Comparison& comparison) {
  const auto samples_a = samples_of(a);
  const auto samples_b = samples_of(b);
  if (!comparison.z || !samples_a || !samples_b) return;
  const auto shared = shared_samples(*samples_a, *samples_b);
  if (!shared) return;
  comparison.warnings.push_back("z-test: A and B share samples " + std::to_string(shared->first) + " to " +
                                std::to_string(shared->last) + " of seed " + std::to_string(shared->seed) +
                                "; the test takes their noise to be independent");
}

void use_stored_noise(const ImageAttributes& attributes, std::optional<ImageNoise>& noise) {
  const auto relative = find_number(attributes, kNoiseAttribute);
  const auto pixels = find_integer(attributes, kNoisePixelsAttribute);
  if (!noise || noise->over != NoisePixels::all || !std::isfinite(noise->relative)) return;
  if (!relative || !pixels) return;
  if (*relative < 0 || *pixels < 1 || static_cast<std::size_t>(*pixels) >= noise->pixels) return;
  noise->relative = *relative;
  noise->pixels = static_cast<std::size_t>(*pixels);
  noise->over = NoisePixels::object;
}

std::string comparison_text(const Comparison& c) {
  const ImageError& e = c.error;
  std::string text;
  row(text, "pixels", std::to_string(e.pixels));
  row(text, "rmse", number(e.rmse));
  row(text, "relative_rmse", number(e.relative_rmse));
  row(text, "relmse", number(e.relmse));
  row(text, "mae", number(e.mae));
  row(text, "psnr", number(e.psnr, "%.6g") + " dB");
  row(text, "mean_signed",
      with_error(c.mean.mean, c.mean.standard_error) + " (" + source_text(c.mean.source) + ")");
  for (int i = 0; i < 3; ++i)
    row(text, std::string("mean_signed_") + kChannel[i],
        with_error(c.mean.channel_mean[i], c.mean.channel_standard_error[i]));
  row(text, "max_abs", e.max_channel < 0 ? number(e.max_abs) : largest(e));
  row(text, "non_finite", std::to_string(e.non_finite));
  put_noise(text, 'a', c.noise_a);
  put_noise(text, 'b', c.noise_b);
  if (c.beyond_fail) row(text, "beyond_fail", std::to_string(*c.beyond_fail) + " pixels");
  if (c.beyond_warn) row(text, "beyond_warn", std::to_string(*c.beyond_warn) + " pixels");
  if (c.z) put_z_test(text, c);
  row(text, "result", verdict(c.passed()));
  return text;
}

std::string comparison_json(const Comparison& c) {
  const ImageError& e = c.error;
  Json json;
  json["passed"] = c.passed();
  json["failures"] = c.failures;
  json["warnings"] = c.warnings;
  json["pixels"] = e.pixels;
  json["rmse"] = finite(e.rmse);
  json["relative_rmse"] = finite(e.relative_rmse);
  json["relmse"] = finite(e.relmse);
  json["mae"] = finite(e.mae);
  json["psnr"] = finite(e.psnr);
  json["mean_signed"] = estimate(c.mean.mean, c.mean.standard_error);
  json["mean_signed"]["error_from"] = source_text(c.mean.source);
  json["mean_signed_rgb"] = Json::array();
  for (int i = 0; i < 3; ++i)
    json["mean_signed_rgb"].push_back(estimate(c.mean.channel_mean[i], c.mean.channel_standard_error[i]));
  json["max_abs"] = finite(e.max_abs);
  json["max_abs_at"] = nullptr;
  if (e.max_channel >= 0)
    json["max_abs_at"] = {{"x", e.max_x}, {"y", e.max_y}, {"channel", kChannel[e.max_channel]}};
  json["non_finite"] = e.non_finite;
  json["relative_noise_a"] = relative_noise(c.noise_a);
  json["relative_noise_b"] = relative_noise(c.noise_b);
  json["noise_a"] = noise_json(c.noise_a);
  json["noise_b"] = noise_json(c.noise_b);
  json["variance_a"] = variance_json(c.noise_a);
  json["variance_b"] = variance_json(c.noise_b);
  json["beyond_fail"] = beyond_json(c.beyond_fail);
  json["beyond_warn"] = beyond_json(c.beyond_warn);
  json["z_test"] = c.z ? z_test_json(*c.z) : Json(nullptr);
  return json.dump(2) + "\n";
}

}  // namespace meander
