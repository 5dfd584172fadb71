// How camming on virtual axes ends: at the end of its cam, by the next one, by MC_CamOut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/gear_in.hpp"
#include "fb/offset.hpp"
#include "fb/phasing.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tests/fb/cam_pair.hpp"

namespace lockstep::camming_end_test {
namespace {

using test::bit;
using test::CamPair;
using test::fast_ring;
using test::line;

// ---- Ends
// -------------------------------------------------------------------------------------------------------

TEST(MC_CamIn, ACamThatIsPassedOnceEndsTheJobAtItsEnd) {
  CamPair rig;
  rig.in.Cam = &rig.cam("Dwell", {{0, 0}, {10, 0}, {180, 50}, {350, 80}, {360, 80}}, 0);
  // A cubic spline through these ends with a little slope: with segments at rest it does not.
  auto& data = *static_cast<CamData1k*>(rig.in.Cam->data_block());
  data.Segment[0] = {.xmin = 340.0, .xmax = 360.0, .a0 = 80.0};
  data.ValidSegment[0] = true;
  CamInterpolator interpolator(kCamPoints);
  ASSERT_EQ(rig.in.Cam->interpolate(interpolator), ErrorId::none);
  rig.start_leading(300.0);
  rig.in.MasterStartDistance = 60.0;
  rig.in.MasterSyncPosition = 20.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  ASSERT_TRUE(rig.run_until([&] { return rig.in.EndOfProfile; }, 2000));
  EXPECT_FALSE(rig.in.Busy || rig.in.InSync || rig.in.CommandAborted || rig.in.Error);
  EXPECT_EQ(rig.status().FunctionState, 0);
  EXPECT_EQ(rig.status().ActualCam, DB_ANY{});
  EXPECT_EQ(rig.f.setpoint().position.value, 80.0);
  EXPECT_TRUE(rig.f.setpoint().standing());
  rig.run(100);
  EXPECT_TRUE(rig.in.EndOfProfile);
  EXPECT_EQ(rig.f.setpoint().position.value, 80.0);
  rig.in.Execute = false;
  rig.run(2);
  EXPECT_FALSE(rig.in.EndOfProfile);
}

TEST(MC_CamIn, ACamThatEndsWithASlopeIsLeftWithTheDefaultDynamics) {
  CamPair rig;
  rig.in.Cam = &rig.feed;
  rig.f.data.DynamicDefaults.Deceleration = 2000.0;
  rig.start_leading(300.0);
  rig.in.MasterStartDistance = 60.0;
  rig.in.MasterSyncPosition = 20.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  ASSERT_TRUE(rig.run_until([&] { return rig.in.EndOfProfile; }, 2000));
  EXPECT_FALSE(rig.in.Busy);
  ASSERT_TRUE(rig.run_until([&] { return rig.f.setpoint().standing(); }, 2000));
  EXPECT_GT(rig.f.setpoint().position.value, 39.0);
  EXPECT_LT(rig.f.setpoint().position.value, 45.0);
}

/// With the default jerk it would take its acceleration away only far beyond the velocity limit.
TEST(MC_CamIn, ACamThatEndsWithASlopeAndBendsIsLeftWithinTheVelocityLimit) {
  CamPair rig;
  rig.in.Cam = &rig.cam("Valley", {{0, 0}, {300, 20}}, 0);
  auto& data = *static_cast<CamData1k*>(rig.in.Cam->data_block());
  data.Segment[0] = {
      .xmin = 340.0, .xmax = 360.0, .a0 = 6498.0125, .a1 = -36.05, .a2 = 0.05};  // 0.05 (x - 360.5)²
  data.ValidSegment[0] = true;
  CamInterpolator interpolator(kCamPoints);
  ASSERT_EQ(rig.in.Cam->interpolate(interpolator), ErrorId::none);
  rig.f.data.DynamicDefaults.Jerk = 20.0;
  rig.f.data.DynamicLimits.Velocity = 500.0;
  rig.start_leading(300.0);
  rig.in.MasterStartDistance = 60.0;
  rig.in.MasterSyncPosition = 20.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  ASSERT_TRUE(rig.run_until([&] { return rig.in.EndOfProfile; }, 2000));
  double fastest = 0.0;
  ASSERT_TRUE(rig.run_until(
      [&] {
        fastest = std::max(fastest, std::abs(rig.f.setpoint().velocity));
        return rig.f.setpoint().standing();
      },
      200000));
  EXPECT_LE(fastest, 500.0);
}

TEST(MC_CamIn, Profile5ChangesTheCamAtItsEndWithoutAStep) {
  CamPair rig;
  rig.couple();
  rig.next.SyncProfileReference = 5;
  rig.next.ApplicationMode = 2;
  rig.next.MasterScaling = 0.5;
  rig.continuity[1].highest_acceleration = 1e7;  // the slopes differ
  ASSERT_TRUE(rig.run_until([&] { return rig.leading() > 100.0 && rig.leading() < 110.0; }));
  rig.next.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.status().WaitingFunctionState, 3);
  EXPECT_TRUE(rig.next.Busy && !rig.next.InSync && rig.in.InSync);
  ASSERT_TRUE(rig.run_until([&] { return rig.next.InSync; }, 1000));
  EXPECT_LT(rig.leading(), 1.0);
  EXPECT_TRUE(rig.in.EndOfProfile && rig.in.CommandAborted && !rig.in.InSync);
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
  EXPECT_EQ(rig.status().ActualCam, rig.feed.number);
  EXPECT_EQ(rig.status().WaitingFunctionState, 0);
  EXPECT_NEAR(rig.status().SlaveOffset, 0.0, 1e-12);
  const auto first = rig.l.setpoint().position.turns;
  for (int i = 0; i < 2000; ++i) {
    rig.tick();
    const double distance =
        rig.leading() + 360.0 * static_cast<double>(rig.l.setpoint().position.turns - first);
    const double pass = std::floor(distance / 180.0);
    ASSERT_NEAR(rig.f.setpoint().position.value,
                rig.feed.function().value((distance - 180.0 * pass) / 0.5).position + 40.0 * pass, 1e-9);
  }
}

TEST(MC_CamIn, Profile5TakesOverFromACamThatIsPassedOnceAndNeedsCamming) {
  CamPair rig;
  rig.next.SyncProfileReference = 5;
  rig.next.Execute = true;
  rig.run(2);
  EXPECT_EQ(rig.next.ErrorID, WORD{0x808B});
  rig.next.Execute = false;
  rig.start_leading(400.0);
  rig.in.MasterStartDistance = 60.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  rig.next.ApplicationMode = 1;
  rig.next.Cam = &rig.wave;
  rig.next.MasterSyncPosition = 0.0;
  rig.next.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.next.InSync; }, 2000));
  EXPECT_TRUE(rig.in.EndOfProfile && rig.in.CommandAborted);
  for (int i = 0; i < 1500; ++i) {
    rig.tick();
    ASSERT_TRUE(rig.next.InSync);
    ASSERT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(rig.leading()).position, 1e-9);
  }
}

