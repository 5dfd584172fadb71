// What axes do that follow the setpoint of an axis which leaves position control and takes it up again: zero
// leads them meanwhile, which is a published step, and from there they come back without one.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/superimposed.hpp"
#include "tests/support/bent_cam.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::position_control_hand_over_test {
namespace {

using test::Rig;

constexpr double kSpeed = 100.0;  // of the leading axis [u/s]
constexpr double kRing = 37.0;    // of all axes that have one [u]
constexpr double kStart = -10.0;  // where the ring begins, as a rule [u]

enum class By : std::uint8_t { gear, gear_in_pos, cam, velocity };
/// What gives position control back to the leading axis.
enum class Taken : std::uint8_t { by_motion, by_positioning, by_superimposed, by_gear, by_power };

struct Case {
  bool driven = false;  // leading axis
  bool ring = false;    // leading and following axis
  int ratio = 1;        // of servo and interpolator cycle
  double start = kStart;
};

/// An axis that leads, one that follows it by twice its way, one that follows that, one that may lead the
/// leading one, and one that couples later.
struct Led : Rig {
  explicit Led(By how, const Case& c = {})
      : Rig(1'000'000, c.ratio),
        by(how),
        l(axis("Leading", [&](AxisData& data) { shape(data, c, c.driven); })),
        f(axis("Following", [&](AxisData& data) { shape(data, c, false); })),
        g(axis("Third", [&](AxisData& data) { shape(data, c, false); })),
        first(axis("First")),
        late(axis("Late")),
        power(block<MC_Power>()),
        power_f(block<MC_Power>()),
        power_g(block<MC_Power>()),
        power_first(block<MC_Power>()),
        home(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()),
        run_again(block<MC_MoveVelocity>()),
        run_first(block<MC_MoveVelocity>()),
        move_l(block<MC_MoveRelative>()),
        superimpose(block<MC_MoveSuperimposed>()),
        gear_l(block<MC_GearIn>()),
        gear(block<MC_GearIn>()),
        gear_g(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()),
        cam_in(block<MC_CamIn>()),
        velocity(block<MC_GearInVelocity>()) {
    lead(f, l);
    lead(g, f);
    lead(l, first);
    lead(late, l);
    power.Axis = home.Axis = run_l.Axis = run_again.Axis = move_l.Axis = superimpose.Axis = &l;
    power_f.Axis = &f;
    power_g.Axis = &g;
    power_first.Axis = run_first.Axis = &first;
    gear_l.Master = &first;
    gear_l.Slave = &l;
    gear.Master = pos.Master = cam_in.Master = velocity.Master = &l;
    gear.Slave = pos.Slave = cam_in.Slave = velocity.Slave = &f;
    gear_g.Master = &f;
    gear_g.Slave = &g;
    gear.RatioNumerator = pos.RatioNumerator = velocity.RatioNumerator = 2;
    gear_g.RatioNumerator = -1;
    velocity.PositionControlled = true;
    cam_in.Cam = &test::add_bent_cam(controller, kRing);
    watch(true);
    power.Enable = power_f.Enable = power_g.Enable = power_first.Enable = true;
    home_in_place(f);
    run(20);
    home.Execute = true;
    run(20);
  }

  static void shape(AxisData& data, const Case& c, bool driven) {
    data.VirtualAxis.Mode = driven ? 0 : 1;
    data.Modulo = {c.ring, kRing, c.start};
    data.DynamicLimits.MaxVelocity = 500.0;
    data.DynamicLimits.MaxAcceleration = data.DynamicLimits.MaxDeceleration = 3000.0;
    data.DynamicLimits.MaxJerk = 1e6;
    data.FollowingError.EnableMonitoring = false;
  }

  /// Followers may do what the leading value does with the maximum dynamics of its axis, on top of its own.
  void watch(bool on) {
    continuity[0].velocity = false;  // a drive begins position control where the axis is
    for (const std::size_t i : {1U, 2U}) {
      continuity[i].velocity = on;
      continuity[i].acceleration = false;
      continuity[i].highest_acceleration = 2.5 * (3000.0 + 1000.0) + (by == By::cam ? 12000.0 : 0.0);
    }
  }

