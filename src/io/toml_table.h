// One table of a scene file, read key by key: each value is checked where it is read, and a key that nobody
// asked for is an error which suggests the nearest one that exists. Every error names the file, line and
// column.
#pragma once

#include <toml++/toml.h>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "math/types.h"

namespace meander {

/// The values a number may take, and how an error message says so.
struct Range {
  double low;
  double high;
  bool open_low;
  bool open_high;
  std::string_view text;

  [[nodiscard]] bool contains(double value) const noexcept {
    return (open_low ? value > low : value >= low) && (open_high ? value < high : value <= high);
  }
};

inline constexpr double kLargest = 1e30;
inline constexpr Range kAnyNumber{-kLargest, kLargest, false, false, "a finite number"};
inline constexpr Range kPositive{0, kLargest, true, false, "greater than 0"};
inline constexpr Range kNotNegative{0, kLargest, false, false, "0 or more"};
inline constexpr Range kUnitInterval{0, 1, false, false, "in [0, 1]"};

/// The value of a node that is a number: a whole number counts as the nearest double.
[[nodiscard]] double number_of(const toml::node& node);

/// Sets a key to a list of three numbers. A colour is written in the fewest digits that it is known by.
void set_triple(toml::table& table, std::string_view key, const DVec3& value);
void set_color(toml::table& table, std::string_view key, const Rgb& value);

/// Where a node stands; a value given on the command line has its option as the file and no line.
[[nodiscard]] Place place_of(const toml::node& node, const std::string& file);

class TomlTable {
 public:
  /// `where` names the table in messages, such as `[camera]`. Both must outlive this.
  TomlTable(const toml::table& table, const std::string& file, std::string where)
      : table_(table), file_(file), where_(std::move(where)) {}

  [[nodiscard]] bool has(std::string_view key) const { return table_.contains(key); }
  [[nodiscard]] std::optional<double> number(std::string_view key, const Range& range);
  [[nodiscard]] std::optional<std::int64_t> integer(std::string_view key, const Range& range);
  [[nodiscard]] std::optional<bool> boolean(std::string_view key);
  [[nodiscard]] std::optional<std::string> text(std::string_view key);
  /// The index of the text among the allowed ones.
  [[nodiscard]] std::optional<std::size_t> choice(std::string_view key,
                                                  std::span<const std::string_view> allowed);
  /// Three numbers; with `or_single`, one number stands for three equal ones.
  [[nodiscard]] std::optional<DVec3> triple(std::string_view key, const Range& range, bool or_single);
  /// An inner table, `[key]` in messages.
  [[nodiscard]] std::optional<TomlTable> table(std::string_view key);
  /// A list of tables, `[[key]]`; null when there is none.
  [[nodiscard]] const toml::array* tables(std::string_view key);

  /// The value, or an error that says that the table must have it, or that names the key that was meant for
  /// it.
  template <class T>
  [[nodiscard]] T required(std::optional<T> value, std::string_view key) const {
    if (!value) missing(key);
    return *value;
  }

  /// Call last: an error for the first key that was not asked for.
  void finish() const;

  [[nodiscard]] Place place() const { return place_of(table_, file_); }
  [[nodiscard]] Place place(std::string_view key) const;
  [[nodiscard]] const std::string& where() const noexcept { return where_; }

 private:
  [[nodiscard]] const toml::node* find(std::string_view key);
  [[noreturn]] void missing(std::string_view key) const;
  [[noreturn]] void unknown(const toml::key& key, const toml::node& node,
                            std::span<const std::string_view> known) const;
  [[nodiscard]] double checked(const toml::node& node, std::string_view key, const Range& range) const;
  [[noreturn]] void wrong_type(const toml::node& node, std::string_view key, std::string_view wanted) const;

  const toml::table& table_;
  const std::string& file_;
  std::string where_;
  std::vector<std::string_view> asked_;
};

}  // namespace meander
