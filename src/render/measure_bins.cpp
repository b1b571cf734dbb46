#include "render/measure_bins.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meander {

void BinRow::add(int bin, double value) {
  if (value == 0) return;
  if (current_[bin] == 0) touched_.push_back(bin);
  current_[bin] += value;
}

void BinRow::end_walk() {
  for (const int bin : touched_) {
    sum_[bin] += current_[bin];
    squares_[bin] += current_[bin] * current_[bin];
    current_[bin] = 0;
  }
  touched_.clear();
}

void BinRow::merge(const BinRow& other) {
  if (other.empty()) return;
  if (empty()) *this = BinRow(other.size());
  for (int i = 0; i < size(); ++i) {
    sum_[i] += other.sum_[i];
    squares_[i] += other.squares_[i];
  }
}

double BinRow::mean(int bin, std::uint64_t walks) const { return sum_[bin] / static_cast<double>(walks); }

double BinRow::standard_error(int bin, std::uint64_t walks) const {
  if (walks < 2) return 0;
  const auto n = static_cast<double>(walks);
  const double average = sum_[bin] / n;
  return std::sqrt(std::max(squares_[bin] / n - average * average, 0.0) / (n - 1));
}

void RatioOfSums::add(double numerator, double denominator) noexcept {
  n_ += numerator;
  d_ += denominator;
  nn_ += numerator * numerator;
  nd_ += numerator * denominator;
  dd_ += denominator * denominator;
}

void RatioOfSums::merge(const RatioOfSums& other) noexcept {
  n_ += other.n_;
  d_ += other.d_;
  nn_ += other.nn_;
  nd_ += other.nd_;
  dd_ += other.dd_;
}

double RatioOfSums::value() const noexcept { return d_ > 0 ? n_ / d_ : 0; }

double RatioOfSums::standard_error() const noexcept {
  if (!(d_ > 0)) return 0;
  const double r = value();
  return std::sqrt(std::max(nn_ - 2 * r * nd_ + r * r * dd_, 0.0)) / d_;
}

ResolvedBins::ResolvedBins(const BinOptions& o)
    : reflected_angle(o.angular),
      transmitted_angle(o.angular),
      reflected_radius(o.radial > 0 ? o.radial + 1 : 0),
      transmitted_radius(o.radial > 0 ? o.radial + 1 : 0),
      absorbed_depth(o.depth > 0 ? o.depth + 1 : 0),
      fluence(o.depth > 0 ? o.depth + 1 : 0),
      reflected_path(o.path > 0 ? o.path + 1 : 0),
      transmitted_path(o.path > 0 ? o.path + 1 : 0) {}

void ResolvedBins::end_walk() {
  for (BinRow* row : {&reflected_angle, &transmitted_angle, &reflected_radius, &transmitted_radius,
                      &absorbed_depth, &fluence, &reflected_path, &transmitted_path})
    row->end_walk();
}

void ResolvedBins::merge(const ResolvedBins& other) {
  reflected_angle.merge(other.reflected_angle);
  transmitted_angle.merge(other.transmitted_angle);
  reflected_radius.merge(other.reflected_radius);
  transmitted_radius.merge(other.transmitted_radius);
  absorbed_depth.merge(other.absorbed_depth);
  fluence.merge(other.fluence);
  reflected_path.merge(other.reflected_path);
  transmitted_path.merge(other.transmitted_path);
  mean_path_reflected.merge(other.mean_path_reflected);
  mean_path_transmitted.merge(other.mean_path_transmitted);
}

int bin_of(double value, int count, double range) noexcept {
  if (!(value < range)) return count;
  return std::clamp(static_cast<int>(value / range * count), 0, count - 1);
}

}  // namespace meander
