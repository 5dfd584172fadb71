// Gearing on virtual axes with synchronous positions, through MC_GearInPos.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/fb/gear_pair.hpp"

namespace lockstep::gear_in_pos_test {
namespace {

using test::bit;
using test::GearPair;
using test::line;
using test::Rig;

void ring(AxisData& data) {
  data.Modulo.Enable = true;
}

/// A chain of gears whose first member waits for its last one, which is legal as long as it only waits; made
/// in an order of the objects in which each of them is looked at first once.
struct WaitingChain : Rig {
  explicit WaitingChain(std::size_t first_made) {
    const char* const names[] = {"A", "B", "C", "D"};
    axes.resize(4);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t place = (first_made + i) % 4;
      axes[place] = &axis(names[place]);
      axes[place]->data.DynamicLimits.MaxVelocity = 1e6;
    }
    for (std::size_t i = 1; i < 4; ++i) {
      lead(*axes[i], *axes[i - 1]);
      auto& gear = block<MC_GearIn>();
      gear.Master = axes[i - 1];
      gear.Slave = axes[i];
      gears.push_back(&gear);
    }
    lead(*axes[1], *axes[3]);
    auto& waits = block<MC_GearInPos>();
    waits.Master = axes[3];
    waits.Slave = axes[1];
    waits.SyncProfileReference = 1;
    waits.MasterSyncPosition = waits.SlaveSyncPosition = 1000.0;
    waits.MasterStartDistance = 10.0;
    waiting = &waits;
    for (Axis* axis : axes) {
      auto& power = block<MC_Power>();
      power.Axis = axis;
      power.Enable = true;
      powers.push_back(&power);
    }
    auto& move = block<MC_MoveVelocity>();
    move.Axis = axes[0];
    move.Velocity = 1000.0;
    home_in_place(*axes[1]);
    Rig::run(3);
    for (MC_GearIn* gear : gears) gear->Execute = true;
    EXPECT_TRUE(run_until([&] { return gears[0]->InGear && gears[1]->InGear && gears[2]->InGear; }));
    move.Execute = true;
    waits.Execute = true;
    Rig::run(5);
    EXPECT_TRUE(waits.Busy);
  }

