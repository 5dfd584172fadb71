// What axes that follow the setpoint of a driven axis do when that axis is switched off in motion, by
// MC_Power or by an alarm, so that its setpoint goes over to the actual value, and when it is switched on
// again: they follow without a step, and end in their place.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/parameter.hpp"
#include "fb/power.hpp"
#include "tests/support/bent_cam.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::hand_over_test {
namespace {

using test::Rig;

constexpr double kSpeed = 100.0;          // of the leading axis [u/s]
constexpr double kDeceleration = 4000.0;  // of its emergency ramp and of the quick stop of its drive [u/s²]
constexpr double kMaximum = 3000.0;       // its maximum acceleration [u/s²]
constexpr double kTimeConstant =
    0.025;                      // of its drive [s]: without setpoint it brakes with v / kTimeConstant
constexpr double kRing = 37.0;  // [u]

/// How the leading axis is switched off.
enum class Off : std::uint8_t {
  stop_mode_0,
  stop_mode_1,
  stop_mode_2,
  stop_mode_3,
  drive_fault,
  following_error,
  limit_switch
};
/// How the other axis follows it.
enum class By : std::uint8_t { gear, gear_in_pos, cam, velocity };

double unrolled(const Axis& axis) {
  return difference(axis.setpoint().position, {}, axis.modulo()).rounded();
}

/// A driven axis that lags far behind its setpoint, one that follows it, and one that follows that.
struct Led : Rig {
  explicit Led(By how, bool ring = false, int ratio = 1, const std::function<void(Axis&)>& change = {},
               Coupling coupling = Coupling::setpoint)
      : Rig(1'000'000, ratio),
        by(how),
        l(axis("Leading", [ring](AxisData& data) { shape(data, ring); })),
        f(axis("Following", [ring](AxisData& data) { data.Modulo.Enable = ring; })),
        g(axis("Third", [ring](AxisData& data) { data.Modulo.Enable = ring; })),
        first(axis("First")),
        cam(test::add_bent_cam(controller, kRing)),
        power(block<MC_Power>()),
        power_f(block<MC_Power>()),
        power_g(block<MC_Power>()),
        home(block<MC_Home>()),
        reset(block<MC_Reset>()),
        run_l(block<MC_MoveVelocity>()),
        move_f(block<MC_MoveRelative>()),
        gear(block<MC_GearIn>()),
        gear_g(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()),
        cam_in(block<MC_CamIn>()),
        velocity(block<MC_GearInVelocity>()),
        power_first(block<MC_Power>()),
        run_first(block<MC_MoveVelocity>()),
        gear_l(block<MC_GearIn>()),
        simulation(block<MC_SynchronizedMotionSimulation>()),
        sensor(block<MC_SetSensor>()) {
    l.drive_settings.time_constant = kTimeConstant;
    l.drive_settings.quick_stop = kDeceleration;
    l.drive_settings.faults.drive = &fault;
    if (change) change(l);
    f.leading_values.push_back({&l, coupling});
    lead(g, f);
    lead(l, first);
    power.Axis = home.Axis = run_l.Axis = sensor.Axis = &l;
    reset.Axis = &l;
    power_f.Axis = move_f.Axis = &f;
    power_g.Axis = &g;
    power_first.Axis = run_first.Axis = &first;
    gear_l.Master = &first;
    gear_l.Slave = &l;
    gear.Master = pos.Master = cam_in.Master = velocity.Master = &l;
    gear.Slave = pos.Slave = cam_in.Slave = velocity.Slave = simulation.Slave = &f;
    gear_g.Master = &f;
    gear_g.Slave = &g;
    gear.RatioNumerator = pos.RatioNumerator = velocity.RatioNumerator = 2;
    gear_g.RatioNumerator = -1;
    cam_in.Cam = &cam;
    continuity[0].velocity = false;
    continuity[1].acceleration = continuity[2].acceleration = false;
    power.Enable = power_f.Enable = power_g.Enable = power_first.Enable = true;
    home_in_place(f);
    run(20);
    home.Execute = true;
    run(20);
    couple();
  }

