// What the previewer says of the scene, and what it reads again when files change.
#include <algorithm>
#include <filesystem>
#include <iterator>

#include "app/previewer.h"
#include "app/scene_warnings.h"
#include "core/error.h"

namespace meander {
namespace {

constexpr double kWatchSeconds = 0.4;  // between two looks at the files

}  // namespace

// What the scene as it now is gives cause to warn of, each once for as long as it does.
void Previewer::tell_warnings() {
  std::vector<std::string> due = state_.warnings;
  const auto& frame = pictures_.newest();
  if (frame && frame->generation == generation_ && frame->overlaps) overlaps_ = *frame->overlaps;
  std::ranges::copy(overlaps_, std::back_inserter(due));
  std::ranges::copy(scene_warnings(*state_.scene), std::back_inserter(due));
  std::erase_if(warnings_, [&](const auto& told) {
    const bool over = std::ranges::find(due, told.first) == due.end();
    if (over) state_.withdraw(told.second);
    return over;
  });
  for (const std::string& warning : due) {
    if (std::ranges::find(warnings_, warning, &std::pair<std::string, std::uint64_t>::first) !=
        warnings_.end())
      continue;
    state_.tell(MessageKind::warning, warning);
    warnings_.emplace_back(warning, state_.messages.back().id);
  }
}

std::vector<std::string> Previewer::warnings() const {
  std::vector<std::string> texts;
  for (const auto& [text, id] : warnings_) texts.push_back(text);
  return texts;
}

std::uint64_t Previewer::tell_error(const Error& error) {
  state_.tell(MessageKind::error, error.what());
  return state_.messages.back().id;
}

// The scene file as it now is on disk, with the edits of the command line. Unless it was asked for, nothing
// where the file says what it said when it was read or saved here: edits since then stay.
void Previewer::reload_scene(bool asked) {
  frames_due_ = kSettleFrames;
  state_.withdraw(scene_error_);
  refused_files_.clear();
  const SceneDocument& now = state_.history.now();
  try {
    SceneDocument fresh = now.reopened();
    if (!asked && fresh == state_.original) return;
    if (!(fresh == now)) {
      if (now.path() == state_.asked.path)
        for (const std::string& edit : state_.asked.edits) fresh.apply(edit);
      if (!asked && fresh == state_.original) return;
    }
    const bool differs = !(fresh == now);
    if (differs) state_.change(std::move(fresh));
    state_.settle();  // what is shown is what the file says, even where it was so already
    if (!differs) return;
    state_.withdraw(part_error_);
    state_.tell(MessageKind::note, "reloaded the scene");
  } catch (const Error& error) {
    scene_error_ = tell_error(error);
    refused_files_ = now.reopened_files();
  }
}

// Meshes and pictures as they now are on disk; what was edited stays.
void Previewer::reload_parts() {
  frames_due_ = kSettleFrames;
  state_.withdraw(part_error_);
  try {
    state_.resolve();
    submit(false);
    state_.tell(MessageKind::note, "reloaded what changed on disk");
  } catch (const Error& error) {
    part_error_ = tell_error(error);
  }
}

void Previewer::reload_shaders() {
  frames_due_ = kSettleFrames;
  state_.withdraw(shader_error_);
  try {
    pictures_.reload();
    interface_view_.reload();
    state_.tell(MessageKind::note, "reloaded the shaders");
  } catch (const Error& error) {
    shader_error_ = tell_error(error);
  }
}

void Previewer::watch_files(double now) {
  if (!options_.watches_files || now - last_watch_ < kWatchSeconds) return;
  last_watch_ = now;
  const std::vector<FileStamp> files = state_.history.now().watched_files();
  const std::string scene = files.front().path;
  // A scene that was refused is read again when anything that it names changes.
  if (!refused_files_.empty() && refused_files_.front().path != scene) refused_files_.clear();
  const bool refused = !refused_files_.empty();
  std::vector<FileStamp> all = files;
  all.insert(all.end(), refused_files_.begin(), refused_files_.end());
  files_.watch(all);
  const std::vector<std::string> changed = files_.changed();
  // A bare mesh in the studio is a part like any other.
  const bool is_text = std::filesystem::path(scene).extension() == ".toml";
  const auto has_changed = [&](const FileStamp& file) {
    return std::find(changed.begin(), changed.end(), file.path) != changed.end();
  };
  if (std::any_of(files.begin() + (is_text ? 1 : 0), files.end(), has_changed)) reload_parts();
  if ((is_text && has_changed(files.front())) || (refused && !changed.empty())) reload_scene(false);
  if (!shaders_.changed().empty()) reload_shaders();
}

}  // namespace meander
