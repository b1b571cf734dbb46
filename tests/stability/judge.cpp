#include "stability/judge.h"

#include <cmath>
#include <sstream>

#include "render/small_scene.h"
#include "scene/precision.h"
#include "stability/double_walk.h"
#include "trace/overlaps.h"

namespace meander {
namespace {

constexpr double kFloor = 2e-7;  // rounding of a mean near 1

bool is_grey_scene(const Scene& scene) {
  for (const Material& material : scene.materials)
    if (const auto* body = std::get_if<TranslucentMaterial>(&material.kind))
      if (!is_grey(body->medium.sigma_t) || !is_grey(body->medium.albedo)) return false;
  return true;
}

bool whole_alone(const Case& row) {
  return std::holds_alternative<Exact>(row.oracle) || row.scene.film.width == 1;
}

Rendering rendered(Job job, std::uint64_t spp, WalkCode walk, std::uint64_t seed) {
  job.walk = walk;
  job.seed = seed;
  return render_spp(job, spp);
}

// What the case is held against, in the units of the image.
Readings reference_of(const Case& row) {
  Readings readings{};
  if (const auto* exact = std::get_if<Exact>(&row.oracle))
    for (Reading& reading : readings[kWhole])
      reading = {row.offset + exact->value / row.scale, exact->error / std::abs(row.scale)};
  const auto pixels = static_cast<std::uint64_t>(row.scene.film.width * row.scene.film.height);
  const auto* stated = std::get_if<Stated>(&row.oracle);
  if (std::holds_alternative<InDouble>(row.oracle) || (stated && stated->in_double))
    return double_walk(row.scene, row.spp * pixels);
  if (const auto* same = std::get_if<Same>(&row.oracle))
    return readings_of(rendered(make_job(same->scene, 2), 2 * row.spp, WalkCode::batch, 3).film);
  if (stated)
    for (Reading& reading : readings[kWhole]) reading.value = stated->value;
  if (std::holds_alternative<Furnace>(row.oracle))
    for (Reading& reading : readings[kWhole]) reading = {1, std::get<Furnace>(row.oracle).tolerance};
  return readings;
}

bool is_finite(const Film& film) {
  for (const Pixel& pixel : film.pixels)
    for (std::size_t c = 0; c < 3; ++c)
      if (!std::isfinite(pixel.mean[c]) || !std::isfinite(pixel.variance_of_mean()[c])) return false;
  return true;
}

// The value furthest from 1.
double furthest(const Film& film) {
  double worst = 1;
  for (const Pixel& pixel : film.pixels)
    for (const double value : pixel.mean)
      if (!(std::abs(value - 1) <= std::abs(worst - 1))) worst = value;
  return worst;
}

// The verdict on one walk, and the reasons why it fails.
class Judge {
 public:
  Judge(const Case& row, const Readings& reference, double threshold)
      : row_(row), reference_(reference), threshold_(threshold) {}

  Verdict verdict(const Rendering& r) {
    Readings seen = readings_of(r.film);
    const auto* exact = std::get_if<Exact>(&row_.oracle);
    if (exact && exact->binary) take_binary_noise(r, seen[kWhole]);
    Verdict verdict;
    verdict.stated = rescaled(seen, row_.offset, row_.scale)[kWhole][0];
    verdict.leaked = r.counters.leaked_walks;
    verdict.walks = r.counters.walks;
    verdict.non_finite = r.non_finite;
    verdict.seconds = r.seconds;
    check_counts(r, verdict);
    if (const auto* furnace = std::get_if<Furnace>(&row_.oracle)) {
      verdict.stated = {furthest(r.film), 0};
      verdict.deviation = verdict.stated.value - 1;
      if (!(std::abs(verdict.deviation) <= furnace->tolerance))
        fail("a pixel is off by " + std::to_string(verdict.deviation));
    } else if (const auto* stated = std::get_if<Stated>(&row_.oracle)) {
      check_stated(*stated, seen[kWhole][0], verdict);
    } else {
      verdict.deviation = worst_z(seen, reference_, is_grey_scene(row_.scene), whole_alone(row_), kFloor);
      if (!(std::abs(verdict.deviation) <= threshold_)) fail("z = " + std::to_string(verdict.deviation));
    }
    return verdict;
  }

  [[nodiscard]] const std::vector<std::string>& reasons() const { return reasons_; }

 private:
  void fail(const std::string& reason) { reasons_.push_back(reason); }

  void check_counts(const Rendering& r, const Verdict& verdict) {
    if (!is_finite(r.film)) fail("a value or a variance is not finite");
    if (r.non_finite > 0) fail(std::to_string(r.non_finite) + " samples are not finite");
    if (row_.leaks != (verdict.leaked > 0))
      fail(std::to_string(verdict.leaked) + " of " + std::to_string(verdict.walks) + " walks leaked");
    if (verdict.walks == 0) fail("no walk");
  }