  std::vector<Axis*> axes;
  std::vector<MC_GearIn*> gears;
  std::vector<MC_Power*> powers;
  MC_GearInPos* waiting = nullptr;
};

TEST(MC_GearInPos, ThatWaitsForAnAxisThatFollowsItsOwnDelaysNoneOfThem) {
  for (std::size_t first_made = 0; first_made < 4; ++first_made) {
    WaitingChain rig(first_made);
    while (rig.axes[3]->data.Position < 900.0) {
      rig.tick();
      for (std::size_t i = 1; i < 4; ++i)
        ASSERT_EQ(rig.axes[i]->data.Position, rig.axes[0]->data.Position) << first_made;
    }
    ASSERT_TRUE(rig.run_until([&] { return !rig.waiting->Busy; }));
    EXPECT_EQ(rig.waiting->ErrorID, static_cast<WORD>(0x8019));
    EXPECT_TRUE(rig.gears[2]->InGear);
  }
}

TEST(MC_GearInPos, ThatWaitsBecomesActiveOnceTheAxisThatItAwaitsFollowsItsOwnNoLonger) {
  WaitingChain rig(0);
  auto& away = rig.block<MC_MoveVelocity>();  // takes the last axis out of its gear
  away.Axis = rig.axes[3];
  away.Velocity = 1000.0;
  away.Execute = true;
  rig.continuity[1].highest_acceleration = 1e6;
  rig.continuity[1].highest_jerk = 1e9;
  rig.continuity[2] = rig.continuity[1];
  ASSERT_TRUE(rig.run_until([&] { return rig.waiting->InSync; }));
  for (int i = 0; i < 100; ++i) {
    rig.tick();
    ASSERT_NEAR(rig.axes[1]->data.Position, rig.axes[3]->data.Position, 1e-9);
    ASSERT_EQ(rig.axes[2]->data.Velocity, rig.axes[1]->data.Velocity);
  }
}

struct SyncCase {
  const char* name;
  bool modulo;
  DINT profile;
  double velocity;  // of the leading axis
  DINT numerator, denominator;
  double master_sync, slave_sync, distance;
  DINT direction;
};

std::ostream& operator<<(std::ostream& out, const SyncCase& c) {
  return out << c.name;
}

class MC_GearInPosWays : public ::testing::TestWithParam<SyncCase> {};

TEST_P(MC_GearInPosWays, WaitsSynchronizesWithoutAStepAndIsThenExact) {
  const SyncCase c = GetParam();
  GearPair rig(c.modulo ? ring : line, c.modulo ? ring : line);
  rig.pos.RatioNumerator = c.numerator;
  rig.pos.RatioDenominator = c.denominator;
  rig.pos.MasterSyncPosition = c.master_sync;
  rig.pos.SlaveSyncPosition = c.slave_sync;
  rig.pos.SyncProfileReference = c.profile;
  rig.pos.MasterStartDistance = c.distance;
  rig.pos.SyncDirection = c.direction;
  rig.pos.Velocity = 2000.0;
  rig.pos.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.pos.Busy);
  EXPECT_FALSE(rig.pos.StartSync);
  EXPECT_FALSE(rig.pos.InSync);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 2);
  rig.start_leading(c.velocity);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.StartSync; }));
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronizing));
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 0);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.FunctionState, 2);
  const AxisPosition start = rig.f.setpoint().position;
  double lowest = 0.0, highest = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    const double distance = difference(rig.f.setpoint().position, start, rig.f.modulo()).rounded();
    lowest = std::min(lowest, distance);
    highest = std::max(highest, distance);
    return rig.pos.InSync;
  }));
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
  EXPECT_FALSE(rig.pos.StartSync);
  if (c.modulo && c.direction == 1) {
    EXPECT_GE(lowest, -1e-9);
  }
  if (c.modulo && c.direction == 2) {
    EXPECT_LE(highest, 1e-9);
  }
  const double ratio = static_cast<double>(c.numerator) / c.denominator;
  for (int i = 0; i < 2000; ++i) {
    rig.tick();
    const double function = c.slave_sync + ratio * (rig.l.data.Position - c.master_sync);
    const double away = rig.f.data.Position - function;
    const double off =
        c.modulo ? std::remainder(away, ratio == std::round(ratio) ? 360.0 : 360.0 / c.denominator) : away;
    ASSERT_NEAR(off, 0.0, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Profiles, MC_GearInPosWays,
    ::testing::Values(SyncCase{"advance", false, 1, 100, 3, 2, 300, 90, 100, 3},
                      SyncCase{"advance_backward", false, 1, -100, 3, 2, -300, 90, 100, 3},
                      SyncCase{"advance_negative_ratio", false, 1, 100, -1, 3, 150, -40, 100, 3},
                      SyncCase{"subsequent", false, 3, 100, 1, 1, 120, 80, 60, 3},
                      SyncCase{"subsequent_backward", false, 3, -100, 1, 1, -120, 80, 60, 3},
                      SyncCase{"dynamic", false, 0, 100, 1, 1, 400, 90, 0, 3},
                      SyncCase{"dynamic_backward", false, 0, -100, 2, 1, -400, 90, 0, 3},
                      SyncCase{"dynamic_negative_ratio", false, 0, 100, -1, 2, 400, 90, 0, 3},
                      SyncCase{"ring_advance_shortest", true, 1, 200, 1, 1, 300, 200, 100, 3},
                      SyncCase{"ring_advance_positive", true, 1, 200, 1, 1, 300, 200, 100, 1},
                      SyncCase{"ring_advance_negative", true, 1, 200, -1, 1, 300, 10, 100, 2},
                      SyncCase{"ring_subsequent_positive", true, 3, 200, 2, 1, 90, 350, 100, 1},
                      SyncCase{"ring_dynamic_positive", true, 0, 100, 1, 1, 200, 200, 0, 1},
                      SyncCase{"ring_dynamic_negative", true, 0, 100, -1, 1, 200, 200, 0, 2},
                      SyncCase{"ring_dynamic_shortest", true, 0, 100, 1, 1, 200, 20, 0, 3}),
    [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(MC_GearInPos, IsSynchronousAtOnceWhenBothAxesStandOnTheirPositions) {
  for (const DINT profile : {0, 1, 3}) {
    GearPair rig;
    rig.pos.SyncProfileReference = profile;
    rig.pos.Execute = true;
    rig.run(2);
    EXPECT_TRUE(rig.pos.InSync) << profile;
  }
}

TEST(MC_GearInPos, ProfileOneInsideItsDistanceIsRejected) {
  GearPair rig;
  rig.pos.MasterSyncPosition = 50.0;
  rig.pos.MasterStartDistance = 60.0;
  rig.pos.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.pos.ErrorID, static_cast<WORD>(0x8026));
}

TEST(MC_GearInPos, ProfileOneInsideItsDistanceOnARingWaitsForTheNextTurn) {
  GearPair rig(ring, ring);
  rig.pos.MasterSyncPosition = 50.0;
  rig.pos.MasterStartDistance = 60.0;
  rig.pos.Execute = true;
  rig.start_leading(200.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  EXPECT_GE(rig.l.setpoint().position.turns, 1);
}

TEST(MC_GearInPos, ThatIsRejectedLeavesTheOneThatWaits) {
  GearPair rig;
  rig.pos.MasterSyncPosition = 100.0;
  rig.pos.MasterStartDistance = 50.0;
  rig.pos.Execute = true;
  rig.run(3);
  ASSERT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 2);
  auto& late = rig.block<MC_GearInPos>();
  late.Master = &rig.l;
  late.Slave = &rig.f;
  late.MasterSyncPosition = 10.0;
  late.MasterStartDistance = 50.0;
  late.Execute = true;
  rig.run(3);
  EXPECT_EQ(late.ErrorID, static_cast<WORD>(0x8026));
  EXPECT_TRUE(rig.pos.Busy);
  EXPECT_FALSE(rig.pos.CommandAborted);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 2);
  rig.start_leading(100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  EXPECT_NEAR(rig.l.data.Position, 100.0, 0.2);
}

TEST(MC_GearInPos, ProfileZeroBeyondItsVelocityIsRejected) {
  GearPair rig;
  rig.start_leading(100.0);
  rig.run(300);
  rig.pos.SyncProfileReference = 0;
  rig.pos.RatioNumerator = 3;
  rig.pos.Velocity = 200.0;
  rig.pos.MasterSyncPosition = 1000.0;
  rig.pos.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.pos.ErrorID, static_cast<WORD>(0x8003));
}

TEST(MC_GearInPos, ASynchronousFunctionAgainstSyncDirectionIsRejected) {
  GearPair rig(ring, ring);
  rig.pos.MasterSyncPosition = 200.0;
  rig.pos.MasterStartDistance = 50.0;
  rig.pos.SyncDirection = 2;
  rig.pos.Execute = true;
  rig.start_leading(200.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.Error; }));
  EXPECT_EQ(rig.pos.ErrorID, static_cast<WORD>(0x8007));
}

