#include "core/digest.h"

#include <doctest/doctest.h>

#include <set>
#include <vector>

using namespace meander;

namespace {

std::uint64_t digest_of(const std::vector<unsigned char>& bytes) {
  Digest digest;
  digest.add(std::as_bytes(std::span(bytes)));
  return digest.value();
}

}  // namespace

TEST_CASE("a digest tells every changed byte, every length and every order") {
  std::vector<unsigned char> bytes(37);
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<unsigned char>(3 * i);
  std::set<std::uint64_t> seen{digest_of(bytes)};
  std::size_t inputs = 1;
  for (unsigned char& byte : bytes) {
    const unsigned char kept = byte;
    for (int other = 1; other < 256; ++other, ++inputs) {
      byte = static_cast<unsigned char>(kept ^ other);
      seen.insert(digest_of(bytes));
    }
    byte = kept;
  }
  for (std::size_t length = 0; length < 64; ++length, ++inputs)
    seen.insert(digest_of(std::vector<unsigned char>(length)));
  CHECK(seen.size() == inputs);

  Digest ab;
  ab.add(std::string_view("a"));
  ab.add(std::string_view("b"));
  Digest ba;
  ba.add(std::string_view("b"));
  ba.add(std::string_view("a"));
  CHECK(ab.value() != ba.value());
  Digest again;
  again.add(std::string_view("a"));
  again.add(std::string_view("b"));
  CHECK(again.value() == ab.value());
}

TEST_CASE("a digest is written with all its digits") {
  CHECK(hex_text(0) == "0000000000000000");
  CHECK(hex_text(0x0123456789abcdef) == "0123456789abcdef");
}
