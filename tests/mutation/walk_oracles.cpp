// Oracles of walks in exact worlds.
#include <algorithm>

#include "render/measure.h"
#include "verdict.h"
#include "walk/analytic_worlds.h"
#include "walk/lane_walks.h"
#include "walk/random_walk.h"

using namespace meander;

namespace {

constexpr std::uint64_t kWalks = 400'000;

struct Substance {
  double albedo;
  double g;
  double ior = 1;
};

Measurement run(WalkCode code, decltype(MeasureJob::shape) shape, const Substance& substance,
                Incidence incidence, Estimator estimator = Estimator::implicit) {
  const std::atomic<bool> stop{false};
  MeasureJob job;
  job.shape = shape;
  job.albedo = substance.albedo;
  job.g = substance.g;
  job.ior = substance.ior;
  job.boundary = substance.ior == 1 ? Boundary::matched : Boundary::dielectric;
  job.incidence = incidence;
  job.estimator = estimator;
  job.walk = code;
  job.walks = kWalks;
  job.threads = 1;
  return measure(job, stop);
}

constexpr Incidence kNormal{false, 1};
constexpr Incidence kDiffuse{true, 1};

// van de Hulst 1980; reference/a_slab.
void slab_forward(Verdict& v, WalkCode code) {
  const Measurement m = run(code, MeasuredSlab{2}, {0.9, 0.75}, kNormal);
  v.score("R", m.reflectance, 0.097394638671);
  v.score("T", m.transmittance, 0.660957700163);
}

void slab_oblique(Verdict& v, WalkCode code) {
  const Measurement m = run(code, MeasuredSlab{2}, {0.9, 0.75}, {false, 0.5});
  v.score("R", m.reflectance, 0.233569487518);
  v.score("T", m.transmittance, 0.415890432957);
}

void slab_unscattered(Verdict& v, WalkCode code) {
  const Measurement m = run(code, MeasuredSlab{2}, {0.5, 0}, kNormal);
  v.score("unscattered T", m.unscattered_transmittance, std::exp(-2.0));
}

// Chandrasekhar's H-function; reference/b2.
void half_space(Verdict& v, WalkCode code) {
  v.score("R", run(code, MeasuredHalfSpace{}, {0.9, 0}, kNormal).reflectance, 0.414947479131);
}

void half_space_bright(Verdict& v, WalkCode code) {
  v.score("R", run(code, MeasuredHalfSpace{}, {0.999, 0}, kNormal).reflectance, 0.912845334805);
}

void half_space_backward(Verdict& v, WalkCode code) {
  v.score("R", run(code, MeasuredHalfSpace{}, {0.97, -0.5}, kDiffuse).reflectance, 0.721941497880);
}

// Peierls' equation; reference/f1.
void sphere_diffuse(Verdict& v, WalkCode code) {
  const Measurement m = run(code, MeasuredSphere{2}, {0.9, 0}, kDiffuse);
  v.score("escaped", m.reflectance, 0.781617316958);
  v.score("unscattered", m.unscattered_transmittance, 0.113552725695);
}

// reference/f3.
void sphere_fresnel(Verdict& v, WalkCode code) {
  v.score("absorbed", run(code, MeasuredSphere{1}, {0.9, 0, 1.5}, kDiffuse).absorptance, 0.2275306963);
}

// 4V/S; Blanco & Fournier 2003.
void mean_path(Verdict& v, WalkCode code) {
  v.score("path", run(code, MeasuredSphere{1}, {1, 0.5}, kDiffuse).mean_path_length, 4.0 / 3);
  v.score("path", run(code, MeasuredSphere{5}, {1, 0.5}, kDiffuse).mean_path_length, 20.0 / 3);
}

void mean_path_fresnel(Verdict& v, WalkCode code) {
  v.score("path", run(code, MeasuredSphere{2}, {1, 0, 1.5}, kDiffuse).mean_path_length, 1.5 * 1.5 * 8.0 / 3);
}

// Nothing is lost without absorption, walk by walk, and with an interface in the mean.
void furnace(Verdict& v, WalkCode code) {
  const Measurement m = run(code, MeasuredSphere{5}, {1, 0.5}, kDiffuse);
  v.require("escaped", m.reflectance.mean, 1 - 1e-5, 1 + 1e-5);
  v.score("escaped", run(code, MeasuredSphere{2}, {1, 0, 1.5}, kDiffuse).reflectance, 1);
}

void energy(Verdict& v, WalkCode code) {
  const Measurement m = run(code, MeasuredSlab{2}, {0.8, 0.5, 1.4}, kDiffuse, Estimator::analog);
  v.require("R + T + A", m.reflectance.mean + m.transmittance.mean + m.absorptance.mean, 1 - 1e-9, 1 + 1e-9);
}

// Of ten free paths in an infinite medium; closed forms, reference/e2.
constexpr int kPaths = 10;

struct PlaceMoments {
  Moments x, y, z, r2;