  static void shape(AxisData& data, bool ring) {
    data.VirtualAxis.Mode = 0;
    data.Modulo.Enable = ring;
    data.Modulo.Length = kRing;
    data.DynamicDefaults.EmergencyDeceleration = kDeceleration;
    data.DynamicLimits.MaxAcceleration = data.DynamicLimits.MaxDeceleration = kMaximum;
    data.DynamicLimits.MaxJerk = 1e6;
    data.PositionControl.Kv = 10.0;
    data.FollowingError.EnableMonitoring = false;
  }

  /// Under way at constant velocity with an axis that follows, and one that follows that.
  void couple() {
    gear_g.Execute = true;
    gear.Execute = by == By::gear;
    velocity.PositionControlled = true;
    velocity.Execute = by == By::velocity;
    pos.SyncProfileReference = 3;
    pos.MasterSyncPosition = 5.0;
    pos.MasterStartDistance = 20.0;
    pos.Execute = by == By::gear_in_pos;
    cam_in.SyncProfileReference = 3;
    cam_in.ApplicationMode = 2;
    cam_in.MasterSyncPosition = 5.0;
    cam_in.MasterStartDistance = 20.0;
    cam_in.Execute = by == By::cam;
    run(20);
    run_l.Velocity = kSpeed;
    run_l.Acceleration = 1000.0;
    run_l.Jerk = 0.0;
    run_l.Execute = true;
    run(1000);
    ASSERT_TRUE(synchronous());
    ASSERT_TRUE(gear_g.InGear);
    ASSERT_GT(away(), 1.0) << "the setpoint is to be far ahead of the axis";
    // What may be seen: what the drive does, and on top of it the maximum dynamics of the leading axis.
    continuity[1].highest_acceleration = continuity[2].highest_acceleration =
        2.5 * (2.0 * kSpeed / kTimeConstant + kMaximum);
  }
  void run_leading(double speed, int ticks = 1000) {
    run_l.Velocity = speed;
    run_l.Execute = false;
    run(controller.clock.interpolator_ratio);
    run_l.Execute = true;
    run(ticks);
  }
  /// The leading axis is one that follows from here on, at the same velocity.
  void follow_the_first() {
    run_first.Velocity = kSpeed;
    run_first.Execute = true;
    run(1000);
    gear_l.Execute = true;
    run(500);
    ASSERT_TRUE(gear_l.InGear);
  }
  bool synchronous() const { return has_bit(f.data.StatusWord, StatusBit::Synchronous); }

  /// By how much the setpoint of the leading axis is ahead of where that is.
  double away() const { return rounded_difference(l.setpoint().position, l.actual_position(), l.modulo()); }
  /// How far the following axis is from its place by the setpoint of the leading one.
  double off_place() const {
    if (by == By::velocity) return 0.0;
    const double leading = unrolled(l);
    if (by == By::cam) return unrolled(f) - test::on_bent_cam(cam, kRing, leading) - apart;
    return unrolled(f) - 2.0 * leading - apart;
  }

  void remember_place() {
    apart = 0.0;
    apart = off_place();
  }
  void switch_off(Off how) {
    if (!f.simulating()) remember_place();
    if (how <= Off::stop_mode_3) {
      power.StopMode = static_cast<INT>(how);
      power.Enable = false;
    }
    fault = how == Off::drive_fault;
    if (how == Off::following_error) {
      l.data.FollowingError.MinValue = l.data.FollowingError.MaxValue = 0.1;
      l.data.FollowingError.EnableMonitoring = true;
      run_l.Execute = false;  // it gets there while the axis accelerates
      run(controller.clock.interpolator_ratio);
      run_l.Velocity = 1.2 * kSpeed;
      run_l.Execute = true;
    }
  }
  void switch_on() {
    fault = false;
    l.data.FollowingError.EnableMonitoring = false;
    reset.Execute = true;
    power.Enable = true;
  }
  /// Follows on, at rest in its place.
  void expect_in_place() {
    EXPECT_TRUE(synchronous());
    EXPECT_TRUE(gear_g.InGear);
    EXPECT_NEAR(f.setpoint().velocity, 0.0, 1e-9);
    EXPECT_NEAR(off_place(), 0.0, 1e-9);
  }

