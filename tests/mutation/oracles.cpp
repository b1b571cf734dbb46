// The oracles that planted bugs must not pass: each compares the walk with a number that no walk made, or
// holds it to what must be true of every walk. Compiled once for the true source and once for every mutant.
//
//   oracles          lists their names
//   oracles NAME     prints "NAME passed|FAILED MESSAGE"; exit code 0 or 1
#include <cmath>
#include <cstdio>
#include <string>

#include "render/measure.h"
#include "walk/analytic_worlds.h"
#include "walk/random_walk.h"

using namespace meander;

namespace {

constexpr double kBound = 4.5;  // of |z|; 30 scores of the true walk exceed it with probability 2e-4
constexpr std::uint64_t kWalks = 400'000;

// What one oracle found: the worst of its scores, or what was not exact.
class Verdict {
 public:
  void score(const char* what, const Moments& measured, double exact) {
    score(what, measured.mean, exact, measured.standard_error());
  }
  void score(const char* what, double measured, double exact, double error) {
    const double z = (measured - exact) / std::max(error, 1e-6 * std::abs(exact) + 1e-12);
    if (std::abs(z) < std::abs(worst_)) return;
    worst_ = z;
    say("%s %.5g, exact %.5g, z %.1f", what, measured, exact, z);
  }
  /// The value must lie in [low, high].
  void require(const char* what, double value, double low, double high) {
    if (value >= low && value <= high) return;
    broken_ = true;
    say("%s %.6g, not in [%.6g, %.6g]", what, value, low, high);
  }
  [[nodiscard]] bool passed() const { return !broken_ && std::abs(worst_) < kBound; }
  [[nodiscard]] const std::string& message() const { return message_; }

 private:
  // A broken requirement is not talked over.
  template <class... Values>
  void say(const char* format, Values... values) {
    if (settled_) return;
    settled_ = broken_;
    char text[200];
    std::snprintf(text, sizeof text, format, values...);
    message_ = text;
  }

  double worst_ = 0;
  bool broken_ = false;
  bool settled_ = false;
  std::string message_ = "as it must be";
};

Measurement run(decltype(MeasureJob::shape) shape, double albedo, double g, double ior, Incidence incidence,
                Estimator estimator = Estimator::implicit) {
  const std::atomic<bool> stop{false};
  MeasureJob job;
  job.shape = shape;
  job.albedo = albedo;
  job.g = g;
  job.ior = ior;
  job.boundary = ior == 1 ? Boundary::matched : Boundary::dielectric;
  job.incidence = incidence;
  job.estimator = estimator;
  job.walks = kWalks;
  job.threads = 1;
  return measure(job, stop);
}

constexpr Incidence kNormal{false, 1};
constexpr Incidence kDiffuse{true, 1};

// van de Hulst 1980; reference/a_slab.
void slab_forward(Verdict& v) {
  const Measurement m = run(MeasuredSlab{2}, 0.9, 0.75, 1, kNormal);
  v.score("R", m.reflectance, 0.097394638671);
  v.score("T", m.transmittance, 0.660957700163);
}

void slab_oblique(Verdict& v) {
  const Measurement m = run(MeasuredSlab{2}, 0.9, 0.75, 1, {false, 0.5});
  v.score("R", m.reflectance, 0.233569487518);
  v.score("T", m.transmittance, 0.415890432957);
}

void slab_unscattered(Verdict& v) {
  const Measurement m = run(MeasuredSlab{2}, 0.5, 0, 1, kNormal);
  v.score("unscattered T", m.unscattered_transmittance, std::exp(-2.0));
}

// Chandrasekhar's H-function; reference/b2.
void half_space(Verdict& v) {
  v.score("R", run(MeasuredHalfSpace{}, 0.9, 0, 1, kNormal).reflectance, 0.414947479131);
}

void half_space_bright(Verdict& v) {
  v.score("R", run(MeasuredHalfSpace{}, 0.999, 0, 1, kNormal).reflectance, 0.912845334805);
}

void half_space_backward(Verdict& v) {
  v.score("R", run(MeasuredHalfSpace{}, 0.97, -0.5, 1, kDiffuse).reflectance, 0.721941497880);
}

// Peierls' equation; reference/f1.
void sphere_diffuse(Verdict& v) {
  const Measurement m = run(MeasuredSphere{2}, 0.9, 0, 1, kDiffuse);
  v.score("escaped", m.reflectance, 0.781617316958);
  v.score("unscattered", m.unscattered_transmittance, 0.113552725695);
}

// reference/f3.
void sphere_fresnel(Verdict& v) {
  v.score("absorbed", run(MeasuredSphere{1}, 0.9, 0, 1.5, kDiffuse).absorptance, 0.2275306963);
}

// 4V/S; Blanco & Fournier 2003.
void mean_path(Verdict& v) {
  v.score("path", run(MeasuredSphere{1}, 1, 0.5, 1, kDiffuse).mean_path_length, 4.0 / 3);
  v.score("path", run(MeasuredSphere{5}, 1, 0.5, 1, kDiffuse).mean_path_length, 20.0 / 3);
}

void mean_path_fresnel(Verdict& v) {
  v.score("path", run(MeasuredSphere{2}, 1, 0, 1.5, kDiffuse).mean_path_length, 1.5 * 1.5 * 8.0 / 3);
}

// Nothing is lost without absorption, walk by walk, and with an interface in the mean.
void furnace(Verdict& v) {
  const Measurement m = run(MeasuredSphere{5}, 1, 0.5, 1, kDiffuse);
  v.require("escaped", m.reflectance.mean, 1 - 1e-5, 1 + 1e-5);
  v.score("escaped", run(MeasuredSphere{2}, 1, 0, 1.5, kDiffuse).reflectance, 1);
}

void energy(Verdict& v) {
  const Measurement m = run(MeasuredSlab{2}, 0.8, 0.5, 1.4, kDiffuse, Estimator::analog);
  v.require("R + T + A", m.reflectance.mean + m.transmittance.mean + m.absorptance.mean, 1 - 1e-9, 1 + 1e-9);
}

// Ten free paths in an infinite medium; closed forms, reference/e2.
void infinite_moments(Verdict& v) {
  for (const double g : {-0.5, 0.0, 0.8}) {
    constexpr int kPaths = 10;
    Moments x, y, z, r2;
    for (std::uint32_t i = 0; i < kWalks; ++i) {
      Random random = stream(1, 0, i);
      Walker walker;
      for (int n = 0; n < kPaths; ++n) {
        if (n > 0) scatter_direction(walker, static_cast<Real>(g), random);
        walker.position += sample_free_path(1, random.next()) * walker.direction;
      }
      x.add(double{walker.position.x});
      y.add(double{walker.position.y});
      z.add(double{walker.position.z});
      r2.add(double{glm::dot(walker.position, walker.position)});
    }
    const double sum = (1 - std::pow(g, kPaths)) / (1 - g);
    v.score("E[x]", x, 0);
    v.score("E[y]", y, 0);
    v.score("E[z]", z, sum);
    v.score("E[r^2]", r2, 2 * (kPaths / (1 - g) - g * sum / (1 - g)));
  }
}

struct NoEvents {
  void segment(const Walker&, Real) const noexcept {}
  void absorbed(const Rgb&) const noexcept {}
  void scattered(const Walker&) const noexcept {}
  [[nodiscard]] bool stop() const noexcept { return false; }
};

// Three slabs in one: optical thickness 0.1, 1 and 10, each channel in a line of reference/a_slab.
struct ChromaticSlab {
  Moments reflected[3], transmitted[3];
  double largest_weight = 0;