  void add(const Vec3& p) {
    x.add(double{p.x});
    y.add(double{p.y});
    z.add(double{p.z});
    r2.add(double{glm::dot(p, p)});
  }
};

PlaceMoments fly_scalar(Real g) {
  PlaceMoments places;
  for (std::uint32_t i = 0; i < kWalks; ++i) {
    Random random = stream(1, 0, i);
    Walker walker;
    for (int n = 0; n < kPaths; ++n) {
      if (n > 0) scatter_direction(walker, g, random);
      walker.position += sample_free_path(1, random.next()) * walker.direction;
    }
    places.add(walker.position);
  }
  return places;
}

// Lanes that rest at every collision: one path at a time.
PlaceMoments fly_in_lanes(Real g) {
  PlaceMoments places;
  LaneModel model{{Rgb(1), Rgb(1), g}, {}, true};
  std::ranges::fill(model.region.low, -1e6f);
  std::ranges::fill(model.region.high, 1e6f);
  Lanes lanes{};
  for (std::uint32_t i = 0; i < kWalks / kLanes; ++i) {
    for (int lane = 0; lane < kLanes; ++lane)
      put_walker(lanes, lane, {}, stream(1, 1, i * kLanes + static_cast<std::uint32_t>(lane)), 1);
    for (int n = 0; n < kPaths; ++n) {
      std::ranges::fill(lanes.state, static_cast<std::uint32_t>(LaneState::running));
      advance_lanes(instruction_sets().back(), model, lanes, kLanes, kLanes);
    }
    for (int lane = 0; lane < kLanes; ++lane) places.add(walker_of(lanes, lane).position);
  }
  return places;
}

void infinite_moments(Verdict& v, WalkCode code) {
  for (const double g : {-0.5, 0.0, 0.8}) {
    const auto real_g = static_cast<Real>(g);
    const PlaceMoments places = code == WalkCode::batch ? fly_in_lanes(real_g) : fly_scalar(real_g);
    const double sum = (1 - std::pow(g, kPaths)) / (1 - g);
    v.score("E[x]", places.x, 0);
    v.score("E[y]", places.y, 0);
    v.score("E[z]", places.z, sum);
    v.score("E[r^2]", places.r2, 2 * (kPaths / (1 - g) - g * sum / (1 - g)));
  }
}

struct NoEvents {
  void segment(const Walker&, Real) const noexcept {}
  void absorbed(const Rgb&) const noexcept {}
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

// Three slabs in one: optical thickness 0.1, 1 and 10, each channel in a line of reference/a_slab. A client
// of lanes, too.
struct ChromaticSlab {
  Medium medium{Rgb(Real(0.1), 1, 10), Rgb(Real(0.1), Real(0.5), Real(0.99)), 0};
  SlabWorld world{1};
  Moments reflected[3], transmitted[3];
  double largest_weight = 0;
  std::uint32_t begun = 0;

  explicit ChromaticSlab(WalkCode code) {
    if (code == WalkCode::batch)
      walk_in_lanes();
    else
      walk_scalar();
  }

  void walk_scalar() {
    Walker walker;
    Random random({1, 0, 0, 0});
    NoEvents events;
    while (start(0, walker, random))
      add(random_walk(world, WalkModel{medium, Estimator::implicit}, walker, random, events), walker);
  }
  void walk_in_lanes() {
    LaneModel model{medium, {}, false};
    for (int axis = 0; axis < 3; ++axis) {
      model.region.low[axis] = axis == 2 ? -1.0f : -1e6f;
      model.region.high[axis] = axis == 2 ? 0.0f : 1e6f;
    }
    (void)LaneWalks(instruction_sets().back(), world, model, *this).run();
  }

  [[nodiscard]] bool start(int, Walker& walker, Random& random) {
    if (begun == kWalks) return false;
    random = stream(2, 0, begun++);
    walker = {};
    walker.direction = {0, 0, -1};
    walker.weight.hero = std::min(static_cast<int>(random.next() * 3), 2);
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& result, Walker& walker, Random& random) {
    add(result, walker);
    return start(lane, walker, random);
  }
  void collided(int, Real, const Walker&, const Random&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }

  void add(const WalkResult& result, const Walker& walker) {
    const bool exited = result.end == WalkEnd::exited;
    const Rgb free_path = exited ? walker.weight.free_path_weight() : Rgb(0);
    const Rgb weight = walker.weight.carried() * free_path;
    largest_weight = std::max(largest_weight, double{largest(weight)});
    const bool back = result.crossing.normal.z > 0;
    for (int c = 0; c < 3; ++c) {
      reflected[c].add(back ? double{weight[c]} : 0);
      transmitted[c].add(back ? 0 : double{weight[c]});
    }
  }
};

void chromatic_slab(Verdict& v, WalkCode code) {
  const ChromaticSlab slab(code);
  const double reflectance[3]{0.004059278910, 0.099119185537, 0.740932321851};
  const double transmittance[3]{0.908875943201, 0.446058389891, 0.084760870823};
  for (int c = 0; c < 3; ++c) {
    v.score("R", slab.reflected[c], reflectance[c]);
    v.score("T", slab.transmitted[c], transmittance[c]);
  }
}

void chromatic_bound(Verdict& v, WalkCode code) {
  v.require("largest weight", ChromaticSlab(code).largest_weight, 0, 3.00001);
}

// Chromatic walks in a slab, known by their numbers in the order in which they begin.
struct NumberedWalks {
  std::vector<Walker> ended;
  std::uint32_t begun;
  std::uint32_t number[kLanes] = {};

  // Those up to `count` from `first` on, which walk together.
  NumberedWalks(std::uint32_t first, std::uint32_t count) : ended(count), begun(first) {
    LaneModel model{{Rgb(Real(0.1), 1, 10), Rgb(Real(0.1), Real(0.5), Real(0.99)), 0}, {}, false};
    for (int axis = 0; axis < 3; ++axis) {
      model.region.low[axis] = axis == 2 ? -1.0f : -1e6f;
      model.region.high[axis] = axis == 2 ? 0.0f : 1e6f;
    }
    const SlabWorld world{1};
    (void)LaneWalks(instruction_sets().back(), world, model, *this).run();
  }

  [[nodiscard]] bool start(int lane, Walker& walker, Random& random) {
    if (begun == ended.size()) return false;
    number[lane] = begun;
    random = stream(3, 0, begun++);
    walker = {};
    walker.direction = {0, 0, -1};
    walker.weight.hero = std::min(static_cast<int>(random.next() * 3), 2);
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult&, Walker& walker, Random& random) {
    ended[number[lane]] = walker;
    return start(lane, walker, random);
  }
  void collided(int, Real, const Walker&, const Random&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

// A walk ends alike beside many others and beside few.
void company(Verdict& v, WalkCode code) {
  if (code == WalkCode::scalar) return;
  constexpr std::uint32_t kMany = 20000;
  constexpr std::uint32_t kFew = 60;
  const NumberedWalks many(0, kMany);
  int different = 0;
  for (std::uint32_t first = 0; first + kFew <= kMany; first += kFew) {
    const NumberedWalks few(first, first + kFew);
    for (std::uint32_t i = first; i < first + kFew; ++i) {
      const PathWeight& a = many.ended[i].weight;
      const PathWeight& b = few.ended[i].weight;
      different += a.hero != b.hero || a.ratio != b.ratio || a.throughput != b.throughput ||
                   a.length != b.length || many.ended[i].position != few.ended[i].position;
    }
  }
  v.require("walks that differ", different, 0, 0);
}

constexpr Oracle kOracles[]{{"slab_forward", slab_forward},
                            {"slab_oblique", slab_oblique},
                            {"slab_unscattered", slab_unscattered},
                            {"half_space", half_space},
                            {"half_space_bright", half_space_bright},
                            {"half_space_backward", half_space_backward},
                            {"sphere_diffuse", sphere_diffuse},
                            {"sphere_fresnel", sphere_fresnel},
                            {"mean_path", mean_path},
                            {"mean_path_fresnel", mean_path_fresnel},
                            {"furnace", furnace},
                            {"energy", energy, false},
                            {"infinite_moments", infinite_moments},
                            {"chromatic_slab", chromatic_slab},
                            {"chromatic_bound", chromatic_bound},
                            {"company", company}};

}  // namespace

int main(int argc, char** argv) { return answer(kOracles, argc, argv); }