// The end of a cam takes phase shift, offset and superimposed jobs away; what they still move comes to rest.
TEST(MC_CamIn, Profile5DropsNoMotionOfWhatStillMoves) {
  for (const int what : {0, 1, 2}) {
    CamPair rig(fast_ring, [](AxisData& data) {
      data.DynamicLimits.MaxAcceleration = data.DynamicLimits.MaxDeceleration = 4000.0;
      data.DynamicLimits.MaxJerk = 1e6;
    });
    auto& phasing = rig.block<MC_PhasingRelative>();
    auto& offset = rig.block<MC_OffsetRelative>();
    auto& superimposed = rig.block<MC_MoveSuperimposed>();
    phasing.Master = &rig.l;
    phasing.Slave = offset.Slave = superimposed.Axis = &rig.f;
    phasing.ProfileReference = 1;
    phasing.PhaseShift = offset.Offset = 20.0;
    phasing.PhasingDistance = offset.OffsetDistance = 100.0;
    superimposed.Distance = 1000.0;
    rig.couple(360.0);
    // The same cam once more: whatever steps is not the cam's. It is as smooth at its ends as inside.
    rig.next.Cam = &rig.wave;
    rig.next.SyncProfileReference = 5;
    rig.next.ApplicationMode = 1;
    rig.next.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.leading() > 300.0 && rig.leading() < 301.0; }));
    (what == 0 ? phasing.Execute : what == 1 ? offset.Execute : superimposed.Execute) = true;
    rig.tick();
    rig.continuity[1].highest_acceleration = 20000.0;
    rig.continuity[1].acceleration = false;
    ASSERT_TRUE(rig.run_until([&] { return rig.next.InSync; }, 200)) << what;
    EXPECT_TRUE(what == 0   ? phasing.CommandAborted
                : what == 1 ? offset.CommandAborted
                            : superimposed.CommandAborted)
        << what;
    const double before = rig.f.setpoint().position.value;
    rig.run(2000);
    ASSERT_TRUE(rig.next.InSync);
    EXPECT_NE(rig.f.setpoint().position.value, before);
    const double phase = rig.status().PhaseShift;
    EXPECT_EQ(phase != 0.0, what == 0);
    const double start = rig.status().MasterOffset;
    double reached = 0.0;
    for (int i = 0; i < 1000; ++i) {
      rig.tick();
      const double place = std::fmod(rig.leading() + rig.status().PhaseShift - start + 720.0, 360.0);
      const double rest = rig.f.setpoint().position.value - rig.wave.function().value(place).position;
      if (i == 0) reached = rest;
      ASSERT_NEAR(rest, reached, 1e-9) << what << ": at rest on the cam";
      ASSERT_EQ(rig.status().PhaseShift, phase);
    }
  }
}

