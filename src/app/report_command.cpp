// The verb report: error against time.
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>

#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/plot_picture.h"
#include "app/render_options.h"
#include "app/report_folder.h"
#include "app/report_plot.h"
#include "app/report_reference.h"
#include "app/report_run.h"
#include "app/report_table.h"
#include "core/error.h"
#include "core/timer.h"
#include "render/first_hits.h"
#include "render/parallel.h"

namespace meander {
namespace {

struct ReportOptions {
  RenderOptions render;
  std::vector<std::string> estimators{"implicit", "analog"};
  std::vector<std::string> walks{"batch"};
  std::vector<int> threads;  // empty: those of --threads
  std::string reference;
  std::optional<std::uint64_t> reference_spp;
};

std::string utc_date() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  return text;
}

// The processor's name as Linux gives it.
std::string machine_name() {
  std::ifstream in("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      name = line.substr(colon + 2);
      break;
    }
  }
  return name + ", " + std::to_string(hardware_threads()) + " threads";
}

template <class T>
std::vector<T> once_each(const std::vector<T>& values) {
  std::vector<T> kept;
  for (const T& value : values)
    if (std::ranges::find(kept, value) == kept.end()) kept.push_back(value);
  return kept;
}

std::vector<ReportMethod> methods_of(const ReportOptions& options) {
  std::vector<ReportMethod> methods;
  for (const std::string& estimator : once_each(options.estimators)) {
    if (estimator == "analog") {
      methods.push_back({Estimator::analog, WalkCode::scalar});
      continue;
    }
    for (const std::string& walk : once_each(options.walks))
      methods.push_back({Estimator::implicit, walk_code(walk)});
  }
  return methods;
}

ReportPlan plan_of(const ReportOptions& options, const Job& job) {
  ReportPlan plan;
  plan.budget = budget_of(options.render);
  plan.methods = methods_of(options);
  plan.threads = options.threads.empty() ? std::vector<int>{job.threads} : once_each(options.threads);
  plan.quiet = options.render.quiet;
  for (const int threads : plan.threads)
    if (threads > hardware_threads())
      throw Error(Fault::input, "--thread-counts has " + std::to_string(threads) + ", but this machine has " +
                                    std::to_string(hardware_threads()) + " threads");
  return plan;
}

// Nothing without OpenGL, which only the plot needs.
std::optional<Image8> draw_plot_of(const Report& report) {
  constexpr int kWidth = 1200;
  constexpr int kHeight = 750;
  try {
    return plot_picture(report_plot(report), kWidth, kHeight);
  } catch (const Error& error) {
    std::cerr << "meander: warning: there is no plot: " << error.what() << '\n';
    return std::nullopt;
  }
}

// The report's files go by fixed names, and would take the reference's place.
void refuse_reference_inside(const ReportOptions& options) {
  if (options.reference.empty()) return;
  std::error_code error;
  const auto named = std::filesystem::absolute(options.reference, error).parent_path();
  const auto real = std::filesystem::canonical(options.reference, error).parent_path();
  if (std::filesystem::equivalent(named, options.render.output, error) ||
      std::filesystem::equivalent(real, options.render.output, error))
    throw Error(Place{options.reference, 0, 0},
                "the reference lies in the folder that the report is written into; use another -o");
}

void check_outputs(const ReportOptions& options) {
  check_folder(options.render.output, report_file_names(methods_of(options), once_each(options.threads)));
  refuse_reference_inside(options);
}

// The scene, the pixels that count, and what the runs are held against.
void prepare(const ReportOptions& options, Report& report, ReportPlan& plan, const std::atomic<bool>& stop) {
  report.date = utc_date();
  report.machine = machine_name();
  const Timer setup;
  report.job = prepare_job(options.render);
  report.setup_seconds = setup.seconds();
  plan = plan_of(options, report.job);
  report.mask = first_hits(report.job, stop).mask;
  report.reference =
      options.reference.empty()
          ? make_reference(report.job, reference_budget(plan.budget, options.reference_spp), plan.quiet, stop)
          : read_reference(options.reference, report.job, plan.budget, report.mask);
}

int run_report(const ReportOptions& options) {
  check_outputs(options);
  const std::atomic<bool>& stop = watch_interrupts();
  Report report;
  ReportPlan plan;
  prepare(options, report, plan, stop);
  make_runs(report, plan, stop);
  report.interrupted = stop;
  if (report.runs.empty())
    throw Error(Fault::runtime, "interrupted before the first pass was complete; nothing was written");
  // First, so that a folder that cannot be written any longer does not cost the work.
  std::cout << report_text(report) << std::flush;
  write_report(report, options.render.output);
  // Last, because it takes OpenGL, and a broken driver may end the program.
  if (const auto plot = draw_plot_of(report)) add_report_plot(report, *plot, options.render.output);
  if (report.interrupted) std::cerr << "meander: interrupted; wrote what was complete\n";
  return 0;
}

void change_render_options(CLI::App& verb, RenderOptions& options) {
  add_render_options(verb, options);
  verb.get_option("--output")->description("folder to write into; made where there is none");
  verb.get_option("--spp")->description(
      "largest number of samples a pixel (64 when neither --time nor --error is given)");
  verb.get_option("--time")->description("seconds to render for, each run");
  verb.remove_option(verb.get_option("--estimator"));
  verb.remove_option(verb.get_option("--walk"));
  for (const char* of_one_run : {"--stats", "--every", "--checkpoint", "--resume"})
    verb.remove_option(verb.get_option(of_one_run));
}

}  // namespace

void add_report_command(CLI::App& app, Action& action) {
  CLI::App* verb =
      app.add_subcommand("report", "error against time of each estimator: table, CSV, JSON, plot and page");
  const auto o = std::make_shared<ReportOptions>();
  change_render_options(*verb, o->render);
  verb->add_option("--estimators,--estimator", o->estimators, "implicit,analog: those to run (all)")
      ->delimiter(',')
      ->check(CLI::IsMember({"analog", "implicit"}));
  verb->add_option("--walks,--walk", o->walks, "batch,scalar: the code of implicit walks (batch)")
      ->delimiter(',')
      ->check(CLI::IsMember({"scalar", "batch"}));
  verb->add_option("--thread-counts", o->threads, "1,2: run with each of these numbers of threads")
      ->delimiter(',')
      ->transform(thread_count());
  CLI::Option* given =
      verb->add_option("--reference", o->reference, "image to measure the error from (one of its own)")
          ->check(file_name());
  verb->add_option("--reference-spp", o->reference_spp,
                   "samples a pixel of its own reference (16 times the largest budget)")
      ->transform(whole_number(2, std::uint64_t{1} << 31))
      ->excludes(given);
  verb->callback([o, &action] { action = [o] { return run_report(*o); }; });
}

}  // namespace meander