TEST(MC_GearInPos, TakesOverARunningMotionWithoutAStepAndAbortsItOnlyWhenActive) {
  GearPair rig;
  rig.move_f.Velocity = 30.0;
  rig.move_f.Execute = true;
  rig.start_leading(100.0);
  rig.pos.MasterSyncPosition = 300.0;
  rig.pos.SlaveSyncPosition = 200.0;
  rig.pos.MasterStartDistance = 100.0;
  rig.pos.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move_f.InVelocity; }));
  EXPECT_TRUE(rig.pos.Busy);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.StartSync; }));
  rig.run(1);
  EXPECT_TRUE(rig.move_f.CommandAborted);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  EXPECT_NEAR(rig.following_minus_function(1, 1, 300.0, 200.0), 0.0, 1e-10);
}

TEST(MC_GearInPos, RetriggeredWhileSynchronousItKeepsItsGearUntilTheNewJobStarts) {
  GearPair rig(ring, ring);
  rig.pos.MasterSyncPosition = 100.0;
  rig.pos.SlaveSyncPosition = 0.0;
  rig.pos.MasterStartDistance = 50.0;
  rig.pos.Execute = true;
  rig.start_leading(100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  rig.pos.Execute = false;
  rig.run(1);
  rig.pos.SlaveSyncPosition = 45.0;
  rig.pos.Execute = true;
  rig.run(2);
  EXPECT_FALSE(rig.pos.InSync);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 2);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.FunctionState, 2);
  EXPECT_EQ(rig.f.data.Velocity, rig.l.data.Velocity);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  EXPECT_NEAR(std::remainder(rig.f.data.Position - rig.l.data.Position + 55.0, 360.0), 0.0, 1e-9);
}

