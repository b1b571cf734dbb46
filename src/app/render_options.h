// The options that render and capture share, and the run that they describe.
#pragma once

#include <CLI/CLI.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/preview_state.h"
#include "render/progressive.h"

namespace meander {

struct RenderOptions {
  std::string scene;
  std::string output;
  std::vector<std::string> edits;
  std::optional<std::uint64_t> spp;
  std::optional<double> seconds;
  std::optional<double> error;
  std::uint64_t seed = 0;
  std::uint32_t first_sample = 0;
  int threads = 0;  // 0: all
  std::optional<int> width;
  std::optional<int> height;
  std::vector<int> crop;
  std::string estimator = "implicit";
  std::string walk = "batch";
  std::string isa;  // empty: the best that the machine has
  std::string stats;
  std::string checkpoint;
  double every = 60;  // seconds between checkpoints
  std::string resume;
  bool quiet = false;
};

/// Declares what ends an image, its size and its edits, which all verbs that trace share.
void add_budget_options(CLI::App& verb, RenderOptions& options);

/// Declares --walk and --isa; and what they mean, once they have been checked.
void add_walk_options(CLI::App& verb, std::string& walk, std::string& isa);
[[nodiscard]] WalkCode walk_code(std::string_view name) noexcept;
[[nodiscard]] InstructionSet instruction_set_of(std::string_view name) noexcept;

/// The edits, and the film's size as further ones.
[[nodiscard]] std::vector<std::string> all_edits(const RenderOptions& options);

/// The previewer's settings that these options ask for.
[[nodiscard]] PreviewSettings preview_settings(const RenderOptions& options);

/// Declares the options on a verb; `options` must outlive the parse.
void add_render_options(CLI::App& verb, RenderOptions& options);

struct FinishedRun {
  Job job;
  Budget budget;
  Rendering rendering;
  bool interrupted = false;
  bool kept = false;  // all of it, in the checkpoint
};

/// What ends the image: 64 samples a pixel where nothing is said.
[[nodiscard]] Budget budget_of(const RenderOptions& options);

/// Loads the scene and builds its geometry; says what there is to warn of. Error(input) for anything wrong
/// with the options or the scene.
[[nodiscard]] Job prepare_job(const RenderOptions& options);

/// Checks the outputs, loads the scene, and renders with progress, from and with checkpoints where they are
/// asked for. `extensions` are those that the output may have. Errors: Error(input) for anything wrong with
/// the options, the scene or the checkpoint; Error(runtime) when it was interrupted, or the time was up,
/// before the first pass was complete.
[[nodiscard]] FinishedRun run_render(const RenderOptions& options,
                                     std::span<const std::string_view> extensions);

/// The closing lines of a run: what was written, what it reached of its budget, and what to doubt.
void print_summary(const RenderOptions& options, const FinishedRun& run);

}  // namespace meander
