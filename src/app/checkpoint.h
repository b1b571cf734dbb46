// The checkpoints of a run: written as it goes, and read to continue it.
#pragma once

#include <cstdint>
#include <string>

#include "core/timer.h"
#include "render/progressive.h"

namespace meander {

/// Writes all that another process needs to continue the job from here (io/checkpoint_file.h). Errors: Error
/// as write_file.
void save_checkpoint(const std::string& path, const Job& job, const Rendering& rendering);

/// The rendering that a checkpoint holds, without its noise. Error (input): as read_checkpoint; it is of
/// another job (version, size, crop, scene, seed, first sample, estimator, walk or instruction set), or has
/// more samples than the budget's.
[[nodiscard]] Rendering load_checkpoint(const std::string& path, const Job& job, const Budget& budget);

/// Writes checkpoints every so many seconds. One that cannot be written is a warning on standard error, and
/// leaves the one before it: the run goes on. The same reason is told once.
class CheckpointKeeper {
 public:
  /// `path` empty: none is written. The job must outlive the keeper.
  CheckpointKeeper(const Job& job, std::string path, double every_seconds);

  /// After a pass.
  void keep(const Rendering& rendering);
  /// Once the run has ended. Whether the file now holds all of it.
  bool keep_last(const Rendering& rendering);

 private:
  void save(const Rendering& rendering);

  const Job& job_;
  std::string path_;
  double every_;
  Timer since_;
  std::uint64_t kept_spp_ = 0;
  std::string said_;  // why the last one could not be written
};

}  // namespace meander