  void run_leading(double speed, bool controlled, int ticks) {
    run_l.Velocity = speed;
    run_l.Acceleration = 1000.0;
    run_l.Jerk = 0.0;
    run_l.PositionControlled = controlled;
    run_l.Execute = false;
    run(controller.clock.interpolator_ratio);
    run_l.Execute = true;
    run(ticks);
  }

  void couple() {
    gear_g.Execute = true;
    gear.Execute = by == By::gear;
    velocity.Execute = by == By::velocity;
    pos.SyncProfileReference = cam_in.SyncProfileReference = 3;
    pos.MasterSyncPosition = cam_in.MasterSyncPosition = 5.0;
    pos.MasterStartDistance = cam_in.MasterStartDistance = 20.0;
    pos.Execute = by == By::gear_in_pos;
    cam_in.ApplicationMode = 2;
    cam_in.Execute = by == By::cam;
    run_leading(kSpeed, true, 1020);
    ASSERT_TRUE(synchronous());
    ASSERT_TRUE(gear_g.InGear);
  }

  bool synchronous() const { return has_bit(f.data.StatusWord, StatusBit::Synchronous); }
  /// The leading axis as the following one sees it.
  double seen() const { return f.data.StatusSynchronizedMotion.EffectiveLeadingValue.Position; }
  /// On the ring, or on the line.
  double apart(double a, double b) const { return l.modulo().enabled ? std::remainder(a - b, kRing) : a - b; }
  double unrolled(const Axis& axis) const {
    return difference(axis.setpoint().position, {}, axis.modulo()).rounded();
  }

  /// How far the following axis is from its place by the setpoint of the leading one.
  double off_place() const {
    const double leading = unrolled(l);
    if (by != By::cam) return apart(unrolled(f), 2.0 * leading);
    return apart(unrolled(f), test::on_bent_cam(*cam_in.Cam, kRing, leading));
  }

  /// Leaves position control in motion; the rig does not look at the published step.
  void leave() {
    watch(false);
    run_leading(kSpeed, false, 3 * controller.clock.interpolator_ratio);
    watch(true);
    run(2);
  }
  void take_up(Taken how) {
    if (how == Taken::by_motion) return run_leading(kSpeed, true, 0);
    if (how == Taken::by_positioning) {
      move_l.Distance = 200.0;
      move_l.Velocity = kSpeed;
      move_l.Execute = true;
    }
    if (how == Taken::by_superimposed) {
      superimpose.Distance = 5.0;
      superimpose.VelocityDiff = 20.0;
      superimpose.Execute = true;
    }
    if (how == Taken::by_gear) {
      run_first.Velocity = 0.8 * kSpeed;
      run_first.Execute = true;
      gear_l.Execute = true;
    }
    if (how == Taken::by_power) {
      power.Enable = false;
      run(200);
      power.StartMode = 1;
      power.Enable = true;
    }
  }

  /// In the tick of the first switch, or so many after it.
  void switch_twice(bool first_on, int ticks_between) {
    run_l.Execute = false;
    run(1);
    run_l.Velocity = run_again.Velocity = kSpeed;
    run_l.Acceleration = run_again.Acceleration = 1000.0;
    run_l.Jerk = run_again.Jerk = 0.0;
    run_l.PositionControlled = first_on;
    run_again.PositionControlled = !first_on;
    run_l.Execute = true;
    if (ticks_between != 0) run(ticks_between);
    run_again.Execute = true;
    run(2);
    EXPECT_EQ(l.position_controlled(), !first_on);
  }

  /// As `switch_twice`, without a switch.
  void run_again_at(double speed) {
    run_l.Execute = false;
    run(1);
    run_again.Velocity = speed;
    run_again.Acceleration = 1000.0;
    run_again.Jerk = 0.0;
    run_again.PositionControlled = true;
    run_again.Execute = true;
    run(2);
  }

