// Counters of DINT in a project, as a user has them.
#include <gtest/gtest.h>

#include <string>

#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::long_counters_test {
namespace {

/// Each counter is loaded in the first tick, as far as it can be, and then gets an edge in every other one.
Json counting() {
  Json project = empty_project();
  project["tags"] = {{"part", {{"type", "BOOL"}}}, {"ready", {{"type", "BOOL"}}}};
  const Json calls = Json::array({
      call("CTU_DINT", "parts", {{"CU", "part"}, {"PV", 3}}),
      call("CTD_DINT", "rest", {{"CD", "part"}, {"LD", "NOT ready"}, {"PV", -32'767}}),
      call("CTUD_DINT", "stock", {{"CU", "part"}, {"LD", "NOT ready"}, {"PV", 32'766}}),
      call("CTUD", "short", {{"CU", "part"}, {"LD", "NOT ready"}, {"PV", 32'766}}),
      assignment("part", "NOT part AND ready"),
      assignment("ready", true),
  });
  project["programs"].push_back({{"name", "Main"}, {"ob", "Main"}, {"cycle", "1ms"}, {"calls", calls}});
  return project;
}

TEST(LongCounters, GoOnWhereThoseOfIntStop) {
  const CsvTable table =
      simulate(counting(), "12ms", "parts.CV,parts.Q,rest.CV,rest.Q,stock.CV,stock.QU,short.CV");
  ASSERT_GE(table.rows, 12u);
  const std::size_t last = table.rows - 1;
  EXPECT_EQ(table["parts.CV"][last], 5.0);
  EXPECT_EQ(table["rest.CV"][last], -32'772.0);
  EXPECT_EQ(table["rest.Q"][last], 1.0);
  EXPECT_EQ(table["stock.CV"][last], 32'771.0);
  EXPECT_EQ(table["stock.QU"][last], 1.0);
  EXPECT_EQ(table["short.CV"][last], 32'767.0);
  EXPECT_EQ(table.first("parts.Q", 1.0), table.first("parts.CV", 3.0));
}

}  // namespace
}  // namespace lockstep::test::long_counters_test