  BOOL fault = false;
  By by;
  double apart = 0.0;
  Axis& l;
  Axis& f;
  Axis& g;
  Axis& first;  // may lead the leading axis
  Cam& cam;
  MC_Power& power;
  MC_Power& power_f;
  MC_Power& power_g;
  MC_Home& home;
  MC_Reset& reset;
  MC_MoveVelocity& run_l;
  MC_MoveRelative& move_f;
  MC_GearIn& gear;
  MC_GearIn& gear_g;
  MC_GearInPos& pos;
  MC_CamIn& cam_in;
  MC_GearInVelocity& velocity;
  MC_Power& power_first;
  MC_MoveVelocity& run_first;
  MC_GearIn& gear_l;
  MC_SynchronizedMotionSimulation& simulation;
  MC_SetSensor& sensor;
};

void press_at_120(Axis& axis) {
  axis.drive_settings.signals.limit_max = 120.0;
  axis.data.PositionLimits_HW.Active = true;
  axis.data.PositionLimits_HW.ApproachBehavior = 0;  // removes the enable
}

// ---- Switched off
// ------------------------------------------------------------------------------------------------

class SwitchedOff : public ::testing::TestWithParam<std::tuple<Off, By, bool, int>> {};
INSTANTIATE_TEST_SUITE_P(Ways, SwitchedOff,
                         ::testing::Combine(::testing::Values(Off::stop_mode_0, Off::stop_mode_1,
                                                              Off::stop_mode_2, Off::stop_mode_3,
                                                              Off::drive_fault, Off::following_error),
                                            ::testing::Values(By::gear, By::gear_in_pos, By::cam),
                                            ::testing::Bool(), ::testing::Values(1, 4)));

TEST_P(SwitchedOff, OfALeadingAxisSwitchedOffInMotionAndOnAgainIsNoStepForAxesThatFollow) {
  const auto [how, by, ring, ratio] = GetParam();
  Led rig(by, ring, ratio);
  rig.switch_off(how);
  rig.run(2000);  // the rig looks for steps
  EXPECT_TRUE(rig.l.off());
  EXPECT_EQ(rig.l.data.Position, rig.l.data.ActualPosition);
  rig.expect_in_place();
  rig.switch_on();
  ASSERT_TRUE(rig.run_until([&] { return rig.power.Status; }, 200));
  rig.run(200);
  rig.expect_in_place();
}

TEST(HandOver, OfALeadingAxisSwitchedOffWhileItSpeedsUpIsNoStepOfPositionOrVelocity) {
  for (const By by : {By::gear, By::velocity})
    for (const Off how : {Off::stop_mode_0, Off::stop_mode_1, Off::stop_mode_2, Off::stop_mode_3}) {
      Led rig(by);
      rig.run_leading(0.0);
      rig.run_l.Acceleration = kMaximum;
      rig.run_leading(kSpeed, 30);
      ASSERT_GT(rig.l.setpoint().velocity - rig.l.data.ActualVelocity, 40.0);
      rig.switch_off(how);
      rig.run(1000);
      EXPECT_TRUE(rig.l.off());
      rig.expect_in_place();
    }
}

TEST(HandOver, ThatTakesTheLeadingValueBackIsAReversalForAnAxisThatIsSynchronizing) {
  Led rig(By::gear);
  auto& limits = rig.f.data.DynamicLimits;
  limits.MaxAcceleration = limits.MaxDeceleration = 20000.0;
  rig.pos.MasterSyncPosition = rig.l.data.Position + 5.0;
  rig.pos.MasterStartDistance = 500.0;
  rig.pos.SlaveSyncPosition = rig.f.data.Position;
  rig.pos.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.StartSync; }, 1000));
  rig.run(100);
  rig.switch_off(Off::stop_mode_3);
  rig.run(1000);
  EXPECT_EQ(rig.f.pending_alarm(), alarm::kSynchronizing);
  EXPECT_EQ(rig.f.setpoint().velocity, 0.0);
}

TEST(HandOver, OfALeadingAxisThatAHardwareLimitSwitchDisablesIsNoStep) {
  Led rig(By::gear, false, 1, &press_at_120);
  rig.switch_off(Off::limit_switch);
  ASSERT_TRUE(rig.run_until([&] { return rig.l.pending_alarm() != 0; }, 2000));
  EXPECT_EQ(rig.l.data.ErrorDetail.Reaction, 4);
  rig.run(500);
  EXPECT_TRUE(rig.l.off());
  rig.expect_in_place();
}

