#include "app/report_run.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "app/progress.h"
#include "core/timer.h"
#include "render/sample_tail.h"

namespace meander {
namespace {

constexpr std::uint64_t kLeastTestedSpp = 8;  // what a z-test asks of either image
constexpr double kEnoughForTheTail = 1e5;     // samples: ten lie beyond the 99.99th percentile
constexpr double kTailSamples = 1e6;          // about as many are traced for it
constexpr double kTailQuantile = 0.9999;

ReportRow make_row(const Report& report, const Rendering& rendering) {
  const Image image = resolve(rendering.film);
  ReportRow row;
  row.spp = rendering.spp;
  row.seconds = rendering.seconds;
  row.noise = rendering.noise.noise;
  row.noise_doubt = rendering.noise.doubt;
  row.error = debiased_error(image, report.reference.image, report.mask);
  row.plain = image_error(image, report.reference.image, report.mask);
  row.counters = rendering.counters;
  return row;
}

// A run in the making.
class Runner {
 public:
  Runner(const Report& report, const Job& job, const ReportPlan& plan, const std::atomic<bool>& stop)
      : report_(report), plan_(plan), stop_(stop), passes_(job, stop), progress_(plan.budget, plan.quiet) {
    const Tile area = area_of(job);
    done_.film = Film(area.x1 - area.x0, area.y1 - area.y0);
    next_ = done_;
  }

  // Leaves the run without rows when nothing was complete.
  void run(ReportRun& run) {
    constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();
    const Budget& budget = plan_.budget;
    for (std::uint64_t milestone = 1;; milestone *= 2) {
      const std::uint64_t target = std::min(milestone, budget.spp.value_or(kNever));
      if (!reach(target)) break;
      run.rows.push_back(make_row(report_, done_));
      if (done_.spp < target || next_pass(progress_of(done_), budget) == 0) break;
    }
    const bool left_over = done_.spp > 0 && (run.rows.empty() || run.rows.back().spp < done_.spp);
    if (left_over) run.rows.push_back(make_row(report_, done_));
    progress_.finish();
    run.image = resolve(done_.film);
    run.doubt = estimate_noise(done_.film, {}).doubt;
    done_.film = {};
    run.last = std::move(done_);
  }

 private:
  // Renders until `target` samples a pixel, or until the budget is met; false when it was interrupted.
  [[nodiscard]] bool reach(std::uint64_t target) {
    Budget leg = plan_.budget;
    leg.spp = target;
    for (;;) {
      const std::uint64_t samples = next_pass(progress_of(done_), leg);
      if (samples == 0) return true;
      const Timer timer;
      if (stop_ || !passes_.advance(done_, samples, next_)) return false;
      next_.seconds = done_.seconds + timer.seconds();
      std::swap(done_, next_);
      done_.noise = estimate_noise(done_.film, report_.mask);
      progress_.show(done_);
    }
  }

  const Report& report_;
  const ReportPlan& plan_;
  const std::atomic<bool>& stop_;
  Passes passes_;
  ProgressReport progress_;
  Rendering done_;
  Rendering next_;
};

// At most as many samples as the run itself has.
std::optional<Fireflies> find_fireflies(const Report& report, const Job& job, std::uint64_t most,
                                        const std::atomic<bool>& stop) {
  const auto counted = static_cast<std::size_t>(std::ranges::count(report.mask, std::uint8_t{1}));
  const double pixels = static_cast<double>(counted > 0 ? counted : report.mask.size());
  const double wanted = std::ceil(kTailSamples / pixels);
  const std::uint64_t spp = wanted < static_cast<double>(most) ? static_cast<std::uint64_t>(wanted) : most;
  if (pixels * static_cast<double>(spp) < kEnoughForTheTail) return std::nullopt;
  const auto tail = sample_tail(job, report.reference.image, report.mask, spp, stop);
  if (!tail) return std::nullopt;
  return Fireflies{tail->count(), tail->quantile(kTailQuantile), tail->largest()};
}

void judge(const Report& report, const Job& job, ReportRun& run, const std::atomic<bool>& stop) {
  const ReportReference& reference = report.reference;
  // A file that does not say how many samples it has is taken to have enough.
  const std::uint64_t least = std::min(run.last.spp, reference.spp.value_or(kLeastTestedSpp));
  if (least >= kLeastTestedSpp && reference.image.channels >= 6)
    run.bias = z_test(run.image, reference.image);
  // The samples, and so their tail, are the same on any number of threads.
  const auto same = std::ranges::find_if(report.runs, [&](const ReportRun& other) {
    return other.method.estimator == run.method.estimator && other.fireflies;
  });
  run.fireflies =
      same != report.runs.end() ? same->fireflies : find_fireflies(report, job, run.last.spp, stop);
}

}  // namespace

void make_runs(Report& report, const ReportPlan& plan, const std::atomic<bool>& stop) {
  for (const ReportMethod& method : plan.methods) {
    for (const int threads : plan.threads) {
      if (stop) return;
      Job job = report.job;
      job.estimator = method.estimator;
      job.walk = method.walk;
      job.threads = threads;
      ReportRun run;
      run.method = method;
      run.walk = describe_model(job);
      run.threads = threads;
      if (!plan.quiet)
        std::fprintf(stderr, "%s, %d thread%s\n", std::string(method_name(method)).c_str(), threads,
                     threads == 1 ? "" : "s");
      Runner(report, job, plan, stop).run(run);
      if (run.rows.empty()) return;
      judge(report, job, run, stop);
      report.runs.push_back(std::move(run));
    }
  }
}

}  // namespace meander
