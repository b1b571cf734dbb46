// Which pixels no camera ray meets anything in: there a sample costs no ray.
#pragma once

#include <vector>

#include "render/progressive.h"

namespace meander {

/// By the bounding sphere of every object; refers to the job.
class EmptyPixels {
 public:
  EmptyPixels(const Job& job, const CameraRays& camera);

  /// Whether no ray through a pixel of the image, in the job's own pixels, comes near an object. May say no
  /// where it is so.
  [[nodiscard]] bool contains(int x, int y) const noexcept;

 private:
  // A bounding sphere as the camera sees it: what the line through a pixel's middle keeps off its centre.
  struct Outline {
    DVec3 center;  // from the camera
    double squared;
  };

  [[nodiscard]] static Outline outline(const CameraRays& camera, const DVec3& center, double radius,
                                       double spread) noexcept;

  const Job& job_;
  const CameraRays& camera_;
  std::vector<Outline> outlines_;
};

}  // namespace meander
