// How MC_CamIn synchronizes, on virtual axes: each profile, and the direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/fb/cam_pair.hpp"

namespace lockstep::camming_synchronizing_test {
namespace {

using test::bit;
using test::CamPair;
using test::fast_ring;

TEST(MC_CamIn, Profile1IsSynchronousAtTheSynchronousPosition) {
  CamPair rig;
  rig.start_leading(200.0);
  rig.in.ApplicationMode = 1;
  rig.in.MasterSyncPosition = 120.0;
  rig.in.MasterStartDistance = 80.0;
  rig.in.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.in.Busy && !rig.in.StartSync && !rig.in.InSync);
  EXPECT_EQ(rig.status().WaitingFunctionState, 3);
  EXPECT_TRUE(bit(rig.wave, CamStatusBit::Control));
  ASSERT_TRUE(rig.run_until([&] { return rig.in.StartSync; }));
  EXPECT_NEAR(rig.leading(), 40.0, 0.6);
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronizing));
  EXPECT_EQ(rig.status().FunctionState, 3);
  EXPECT_EQ(rig.status().WaitingFunctionState, 0);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  EXPECT_NEAR(rig.leading(), 120.0, 0.6);
}

TEST(MC_CamIn, Profile0PlansItsMotionWithinTheGivenDynamics) {
  CamPair rig;
  rig.start_leading(100.0);
  rig.in.ApplicationMode = 1;
  rig.in.SyncProfileReference = 0;
  rig.in.MasterSyncPosition = 90.0;
  rig.in.Velocity = 120.0;
  rig.in.Acceleration = rig.in.Deceleration = 400.0;
  rig.in.Jerk = 5000.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.StartSync; }));
  ASSERT_TRUE(rig.run_until([&] {
    EXPECT_LE(std::abs(rig.f.setpoint().velocity), 120.0 * 1.01);
    EXPECT_LE(std::abs(rig.f.setpoint().acceleration), 400.0 * 1.01);
    return rig.in.InSync;
  }));
  EXPECT_NEAR(rig.leading(), 90.0, 0.2);
  rig.run(10);
  EXPECT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(rig.leading()).position, 1e-10);
}

/// The profile runs over the leading distance, so that it gets as steep as the leading value gets fast behind
/// the start. The job is there before the leading axis starts from rest, as behind one button for both.
class CamInOverTimeBehindARunUp : public ::testing::TestWithParam<double> {};

TEST_P(CamInOverTimeBehindARunUp, KeepsTwiceItsDynamicsAndWaitsForTheNextTurnOtherwise) {
  constexpr double kVelocity = 800.0, kAcceleration = 4000.0, kLeading = 150.0;
  CamPair rig;
  rig.in.ApplicationMode = 1;
  rig.in.SyncProfileReference = 0;
  rig.in.MasterSyncPosition = GetParam();
  rig.in.Velocity = kVelocity;
  rig.in.Acceleration = rig.in.Deceleration = kAcceleration;
  rig.in.Jerk = 80000.0;
  rig.in.Execute = true;
  rig.run_l.Acceleration = kAcceleration;
  rig.run_l.Jerk = 80000.0;
  rig.CoupledRig::start_leading(kLeading);
  double fastest = 0.0, steepest = 0.0;
  for (int ticks = 0; ticks < 10000 && !rig.in.InSync; ++ticks) {
    rig.tick();
    fastest = std::max(fastest, std::abs(rig.f.setpoint().velocity));
    steepest = std::max(steepest, std::abs(rig.f.setpoint().acceleration));
  }
  ASSERT_TRUE(rig.in.InSync);
  EXPECT_LE(fastest, std::sqrt(2.0) * kVelocity);
  EXPECT_LE(steepest, 2.0 * kAcceleration);
  rig.run(5);
  EXPECT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(rig.leading()).position, 1e-9);
}

// Places at which the wave stands far enough from rest (0) to need a profile.
INSTANTIATE_TEST_SUITE_P(Places, CamInOverTimeBehindARunUp,
                         ::testing::Values(5.0, 8.0, 12.0, 15.0, 20.0, 25.0, 30.0, 45.0, 60.0, 90.0, 150.0,
                                           200.0));

TEST(MC_CamIn, Profile3BeginsAtTheSynchronousPosition) {
  CamPair rig;
  rig.start_leading(200.0);
  rig.in.ApplicationMode = 1;
  rig.in.SyncProfileReference = 3;
  rig.in.MasterSyncPosition = 120.0;
  rig.in.MasterStartDistance = 80.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.StartSync; }));
  EXPECT_NEAR(rig.leading(), 120.0, 0.6);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  EXPECT_NEAR(rig.leading(), 200.0, 0.6);
  rig.run(5);
  EXPECT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(rig.leading()).position, 1e-10);
}

