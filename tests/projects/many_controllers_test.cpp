// A hundred controllers on one network: one leading axis, 99 proxies, four cascades deep.
#include "many_controllers.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "projects/system/connections.hpp"
#include "tests/support/seeds.hpp"

namespace lockstep::many_controllers_test {
namespace {

using namespace std::chrono_literals;
using test::axis_of;
using test::kRing;
using test::line_of;

/// With the delays that are computed all followers are at the same place.
TEST(ManyControllers, FollowOneLeadingAxisInFourCascades) {
  const test::SystemFiles files = test::hundred_controllers();
  // From the end: 2 × 1 ms for each of four cascades.
  EXPECT_EQ(test::apply_calculated_delays(files), 8 * test::kMilli);
  SimulatedSystem machine(files.path());
  ASSERT_EQ(machine.system().controllers.size(), 100u);
  machine.run_for(100ms);
  for (int i = 0; i < 100; ++i) machine.write("C" + std::to_string(i) + ".couple", 1.0);
  machine.run_for(100ms);
  machine.write("C0.go", 1.0);
  machine.run_for(std::chrono::milliseconds(test::cases(300, 30'000)));
  const double near = line_of(axis_of(machine, 0, "Near").setpoint(), kRing);
  EXPECT_GT(near, 50.0);
  for (std::size_t i = 1; i < 100; ++i)
    EXPECT_NEAR(line_of(axis_of(machine, i, "Far").setpoint(), kRing), near, 1e-9) << i;
}

}  // namespace
}  // namespace lockstep::many_controllers_test
