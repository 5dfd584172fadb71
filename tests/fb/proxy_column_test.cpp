// The column of leading axis proxies in the table of instructions: who works on one, and who refuses it.
// @source S7-1500T synchronous operation V7, 4.4
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "fb/block.hpp"

namespace lockstep::proxy_column_test {
namespace {

constexpr ObjectKinds kProxy = static_cast<ObjectKinds>(ObjectKind::TO_LeadingAxisProxy);

struct Cell {
  std::string_view block;
  std::string_view pin;  // by which it works on a proxy; empty: it does not
};

constexpr Cell kColumn[] = {
    {"MC_Reset", "Axis"},
    {"MC_GearIn", "Master"},
    {"MC_GearInPos", "Master"},
    {"MC_GearInVelocity", "Master"},
    {"MC_PhasingRelative", "Master"},
    {"MC_PhasingAbsolute", "Master"},
    {"MC_OffsetRelative", ""},
    {"MC_OffsetAbsolute", ""},
    {"MC_CamIn", "Master"},
    {"MC_SynchronizedMotionSimulation", ""},
    {"MC_LeadingValueAdditive", ""},
    {"MC_GearOut", ""},
    {"MC_CamOut", ""},
    {"MC_InterpolateCam", ""},
    {"MC_GetCamLeadingValue", ""},
    {"MC_GetCamFollowingValue", ""},
    {"MC_CopyCamData", ""},
};

/// The pins of a block that take a proxy.
std::set<std::string> pins_of_proxies(const BlockType& type) {
  std::set<std::string> names;
  for (const Pin& pin : type.pins)
    if ((pin.objects & kProxy) != 0) names.insert(std::string(pin.name));
  return names;
}

TEST(ProxyColumn, IsThatOfThePublishedTable) {
  for (const Cell& cell : kColumn) {
    const auto types = block_types();
    const auto type = std::find_if(types.begin(), types.end(),
                                   [&](const BlockType& one) { return one.name == cell.block; });
    ASSERT_NE(type, types.end()) << cell.block;
    EXPECT_EQ(pins_of_proxies(*type),
              cell.pin.empty() ? std::set<std::string>{} : std::set<std::string>{std::string(cell.pin)})
        << cell.block;
  }
}

TEST(ProxyColumn, HasNoFurtherBlocks) {
  for (const BlockType& type : block_types()) {
    const auto in_column = std::any_of(std::begin(kColumn), std::end(kColumn),
                                       [&](const Cell& cell) { return cell.block == type.name; });
    if (!in_column) {
      EXPECT_TRUE(pins_of_proxies(type).empty()) << type.name;
    }
  }
}

}  // namespace
}  // namespace lockstep::proxy_column_test
