// Logarithm, sine and cosine for SIMD lanes, one instruction set an inclusion (Highway's way: no include
// guard of the usual kind).
#if defined(MEANDER_VECTOR_MATH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef MEANDER_VECTOR_MATH_INL_H_
#undef MEANDER_VECTOR_MATH_INL_H_
#else
#define MEANDER_VECTOR_MATH_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace meander::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// ln x for positive normal x. Relative error below 2 ulp; exactly 0 at 1. Minimax polynomial of
/// (ln(1 + t) - t + t^2/2) / t^3 on [sqrt(1/2) - 1, sqrt(2) - 1], fitted for this project (error 2.9e-8).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V log_lanes(D d, V x) {
  const hn::RebindToSigned<D> di;
  const auto bits = hn::BitCast(di, x);
  const auto offset = hn::Sub(bits, hn::Set(di, 0x3f3504f3));  // sqrt(1/2)
  const auto exponent = hn::ShiftRight<23>(offset);
  const auto mantissa = hn::Sub(bits, hn::ShiftLeft<23>(exponent));
  const V t = hn::Sub(hn::BitCast(d, mantissa), hn::Set(d, 1.0f));
  V p = hn::Set(d, 0.06971611471f);
  p = hn::MulAdd(p, t, hn::Set(d, -0.1147973385f));
  p = hn::MulAdd(p, t, hn::Set(d, 0.1168541992f));
  p = hn::MulAdd(p, t, hn::Set(d, -0.1242568733f));
  p = hn::MulAdd(p, t, hn::Set(d, 0.1424905765f));
  p = hn::MulAdd(p, t, hn::Set(d, -0.1666780232f));
  p = hn::MulAdd(p, t, hn::Set(d, 0.2000071575f));
  p = hn::MulAdd(p, t, hn::Set(d, -0.2499999696f));
  p = hn::MulAdd(p, t, hn::Set(d, 0.3333333118f));
  const V e = hn::ConvertTo(d, exponent);
  const V t2 = hn::Mul(t, t);
  // ln 2 in two parts, the first exact in a few bits.
  V tail = hn::Mul(hn::Mul(t2, t), p);
  tail = hn::MulAdd(e, hn::Set(d, -2.12194440e-4f), tail);
  tail = hn::NegMulAdd(hn::Set(d, 0.5f), t2, tail);
  return hn::MulAdd(e, hn::Set(d, 0.693359375f), hn::Add(t, tail));
}

/// exp x for x <= 0; 0 below -87. Relative error below 3 ulp. Minimax polynomial of 2^f on [-1/2, 1/2],
/// fitted for this project (error 2e-9).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V exp_lanes(D d, V x) {
  const hn::RebindToSigned<D> di;
  const V clamped = hn::Max(x, hn::Set(d, -88.0f));
  const V n = hn::Round(hn::Mul(clamped, hn::Set(d, 1.44269504f)));
  V r = hn::NegMulAdd(n, hn::Set(d, 0.693359375f), clamped);
  r = hn::NegMulAdd(n, hn::Set(d, -2.12194440e-4f), r);
  const V f = hn::Mul(r, hn::Set(d, 1.44269504f));
  V p = hn::Set(d, 0.000154614447f);
  p = hn::MulAdd(p, f, hn::Set(d, 0.001340042818f));
  p = hn::MulAdd(p, f, hn::Set(d, 0.009618056679f));
  p = hn::MulAdd(p, f, hn::Set(d, 0.05550327227f));
  p = hn::MulAdd(p, f, hn::Set(d, 0.2402265092f));
  p = hn::MulAdd(p, f, hn::Set(d, 0.6931472067f));
  p = hn::MulAdd(p, f, hn::Set(d, 1.0f));
  const auto scale = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, n), hn::Set(di, 127)));
  const V value = hn::Mul(p, hn::BitCast(d, scale));
  return hn::IfThenElseZero(hn::Ge(x, hn::Set(d, -87.0f)), value);
}

/// Sine and cosine of u turns, u in [0, 1]: absolute error below 1.5e-7. The quadrant is taken off exactly.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void sincos_turns(D d, V u, V& sine, V& cosine) {
  const hn::RebindToSigned<D> di;
  const V quarters = hn::Mul(u, hn::Set(d, 4.0f));
  const V whole = hn::Round(quarters);
  const V r = hn::Sub(quarters, whole);
  const V z = hn::Mul(r, r);
  V s = hn::Set(d, -0.004602149213f);
  s = hn::MulAdd(s, z, hn::Set(d, 0.07968021765f));
  s = hn::MulAdd(s, z, hn::Set(d, -0.6459634777f));
  s = hn::Mul(hn::MulAdd(s, z, hn::Set(d, 1.570796322f)), r);
  V c = hn::Set(d, 0.0009036280664f);
  c = hn::MulAdd(c, z, hn::Set(d, -0.0208600695f));
  c = hn::MulAdd(c, z, hn::Set(d, 0.2536692037f));
  c = hn::MulAdd(c, z, hn::Set(d, -1.233700541f));
  c = hn::MulAdd(c, z, hn::Set(d, 1.0f));
  const auto quadrant = hn::ConvertTo(di, whole);
  const auto odd = hn::RebindMask(d, hn::Ne(hn::And(quadrant, hn::Set(di, 1)), hn::Zero(di)));
  const auto sine_sign = hn::ShiftLeft<30>(hn::And(quadrant, hn::Set(di, 2)));
  const auto cosine_sign = hn::ShiftLeft<30>(hn::And(hn::Add(quadrant, hn::Set(di, 1)), hn::Set(di, 2)));
  sine = hn::Xor(hn::IfThenElse(odd, c, s), hn::BitCast(d, sine_sign));
  cosine = hn::Xor(hn::IfThenElse(odd, s, c), hn::BitCast(d, cosine_sign));
}

}  // namespace meander::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
