// A 64-bit digest of bytes: to tell whether two things are the same, or whether a file is damaged. Not
// against forgery.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace meander {

/// Takes bytes in words of eight, the last one filled with zeros; the number of bytes counts as well. Each
/// step is a bijection of the state for a given word, and of the word for a given state: two inputs of one
/// length that differ in a single word never agree.
class Digest {
 public:
  void add(std::span<const std::byte> bytes) noexcept {
    const std::size_t size = bytes.size();
    for (; bytes.size() >= 8; bytes = bytes.subspan(8)) mix(word_of(bytes.first(8)));
    if (!bytes.empty()) mix(word_of(bytes));
    mix(size);
  }
  void add(std::string_view text) noexcept { add(std::as_bytes(std::span(text))); }

  /// A value without padding: a number, an enumerator, a vector of numbers.
  template <class Value>
  requires(std::is_trivially_copyable_v<Value> && !std::is_convertible_v<Value, std::string_view> &&
           !std::is_convertible_v<Value, std::span<const std::byte>>) void add(const Value& value) noexcept {
    add(std::as_bytes(std::span(&value, 1)));
  }

  [[nodiscard]] std::uint64_t value() const noexcept {
    const std::uint64_t spread = (state_ ^ state_ >> 32) * kSecond;
    return spread ^ spread >> 29;
  }

 private:
  static constexpr std::uint64_t kFirst = 0x9e3779b97f4a7c15;  // both odd
  static constexpr std::uint64_t kSecond = 0xd6e8feb86659fd93;

  static std::uint64_t word_of(std::span<const std::byte> bytes) noexcept {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data(), bytes.size());
    return word;
  }
  void mix(std::uint64_t word) noexcept { state_ = std::rotl(state_ ^ word * kFirst, 27) * kSecond + 1; }

  std::uint64_t state_ = kFirst;
};

/// Sixteen hexadecimal digits.
[[nodiscard]] inline std::string hex_text(std::uint64_t value) {
  std::string text(16, '0');
  for (std::size_t i = 16; i-- > 0; value >>= 4) text[i] = "0123456789abcdef"[value & 15];
  return text;
}

}  // namespace meander