// ---- MC_CamOut
// -----------------------------------------------------------------------------------------------------

TEST(MC_CamOut, BringsTheAxisToRestAtItsPosition) {
  for (const DINT profile : {0, 1}) {
    CamPair rig;
    rig.couple(300.0);
    rig.out.SyncProfileReference = profile;
    rig.out.SlavePosition = 30.0;
    rig.out.MasterStopDistance = 40.0;
    rig.out.Deceleration = 800.0;
    rig.out.Jerk = 20000.0;
    rig.out.SyncOutDirection = 2;
    rig.out.Execute = true;
    rig.run(2);
    EXPECT_TRUE(rig.out.Busy && !rig.out.StartSyncOut && rig.in.InSync) << profile;
    EXPECT_EQ(rig.status().WaitingFunctionState, 5);
    ASSERT_TRUE(rig.run_until([&] { return rig.out.StartSyncOut; }));
    EXPECT_TRUE(rig.in.CommandAborted);
    EXPECT_EQ(rig.status().FunctionState, 5);
    EXPECT_TRUE(has_bit(rig.f.data.StatusWord2, Status2Bit::DesynchronizingCommand));
    while (!rig.out.Done) {
      rig.tick();
      ASSERT_LE(rig.f.setpoint().velocity, 1e-9);  // in negative direction only
      ASSERT_TRUE(rig.out.Busy || rig.out.Done);
    }
    EXPECT_EQ(rig.f.setpoint().position.value, 30.0);
    rig.run(2);
    EXPECT_FALSE(bit(rig.wave, CamStatusBit::Control));
  }
}

/// Over a distance that is long against the cam's waves it would turn back and come from the other side.
TEST(MC_CamOut, OverALongDistanceDoesNotTurnBackWithTheCam) {
  CamPair rig(line, fast_ring);
  rig.in.Cam = &rig.cam("Staircase", {{0, 0}, {100, 200}}, 0);
  auto& data = *static_cast<CamData1k*>(rig.in.Cam->data_block());
  data.ValidPoint = {};
  data.Segment[0] = {.xmin = 0.0, .xmax = 100.0, .a0 = 25.0, .a1 = 2.0};
  data.Segment[0].sineAmplitude = -25.0;
  data.Segment[0].sinePeriod = 0.02 * std::acos(-1.0);
  data.Segment[0].sinePhase = 0.5 * std::acos(-1.0);
  data.ValidSegment[0] = true;
  CamInterpolator interpolator(kCamPoints);
  ASSERT_EQ(rig.in.Cam->interpolate(interpolator), ErrorId::none);
  rig.in.SyncProfileReference = 2;
  rig.in.ApplicationMode = 2;
  rig.in.SlaveScaling = -2.0;
  rig.in.Execute = true;
  rig.start_leading(60.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  rig.run(300);
  rig.out.SyncProfileReference = 1;
  rig.out.SlavePosition = 10.0;
  rig.out.MasterStopDistance = 200.0;
  rig.out.SyncOutDirection = 2;
  rig.out.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.out.StartSyncOut; }));
  while (!rig.out.Done && !HasFailure()) {
    rig.tick();
    ASSERT_LE(rig.f.setpoint().velocity, 1e-6);
  }
}

