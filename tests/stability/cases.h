// The hard cases: data. Each is rendered with both walks and held against something that is known.
#pragma once

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene.h"
#include "stability/readings.h"

namespace meander {

/// Every pixel is 1 within `tolerance`.
struct Furnace {
  double tolerance = 1e-5;
};
/// The whole image has this value, known within `error`. `binary`: samples are 0 or 1, so that their noise
/// follows from the value, however few they are that differ.
struct Exact {
  double value = 0;
  double error = 0;
  bool binary = false;
};
/// The quarters and the whole agree with a walk in double precision (double_walk.h).
struct InDouble {};
/// They agree with those of another scene whose image has the same expectation.
struct Same {
  Scene scene;
};
/// Out of what single precision can do, or unknown: values are finite, no brighter than the surround, and
/// stated beside `value` or a walk in double precision, where there is one off by no more than `within` of
/// it.
struct Stated {
  double value = 0;
  bool in_double = false;
  double within = 0;
};

/// What is done to a case for its test to fail: albedo 2 % lower, sigma_t twice, 10^4 times or a thousandth
/// of what it was, a triangle of the mesh dropped, the body 5 % of its size aside, the hole closed, or the
/// second body taken away.
enum class Fault { albedo, doubled, dense, diluted, triangle, aside, closed, alone };

struct Case {
  std::string group;
  std::string name;
  std::string held_against;
  Scene scene;
  std::uint64_t spp = 0;
  std::variant<Furnace, Exact, InDouble, Same, Stated> oracle;
  Fault fault = Fault::albedo;
  double offset = 0;  // what is stated is scale * (value - offset)
  double scale = 1;
  bool leaks = false;           // walks must be lost, and are counted; elsewhere none may be
  bool overlaps = false;        // a warning names the bodies; elsewhere there is none
  bool inaccurate = false;      // a warning says so; elsewhere there is none
  std::uint64_t long_spp = 16;  // times as many samples in the long run
  bool rare = false;            // events are so rare that the quick run sees a gross fault only
};

/// `rows` grows by the cases of media, of shapes, and of whole scenes and films.
void add_medium_cases(std::vector<Case>& rows);
void add_shape_cases(std::vector<Case>& rows);
void add_scene_cases(std::vector<Case>& rows);

using Shape = decltype(Object::shape);

/// A body at the origin in a white surround, seen along -z by an orthographic camera of this height; 16 x 16.
[[nodiscard]] Scene white_surround(const Shape& shape, const TranslucentMaterial& material, double height);

/// Grey matter of this mean free path and albedo.
[[nodiscard]] Medium grey(double mean_free_path, double albedo, double g = 0);

[[nodiscard]] Shape shape_of(Mesh mesh);

/// The scene with a fault in it.
[[nodiscard]] Scene with_fault(Scene scene, Fault fault);

}  // namespace meander
