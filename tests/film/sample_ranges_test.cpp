#include "film/sample_ranges.h"

#include <doctest/doctest.h>

using namespace meander;

TEST_CASE("ranges that meet or overlap are joined, of one seed alone") {
  CHECK(joined({{0, 64, 127}, {0, 0, 63}}) == SampleRanges{{0, 0, 127}});
  CHECK(joined({{0, 0, 63}, {0, 65, 70}}) == SampleRanges{{0, 0, 63}, {0, 65, 70}});
  CHECK(joined({{0, 0, 63}, {1, 64, 70}}) == SampleRanges{{0, 0, 63}, {1, 64, 70}});
  CHECK(joined({{0, 0, 9}, {0, 5, 6}, {0, 2, 20}}) == SampleRanges{{0, 0, 20}});
  constexpr std::uint64_t kLast = ~std::uint64_t{0};
  CHECK(joined({{5, 3, kLast}, {5, 0, 2}}) == SampleRanges{{5, 0, kLast}});
  CHECK(joined({}).empty());
}

TEST_CASE("the lowest shared samples are found, ends included") {
  CHECK(shared_samples({{0, 0, 15}}, {{0, 15, 20}}) == SampleRange{0, 15, 15});
  CHECK_FALSE(shared_samples({{0, 0, 15}}, {{0, 16, 20}}).has_value());
  CHECK_FALSE(shared_samples({{0, 0, 15}}, {{1, 0, 15}}).has_value());
  CHECK(shared_samples({{2, 0, 9}, {1, 0, 99}}, {{2, 5, 6}, {1, 50, 200}}) == SampleRange{1, 50, 99});
  CHECK_FALSE(shared_samples({}, {{0, 0, 1}}).has_value());
}

TEST_CASE("ranges travel as text, and what is no such text is nothing") {
  const SampleRanges ranges{{0, 0, 63}, {18446744073709551615u, 128, 255}};
  CHECK(ranges_text(ranges) == "0:0-63,18446744073709551615:128-255");
  CHECK(read_ranges(ranges_text(ranges)) == ranges);
  for (const char* bad : {"", "0", "0:", "0:1", "0:1-", "0:2-1", "0:0-1,", ",0:0-1", "0:0-1 ", "-1:0-1",
                          "0:0-1;0:2-3", "0:0-18446744073709551616", "a:0-1"}) {
    CAPTURE(bad);
    CHECK_FALSE(read_ranges(bad).has_value());
  }
}
