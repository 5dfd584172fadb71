// Columns of a ring that several sinks share.
#include <gtest/gtest.h>

#include "hmi_bridge/traces/columns.hpp"

namespace lockstep::trace_columns_test {
namespace {

TEST(TraceColumns, HoldASignalOnceHoweverManyAskForIt) {
  LREAL position = 2.5;
  DWORD status{};
  const NamedSignal first{"Knife.Position", {&position, Type::LREAL}, Unit::kPosition};
  const NamedSignal second{"Knife.StatusWord", {&status, Type::DWORD}, Unit::kNone};
  TraceColumns columns;
  EXPECT_EQ(columns.of(std::vector{first}), std::vector<std::size_t>{0});
  EXPECT_EQ(columns.of(std::vector{second, first}), (std::vector<std::size_t>{1, 0}));
  EXPECT_EQ(columns.of(second), 1u);
  ASSERT_EQ(columns.places().size(), 2u);
  EXPECT_EQ(columns.places()[0].load().r, 2.5);
  EXPECT_EQ(columns.described(), (std::vector<TraceSignal>{{"Knife.Position", Type::LREAL, "u"},
                                                           {"Knife.StatusWord", Type::DWORD, ""}}));
}

}  // namespace
}  // namespace lockstep::trace_columns_test
