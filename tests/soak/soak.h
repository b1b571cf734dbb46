// A previewer under random use for as long as one likes: the storm of tests/app, files that change under it,
// and what must hold meanwhile.
#pragma once

#include <cstdint>
#include <memory>
#include <random>
#include <string>

#include "app/storm.h"

namespace meander {

/// Frames, 10 ms apart or more, within which a picture of what was asked last has to be there, or what
/// changed on disk be noticed (the previewer looks every 0.4 s); ten times as many under the address
/// sanitizer. Counted in frames, not seconds: the process may be stopped.
#ifdef __SANITIZE_ADDRESS__
inline constexpr int kMostFrames = 3000;
#else
inline constexpr int kMostFrames = 300;
#endif

class Soak {
 public:
  Soak(const Folder& folder, unsigned seed) : folder_(folder), random_(seed + 77), storm_(folder, seed) {}

  /// A step of the storm, or a file that changes, as the second does at any rate; then the picture of what is
  /// asked now has to come.
  void step();
  /// Lets the picture become complete: it and what the screen shows must be what a new rendering and a new
  /// display make of the parameters, bit for bit and nearly so. Lets go of snapshots, which a user may pile
  /// up.
  void verify();

  int longest_wait = 0;  // frames until a picture was there
  int reloads = 0;       // files that changed and were read, or refused
  int pictures = 0;      // that were compared
  int screens = 0;       // likewise
  [[nodiscard]] int grey() const { return storm_.grey; }
  int compared = 0;    // screens that show the image, and not that of the time before
  int told_apart = 0;  // of these the ones that could be told from that of the time before

 private:
  [[nodiscard]] const PreviewState& state() const { return storm_.previewer().state(); }
  int whole(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<unsigned>(high - low + 1));
  }
  template <class Done>
  bool wait_until(const Done& done);
  void await_current();
  void rewrite_scene();
  void rewrite_mesh();
  [[nodiscard]] std::string edited_text();
  void show_live_picture();
  void check_screen(const std::shared_ptr<const LiveFrame>& frame);
  [[nodiscard]] bool verified();
  [[nodiscard]] bool check_screens(const std::shared_ptr<const LiveFrame>& frame);

  const Folder& folder_;
  std::mt19937 random_;
  Storm storm_;
  int steps_ = 0;
  std::shared_ptr<const LiveFrame> before_;
};

}  // namespace meander