TEST(MC_GearInPos, AWaitingJobIsReplacedByAnotherWaitingOneAndSurvivesMC_Halt) {
  GearPair rig;
  auto& other = rig.block<MC_GearInPos>();
  other.Master = &rig.l;
  other.Slave = &rig.f;
  rig.pos.MasterSyncPosition = other.MasterSyncPosition = 500.0;
  rig.pos.Execute = true;
  rig.run(2);
  rig.halt_f.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.pos.Busy);
  other.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.pos.CommandAborted);
  EXPECT_TRUE(other.Busy);
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.WaitingFunctionState, 2);
}

TEST(MC_GearInPos, HomingTheFollowingAxisWhileActiveIsRejected) {
  GearPair rig;
  rig.pos.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  rig.home_f.Execute = false;
  rig.run(1);
  rig.home_f.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.home_f.ErrorID, static_cast<WORD>(0x80A1));
  EXPECT_TRUE(rig.pos.InSync);
}

TEST(MC_GearInPos, WithinTheReversionToleranceTheProfileIsFollowedBackwards) {
  GearPair rig(line, [](AxisData& data) { data.Synchronization.MasterReversionTolerance = 20.0; });
  rig.pos.MasterSyncPosition = 200.0;
  rig.pos.SlaveSyncPosition = 50.0;
  rig.pos.MasterStartDistance = 150.0;
  rig.pos.Execute = true;
  rig.start_leading(100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.l.data.Position > 120.0; }));
  rig.run_l.Jerk = 0.0;
  rig.continuity[0].acceleration = false;
  rig.start_leading(-40.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.l.data.Velocity == -40.0; }));
  rig.run(100);
  EXPECT_FALSE(rig.pos.Error);
  rig.start_leading(100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  EXPECT_NEAR(rig.following_minus_function(1, 1, 200.0, 50.0), 0.0, 1e-10);
}

TEST(MC_GearInPos, AMovingAxisIsNotTakenOverByALeadingAxisThatCreeps) {
  GearPair rig;
  rig.move_f.Velocity = 80.0;
  rig.move_f.Execute = true;
  rig.start_leading(0.01);
  ASSERT_TRUE(rig.run_until([&] { return rig.move_f.InVelocity && rig.run_l.InVelocity; }));
  rig.pos.SyncProfileReference = 3;
  rig.pos.MasterSyncPosition = rig.l.data.Position + 0.02;
  rig.pos.SlaveSyncPosition = rig.f.data.Position + 200.0;
  rig.pos.MasterStartDistance = 100.0;
  rig.pos.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.Error; }));
  EXPECT_EQ(rig.pos.ErrorID, static_cast<WORD>(0x8026));
  EXPECT_TRUE(rig.move_f.InVelocity);
}

