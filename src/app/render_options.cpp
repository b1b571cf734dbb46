#include "app/render_options.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <sstream>
#include <utility>

#include "app/checkpoint.h"
#include "app/command_line.h"
#include "app/interrupt.h"
#include "app/progress.h"
#include "app/run_stats.h"
#include "app/scene_warnings.h"
#include "core/error.h"
#include "io/checkpoint_file.h"
#include "io/output_file.h"
#include "io/scene_file.h"
#include "render/parallel.h"
#include "trace/overlaps.h"

namespace meander {
namespace {

std::optional<Tile> crop_of(const RenderOptions& options, const FilmSize& film) {
  if (options.crop.empty()) return std::nullopt;
  const Tile crop{options.crop[0], options.crop[1], options.crop[2], options.crop[3]};
  const bool inside = 0 <= crop.x0 && crop.x0 < crop.x1 && crop.x1 <= film.width && 0 <= crop.y0 &&
                      crop.y0 < crop.y1 && crop.y1 <= film.height;
  if (inside) return crop;
  throw Error(Fault::input, "--crop must be X0,Y0,X1,Y1 with 0 <= X0 < X1 <= " + std::to_string(film.width) +
                                " and 0 <= Y0 < Y1 <= " + std::to_string(film.height));
}

// A film that the machine cannot hold is refused rather than left to the system's mercy.
void check_memory(const Job& job) {
  const auto machine =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  if (film_bytes(job) < machine / 10 * 9) return;
  throw Error(Fault::input, "the film needs " + std::to_string(film_bytes(job) >> 20) +
                                " MiB, and this machine has " + std::to_string(machine >> 20) +
                                ": use --crop, or a smaller --width and --height");
}

Job make_job(const RenderOptions& options, Scene scene) {
  if (options.width) scene.film.width = *options.width;
  if (options.height) scene.film.height = *options.height;
  Job job;
  job.threads = options.threads > 0 ? std::min(options.threads, hardware_threads()) : hardware_threads();
  job.crop = crop_of(options, scene.film);
  job.seed = options.seed;
  job.first_sample = options.first_sample;
  job.estimator = options.estimator == "analog" ? Estimator::analog : Estimator::implicit;
  job.walk = walk_code(options.walk);
  job.instruction_set = instruction_set_of(options.isa);
  job.scene = std::make_shared<const Scene>(std::move(scene));
  job.geometry = std::make_shared<const Geometry>(*job.scene, job.threads);
  return job;
}

// Everything that is written must be a file of its own.
void check_outputs(const RenderOptions& options, std::span<const std::string_view> extensions) {
  constexpr std::string_view kJson[] = {".json"};
  check_writable(options.output, extensions);
  if (!options.stats.empty()) check_writable(options.stats, kJson);
  const std::array resumed{options.resume};
  refuse_overwriting("--output", options.output, resumed);
  refuse_overwriting("--stats", options.stats, resumed);
  if (options.checkpoint.empty()) return;
  check_checkpoint_writable(options.checkpoint);
  for (const std::string& other : {options.output, options.stats})
    if (std::filesystem::path(other).lexically_normal() ==
        std::filesystem::path(options.checkpoint).lexically_normal())
      throw Error(Fault::input, "--checkpoint must name another file than " + other);
  // Hours of work may lie in it: only the run that goes on from there replaces it.
  std::error_code ignored;
  if (std::filesystem::exists(options.checkpoint, ignored) &&
      !std::filesystem::equivalent(options.checkpoint, options.resume, ignored))
    throw Error(Place{options.checkpoint, 0, 0}, "holds an earlier run: continue it with --resume " +
                                                     options.checkpoint +
                                                     ", or remove it, or name another file");
}

std::string without_samples(const FinishedRun& run) {
  if (run.interrupted || !run.budget.seconds)
    return "interrupted before the first pass was complete; nothing was written";
  std::ostringstream text;
  text << "no pass was complete within --time " << *run.budget.seconds
       << " (seconds), not even one sample a pixel; nothing was written";
  return text.str();
}

}  // namespace

WalkCode walk_code(std::string_view name) noexcept {
  return name == "scalar" ? WalkCode::scalar : WalkCode::batch;
}

InstructionSet instruction_set_of(std::string_view name) noexcept {
  return instruction_set(name).value_or(instruction_sets().back());
}

void add_walk_options(CLI::App& verb, std::string& walk, std::string& isa) {
  verb.add_option("--walk", walk, "scalar or batch: one walk at a time, or lanes of SIMD (batch)")
      ->check(CLI::IsMember({"scalar", "batch"}));
  std::vector<std::string> names;
  for (const InstructionSet set : instruction_sets()) names.emplace_back(name_of(set));
  verb.add_option("--isa", isa, "instruction set of the batch walk (the best of this machine)")
      ->check(CLI::IsMember(names));
}

void add_budget_options(CLI::App& verb, RenderOptions& o) {
  verb.add_option("--spp", o.spp, "samples a pixel at which the image is done")->transform(sample_count());
  verb.add_option("--time", o.seconds, "seconds to render for")->check(greater_than(0));
  verb.add_option("--error,--noise", o.error, "relative noise to reach, such as 0.01")
      ->check(greater_than(0));
  verb.add_option("--seed", o.seed, "random seed (0)")->transform(seed_number());
  verb.add_option("--threads", o.threads, "threads (all that the machine has, and at most those)")
      ->transform(thread_count());
  verb.add_option("--width", o.width, "film width, pixels")->transform(whole_number(1, 16384));
  verb.add_option("--height", o.height, "film height, pixels")->transform(whole_number(1, 16384));
  verb.add_option("--estimator", o.estimator, "analog or implicit (implicit)")
      ->check(CLI::IsMember({"analog", "implicit"}));
  add_walk_options(verb, o.walk, o.isa);
  verb.add_option("--set", o.edits, "PATH=VALUE: any scene value, such as material.wax.g=0.4 (repeatable)")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_render_options(CLI::App& verb, RenderOptions& o) {
  verb.add_option("SCENE", o.scene, "scene file (.toml), or a bare mesh (.ply .obj .glb .stl)")
      ->required()
      ->check(file_name());
  verb.add_option("-o,--output", o.output, "image file to write")->required()->check(file_name());
  add_budget_options(verb, o);
  verb.get_option("--spp")->description("samples a pixel (64 when neither --time nor --error is given)");
  verb.add_option("--first-sample", o.first_sample, "number of the first sample (0)")
      ->transform(whole_number(0, std::uint64_t{1} << 31));
  verb.add_option("--crop", o.crop, "X0,Y0,X1,Y1: render this rectangle of the film only")
      ->delimiter(',')
      ->expected(4)
      ->transform(whole_number(0, 16384));
  verb.add_option("--stats", o.stats, "file for statistics (.json)")->check(file_name());
  CLI::Option* checkpoint =
      verb.add_option("--checkpoint", o.checkpoint,
                      "file to keep the state of the run in, which --resume continues: written every --every "
                      "seconds, at the end, and on Ctrl-C")
          ->check(file_name());
  verb.add_option("--every", o.every, "seconds between checkpoints (60)")
      ->check(greater_than(0))
      ->needs(checkpoint);
  verb.add_option("--resume", o.resume, "checkpoint of the same run to continue, to the same total budget")
      ->check(file_name());
  verb.add_flag("--quiet", o.quiet, "say nothing but errors");
}

std::vector<std::string> all_edits(const RenderOptions& options) {
  std::vector<std::string> edits = options.edits;
  if (options.width) edits.push_back("film.width=" + std::to_string(*options.width));
  if (options.height) edits.push_back("film.height=" + std::to_string(*options.height));
  return edits;
}

PreviewSettings preview_settings(const RenderOptions& options) {
  PreviewSettings settings;
  settings.threads = options.threads > 0 ? std::min(options.threads, hardware_threads()) : hardware_threads();
  settings.seed = options.seed;
  settings.estimator = options.estimator == "analog" ? Estimator::analog : Estimator::implicit;
  settings.walk = walk_code(options.walk);
  settings.instruction_set = instruction_set_of(options.isa);
  settings.budget = {options.spp, options.seconds, options.error};
  return settings;
}

Budget budget_of(const RenderOptions& options) {
  Budget budget{options.spp, options.seconds, options.error};
  if (!budget.spp && !budget.seconds && !budget.error) budget.spp = 64;
  return budget;
}

Job prepare_job(const RenderOptions& options) {
  SceneFile file = load_scene(options.scene, options.edits);
  refuse_overwriting("--output", options.output, file.files);
  refuse_overwriting("--stats", options.stats, file.files);
  if (!options.quiet)
    for (const std::string& warning : file.warnings) warn(warning);
  Job job = make_job(options, std::move(file.scene));
  check_memory(job);
  if (options.quiet) return job;
  for (const std::string& warning : overlap_warnings(*job.scene, *job.geometry)) warn(warning);
  for (const std::string& warning : scene_warnings(*job.scene)) warn(warning);
  return job;
}

FinishedRun run_render(const RenderOptions& options, std::span<const std::string_view> extensions) {
  check_outputs(options, extensions);
  FinishedRun run;
  run.job = prepare_job(options);
  run.budget = budget_of(options);
  Rendering start;
  if (!options.resume.empty()) start = load_checkpoint(options.resume, run.job, run.budget);
  const std::atomic<bool>& stop = watch_interrupts();
  ProgressReport progress(run.budget, options.quiet);
  CheckpointKeeper keeper(run.job, options.checkpoint, options.every);
  const auto published = [&](const Rendering& rendering) {
    progress.show(rendering);
    keeper.keep(rendering);
  };
  run.rendering = render(run.job, run.budget, stop, published, std::move(start));
  progress.finish();
  run.interrupted = stop;
  if (run.rendering.spp == 0) throw Error(Fault::runtime, without_samples(run));
  run.kept = keeper.keep_last(run.rendering);
  return run;
}

void print_summary(const RenderOptions& options, const FinishedRun& run) {
  const Rendering& r = run.rendering;
  if (!options.stats.empty()) {
    Ending ending = ended_by(progress_of(r), run.budget);
    const bool broken_off = ending == Ending::none && run.budget.seconds && !run.interrupted;
    if (broken_off) ending = Ending::seconds;  // by the limit, in the middle of a pass
    const std::string json = stats_json(run.job, r, ending_name(ending));
    write_file(options.stats, std::as_bytes(std::span(json)));
  }
  if (run.interrupted)
    std::fprintf(stderr, "meander: interrupted; wrote what was complete, %llu samples a pixel\n",
                 static_cast<unsigned long long>(r.spp));
  if (options.quiet) return;
  char noise[32] = "?";
  if (std::isfinite(r.noise.noise)) std::snprintf(noise, sizeof noise, "%.2f %%", 100 * r.noise.noise);
  std::fprintf(stderr, "%s: %llu spp in %.2f s, noise %s, %.3g steps/s\n", options.output.c_str(),
               static_cast<unsigned long long>(r.spp), r.seconds, noise,
               static_cast<double>(r.counters.steps) / r.seconds);
  const std::string reached = closing_line(progress_of(r), run.budget);
  if (!reached.empty()) std::fprintf(stderr, "%s\n", reached.c_str());
  if (!r.noise.reliable()) std::fprintf(stderr, "the noise is unreliable: %s\n", describe(r.noise.doubt));
  if (r.counters.leaked_walks > 0)
    std::fprintf(stderr, "meander: warning: %llu of %llu walks leaked through holes in a mesh\n",
                 static_cast<unsigned long long>(r.counters.leaked_walks),
                 static_cast<unsigned long long>(r.counters.walks));
  if (r.non_finite > 0)
    std::fprintf(stderr, "meander: warning: %llu samples were not finite and count as black\n",
                 static_cast<unsigned long long>(r.non_finite));
}

}  // namespace meander