  By by;
  Axis& l;
  Axis& f;
  Axis& g;
  Axis& first;
  Axis& late;
  MC_Power& power;
  MC_Power& power_f;
  MC_Power& power_g;
  MC_Power& power_first;
  MC_Home& home;
  MC_MoveVelocity& run_l;
  MC_MoveVelocity& run_again;
  MC_MoveVelocity& run_first;
  MC_MoveRelative& move_l;
  MC_MoveSuperimposed& superimpose;
  MC_GearIn& gear_l;
  MC_GearIn& gear;
  MC_GearIn& gear_g;
  MC_GearInPos& pos;
  MC_CamIn& cam_in;
  MC_GearInVelocity& velocity;
};

class PositionControl : public ::testing::TestWithParam<std::tuple<Taken, By, bool, bool, int>> {};
INSTANTIATE_TEST_SUITE_P(Ways, PositionControl,
                         ::testing::Combine(::testing::Values(Taken::by_motion, Taken::by_positioning,
                                                              Taken::by_superimposed, Taken::by_gear,
                                                              Taken::by_power),
                                            ::testing::Values(By::gear, By::gear_in_pos, By::cam),
                                            ::testing::Bool(), ::testing::Bool(), ::testing::Values(1, 4)));

TEST_P(PositionControl, OfALeadingAxisTakenUpAgainIsNoStepForAxesThatFollow) {
  const auto [how, by, driven, ring, ratio] = GetParam();
  Led rig(by, {driven, ring, ratio});
  rig.couple();
  const double before = rig.off_place();
  rig.leave();
  EXPECT_EQ(rig.seen(), 0.0);
  EXPECT_TRUE(rig.synchronous());
  EXPECT_EQ(rig.f.setpoint().velocity, 0.0);
  rig.run(1000);  // some turns of a ring
  EXPECT_FALSE(rig.l.position_controlled());
  rig.take_up(how);
  rig.run(5000);  // the rig looks for steps
  EXPECT_TRUE(rig.l.position_controlled());
  EXPECT_TRUE(rig.synchronous());
  EXPECT_TRUE(rig.gear_g.InGear);
  EXPECT_NEAR(rig.seen(), rig.l.data.Position, 0.0);
  EXPECT_NEAR(rig.apart(rig.off_place(), before), 0.0, 1e-9);
}

TEST(PositionControlOfALeadingAxis, LeftOnARingStepsToZeroOnTheTurnAtHand) {
  for (const By by : {By::gear, By::gear_in_pos, By::cam}) {
    for (const double start : {kStart, 10.0}) {  // 0 itself may be the name of no place of the ring
      Led rig(by, {.ring = true, .start = start});
      rig.couple();
      ASSERT_GT(rig.l.setpoint().position.turns, 1);
      const double zero = start > 0.0 ? kRing : 0.0;
      const double before = rig.l.data.Position;
      const double following = rig.unrolled(rig.f);
      rig.leave();
      EXPECT_EQ(rig.seen(), zero);
      EXPECT_NEAR(rig.unrolled(rig.f) - following, 2.0 * (zero - before), 3.0)
          << "the published step, and no turn";
    }
  }
}

TEST(PositionControlOfALeadingAxis, IsNoMatterOfMC_GearInVelocity) {
  for (const bool driven : {false, true}) {
    Led rig(By::velocity, {.driven = driven});
    rig.couple();
    for (const bool controlled : {false, true, false, true}) {
      rig.run_leading(kSpeed, controlled, 0);
      for (int i = 0; i < 300; ++i) {
        rig.tick();
        ASSERT_NEAR(rig.f.setpoint().velocity, 2.0 * kSpeed, 1e-9) << i;
      }
    }
  }
}

/// What couples anew is led by the setpoint as it is.
TEST(PositionControlOfALeadingAxis, ThatComesBackToSomeIsThereForThoseThatCoupleAnew) {
  Led rig(By::gear);
  auto& power = rig.block<MC_Power>();
  auto& gear = rig.block<MC_GearIn>();
  power.Axis = gear.Slave = &rig.late;
  gear.Master = &rig.l;
  power.Enable = true;
  rig.couple();
  rig.run(6000);
  rig.leave();
  rig.take_up(Taken::by_motion);
  rig.run(3);
  gear.Acceleration = 1000.0;
  gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return gear.InGear; }, 1000))
      << static_cast<int>(gear.ErrorID) << rig.late.setpoint().velocity;
  EXPECT_LT(rig.seen(), 0.8 * rig.l.data.Position) << "still on the way back for the other";
  EXPECT_NEAR(rig.late.setpoint().velocity, kSpeed, 1e-9);
  const double apart = rig.late.data.Position - rig.l.data.Position;
  for (int i = 0; i < 4000; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.late.data.Position - rig.l.data.Position, apart, 1e-9);
    ASSERT_LE(rig.f.setpoint().velocity, 2.0 * (kSpeed + 500.0) + 1e-9) << "setpoint and maximum velocity";
  }
  EXPECT_EQ(rig.seen(), rig.l.data.Position);
}