/// What else moves the axis past the start position does not begin it, be it that the leading value stands
/// or that it creeps: over its distance the axis would be thrown far beyond.
TEST(MC_CamOut, OverADistanceBeginsOnlyOnceTheLeadingValueCanLeadIt) {
  for (const double velocity : {0.0, 0.5}) {
    CamPair rig;
    auto& superimpose = rig.block<MC_MoveSuperimposed>();
    rig.couple(300.0);
    rig.start_leading(velocity);
    rig.continuity[1].highest_acceleration = 1e4;
    superimpose.Axis = &rig.f;
    superimpose.Distance = 200.0;
    superimpose.VelocityDiff = 50.0;
    superimpose.Execute = true;
    rig.out.SyncProfileReference = 1;
    rig.out.SlavePosition = 70.0;
    rig.out.MasterStopDistance = 40.0;
    rig.out.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return superimpose.Done || superimpose.CommandAborted; }));
    EXPECT_TRUE(superimpose.Done) << velocity;
    EXPECT_GT(rig.f.setpoint().position.value, 195.0);
    EXPECT_EQ(rig.status().WaitingFunctionState, 5);
    EXPECT_TRUE(rig.in.InSync && rig.out.Busy);

    rig.continuity[1].highest_acceleration = 1e6;
    rig.start_leading(300.0);
    superimpose.Execute = false;
    rig.run(1);
    rig.continuity[1].highest_acceleration = 1e4;
    superimpose.Distance = -190.0;
    superimpose.VelocityDiff = 20.0;
    superimpose.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.out.Done; }));
    EXPECT_EQ(rig.f.setpoint().position.value, 70.0);
    EXPECT_TRUE(rig.in.CommandAborted && superimpose.CommandAborted);
  }
}

TEST(MC_CamOut, LeavesGearsAloneAndCancelsWhatWaits) {
  CamPair rig;
  rig.out.MasterStopDistance = 10.0;
  rig.out.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.out.ErrorID, WORD{0x8078});
  rig.out.Execute = false;
  rig.start_leading(50.0);
  rig.in.MasterSyncPosition = 300.0;
  rig.in.MasterStartDistance = 10.0;
  rig.in.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.in.Busy);
  rig.out.SyncProfileReference = 5;
  rig.out.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.out.Done && rig.in.CommandAborted);
}

/// One that waits to couple and one that waits to leave the gear at hand: the later one shows, then the
/// other.
TEST(WaitingFunctionState, ShowsTheJobThatStillWaitsWhenTheOtherEnds) {
  CamPair rig;
  auto& gear = rig.block<MC_GearIn>();
  auto& gear_out = rig.block<MC_GearOut>();
  gear.Master = &rig.l;
  gear.Slave = gear_out.Slave = &rig.f;
  rig.start_leading(50.0);
  gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return gear.InGear; }));
  rig.in.MasterSyncPosition = 300.0;
  rig.in.MasterStartDistance = 10.0;
  rig.in.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.status().WaitingFunctionState, 3);
  gear_out.SlavePosition = rig.f.setpoint().position.value + 60.0;
  gear_out.MasterStopDistance = 20.0;
  gear_out.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.status().WaitingFunctionState, 4);
  ASSERT_TRUE(rig.run_until([&] { return gear_out.StartSyncOut; }));
  EXPECT_TRUE(rig.in.Busy);
  EXPECT_EQ(rig.status().FunctionState, 4);
  EXPECT_EQ(rig.status().WaitingFunctionState, 3);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  EXPECT_EQ(rig.status().WaitingFunctionState, 0);
}

}  // namespace
}  // namespace lockstep::camming_end_test
