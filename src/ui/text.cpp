#include "ui/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "math/color.h"

namespace meander {
namespace {

std::string fixed(double value, int decimals) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  return buffer.data();
}

// Shortest text that reads back as the same double, with a point or an exponent: a TOML float.
std::string exact(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace

std::string significant(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size < 1e-4 || size >= 1e6) {
    std::array<char, 32> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%.*e", std::max(digits - 1, 0), value);
    return buffer.data();
  }
  const int magnitude = static_cast<int>(std::floor(std::log10(size)));
  return fixed(value, std::clamp(digits - 1 - magnitude, 0, 9));
}

std::string signed_text(double value, int decimals) {
  const std::string text = fixed(std::abs(value), decimals);
  if (text.find_first_not_of("0.") == std::string::npos) return text;
  return (value < 0 ? "−" : "+") + text;
}

std::string percent_text(double fraction) { return significant(100 * fraction, 2) + " %"; }

std::string short_percent(double fraction) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3g %%", 100 * fraction);
  return buffer.data();
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "∞";
  if (seconds < 9.95) return fixed(seconds, 1) + " s";
  const double whole = std::round(seconds);
  if (whole < 60) return fixed(whole, 0) + " s";
  const double minutes = std::floor(whole / 60);
  std::array<char, 64> buffer{};
  if (minutes < 60)
    std::snprintf(buffer.data(), buffer.size(), "%.0f min %02.0f s", minutes, whole - 60 * minutes);
  else
    std::snprintf(buffer.data(), buffer.size(), "%.0f h %02.0f min", std::floor(minutes / 60),
                  minutes - 60 * std::floor(minutes / 60));
  return buffer.data();
}

std::string count_text(double count) {
  if (count < 1e3) return fixed(count, count < 10 && count != std::floor(count) ? 1 : 0);
  if (count < 999.5e3) return significant(count / 1e3, 3) + " k";
  if (count < 999.5e6) return significant(count / 1e6, 3) + " M";
  return significant(count / 1e9, 3) + " G";
}

std::string length_text(double millimetres) {
  if (!std::isfinite(millimetres)) return "∞";
  if (millimetres == 0) return "0 mm";
  if (millimetres < 0.0995) return significant(1e3 * millimetres, 2) + " µm";
  if (millimetres < 99.5) return significant(millimetres, 2) + " mm";
  if (millimetres < 9950) return significant(millimetres / 10, 3) + " cm";
  return significant(millimetres / 1000, 3) + " m";
}

std::string hex_text(const DVec3& linear) {
  const auto level = [](double x) {
    return static_cast<int>(std::lround(255 * encode_srgb(static_cast<Real>(std::clamp(x, 0.0, 1.0)))));
  };
  std::array<char, 16> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "#%02X%02X%02X", level(linear.x), level(linear.y),
                level(linear.z));
  return buffer.data();
}

std::string triple_text(const DVec3& v, int digits) {
  return significant(v.x, digits) + "  " + significant(v.y, digits) + "  " + significant(v.z, digits);
}

std::string spaced(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string edit_text(const std::string& path, double value) { return path + '=' + exact(value); }

std::string edit_text(const std::string& path, const DVec3& value) {
  return path + "=[" + exact(value.x) + ", " + exact(value.y) + ", " + exact(value.z) + ']';
}

std::string edit_text(const std::string& path, bool value) { return path + (value ? "=true" : "=false"); }

std::string edit_text(const std::string& path, std::string_view word) {
  return path + "=\"" + std::string(word) + '"';
}

}  // namespace meander
