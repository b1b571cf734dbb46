#include <cmath>

#include "walk/lanes.h"
#include "walk/random_walk.h"

// The instruction sets this file is compiled for, once each.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walk/lane_kernels.cpp"
#include <hwy/foreach_target.h>
// after foreach_target.h
#include <hwy/highway.h>

#include "math/vector_math-inl.h"
#include "walk/lane_regions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

// xoshiro128++ as in math/random.h, one state a lane.
struct Generators {
  VU s0, s1, s2, s3;

  HWY_INLINE VU next_bits() {
    const VU sum = hn::Add(s0, s3);
    const VU bits = hn::Add(hn::Or(hn::ShiftLeft<7>(sum), hn::ShiftRight<25>(sum)), s0);
    const VU t = hn::ShiftLeft<9>(s1);
    s2 = hn::Xor(s2, s0);
    s3 = hn::Xor(s3, s1);
    s1 = hn::Xor(s1, s2);
    s0 = hn::Xor(s0, s3);
    s2 = hn::Xor(s2, t);
    s3 = hn::Or(hn::ShiftLeft<11>(s3), hn::ShiftRight<21>(s3));
    return bits;
  }
  static HWY_INLINE VF as_float(VU number) {
    return hn::ConvertTo(F(), hn::BitCast(hn::RebindToSigned<F>(), number));
  }
  // Only the masked lanes draw.
  HWY_INLINE VF next(MF mask) {
    Generators drawn = *this;
    const VF value = hn::Mul(as_float(hn::ShiftRight<8>(drawn.next_bits())), set(0x1p-24f));
    *this = choose(mask, drawn, *this);
    return value;
  }
  // The same, with the rest of Random::next_fine.
  HWY_INLINE VF next_fine(MF mask, VF& rest) {
    Generators drawn = *this;
    const VU bits = drawn.next_bits();
    *this = choose(mask, drawn, *this);
    rest = hn::MulAdd(as_float(hn::And(bits, hn::Set(U(), 255))), set(0x1p-32f), set(0x1p-33f));
    return hn::Mul(as_float(hn::ShiftRight<8>(bits)), set(0x1p-24f));
  }
  static HWY_INLINE Generators choose(MF mask, const Generators& yes, const Generators& no) {
    const auto m = hn::RebindMask(U(), mask);
    return {hn::IfThenElse(m, yes.s0, no.s0), hn::IfThenElse(m, yes.s1, no.s1),
            hn::IfThenElse(m, yes.s2, no.s2), hn::IfThenElse(m, yes.s3, no.s3)};
  }
};

template <SafeRegion::Kind kKind, bool kChromatic, bool kAnisotropic>
class Kernel {
 public:
  HWY_INLINE Kernel(const LaneModel& model, Lanes& lanes)
      : model_(model), region_{model.region}, lanes_(lanes) {}

  HWY_INLINE void run(int count, int enough) {
    const int width = static_cast<int>(hn::Lanes(F()));
    for (std::uint64_t step_of_all = 0; step_of_all < kStopInterval; ++step_of_all) {
      int running = 0;
      for (int at = 0; at < count; at += width) {
        if (const MF landed = running_lanes(at, LaneDue::collision); !hn::AllFalse(F(), landed))
          collide_landed(at, landed);
        const MF mask = hn::RebindMask(F(), hn::Eq(hn::Load(U(), lanes_.state + at), of(LaneState::running)));
        if (hn::AllFalse(F(), mask)) continue;
        running += static_cast<int>(hn::CountTrue(F(), mask));
        step(at, mask);
      }
      region_.settle(lanes_);
      if (running == 0 || running <= count - enough) return;
    }
  }

 private:
  template <class E>
  static HWY_INLINE VU of(E value) {
    return hn::Set(U(), static_cast<std::uint32_t>(value));
  }
  HWY_INLINE MF running_lanes(int at, LaneDue due) const {
    const auto runs = hn::Eq(hn::Load(U(), lanes_.state + at), of(LaneState::running));
    return hn::RebindMask(F(), hn::And(runs, hn::Eq(hn::Load(U(), lanes_.due + at), of(due))));
  }
  HWY_INLINE Generators generators(int at) const {
    return {hn::Load(U(), lanes_.random[0] + at), hn::Load(U(), lanes_.random[1] + at),
            hn::Load(U(), lanes_.random[2] + at), hn::Load(U(), lanes_.random[3] + at)};
  }
  HWY_INLINE void keep(const Generators& random, int at) {
    hn::Store(random.s0, U(), lanes_.random[0] + at);
    hn::Store(random.s1, U(), lanes_.random[1] + at);
    hn::Store(random.s2, U(), lanes_.random[2] + at);
    hn::Store(random.s3, U(), lanes_.random[3] + at);
  }

