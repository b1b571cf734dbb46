// Resolved measurements: where, at which angle and after which path light leaves, and how deep it is
// absorbed, each bin with its standard error.
#pragma once

#include <cstdint>
#include <vector>

namespace meander {

/// Numbers of bins, 0 for none, and the ranges that they span, in mean free paths. What lies beyond a range
/// is counted in one more bin at the end.
struct BinOptions {
  int angular = 0;  // over the exitant cosine, (0, 1]
  int radial = 0;   // over the distance from where a pencil beam enters, [0, radius)
  double radius = 10;
  int depth = 0;  // over the depth below the surface, [0, max_depth)
  double max_depth = 10;
  int path = 0;  // over the path length inside, [0, max_path)
  double max_path = 50;

  [[nodiscard]] bool any() const noexcept { return angular > 0 || radial > 0 || depth > 0 || path > 0; }
};

/// Sums over walks of what falls into each of a row of bins. A walk may fall into a bin several times: its
/// own sum is closed by end_walk(), so that the standard error is that of independent walks.
class BinRow {
 public:
  BinRow() = default;
  explicit BinRow(int count) : sum_(count), squares_(count), current_(count) {}

  [[nodiscard]] bool empty() const noexcept { return sum_.empty(); }
  [[nodiscard]] int size() const noexcept { return static_cast<int>(sum_.size()); }
  void add(int bin, double value);
  void end_walk();
  void merge(const BinRow& other);

  /// Mean of a bin over `walks` walks, and its standard error.
  [[nodiscard]] double mean(int bin, std::uint64_t walks) const;
  [[nodiscard]] double standard_error(int bin, std::uint64_t walks) const;

 private:
  std::vector<double> sum_;
  std::vector<double> squares_;
  std::vector<double> current_;
  std::vector<int> touched_;
};

/// The ratio of two sums over walks, such as a mean path, with its standard error by the delta method.
class RatioOfSums {
 public:
  void add(double numerator, double denominator) noexcept;
  void merge(const RatioOfSums& other) noexcept;
  /// 0 while the denominator is 0.
  [[nodiscard]] double value() const noexcept;
  [[nodiscard]] double standard_error() const noexcept;

 private:
  double n_ = 0;
  double d_ = 0;
  double nn_ = 0;
  double nd_ = 0;
  double dd_ = 0;
};

/// Every row that BinOptions can ask for; reflected and transmitted light apart. Radial, depth and path rows
/// end with their overflow bin. `fluence` holds the path flown per walk in each depth bin.
struct ResolvedBins {
  BinRow reflected_angle, transmitted_angle;
  BinRow reflected_radius, transmitted_radius;
  BinRow absorbed_depth, fluence;
  BinRow reflected_path, transmitted_path;
  RatioOfSums mean_path_reflected, mean_path_transmitted;

  ResolvedBins() = default;
  explicit ResolvedBins(const BinOptions& options);
  void end_walk();
  void merge(const ResolvedBins& other);
};

/// The bin of `value` on a row of `count` equal bins over [0, range) and an overflow bin: count at or beyond
/// the range.
[[nodiscard]] int bin_of(double value, int count, double range) noexcept;

}  // namespace meander