// Published figures: from 270 over 180, synchronous at 90; profile 6 then shows a MasterOffset of -90.
TEST(MC_CamIn, Profiles4And6BeginWhereTheLeadingAxisIs) {
  for (const DINT profile : {4, 6}) {
    CamPair rig;
    rig.start_leading(200.0);
    ASSERT_TRUE(rig.run_until([&] { return rig.leading() >= 269.7 && rig.leading() < 271.0; }));
    rig.in.ApplicationMode = 1;
    rig.in.SyncProfileReference = profile;
    rig.in.MasterSyncPosition = 180.0;
    rig.in.MasterStartDistance = 180.0;
    rig.in.Execute = true;
    rig.run(2);
    EXPECT_TRUE(rig.in.StartSync);
    ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
    EXPECT_NEAR(rig.leading(), 90.0, 0.8);
    rig.run(5);
    const double shift = rig.status().MasterOffset;
    EXPECT_NEAR(shift, profile == 6 ? -90.0 : 0.0, 0.8);
    const double u = std::fmod(rig.leading() - shift + 360.0, 360.0);
    EXPECT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(u).position, 1e-10);
  }
}

TEST(MC_CamIn, Profile2PutsTheCamWhereBothAxesStand) {
  CamPair rig;
  rig.move_f.Distance = 33.0;
  rig.move_f.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move_f.Done; }));
  rig.in.ApplicationMode = 1;
  rig.in.SyncProfileReference = 2;
  rig.in.MasterSyncPosition = 90.0;
  rig.in.Execute = true;
  rig.run(2);
  EXPECT_TRUE(rig.in.InSync);
  EXPECT_EQ(rig.f.setpoint().position.value, 33.0);
  EXPECT_EQ(rig.status().MasterOffset, -90.0);
  EXPECT_EQ(rig.status().SlaveOffset, 3.0);
  rig.start_leading(100.0);
  rig.run(500);
  const double u = std::fmod(rig.leading() + 90.0, 360.0);
  EXPECT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(u).position + 3.0, 1e-10);
}

TEST(MC_CamIn, IsSynchronousAtOnceWhereBothAxesStandOnTheirPositions) {
  for (const DINT profile : {0, 1, 3, 4}) {
    CamPair rig;
    rig.in.SyncProfileReference = profile;
    rig.in.MasterStartDistance = 50.0;
    rig.in.Execute = true;
    rig.run(3);
    EXPECT_TRUE(rig.in.InSync) << profile;
  }
}

TEST(MC_CamIn, SynchronizesARingInOneDirectionOnly) {
  for (const DINT direction : {1, 2}) {
    CamPair rig(fast_ring, fast_ring);
    rig.in.Cam = &rig.feed;
    rig.in.SlaveScaling = direction == 1 ? 1.0 : -1.0;
    rig.start_leading(200.0);
    rig.in.ApplicationMode = 2;
    rig.in.MasterSyncPosition = 180.0;
    rig.in.MasterStartDistance = 150.0;
    rig.in.SlaveOffset = direction == 1 ? -30.0 : 30.0;
    rig.in.SyncDirection = direction;
    rig.in.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.in.StartSync; }));
    while (!rig.in.InSync) {
      rig.tick();
      ASSERT_GE((direction == 1 ? 1.0 : -1.0) * rig.f.setpoint().velocity, -1e-9);
      ASSERT_TRUE(rig.in.Busy);
    }
  }
}

TEST(MC_CamIn, AReversingLeadingAxisStopsSynchronizing) {
  CamPair rig;
  rig.start_leading(200.0);
  rig.in.MasterSyncPosition = 180.0;
  rig.in.MasterStartDistance = 150.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.StartSync; }));
  rig.run(100);
  rig.run_l.Execute = false;
  rig.tick();
  rig.run_l.Velocity = -200.0;
  rig.run_l.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.Error; }));
  EXPECT_EQ(rig.f.pending_alarm(), alarm::kSynchronizing);
}

/// The cam turns back where it becomes synchronous: no profile in one direction bends as it does. Rounding of
/// its slope there must neither refuse the job nor make the axis catch up over thousands of turns.
TEST(MC_CamIn, OneWaySynchronizingWithACamThatTurnsBackNeitherShootsNorDependsOnRounding) {
  for (const DINT direction : {1, 2})
    for (const DINT profile : {1, 3, 4, 6})
      for (const double place : {0.0, 1e-9, 0.01, 90.0, 180.0, 270.0}) {
        SCOPED_TRACE(::testing::Message()
                     << "direction " << direction << " profile " << profile << " at " << place);
        CamPair rig(fast_ring, fast_ring);
        rig.in.Cam = &rig.cam("Peak", {{0, 0}, {180, 50}, {360, 0}}, 1);
        CamInterpolator interpolator(kCamPoints);
        ASSERT_EQ(rig.in.Cam->interpolate(interpolator), ErrorId::none);
        rig.in.ApplicationMode = 1;
        rig.in.SyncProfileReference = profile;
        rig.in.SyncDirection = direction;
        rig.in.MasterSyncPosition = place;
        rig.in.MasterStartDistance = 60.0;
        rig.start_leading(300.0);
        rig.continuity[1].velocity = false;  // the acceleration steps to that of the cam
        rig.in.Execute = true;
        double fastest = 0.0;
        ASSERT_TRUE(rig.run_until(
            [&] {
              fastest = std::max(fastest, std::abs(rig.f.setpoint().velocity));
              return rig.in.InSync || rig.in.Error;
            },
            4000));
        EXPECT_LT(fastest, 300.0 * 2.0 * 360.0 / 60.0 * 2.0);
        const bool rests = place == 0.0 || place == 180.0;
        EXPECT_TRUE(rig.in.InSync || !rests || profile == 3 || profile == 4);
      }
}

}  // namespace
}  // namespace lockstep::camming_synchronizing_test
