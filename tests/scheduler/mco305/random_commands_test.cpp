// Whatever a program asks for, in whatever order: the set position is continuous, and the axis comes to rest.
#include <cmath>
#include <random>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep {
namespace {

/// One command of any kind. @return whether the motor goes off, which ends every motion at once
bool any_command(mco305::Device& device, std::mt19937& random) {
  const auto below = [&random](int n) {
    return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
  };
  switch (below(26)) {
    case 0:
      device.position_to(below(40'000) - 20'000, false);
      break;
    case 1:
      device.position_to(below(4'000) - 2'000, true);
      break;
    case 2:
      device.set_speed(below(200) - 100);
      break;
    case 3:
      device.start_speed();
      break;
    case 4:
      device.stop_speed();
      break;
    case 5:
      device.motor_stop();
      break;
    case 6:
      device.go_on();
      break;
    case 7:
      device.set_velocity(1 + below(100));
      break;
    case 8:
      device.set_acceleration(1 + below(100));
      break;
    case 9:
      device.set_deceleration(1 + below(100));
      break;
    case 10:
      device.set_parameter(mco305::kRampType, below(3));
      break;
    case 11:
      device.set_parameter(mco305::kJerkMin + below(4), below(300));
      break;
    case 12:
      device.begin_home(below(2) == 0);
      break;
    case 13:
      if (below(4) != 0) break;
      device.motor_off();
      device.motor_on();
      return true;
    case 14:
    case 15:
      device.follow(mco305::SyncMode::kVelocity);
      break;
    case 16:
    case 17:
      device.follow(mco305::SyncMode::kPosition);
      break;
    case 18:
    case 19:
      device.follow(mco305::SyncMode::kMarkers);
      break;
    case 20:
      device.master().set_acceleration(below(40'000));
      device.turn_own_master(below(30'000) - 15'000);
      break;
    case 21:
      device.set_parameter(mco305::kSyncFactM, below(2) == 0 ? 1 + below(50) : -1 - below(50));
      device.set_parameter(mco305::kSyncFactS, below(50));
      break;
    case 22:
      device.set_parameter(mco305::kSyncPosOffs, below(20'000) - 10'000);
      device.set_parameter(mco305::kSyncOffTime, below(2) * below(3000));
      break;
    case 23: {
      constexpr std::int32_t kAny[] = {mco305::kSyncVelRel, mco305::kRevers, mco305::kSyncType,
                                       mco305::kSyncMStart, mco305::kSyncMWinM};
      device.set_parameter(kAny[below(5)], below(3));
      break;
    }
    case 24:
      device.set_parameter(mco305::kSyncVfTime, below(100'000) - 50'000);
      device.set_parameter(mco305::kSyncMfTime, below(2) * below(3000));
      break;
    case 25:
      device.move_sync_origin(below(2000) - 1000);
      break;
    default:
      break;
  }
  return false;
}

TEST(Mco305RandomCommands, NeverStepTheSetPosition) {
  constexpr unsigned kSeed = 305;
  constexpr double kSteepest = 0.2 * 1.5707963267948966;  // Amax, in an S-ramp
  std::mt19937 random(kSeed);
  for (int device = 0; device < 40; ++device) {
    DeviceRun run;
    run.set_all(mco305_scenario("S01").at("parameters"));
    run.object.settings.drive.signals.zero_marks = ZeroMarks{0.0, 1500.0};
    run.set("MENCODER", 400);
    run.set("SYNCMPULSM", 1600);
    run.set("SYNCMPULSS", 1500);
    run.begin();
    mco305::Device& axis = run.object.device();
    double position = axis.set_position(), velocity = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const bool off = random() % 40 == 0 && any_command(axis, random);
      if (off) position = axis.set_position(), velocity = 0.0;
      run.step();
      const double now = axis.set_velocity_now();
      ASSERT_TRUE(std::isfinite(axis.set_position()));
      // What is counted comes in whole counts, to either side of a velocity that keeps the limits.
      const double steepest = kSteepest + (axis.following() ? 2.4 : 0.0);
      ASSERT_LE(std::abs(now - velocity), steepest * (1.0 + 1e-6)) << "device " << device << " step " << i;
      ASSERT_LE(std::abs(now), 100.0 * (1.0 + 1e-9));
      ASSERT_NEAR(axis.set_position() - position, (now + velocity) / 2.0, steepest) << device << ' ' << i;
      position = axis.set_position();
      velocity = now;
      if (axis.pending().any()) {
        axis.clear_all_errors();
        position = axis.set_position();
        velocity = axis.set_velocity_now();
      }
    }
    axis.motor_stop();
    run.run(60'000);
    EXPECT_TRUE(axis.arrived()) << device;
    EXPECT_EQ(axis.axis_end() & 1, 1) << device;
    EXPECT_TRUE(run.object.at_rest());
  }
}

// Of the same commands the same bits, whatever the servo cycle.
TEST(Mco305RandomCommands, GiveTheSameWhateverTheServoCycle) {
  std::vector<double> first;
  for (const int ticks : {1, 2, 4}) {
    std::mt19937 random(7);
    Mco305 object("Device", DB_ANY{1});
    object.configure(1e-3 / ticks, 1);
    std::vector<double> seen;
    for (int i = 0; i < 5'000; ++i) {
      if (random() % 50 == 0) any_command(object.device(), random);
      for (int tick = 0; tick < ticks; ++tick)
        object.servo(std::int64_t{i * ticks + tick} * (1'000'000 / ticks));
      object.run_program(0);
      seen.push_back(object.device().set_position());
    }
    if (first.empty()) first = seen;
    EXPECT_EQ(seen, first) << ticks;
  }
}

}  // namespace
}  // namespace lockstep
