#include "core/recent_values.h"

#include <doctest/doctest.h>

#include <string>

namespace meander {

TEST_CASE("the values used last stay") {
  RecentValues<int, std::string> values;
  values.add(1, "one");
  values.add(2, "two");
  CHECK(values.add(3, "three") == "three");
  REQUIRE(values.find(1));
  CHECK(*values.find(1) == "one");
  values.trim(2);
  CHECK_FALSE(values.find(2));
  REQUIRE(values.entries().size() == 2);
  CHECK(values.entries()[0].first == 3);
  CHECK(values.entries()[1].second == "one");
  values.trim(5);
  CHECK(values.entries().size() == 2);
  values.trim(0);
  CHECK_FALSE(values.find(1));
}

}  // namespace meander