/// A way back on which nobody is does not count as motion.
TEST(PositionControlOfALeadingAxis, ThatComesBackToNobodyLetsASimulationBegin) {
  Led rig(By::gear);
  auto& gear = rig.block<MC_GearIn>();
  auto& power = rig.block<MC_Power>();
  auto& simulation = rig.block<MC_SynchronizedMotionSimulation>();
  power.Axis = gear.Slave = simulation.Slave = &rig.late;
  gear.Master = &rig.l;
  power.Enable = true;
  rig.run_leading(kSpeed, true, 6000);
  rig.run_leading(kSpeed, false, 200);
  rig.run_leading(0.0, true, 200);
  gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return gear.InGear; }, 100));
  ASSERT_EQ(rig.l.setpoint().velocity, 0.0);
  simulation.Enable = true;
  rig.run(2 * rig.controller.clock.interpolator_ratio);
  EXPECT_TRUE(simulation.InSimulation);
}

TEST(PositionControlOfALeadingAxis, LeftAgainOnTheWayBackAndTakenUpIsNoStepEither) {
  for (const bool ring : {false, true})
    for (const int ticks : {2, 3, 7, 30}) {
      Led rig(By::gear, {.ring = ring});
      rig.couple();
      const double before = rig.off_place();
      rig.leave();
      rig.run(700);
      rig.run_leading(kSpeed, true, ticks);
      EXPECT_NE(rig.seen(), rig.l.data.Position);
      rig.leave();
      EXPECT_EQ(rig.seen(), 0.0);
      rig.run(900);
      rig.run_leading(kSpeed, true, 3000);
      EXPECT_EQ(rig.seen(), rig.l.data.Position);
      EXPECT_NEAR(rig.apart(rig.off_place(), before), 0.0, 1e-9);
    }
}

/// Published: synchronizing begins once position control is there and the start position is reached.
TEST(PositionControlOfALeadingAxis, IsAwaitedByAJobThatWaits) {
  for (const double place : {0.0, 50.0}) {  // where the leading value seems to be, and on its way back
    Led rig(By::gear_in_pos);
    rig.pos.SyncProfileReference = 3;
    rig.pos.MasterSyncPosition = place;
    rig.pos.MasterStartDistance = 20.0;
    rig.run_leading(kSpeed, true, 1020);  // beyond the place
    rig.pos.Execute = true;
    rig.run(10);
    EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 2);
    rig.run_leading(kSpeed, false, 200);
    EXPECT_FALSE(rig.pos.StartSync || rig.pos.InSync);
    rig.run_leading(kSpeed, true, 1000);
    EXPECT_TRUE(rig.pos.Busy && !rig.pos.StartSync && !rig.pos.InSync) << "the leading axis was never there";
    EXPECT_EQ(rig.seen(), rig.l.data.Position);
    rig.run_leading(-kSpeed, true, 0);
    ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }, 20000));
    EXPECT_NEAR(rig.f.data.Position, 2.0 * (rig.l.data.Position - place), 1e-9);
  }
}

