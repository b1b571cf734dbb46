#include <doctest/doctest.h>

#include <atomic>
#include <vector>

#include "render/parallel.h"

using namespace meander;

TEST_CASE("every index is visited once") {
  for (const int threads : {1, 2, 5}) {
    std::vector<int> visits(10007, 0);
    parallel_for(threads, visits.size(), [&](std::size_t i) { ++visits[i]; });
    for (const int count : visits) CHECK(count == 1);
  }
  parallel_for(2, 0, [](std::size_t) { FAIL("called for an empty range"); });
  CHECK(hardware_threads() >= 1);
}