  ChromaticSlab() {
    const WalkModel model{{Rgb(Real(0.1), 1, 10), Rgb(Real(0.1), Real(0.5), Real(0.99)), 0},
                          Estimator::implicit};
    for (std::uint32_t i = 0; i < kWalks; ++i) {
      Random random = stream(2, 0, i);
      Walker walker;
      walker.direction = {0, 0, -1};
      walker.weight.hero = std::min(static_cast<int>(random.next() * 3), 2);
      NoEvents events;
      const WalkResult result = random_walk(SlabWorld{1}, model, walker, random, events);
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
  }
};

void chromatic_slab(Verdict& v) {
  const ChromaticSlab slab;
  const double reflectance[3]{0.004059278910, 0.099119185537, 0.740932321851};
  const double transmittance[3]{0.908875943201, 0.446058389891, 0.084760870823};
  for (int c = 0; c < 3; ++c) {
    v.score("R", slab.reflected[c], reflectance[c]);
    v.score("T", slab.transmitted[c], transmittance[c]);
  }
}

void chromatic_bound(Verdict& v) { v.require("largest weight", ChromaticSlab().largest_weight, 0, 3.00001); }

struct Oracle {
  const char* name;
  void (*check)(Verdict&);
};

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
                            {"energy", energy},
                            {"infinite_moments", infinite_moments},
                            {"chromatic_slab", chromatic_slab},
                            {"chromatic_bound", chromatic_bound}};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    for (const Oracle& oracle : kOracles) std::printf("%s\n", oracle.name);
    return 0;
  }
  for (const Oracle& oracle : kOracles) {
    if (std::string(oracle.name) != argv[1]) continue;
    Verdict verdict;
    oracle.check(verdict);
    std::printf("%s %s %s\n", oracle.name, verdict.passed() ? "passed" : "FAILED", verdict.message().c_str());
    return verdict.passed() ? 0 : 1;
  }
  std::fprintf(stderr, "oracles: no oracle is called %s\n", argv[1]);
  return 2;
}
