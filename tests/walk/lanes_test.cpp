// The walk in lanes against the scalar walk, which is its oracle, and against itself.
#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "stats/distributions.h"
#include "stats/hypothesis.h"
#include "walk/lane_walks.h"
#include "walk/walk_tally.h"

using namespace meander;

namespace {

using Start = std::function<void(Walker&, Random&)>;

// Red of what comes out at the entered face and elsewhere, and the other things that a lane keeps.
struct LaneTally {
  Moments back, through, unscattered, order, length, green, steps;

  void add(const WalkResult& result, const Walker& walker) {
    const bool exited = result.end == WalkEnd::exited;
    const Rgb weight = exited ? walker.weight.carried() * walker.weight.free_path_weight() : Rgb(0);
    const bool up = result.crossing.normal.z > 0;
    back.add(up ? double{weight.x} : 0);
    through.add(up ? 0 : double{weight.x});
    unscattered.add(walker.weight.order == 0 ? double{weight.x} : 0);
    order.add(walker.weight.order);
    length.add(double{weight.x} * double{walker.weight.length});
    green.add(double{weight.y});
    steps.add(static_cast<double>(walker.steps));
  }
  [[nodiscard]] std::vector<const Moments*> all() const {
    return {&back, &through, &unscattered, &order, &length, &green, &steps};
  }
};

// One walk a sample of the stream, in order; results are kept by number.
struct Client {
  const Start& launch;
  std::uint64_t seed;
  std::vector<std::pair<WalkResult, Walker>> results;
  std::uint32_t next = 0;
  std::uint32_t number[kLanes] = {};
  int collisions = 0;

  Client(const Start& s, std::uint64_t k, std::uint32_t count) : launch(s), seed(k), results(count) {}

  [[nodiscard]] bool start(int lane, Walker& walker, Random& random) {
    if (next == results.size()) return false;
    number[lane] = next;
    random = stream(seed, 0, next++);
    walker = Walker{};
    launch(walker, random);
    return true;
  }
  [[nodiscard]] bool end(int lane, const WalkResult& result, Walker& walker, Random& random) {
    results[number[lane]] = {result, walker};
    return start(lane, walker, random);
  }
  void collided(int, Real, Walker&, Random&) { ++collisions; }
  [[nodiscard]] bool stop() const { return false; }
};

template <World W>
std::vector<std::pair<WalkResult, Walker>> walk_lanes(InstructionSet set, const W& world,
                                                      const LaneModel& model, const Start& start,
                                                      std::uint32_t walks) {
  Client client(start, 7, walks);
  LaneWalks runner(set, world, model, client);
  REQUIRE(runner.run());
  return client.results;
}

template <World W>
LaneTally tally_lanes(InstructionSet set, const W& world, const LaneModel& model, const Start& start,
                      std::uint32_t walks) {
  LaneTally tally;
  for (const auto& [result, walker] : walk_lanes(set, world, model, start, walks)) tally.add(result, walker);
  return tally;
}

// Other streams than the lanes'.
template <World W>
LaneTally tally_scalar(const W& world, const Medium& medium, const Start& start, std::uint32_t walks) {
  LaneTally tally;
  for (std::uint32_t i = 0; i < walks; ++i) {
    Random random = stream(8, 0, i);
    Walker walker;
    start(walker, random);
    TallyEvents events;
    const WalkResult result =
        random_walk(world, WalkModel{medium, Estimator::implicit}, walker, random, events);
    tally.add(result, walker);
  }
  return tally;
}

Start hero_of(Start start) {
  return [start = std::move(start)](Walker& walker, Random& random) {
    walker.weight.hero = std::min(static_cast<int>(random.next() * 3), 2);
    start(walker, random);
  };
}

SafeRegion sphere_region(Real radius) {
  SafeRegion region;
  region.kind = SafeRegion::Kind::ellipsoid;
  for (int i = 0; i < 3; ++i) region.map[i][i] = static_cast<float>(1 / radius);
  return region;
}
SafeRegion slab_region(Real thickness) {
  SafeRegion region;
  const float infinity = std::numeric_limits<float>::infinity();
  for (int i = 0; i < 2; ++i) {
    region.low[i] = -infinity;
    region.high[i] = infinity;
  }
  region.low[2] = static_cast<float>(-thickness);
  region.high[2] = 0;
  return region;
}

const std::vector<Medium>& media() {
  static const std::vector<Medium> all{{Rgb(1), Rgb(Real(0.9)), 0},
                                       {Rgb(1), Rgb(Real(0.95), Real(0.5), Real(0.1)), Real(0.8)},
                                       {Rgb(1, 3, Real(0.2)), Rgb(Real(0.9), Real(0.99), Real(0.7)), 0},
                                       {Rgb(2, 1, 6), Rgb(Real(0.99), Real(0.9), Real(0.8)), Real(-0.5)}};
  return all;
}

template <World W>
void compare(const W& world, const SafeRegion& region, const Start& start, std::vector<double>& scores) {
  constexpr std::uint32_t kWalks = 60000;
  for (const Medium& medium : media()) {
    const Start hero = is_grey(medium.sigma_t) ? start : hero_of(start);
    const LaneTally oracle = tally_scalar(world, medium, hero, kWalks);
    for (const InstructionSet set : instruction_sets()) {
      const LaneModel model{medium, region, false};
      const LaneTally lanes = tally_lanes(set, world, model, hero, kWalks);
      for (std::size_t i = 0; i < oracle.all().size(); ++i) {
        const Moments& a = *lanes.all()[i];
        const Moments& b = *oracle.all()[i];
        scores.push_back(two_sample_z(a.mean, a.standard_error(), b.mean, b.standard_error()));
        CAPTURE(std::string(name_of(set)));
        CAPTURE(medium.g);
        CAPTURE(i);
        CAPTURE(a.mean);
        CAPTURE(b.mean);
        CHECK(std::abs(scores.back()) < 5);
      }
    }
  }
}

}  // namespace

