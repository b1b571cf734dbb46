#include "ui/slider_map.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace meander {

double place_of(const SliderMap& map, double value) {
  const double v = std::clamp(value, map.low, map.high);
  if (map.spacing == Spacing::color) return map.map->color(v);
  if (map.spacing == Spacing::logarithmic) return std::log(v / map.low) / std::log(map.high / map.low);
  return (v - map.low) / (map.high - map.low);
}

double value_at(const SliderMap& map, double place) {
  if (place <= 0) return map.low;
  if (place >= 1) return map.high;
  if (map.spacing == Spacing::color) return map.map->albedo(place);
  if (map.spacing == Spacing::logarithmic) return map.low * std::exp(place * std::log(map.high / map.low));
  return map.low + place * (map.high - map.low);
}

double settled(const SliderMap& map, std::span<const Tick> ticks, double place,
               const std::array<double, 2>& reach_and_step) {
  const auto [reach, step] = reach_and_step;
  for (const Tick& tick : ticks)
    if (std::abs(place_of(map, tick.value) - place) < reach) return tick.value;
  const double p = std::clamp(place, 0.0, 1.0);
  const double value = value_at(map, p);
  if (p == 0 || p == 1) return value;
  const double difference =
      std::abs(value_at(map, std::min(p + step, 1.0)) - value_at(map, std::max(p - step, 0.0)));
  if (!(difference > 0)) return value;
  const int decimals = static_cast<int>(-std::floor(std::log10(0.1 * difference)));
  const double scale = std::pow(10.0, std::abs(decimals));
  const double rounded =
      decimals >= 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
  return std::clamp(rounded, map.low, map.high);
}

std::optional<double> typed_number(const std::string& text, double low, double high) {
  std::string clean;
  for (const char c : text)
    if (c != ' ') clean += c == ',' ? '.' : c;
  const char* first = clean.data();
  const char* last = first + clean.size();
  if (first != last && *first == '+') ++first;
  double value = 0;
  const auto [end, failed] = std::from_chars(first, last, value);
  if (failed != std::errc{} || end != last || !std::isfinite(value)) return std::nullopt;
  return std::clamp(value, low, high);
}

}  // namespace meander