/// The profile over time is carried out over the leading distance: its beginning would be as steep as the
/// leading value is slow. The additive acceleration need not fit the additive velocity.
TEST(GearInPosOverTime, DoesNotThrowAnAxisInMotionBehindALeadingValueThatIsSlowAndAcceleratesStrongly) {
  GearPair rig;
  auto& additive = rig.block<MC_LeadingValueAdditive>();
  additive.Axis = &rig.f;
  rig.move_f.Velocity = 30.0;
  rig.move_f.Execute = true;
  rig.start_leading(4.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.move_f.InVelocity && rig.run_l.InVelocity; }));
  additive.Acceleration = 1000.0;
  additive.Enable = true;
  rig.run(2);
  rig.pos.SyncProfileReference = 0;
  rig.pos.Acceleration = rig.pos.Deceleration = 1000.0;
  rig.pos.Jerk = 100000.0;
  rig.pos.MasterSyncPosition = rig.l.data.Position + 80.0;
  rig.pos.SlaveSyncPosition = rig.f.data.Position + 30.0;
  rig.pos.Execute = true;
  double fastest = 0.0;
  for (int i = 0; i < 22000; ++i) {
    rig.tick();
    fastest = std::max(fastest, std::abs(rig.f.setpoint().velocity));
  }
  EXPECT_LE(fastest, 100.0);
}

/// The profile runs over the leading distance, so that it gets as steep as the leading value gets fast behind
/// the start. The job is there before the leading axis starts from rest, as behind one button for both.
class GearInPosOverTimeBehindARunUp : public ::testing::TestWithParam<double> {};

TEST_P(GearInPosOverTimeBehindARunUp, KeepsTwiceItsDynamicsAndWaitsForTheNextTurnOtherwise) {
  constexpr double kVelocity = 800.0, kAcceleration = 4000.0, kLeading = 150.0;
  for (const double place : {20.0, 60.0, 200.0}) {
    GearPair rig(ring, line);
    const double turn = rig.l.data.Modulo.Length;
    rig.pos.SyncProfileReference = 0;
    rig.pos.Velocity = kVelocity;
    rig.pos.Acceleration = rig.pos.Deceleration = kAcceleration;
    rig.pos.Jerk = 80000.0;
    rig.pos.MasterSyncPosition = GetParam();
    rig.pos.SlaveSyncPosition = place;
    rig.pos.Execute = true;
    rig.run_l.Acceleration = kAcceleration;
    rig.run_l.Jerk = 80000.0;
    rig.start_leading(kLeading);
    double fastest = 0.0, steepest = 0.0;
    int ticks = 0;
    for (; ticks < 10000 && !rig.pos.InSync; ++ticks) {
      rig.tick();
      fastest = std::max(fastest, std::abs(rig.f.setpoint().velocity));
      steepest = std::max(steepest, std::abs(rig.f.setpoint().acceleration));
    }
    ASSERT_TRUE(rig.pos.InSync) << place;
    EXPECT_LE(fastest, std::sqrt(2.0) * kVelocity) << place;
    EXPECT_LE(steepest, 3.0 * kAcceleration) << place;
    const double leading = rig.l.setpoint().position.value;
    EXPECT_NEAR(rig.f.setpoint().position.value - place,
                leading - GetParam() + (leading < GetParam() - 1.0 ? turn : 0.0), 1.0)
        << place;
  }
}

INSTANTIATE_TEST_SUITE_P(Places, GearInPosOverTimeBehindARunUp,
                         ::testing::Values(0.05, 0.5, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0, 30.0, 45.0, 60.0, 80.0,
                                           100.0, 150.0, 200.0));

TEST(MC_GearInPos, ReversalWhileSynchronizingRaisesAlarm608) {
  GearPair rig;
  rig.pos.MasterSyncPosition = 300.0;
  rig.pos.MasterStartDistance = 200.0;
  rig.pos.SlaveSyncPosition = 10.0;
  rig.pos.Execute = true;
  rig.start_leading(100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.StartSync; }));
  rig.run(100);
  rig.start_leading(-100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.Error; }));
  EXPECT_EQ(rig.f.data.ErrorDetail.Number, 608u);
  EXPECT_EQ(rig.pos.ErrorID, static_cast<WORD>(0x8001));
}

}  // namespace
}  // namespace lockstep::gear_in_pos_test