TEST_CASE("walks in lanes have the scalar walk's statistics: slabs, half-spaces and spheres") {
  std::vector<double> scores;
  compare(SlabWorld{2}, slab_region(2), enter(0, Real(0.8)), scores);
  compare(SphereWorld{2}, sphere_region(2), enter(2, 0), scores);
  SafeRegion below = slab_region(1);
  below.low[2] = -std::numeric_limits<float>::infinity();
  compare(HalfSpaceWorld{}, below, enter(0, 0), scores);
  const double threshold = two_sided_threshold(sidak_level(1e-3, scores.size()));
  double sum = 0;
  for (const double z : scores) {
    CHECK(std::abs(z) < threshold);
    sum += z * z;
  }
  MESSAGE(scores.size() << " z, mean of z^2 " << sum / static_cast<double>(scores.size()));
}

TEST_CASE("where nothing is absorbed the weight that leaves is 1 to the last walk") {
  for (const InstructionSet set : instruction_sets()) {
    for (const Real g : {Real(0), Real(0.9)}) {
      const LaneModel model{{Rgb(3), Rgb(1), g}, sphere_region(1), false};
      for (const auto& [result, walker] : walk_lanes(set, SphereWorld{1}, model, enter(1, 0), 2000)) {
        CHECK(result.end == WalkEnd::exited);
        CHECK(walker.weight.carried() == Rgb(1));
      }
    }
  }
}

TEST_CASE("a walk is the same whatever lane it is in and whatever walks beside it") {
  for (const InstructionSet set : instruction_sets()) {
    for (const bool rests : {false, true}) {
      const LaneModel model{media()[3], sphere_region(2), rests};
      const Start start = hero_of(enter(2, 0));
      const auto many = walk_lanes(set, SphereWorld{2}, model, start, 3000);
      for (const std::uint32_t count : {37u, 131u, 300u}) {  // the last ones of 131 and 300 are moved
        const auto few = walk_lanes(set, SphereWorld{2}, model, start, count);
        for (std::size_t i = 0; i < few.size(); ++i) {
          CAPTURE(i);
          CHECK(few[i].first.end == many[i].first.end);
          CHECK(few[i].second.position == many[i].second.position);
          CHECK(few[i].second.direction == many[i].second.direction);
          CHECK(few[i].second.weight.throughput == many[i].second.weight.throughput);
          CHECK(few[i].second.weight.albedo == many[i].second.weight.albedo);
          CHECK(few[i].second.weight.ratio == many[i].second.weight.ratio);
          CHECK(few[i].second.weight.hero == many[i].second.weight.hero);
          CHECK(few[i].second.weight.length == many[i].second.weight.length);
          CHECK(few[i].second.steps == many[i].second.steps);
        }
      }
    }
  }
}

TEST_CASE("directions stay unit vectors over a hundred thousand scatterings") {
  for (const InstructionSet set : instruction_sets()) {
    Lanes lanes{};
    for (int i = 0; i < kLanes; ++i) {
      Walker walker;
      const Random random = stream(3, static_cast<std::uint32_t>(i), 0);
      put_walker(lanes, i, walker, random, 1e6f);
    }
    LaneModel model{{Rgb(1e6f), Rgb(1), Real(0.95)}, sphere_region(1e6f), false};
    double worst = 0;
    for (int round = 0; round < 100000; ++round) {
      // Resting at every collision makes one step of it.
      model.rests_at_collisions = true;
      advance_lanes(set, model, lanes, kLanes, 1);
      for (int i = 0; i < kLanes; ++i) lanes.state[i] = static_cast<std::uint32_t>(LaneState::running);
      if (round % 1000 != 999) continue;
      for (int i = 0; i < kLanes; ++i) {
        const Vec3 d = walker_of(lanes, i).direction;
        worst = std::max(worst, std::abs(double{glm::dot(d, d)} - 1));
      }
    }
    CHECK(lanes.steps[5] == 100000);
    CHECK(worst < 1e-5);
  }
}

TEST_CASE("every collision that asks for a shadow ray gets to ask once") {
  for (const InstructionSet set : instruction_sets()) {
    const LaneModel model{media()[0], sphere_region(2), true};
    const Start start = enter(2, 0);
    Client client(start, 7, 1000);
    const SphereWorld world{2};
    LaneWalks runner(set, world, model, client);
    REQUIRE(runner.run());
    std::uint64_t orders = 0;
    for (const auto& [result, walker] : client.results) orders += walker.weight.order;
    CHECK(static_cast<std::uint64_t>(client.collisions) == orders);
  }
}
