// What a report holds: plain data between the runs and the files.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/image_file.h"
#include "render/progressive.h"
#include "stats/debiased_error.h"
#include "stats/image_error.h"

namespace meander {

/// What was reached at one budget. Seconds are those spent in passes: neither the scene nor the error is in
/// them.
struct ReportRow {
  std::uint64_t spp = 0;
  double seconds = 0;
  double noise = 0;  // infinite below two samples a pixel
  NoiseDoubt noise_doubt = NoiseDoubt::none;
  DebiasedError error;
  ImageError plain;  // nothing subtracted
  PathCounters counters;

  [[nodiscard]] double efficiency() const noexcept;  // 1 / (mse x seconds); NaN where mse <= 0
};

/// The samples of a run beside the pixels they fall on, see sample_tail.h.
struct Fireflies {
  std::uint64_t samples = 0;
  double quantile = 0;  // the 99.99th percentile
  double largest = 0;
};

/// One estimator on one number of threads.
/// What a run may be of: analog walks are always scalar.
struct ReportMethod {
  Estimator estimator = Estimator::implicit;
  WalkCode walk = WalkCode::batch;

  [[nodiscard]] bool operator==(const ReportMethod&) const = default;
};
inline constexpr ReportMethod kReportMethods[] = {{Estimator::implicit, WalkCode::batch},
                                                  {Estimator::implicit, WalkCode::scalar},
                                                  {Estimator::analog, WalkCode::scalar}};

struct ReportRun {
  ReportMethod method;
  std::string walk;  // the model of the scene's walks, in words
  int threads = 1;
  std::vector<ReportRow> rows;
  Image image;                          // of the last row, six channels
  Rendering last;                       // without its film
  NoiseDoubt doubt = NoiseDoubt::none;  // of the noise of the whole image, which the bias test covers
  std::optional<ZTest> bias;  // none where an image has too few samples, or the reference no variance
  std::optional<Fireflies> fireflies;  // none where too few samples were traced, or it was interrupted
};

/// What the runs are held against.
struct ReportReference {
  Image image;                          // three channels, or six with the variance of each mean
  std::string source;                   // in words
  std::optional<std::uint64_t> spp;     // none where its file does not say
  Rendering rendering;                  // without its film; without samples where it was given
  ImageAttributes attributes;           // what its file carries
  std::optional<NoiseEstimate> noise;   // over the mask; none without variance
  NoiseDoubt doubt = NoiseDoubt::none;  // of the noise of the whole image
};

struct Report {
  Job job;
  std::vector<std::uint8_t> mask;  // the pixels that the errors are of
  ReportReference reference;
  std::vector<ReportRun> runs;
  double setup_seconds = 0;  // scene and geometry
  std::string date;          // UTC
  std::string machine;
  bool interrupted = false;
};

/// Why an error is not to be relied upon, the worst first: rare bright samples, of the run or of the
/// reference, which make it and its interval come out too low; a reference whose own error comes near it or
/// is not well known itself; one whose own error is not known at all.
enum class ErrorDoubt { none, rare_bright_samples, reference_noise, reference_unknown };

[[nodiscard]] ErrorDoubt error_doubt(const Report& report, const ReportRun& run,
                                     const ReportRow& row) noexcept;

/// Whether the reference's own error is at most a third of the row's, and itself known: its noise estimate is
/// reliable, and at most 20 %, beyond which its pixels are no measure of a relative error.
[[nodiscard]] bool reference_suffices(const Report& report, const ReportRow& row) noexcept;

/// Seconds until a run's noise was, or would be, 1 %.
struct TimeToNoise {
  enum class Basis {
    at_most,      // the first row with a noise has less
    measured,     // between two rows, along the straight line between them on logarithmic axes
    extrapolated  // beyond the last row, as the root of the time
  };
  double seconds = 0;
  Basis basis = Basis::measured;
  bool reliable = true;  // the noise of the rows that it comes from
};

/// Nothing where no row has a noise.
[[nodiscard]] std::optional<TimeToNoise> time_to_one_percent(const ReportRun& run) noexcept;

/// Whether the bias test's verdict can be believed: the variances that it goes by are too small where rare
/// bright samples carry them, and a sound image then fails.
[[nodiscard]] bool bias_is_reliable(const Report& report, const ReportRun& run) noexcept;

[[nodiscard]] std::string_view estimator_name(Estimator estimator) noexcept;

/// "implicit", "implicit-scalar" or "analog".
[[nodiscard]] std::string_view method_name(const ReportMethod& method) noexcept;

/// The name of a run, and of its image's file: "analog", or "analog-2t" where a report has several thread
/// counts.
[[nodiscard]] std::string run_name(const Report& report, const ReportRun& run);

}  // namespace meander