/// A waiting cam at the end of the active one counts by what that sees.
TEST(PositionControlOfALeadingAxis, ComesBackBeforeACamTakesOverAtTheEndOfAnother) {
  for (const bool ring : {false, true}) {
    Led rig(By::cam, {.ring = ring});
    auto& next = rig.block<MC_CamIn>();
    next.Master = &rig.l;
    next.Slave = &rig.f;
    next.Cam = rig.cam_in.Cam;
    next.SyncProfileReference = 5;
    next.ApplicationMode = 2;
    rig.couple();
    rig.run_leading(0.0, true, 500);
    const double before = rig.off_place();
    next.Execute = true;
    rig.run(3);
    rig.leave();
    rig.run(500);
    rig.run_leading(kSpeed, true, 5000);
    EXPECT_TRUE(rig.synchronous());
    EXPECT_TRUE(rig.cam_in.CommandAborted);
    EXPECT_NEAR(rig.apart(rig.off_place(), before), 0.0, 1e-9);
  }
}

TEST(PositionControlOfALeadingAxis, LeftAndTakenUpDuringAPhaseShiftIsNoStep) {
  for (const DINT profile : {0, 1, 2}) {
    Led rig(By::gear);
    auto& phase = rig.block<MC_PhasingRelative>();
    phase.Master = &rig.l;
    phase.Slave = &rig.f;
    phase.PhaseShift = 30.0;
    phase.ProfileReference = profile;
    phase.PhasingDistance = 400.0;
    phase.Velocity = 50.0;
    rig.couple();
    phase.StartPosition = rig.l.data.Position + 10.0;
    phase.Execute = true;
    rig.run(200);
    EXPECT_TRUE(phase.StartPhasing);
    rig.leave();
    rig.run(200);
    rig.run_leading(kSpeed, true, 5000);
    EXPECT_TRUE(phase.Done);
    EXPECT_EQ(rig.seen(), rig.l.data.Position);
    EXPECT_NEAR(rig.f.data.StatusSynchronizedMotion.PhaseShift, 30.0, 1e-12);
  }
}

/// In one tick nobody sees the one of both switches: what is left is the other, or neither.
class BothSwitches : public ::testing::TestWithParam<std::tuple<By, bool, bool, int>> {};
INSTANTIATE_TEST_SUITE_P(Ways, BothSwitches,
                         ::testing::Combine(::testing::Values(By::gear, By::gear_in_pos, By::cam),
                                            ::testing::Bool(), ::testing::Bool(),
                                            ::testing::Values(0, 1, 2)));

TEST_P(BothSwitches, OffAndOnAgainIsNoStepOnceTheAxisIsControlledAgain) {
  const auto [by, driven, ring, ticks] = GetParam();
  Led rig(by, {.driven = driven, .ring = ring});
  rig.couple();
  const double before = rig.off_place();
  const double seen = rig.seen();
  rig.watch(ticks == 0);  // no step at all, or the published one
  rig.switch_twice(false, ticks);
  rig.watch(true);
  if (ticks == 0) {
    EXPECT_NEAR(rig.apart(rig.seen(), seen), 3.0 * kSpeed * rig.period(), 1e-9);
  }
  rig.run(3000);
  EXPECT_TRUE(rig.l.position_controlled());
  EXPECT_EQ(rig.seen(), rig.l.data.Position);
  EXPECT_NEAR(rig.apart(rig.off_place(), before), 0.0, 1e-9);
}