  // Few at a time: apart, so that all other steps are spared it.
  HWY_NOINLINE void collide_landed(int at, MF landed) {
    Generators random = generators(at);
    collide(at, landed, hn::Load(F(), lanes_.distance + at), random);
    keep(random, at);
  }

  HWY_INLINE void step(int at, MF running) {
    Generators random = generators(at);
    const V3 p = load(lanes_.position, at);
    const V3 d = scatter(at, running, random);
    store(d, lanes_.direction, at);

    const VF sigma = hn::Load(F(), lanes_.sigma + at);
    VF rest;
    const VF xi = random.next_fine(running, rest);
    const VF distance = hn::Div(hn::Sub(rest, log_lanes(F(), hn::Sub(set(1), xi))), sigma);
    hn::Store(hn::IfThenElse(running, distance, hn::Load(F(), lanes_.distance + at)), F(),
              lanes_.distance + at);
    const V3 q{hn::MulAdd(distance, d.x, p.x), hn::MulAdd(distance, d.y, p.y),
               hn::MulAdd(distance, d.z, p.z)};
    const MF safe = region_.holds(running, p, q, lanes_, at);
    store(choose(safe, q, p), lanes_.position, at);
    const VU step = hn::IfThenElseZero(hn::RebindMask(U(), running), hn::Set(U(), 1));
    const VU steps = hn::Add(hn::Load(U(), lanes_.steps + at), step);
    hn::Store(steps, U(), lanes_.steps + at);
    collide(at, safe, distance, random);
    // What was not safe waits for its ray; what roulette ended is marked already.
    VU state = hn::Load(U(), lanes_.state + at);
    const MF waits = hn::AndNot(safe, running);
    state = hn::IfThenElse(hn::RebindMask(U(), waits), of(LaneState::crossing), state);
    const VU since = hn::And(steps, hn::Set(U(), kSumInterval - 1));
    const auto sums = hn::And(hn::Eq(since, hn::Zero(U())), hn::Eq(state, of(LaneState::running)));
    state = hn::IfThenElse(sums, of(LaneState::summed), state);
    hn::Store(state, U(), lanes_.state + at);
    keep(random, at);
  }

  // A new direction for the lanes that one is due for.
  HWY_INLINE V3 scatter(int at, MF running, Generators& random) {
    const V3 d = load(lanes_.direction, at);
    const VU dues = hn::Load(U(), lanes_.due + at);
    const MF due = hn::And(running, hn::RebindMask(F(), hn::Eq(dues, of(LaneDue::scattering))));
    hn::Store(hn::IfThenElseZero(hn::Not(hn::RebindMask(U(), running)), dues), U(), lanes_.due + at);
    if (hn::AllFalse(F(), due)) return d;
    const VF u1 = random.next(due);
    const VF u2 = random.next(due);
    VF sine;
    VF cosine;
    sincos_turns(F(), u2, sine, cosine);
    if constexpr (!kAnisotropic) {
      const VF sin_theta = hn::Sqrt(hn::Mul(u1, hn::Sub(set(1), u1)));
      const VF twice = hn::Add(sin_theta, sin_theta);
      return choose(due, {hn::Mul(twice, cosine), hn::Mul(twice, sine), hn::MulSub(set(2), u1, set(1))}, d);
    } else {
      return choose(due, deflect(at, due, d, {u1, cosine, sine}), d);
    }
  }