TEST(HandOver, OfAVelocityThatFallsBelowAWideStandstillThresholdIsNoStepEither) {
  for (const Off how : {Off::stop_mode_1, Off::stop_mode_3}) {
    Led rig(By::gear, false, 1, [](Axis& axis) { axis.data.StandstillSignal.VelocityThreshold = 60.0; });
    rig.switch_off(how);
    rig.run(500);
    rig.expect_in_place();
  }
}

TEST(HandOver, OfAFollowingAxisSwitchedOffInMotionIsNoStepForAxesThatFollowIt) {
  for (const Off how : {Off::stop_mode_0, Off::stop_mode_1, Off::stop_mode_2, Off::drive_fault}) {
    Led rig(By::gear);
    rig.follow_the_first();
    rig.switch_off(how);
    rig.run(500);
    EXPECT_TRUE(rig.gear_l.CommandAborted || rig.gear_l.Error);
    EXPECT_EQ(rig.first.setpoint().velocity, kSpeed);
    rig.expect_in_place();
  }
}

TEST(HandOver, IsNoStepOfASimulatedCouplingEither) {
  Led rig(By::gear);
  rig.run_leading(0.0);
  rig.remember_place();
  rig.simulation.Enable = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.simulation.InSimulation; }, 2000));
  rig.run_leading(kSpeed);
  const auto& value = rig.f.data.StatusSynchronizedMotion.FunctionFollowingValue;
  const double maximum = rig.continuity[1].highest_acceleration;
  double position = value.Position, velocity = value.Velocity;
  rig.switch_off(Off::stop_mode_2);
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    ASSERT_NEAR(value.Velocity, velocity, maximum * 1e-3) << i;
    ASSERT_NEAR(value.Position - position, 0.5 * (value.Velocity + velocity) * 1e-3, maximum * 1e-6) << i;
    position = value.Position;
    velocity = value.Velocity;
  }
  EXPECT_TRUE(rig.simulation.InSimulation);
  rig.simulation.Enable = false;
  rig.run(2);
  EXPECT_EQ(rig.simulation.ErrorID, static_cast<WORD>(ErrorId::position))
      << "the axis is not where its coupling is";
  rig.move_f.Distance = position - rig.f.data.Position;
  rig.move_f.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return !rig.simulation.InSimulation; }, 20000));
  rig.run(10);
  rig.expect_in_place();
}

/// A following axis that is switched off follows nothing any more, however it comes to rest.
TEST(HandOver, OfAFollowingAxisSwitchedOffLeavesNothingOfItsCouplingBehind) {
  for (const Off how :
       {Off::stop_mode_0, Off::stop_mode_1, Off::stop_mode_2, Off::stop_mode_3, Off::drive_fault}) {
    Led rig(By::gear);
    rig.follow_the_first();
    const auto& status = rig.l.data.StatusSynchronizedMotion;
    ASSERT_EQ(status.FunctionState, 1);
    rig.switch_off(how);
    rig.run(2);
    EXPECT_EQ(status.FunctionState, 0) << static_cast<int>(how);
    EXPECT_EQ(status.ActualMaster, DB_ANY{});
    EXPECT_EQ(status.StatusWord, DWORD{});
  }
}

// ---- Switched on again
// -------------------------------------------------------------------------------------------

class SwitchedOnAgain : public ::testing::TestWithParam<std::tuple<bool, bool, int>> {};
INSTANTIATE_TEST_SUITE_P(Ways, SwitchedOnAgain,
                         ::testing::Combine(::testing::Bool(), ::testing::Bool(), ::testing::Values(1, 4)));

TEST_P(SwitchedOnAgain, ToTheSetpointOfAnAxisSwitchedOnWhileItCoastsIsNoStepForAxesThatFollow) {
  const auto [at_once, ring, ratio] = GetParam();
  Led rig(By::gear, ring, ratio, [at_once = at_once](Axis& axis) {
    axis.data.PositionControl.VelocityModePowerOn = at_once ? 1 : 0;
  });
  rig.switch_off(Off::stop_mode_3);
  ASSERT_TRUE(rig.run_until([&] { return rig.l.data.ActualVelocity < 0.7 * kSpeed; }, 200));
  rig.power.Enable = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.power.Status; }, 50));
  EXPECT_GT(rig.l.data.ActualVelocity, 0.2 * kSpeed) << "switched on in motion";
  rig.run(2000);
  rig.expect_in_place();
}

