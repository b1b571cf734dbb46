// The size of a window or of a frame.
#pragma once

namespace meander {

struct Extent {
  int width = 0;
  int height = 0;

  bool operator==(const Extent&) const = default;
};

}  // namespace meander