  // Henyey-Greenstein about d; `u` is (xi, cosine, sine of the azimuth). As in math/henyey_greenstein.h.
  HWY_INLINE V3 deflect(int at, MF due, const V3& d, const V3& u) {
    const float g = model_.medium.g;
    const float a = std::abs(g);
    const VF one = set(1);
    const VF xi = g < 0 ? hn::Sub(one, u.x) : u.x;
    const VF eta = g < 0 ? u.x : hn::Sub(one, u.x);
    const VF narrow = set(1 - a);
    const VF axi = hn::Mul(set(a), xi);
    const VF q = hn::MulAdd(set(2), axi, narrow);
    const VF scale = hn::Div(set(2), hn::Mul(q, q));
    VF one_minus = hn::Mul(hn::Mul(scale, set((1 - a) * (1 - a))), hn::Mul(eta, hn::Add(one, axi)));
    VF one_plus = hn::Mul(hn::Mul(scale, set((1 + a) * (1 + a))), hn::Mul(xi, hn::Add(narrow, axi)));
    const VF sin_theta = hn::Sqrt(hn::Mul(one_minus, one_plus));
    if (g < 0) {
      const VF swap = one_minus;
      one_minus = one_plus;
      one_plus = swap;
    }
    const VF mu =
        hn::IfThenElse(hn::Lt(one_minus, one_plus), hn::Sub(one, one_minus), hn::Sub(one_plus, one));
    hn::Store(hn::IfThenElse(due, one_minus, hn::Load(F(), lanes_.one_minus_mu + at)), F(),
              lanes_.one_minus_mu + at);
    hn::Store(hn::IfThenElse(due, one_plus, hn::Load(F(), lanes_.one_plus_mu + at)), F(),
              lanes_.one_plus_mu + at);
    return turn(d, {hn::Mul(sin_theta, u.y), hn::Mul(sin_theta, u.z), mu});
  }

  // A local vector in the frame about d, as in math/frame.h, renormalised.
  static HWY_INLINE V3 turn(const V3& d, const V3& local) {
    const VF sign = hn::CopySign(set(1), d.z);
    const VF a = hn::Div(set(-1), hn::Add(sign, d.z));
    const VF b = hn::Mul(hn::Mul(d.x, d.y), a);
    const VF tx = hn::MulAdd(hn::Mul(sign, hn::Mul(d.x, d.x)), a, set(1));
    const VF ty = hn::Mul(sign, b);
    const VF tz = hn::Neg(hn::Mul(sign, d.x));
    const VF by = hn::MulAdd(hn::Mul(d.y, d.y), a, sign);
    const V3 v{hn::MulAdd(local.x, tx, hn::MulAdd(local.y, b, hn::Mul(local.z, d.x))),
               hn::MulAdd(local.x, ty, hn::MulAdd(local.y, by, hn::Mul(local.z, d.y))),
               hn::MulAdd(local.x, tz, hn::NegMulAdd(local.y, d.y, hn::Mul(local.z, d.z)))};
    const VF s = hn::NegMulAdd(set(0.5f), dot(v, v), set(1.5f));
    return {hn::Mul(v.x, s), hn::Mul(v.y, s), hn::Mul(v.z, s)};
  }

  // The weight of a collision after `distance` for the lanes of `safe`, and roulette.
  HWY_INLINE void collide(int at, MF safe, VF distance, Generators& random) {
    const VF length = hn::Load(F(), lanes_.length + at);
    hn::Store(hn::Add(length, hn::IfThenElseZero(safe, distance)), F(), lanes_.length + at);
    const auto m = hn::RebindMask(U(), safe);
    const VU one = hn::IfThenElseZero(m, hn::Set(U(), 1));
    hn::Store(hn::IfThenElse(m, of(LaneDue::scattering), hn::Load(U(), lanes_.due + at)), U(),
              lanes_.due + at);
    if constexpr (kChromatic) weigh_free_path(at, safe, distance);
    tally(at, safe, distance);

    VF weight = set(0);
    for (int c = 0; c < 3; ++c) {
      const VF old = hn::Load(F(), lanes_.albedo[c] + at);
      const VF albedo = hn::IfThenElse(safe, hn::Mul(old, set(model_.medium.albedo[c])), old);
      hn::Store(albedo, F(), lanes_.albedo[c] + at);
      weight = hn::Max(weight, hn::Mul(albedo, hn::Load(F(), lanes_.throughput[c] + at)));
    }
    const VF lift = hn::Load(F(), lanes_.lift + at);
    weight = hn::Mul(weight, lift);
    VU state = hn::Load(U(), lanes_.state + at);
    if (model_.rests_at_collisions) state = hn::IfThenElse(m, of(LaneState::collided), state);
    const MF plays = hn::And(safe, hn::Lt(weight, set(kRouletteThreshold)));
    if (!hn::AllFalse(F(), plays)) {
      const VF survival = hn::Mul(weight, set(1 / kRouletteThreshold));
      const MF survives = hn::Lt(random.next(plays), survival);
      hn::Store(hn::IfThenElse(hn::And(plays, survives), hn::Div(lift, survival), lift), F(),
                lanes_.lift + at);
      state =
          hn::IfThenElse(hn::RebindMask(U(), hn::AndNot(survives, plays)), of(LaneState::absorbed), state);
    }
    hn::Store(state, U(), lanes_.state + at);
    const VU dead = of(LaneState::absorbed);
    const VU scattered = hn::IfThenElseZero(hn::Ne(state, dead), one);
    hn::Store(hn::Add(hn::Load(U(), lanes_.order + at), scattered), U(), lanes_.order + at);
  }