// ---- Velocity alone
// --------------------------------------------------------------------------------------------------

TEST(MC_GearInVelocity, FollowsALeadingAxisWhateverTheModeOfThat) {
  Led rig(By::velocity);
  for (const bool controlled : {false, true, false}) {
    rig.run_l.PositionControlled = controlled;
    rig.run_leading(kSpeed);
    ASSERT_EQ(rig.l.position_controlled(), controlled);
    EXPECT_TRUE(rig.velocity.InSync);
    EXPECT_NEAR(rig.f.setpoint().velocity, 2.0 * kSpeed, 1e-9);
  }
  EXPECT_NEAR(rig.f.data.StatusSynchronizedMotion.EffectiveLeadingValue.Velocity, kSpeed, 1e-9);
  rig.velocity.Execute = false;
  rig.run(1);
  rig.velocity.RatioNumerator = 1;
  rig.velocity.Execute = true;  // synchronizes with an axis without position control
  rig.run(500);
  EXPECT_TRUE(rig.velocity.InSync);
  EXPECT_NEAR(rig.f.setpoint().velocity, kSpeed, 1e-9);
}

TEST(MC_GearInVelocity, MakesNoStepWhenALeadingAxisWithoutPositionControlIsSwitchedOffAndOn) {
  for (const Off how : {Off::stop_mode_0, Off::stop_mode_1, Off::stop_mode_2, Off::stop_mode_3})
    for (const bool controlled : {true, false}) {
      Led rig(By::velocity);
      rig.run_l.PositionControlled = false;
      rig.run_leading(0.0);
      rig.run_l.Acceleration = kMaximum;
      rig.run_leading(kSpeed, 30);
      ASSERT_GT(rig.l.setpoint().velocity - rig.l.data.ActualVelocity, 40.0);
      rig.switch_off(how);
      ASSERT_TRUE(rig.run_until([&] { return rig.l.off(); }, 500));
      rig.power.StartMode = controlled ? 1 : 0;
      rig.switch_on();  // at once: with StopMode 3 in motion
      rig.run(1000);
      EXPECT_TRUE(rig.power.Status);
      rig.expect_in_place();
    }
}

// ---- Beside it
// --------------------------------------------------------------------------------------------------

TEST(HandOver, ToAnotherEncoderOfAnAxisThatIsOffIsNoStep) {
  Led rig(By::gear, false, 1, [](Axis& axis) {
    axis.data.Sensor[1].Existent = true;
    axis.drive_settings.sensors[0] = {.exists = true, .ratio = 1.01};
  });
  rig.switch_off(Off::stop_mode_1);
  rig.run(1000);
  const double before = rig.l.data.Position;
  rig.sensor.Sensor = 2;
  rig.sensor.Mode = 1;  // without alignment
  rig.sensor.Execute = true;
  rig.run(1000);
  ASSERT_TRUE(rig.sensor.Done);
  EXPECT_GT(rig.l.data.Position - before, 0.5) << "an hundredth of its way";
  rig.expect_in_place();
}

TEST(HandOver, DoesNotConcernAxesThatFollowTheActualValue) {
  for (const Off how : {Off::stop_mode_0, Off::stop_mode_1, Off::stop_mode_2, Off::drive_fault}) {
    Led rig(
        By::gear, true, 1,
        [](Axis& axis) {
          axis.data.Extrapolation.PositionFilter = {0.004, 0.003};
          axis.data.Extrapolation.VelocityFilter = {0.02, 0.01};
          axis.data.Extrapolation.Settings.ExtrapolatedVelocityMode = 1;
        },
        Coupling::actual);
    const auto place = [&] {
      return 2.0 * rig.l.data.StatusExtrapolation.ExtrapolatedPosition - rig.f.setpoint().position.value;
    };
    const double apart = place();
    rig.switch_off(how);
    for (int i = 0; i < 1500; ++i) {
      rig.tick();
      ASSERT_NEAR(std::remainder(place() - apart, kRing), 0.0, 1e-9);
    }
    EXPECT_TRUE(rig.l.off());
    rig.switch_on();
    ASSERT_TRUE(rig.run_until([&] { return rig.power.Status; }, 200));
    rig.run(200);
    EXPECT_NEAR(std::remainder(place() - apart, kRing), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace lockstep::hand_over_test