TEST_P(BothSwitches, OnAndOffAgainIsNoStepNorTurns) {
  const auto [by, driven, ring, ticks] = GetParam();
  Led rig(by, {.driven = driven, .ring = ring});
  rig.couple();
  const double before = rig.off_place();
  rig.leave();
  rig.run(1000);  // some turns of a ring
  const double following = rig.unrolled(rig.f);
  rig.watch(ticks == 0);
  rig.switch_twice(true, ticks);
  rig.run(1);
  rig.watch(true);
  EXPECT_EQ(rig.seen(), 0.0);
  EXPECT_EQ(rig.unrolled(rig.f), following);
  rig.run(500);
  rig.run_leading(kSpeed, true, 5000);
  EXPECT_EQ(rig.seen(), rig.l.data.Position);
  EXPECT_NEAR(rig.apart(rig.off_place(), before), 0.0, 1e-9);
}

class OnTheWayBack : public ::testing::TestWithParam<std::tuple<By, bool, bool>> {};
INSTANTIATE_TEST_SUITE_P(Ways, OnTheWayBack,
                         ::testing::Combine(::testing::Values(By::gear, By::gear_in_pos, By::cam),
                                            ::testing::Bool(), ::testing::Bool()));

TEST_P(OnTheWayBack, OffAndOnAgainInOneTickIsAsIfNothingHadBeen) {
  const auto [by, driven, ring] = GetParam();
  Led rig(by, {.driven = driven, .ring = ring});
  Led same(by, {.driven = driven, .ring = ring});
  for (Led* const one : {&rig, &same}) {
    one->couple();
    one->leave();
    one->run(1000);
    one->run_leading(kSpeed, true, 60);
    EXPECT_NE(one->seen(), one->l.data.Position) << "is on the way back";
    one->watch(true);
  }
  rig.switch_twice(false, 0);
  same.run_again_at(kSpeed);
  EXPECT_TRUE(rig.l.position_controlled());
  for (int i = 0; i < 3000; ++i) {
    EXPECT_EQ(rig.seen(), same.seen());
    rig.run(1);
    same.run(1);
  }
  EXPECT_EQ(rig.seen(), rig.l.data.Position);
}

// ---- Restart
// -----------------------------------------------------------------------------------------------------

/// A restart begins with position control, whatever has been before.
TEST(RestartOfALeadingAxis, PutsPositionControlBack) {
  for (const bool ring : {false, true})
    for (const int ticks : {0, 20}) {  // without position control, and on the way back
      Led rig(By::gear, {.ring = ring});
      auto& reset = rig.block<MC_Reset>();
      auto& reset_f = rig.block<MC_Reset>();
      reset.Axis = &rig.l;
      reset_f.Axis = &rig.f;
      reset.Restart = true;
      rig.couple();
      rig.leave();
      rig.run(1000);
      if (ticks != 0) rig.run_leading(kSpeed, true, ticks);
      rig.power.StopMode = 2;
      rig.power.Enable = false;
      ASSERT_TRUE(rig.run_until([&] { return rig.l.off(); }, 100));
      ASSERT_NE(rig.seen(), rig.l.setpoint().position.value);
      EXPECT_EQ(rig.l.position_controlled(), ticks != 0);
      reset.Execute = true;
      ASSERT_TRUE(rig.run_until([&] { return reset.Done; }, 10));
      EXPECT_TRUE(rig.gear.Error);
      EXPECT_EQ(rig.f.pending_alarm(), alarm::kLeadingAxis);
      EXPECT_TRUE(rig.l.position_controlled());
      EXPECT_EQ(rig.l.data.Position, rig.l.data.ActualPosition);

      reset_f.Execute = true;
      rig.gear.Execute = false;
      rig.run(200);
      rig.gear.Execute = true;
      ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }, 10)) << "no alarm 603";
      EXPECT_EQ(rig.seen(), rig.l.data.Position);
      rig.power.Enable = true;
      rig.run(10);
      rig.run_leading(kSpeed, true, 1000);
      EXPECT_EQ(rig.seen(), rig.l.data.Position);
      const double before = rig.l.data.Position;
      const double following = rig.unrolled(rig.f);
      rig.leave();
      EXPECT_NEAR(rig.unrolled(rig.f) - following, -2.0 * before, 3.0) << "the published step, and no turn";
    }
}

}  // namespace
}  // namespace lockstep::position_control_hand_over_test
