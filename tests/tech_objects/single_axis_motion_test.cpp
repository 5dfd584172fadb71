// Motion of one axis along a profile, tick by tick.
#include "tech_objects/profile/single_axis_motion.hpp"

#include <gtest/gtest.h>

namespace lockstep::single_axis_motion_test {
namespace {

/// Round numbers make profiles that last whole ticks but for rounding.
TEST(SingleAxisMotion, HasNoAccelerationLeftWhereItRests) {
  constexpr double kPeriod = 0.001;  // [s]
  int motions = 0;
  for (const double distance : {1.0, 10.0, 30.0, 100.0, 250.0}) {
    for (const double velocity : {10.0, 25.0, 50.0, 80.0, 100.0}) {
      for (const double acceleration : {100.0, 200.0, 500.0, 1000.0, 3000.0}) {
        for (const double jerk : {0.0, 1000.0, 5000.0, 20000.0, 100000.0}) {
          SingleAxisMotion motion;
          motion.configure({}, kPeriod);
          Setpoint setpoint;
          motion.stand(setpoint);
          ASSERT_EQ(
              motion.move_to(setpoint, {0, distance}, distance, {velocity, acceleration, acceleration, jerk}),
              PlanResult::ok);
          ++motions;
          while (!motion.finished()) {
            motion.advance(setpoint);
            ASSERT_TRUE(motion.finished() || setpoint.velocity > 1e-15)
                << setpoint.velocity << ", " << setpoint.acceleration << " for " << distance << ", "
                << velocity << ", " << acceleration << ", " << jerk;
          }
          EXPECT_EQ(setpoint.position.value, distance);
          EXPECT_TRUE(setpoint.standing());
        }
      }
    }
  }
  EXPECT_EQ(motions, 625);
}

}  // namespace
}  // namespace lockstep::single_axis_motion_test