  void check_stated(const Stated& stated, const Reading& seen, Verdict& verdict) {
    const double slack = threshold_ * seen.error + kFloor;
    if (!(seen.value >= -slack && seen.value <= 1 + slack)) fail("shines: " + std::to_string(seen.value));
    if (stated.within == 0) return;
    const Reading& held = reference_[kWhole][0];
    verdict.deviation = seen.value / held.value - 1;
    if (!(std::abs(verdict.deviation) <= stated.within + threshold_ * std::hypot(seen.error, held.error)))
      fail("is off by " + std::to_string(verdict.deviation));
  }

  void take_binary_noise(const Rendering& r, std::array<Reading, 3>& whole) const {
    const double count = static_cast<double>(r.spp) * static_cast<double>(r.film.pixels.size());
    for (std::size_t c = 0; c < 3; ++c) {
      const double chance = reference_[kWhole][c].value;
      whole[c].error = std::sqrt(chance * (1 - chance) / count);
    }
  }

  const Case& row_;
  const Readings& reference_;
  double threshold_;
  std::vector<std::string> reasons_;
};

// What the program warns of.
std::string warning_of(const Job& job) {
  std::string warning;
  if (!overlap_warnings(*job.scene, *job.geometry).empty()) warning += "overlap";
  if (!precision_warnings(*job.scene).empty()) warning += "precision";
  return warning;
}

// What it must warn of.
std::string warning_due(const Case& row) {
  return std::string(row.overlaps ? "overlap" : "") + (row.inaccurate ? "precision" : "");
}

Job job_with(Fault fault, const Case& row, const Job& job) {
  Job faulty = job;
  faulty.scene = std::make_shared<const Scene>(with_fault(row.scene, fault));
  faulty.geometry = std::make_shared<const Geometry>(*faulty.scene, faulty.threads, job.geometry.get());
  return faulty;
}

// Whether the case, walked in lanes, fails with its fault planted in it and held against what it was. A fault
// that changes what is warned of is found by that; the image has to find another then, if it is held against
// anything.
bool finds_fault(const Case& row, const Job& job, const Readings& reference, double threshold) {
  Job faulty = job_with(row.fault, row, job);
  if (warning_of(faulty) != warning_due(row)) {
    if (std::holds_alternative<Stated>(row.oracle)) return true;
    faulty = job_with(Fault::albedo, row, job);
  }
  Judge judge(row, reference, threshold);
  static_cast<void>(judge.verdict(rendered(faulty, row.spp, WalkCode::batch, 2)));
  return !judge.reasons().empty();
}

}  // namespace

std::size_t z_count(const Case& row) {
  if (std::holds_alternative<Furnace>(row.oracle) || std::holds_alternative<Stated>(row.oracle)) return 0;
  return (is_grey_scene(row.scene) ? 1 : 3) * (whole_alone(row) ? 1 : kRegions);
}

Outcome judge(const Case& row, double threshold) {
  Outcome outcome;
  const Readings reference = reference_of(row);
  outcome.held = rescaled(reference, row.offset, row.scale)[kWhole][0];
  const Job job = make_job(row.scene, 2);
  outcome.warning = warning_of(job);
  if (outcome.warning != warning_due(row)) outcome.reasons.push_back("warns of '" + outcome.warning + "'");
  for (const bool lanes : {false, true}) {
    Judge judge(row, reference, threshold);
    const WalkCode walk = lanes ? WalkCode::batch : WalkCode::scalar;
    outcome.verdicts[lanes] = judge.verdict(rendered(job, row.spp, walk, 1 + lanes));
    for (const std::string& reason : judge.reasons())
      outcome.reasons.push_back((lanes ? "lanes: " : "scalar: ") + reason);
  }
  if (!finds_fault(row, job, reference, threshold))
    outcome.reasons.emplace_back("the fault planted is not found");
  return outcome;
}

std::string table_heading() {
  return "group,case,held against,reference,reference error,scalar,scalar error,scalar z or deviation,lanes,"
         "lanes error,lanes z or deviation,leaked_walks scalar,leaked_walks lanes,non_finite scalar,"
         "non_finite lanes,warning,seconds scalar,seconds lanes";
}

std::string table_row(const Case& row, const Outcome& outcome) {
  std::ostringstream line;
  const auto quoted = [](const std::string& text) {
    return text.find(',') == std::string::npos ? text : '"' + text + '"';
  };
  line << quoted(row.group) << ',' << quoted(row.name) << ',' << quoted(row.held_against);
  line.precision(7);
  line << ',' << outcome.held.value << ',';
  const auto rounded = [&](double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.2g", value);
    line << buffer;
  };
  rounded(outcome.held.error);
  for (const Verdict& verdict : outcome.verdicts) {
    line << ',' << verdict.stated.value << ',';
    rounded(verdict.stated.error);
    line << ',';
    rounded(verdict.deviation);
  }
  for (const Verdict& verdict : outcome.verdicts) line << ',' << verdict.leaked;
  for (const Verdict& verdict : outcome.verdicts) line << ',' << verdict.non_finite;
  line << ',' << outcome.warning;
  for (const Verdict& verdict : outcome.verdicts) {
    line << ',';
    rounded(verdict.seconds);
  }
  return line.str();
}

}  // namespace meander