  // What a step flies and leaves behind, before its collision is weighed.
  HWY_INLINE void tally(int at, MF safe, VF distance) {
    const VF carried = hn::IfThenElseZero(
        safe, hn::Mul(hn::Mul(hn::Load(F(), lanes_.albedo[0] + at), hn::Load(F(), lanes_.throughput[0] + at)),
                      hn::Load(F(), lanes_.lift + at)));
    const VF left = hn::Mul(carried, set(1 - model_.medium.albedo.x));
    hn::Store(hn::MulAdd(carried, distance, hn::Load(F(), lanes_.path + at)), F(), lanes_.path + at);
    hn::Store(hn::Add(hn::Load(F(), lanes_.absorbed + at), left), F(), lanes_.absorbed + at);
  }

  // Folds a collision into the densities of the free paths, see PathWeight.
  HWY_INLINE void weigh_free_path(int at, MF safe, VF distance) {
    const Rgb& sigma = model_.medium.sigma_t;
    const float least = std::min({sigma.x, sigma.y, sigma.z});
    VF p[3];
    for (int c = 0; c < 3; ++c) {
      const VF power = hn::Mul(distance, set(least - sigma[c]));
      const VF density = hn::Mul(exp_lanes(F(), power), set(sigma[c]));
      p[c] = hn::Mul(hn::Load(F(), lanes_.ratio[c] + at), density);
    }
    const VF inverse = hn::Div(set(1), hn::Max(p[0], hn::Max(p[1], p[2])));
    for (int c = 0; c < 3; ++c) {
      const VF old = hn::Load(F(), lanes_.ratio[c] + at);
      hn::Store(hn::IfThenElse(safe, hn::Mul(p[c], inverse), old), F(), lanes_.ratio[c] + at);
    }
  }

  const LaneModel& model_;
  Region<kKind> region_;
  Lanes& lanes_;
};

template <SafeRegion::Kind kKind, bool kChromatic>
void advance_with(const LaneModel& model, Lanes& lanes, int count, int enough) {
  if (model.medium.g == 0)
    Kernel<kKind, kChromatic, false>(model, lanes).run(count, enough);
  else
    Kernel<kKind, kChromatic, true>(model, lanes).run(count, enough);
}

template <SafeRegion::Kind kKind>
void advance_in(const LaneModel& model, Lanes& lanes, int count, int enough) {
  if (!is_grey(model.medium.sigma_t))
    advance_with<kKind, true>(model, lanes, count, enough);
  else
    advance_with<kKind, false>(model, lanes, count, enough);
}

void advance(const LaneModel& model, Lanes& lanes, int count, int enough) {
  switch (model.region.kind) {
    case SafeRegion::Kind::box:
      return advance_in<SafeRegion::Kind::box>(model, lanes, count, enough);
    case SafeRegion::Kind::ellipsoid:
      return advance_in<SafeRegion::Kind::ellipsoid>(model, lanes, count, enough);
    case SafeRegion::Kind::balls:
      return advance_in<SafeRegion::Kind::balls>(model, lanes, count, enough);
  }
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace meander {

void advance_lanes(InstructionSet set, const LaneModel& model, Lanes& lanes, int count, int enough) noexcept {
  switch (set) {
    case InstructionSet::avx512:
      return N_AVX3::advance(model, lanes, count, enough);
    case InstructionSet::avx2:
      return N_AVX2::advance(model, lanes, count, enough);
    case InstructionSet::sse4:
      return N_SSE4::advance(model, lanes, count, enough);
    case InstructionSet::baseline:
      return HWY_STATIC_DISPATCH(advance)(model, lanes, count, enough);
  }
}

}  // namespace meander
#endif
