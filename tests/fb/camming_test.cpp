// Camming on virtual axes, through MC_CamIn: following, shifting, refusals.
#include <gtest/gtest.h>

#include <cmath>

#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/phasing.hpp"
#include "fb/superimposed.hpp"
#include "tests/fb/cam_pair.hpp"

namespace lockstep::camming_test {
namespace {

using test::bit;
using test::CamPair;
using test::fast_ring;

// ---- Following
// --------------------------------------------------------------------------------------------------

TEST(MC_CamIn, FollowsTheCamInEveryTickAfterAHundredThousandTurnsAsInTheFirst) {
  CamPair rig;
  rig.couple();
  EXPECT_TRUE(bit(rig.f, StatusBit::Synchronous));
  EXPECT_EQ(rig.status().FunctionState, 3);
  EXPECT_EQ(rig.status().ActualCam, rig.wave.number);
  EXPECT_EQ(rig.status().ActualMaster, rig.l.number);
  const auto follow = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      rig.tick();
      const CamValue reference = rig.wave.function().value(rig.leading());
      ASSERT_NEAR(rig.f.setpoint().position.value, reference.position, 1e-12 * 50.0);
      ASSERT_NEAR(rig.f.setpoint().velocity, reference.first_derivative * rig.l.setpoint().velocity,
                  1e-9 * std::abs(rig.l.setpoint().velocity));
    }
  };
  follow(2000);
  rig.continuity[1].velocity = false;  // a turn and more per tick
  rig.start_leading(359'000.0);
  follow(101'000);
  EXPECT_GT(rig.l.setpoint().position.turns, 100'000);
}

TEST(MC_CamIn, PassesACamBackwards) {
  CamPair rig;
  rig.couple(-500.0);
  int ends = 0;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    ends += rig.in.EndOfProfile;
    ASSERT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(rig.leading()).position, 5e-11);
  }
  EXPECT_EQ(ends, 4);  // 1500 units
}

TEST(MC_CamIn, ScalesAndShiftsTheCam) {
  CamPair rig;
  rig.in.MasterOffset = 40.0;
  rig.in.SlaveOffset = 7.0;
  rig.in.MasterScaling = 0.5;
  rig.in.SlaveScaling = -2.0;
  rig.in.MasterSyncPosition = 20.0;
  rig.couple();
  EXPECT_EQ(rig.status().MasterOffset, 40.0);
  EXPECT_EQ(rig.status().SlaveOffset, 7.0);
  EXPECT_EQ(rig.status().MasterScaling, 0.5);
  EXPECT_EQ(rig.status().SlaveScaling, -2.0);
  EXPECT_EQ(rig.status().Offset, 7.0);
  for (int i = 0; i < 2000; ++i) {
    rig.tick();
    const double u = std::fmod(rig.leading() - 40.0 + 360.0, 180.0) / 0.5;
    const double function = -2.0 * rig.wave.function().value(u).position;
    ASSERT_NEAR(rig.status().FunctionFollowingValue.Position, function, 1e-10);
    ASSERT_NEAR(rig.f.setpoint().position.value, function + 7.0, 1e-10);
  }
}

TEST(MC_CamIn, AppendsPassesAndSeveralAxesShareACam) {
  CamPair rig;
  rig.in.Cam = &rig.feed;
  rig.start_leading(720.0);
  rig.in.ApplicationMode = 2;
  rig.in.MasterStartDistance = 90.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  const auto first = rig.l.setpoint().position.turns;
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    const auto passes = static_cast<double>(rig.l.setpoint().position.turns - first);
    ASSERT_NEAR(rig.f.setpoint().position.value,
                rig.feed.function().value(rig.leading()).position + 40.0 * passes, 1e-9);
  }
}

TEST(MC_CamIn, IsLeftByItsSimulationOnARingAfterAWholeTurn) {
  CamPair rig(fast_ring, fast_ring);
  auto& simulation = rig.block<MC_SynchronizedMotionSimulation>();
  auto& turn = rig.block<MC_MoveRelative>();
  simulation.Slave = &rig.f;
  turn.Axis = &rig.l;
  turn.Distance = 9 * 360.0;  // 9 passes of 40: one turn of the following axis
  turn.Velocity = 5000.0;
  rig.in.Cam = &rig.feed;
  rig.in.ApplicationMode = 2;
  rig.in.MasterStartDistance = 90.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  simulation.Enable = true;
  rig.run(2);
  turn.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return turn.Done; }));
  simulation.Enable = false;
  rig.run(2);
  EXPECT_FALSE(simulation.InSimulation);
  EXPECT_EQ(rig.f.setpoint().position.turns, 0);
  rig.start_leading(720.0);
  rig.run(1000);
  EXPECT_GT(rig.f.data.Position, 40.0);
  EXPECT_TRUE(has_bit(rig.f.data.StatusWord, StatusBit::Synchronous));
}

TEST(MC_CamIn, ShowsTheEndOfEachPassForOneCall) {
  CamPair rig;
  rig.couple(720.0);
  int ends = 0;
  bool last = false;
  for (int i = 0; i < 5000; ++i) {
    rig.tick();
    EXPECT_FALSE(last && rig.in.EndOfProfile);
    last = rig.in.EndOfProfile;
    ends += last;
    EXPECT_TRUE(rig.in.InSync && rig.in.Busy);
  }
  EXPECT_EQ(ends, 10);
}

TEST(MC_CamIn, ShowsTheEndOfEachPassWhileItIsSimulated) {
  CamPair rig;
  auto& simulation = rig.block<MC_SynchronizedMotionSimulation>();
  simulation.Slave = &rig.f;
  rig.in.ApplicationMode = 1;
  rig.in.MasterStartDistance = 100.0;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  simulation.Enable = true;
  rig.run(2);
  rig.start_leading(720.0);
  int ends = 0;
  for (int i = 0; i < 5000; ++i) {
    rig.tick();
    ends += rig.in.EndOfProfile;
  }
  EXPECT_EQ(ends, 10);
  EXPECT_TRUE(simulation.InSimulation);
  EXPECT_TRUE(rig.in.InSync);
}

// ---- Phase shift and offset
// ---------------------------------------------------------------------------------------

TEST(MC_CamIn, IsShiftedByPhasingAndOffset) {
  CamPair rig;
  auto& phasing = rig.block<MC_PhasingAbsolute>();
  auto& offset = rig.block<MC_OffsetRelative>();
  phasing.Master = &rig.l;
  phasing.Slave = offset.Slave = &rig.f;
  rig.in.SlaveOffset = 2.0;
  rig.couple();
  phasing.PhaseShift = 25.0;
  phasing.PhasingDistance = 100.0;
  phasing.Execute = true;
  rig.run(3);
  EXPECT_EQ(phasing.ErrorID, WORD{0x80A8});  // ProfileReference 0
  phasing.Execute = false;
  rig.tick();
  phasing.ProfileReference = 1;
  phasing.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return phasing.Done; }));
  offset.Offset = 5.0;
  offset.OffsetDistance = 80.0;
  offset.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return offset.Done; }));
  EXPECT_EQ(rig.status().Offset, 7.0);
  EXPECT_EQ(rig.status().PhaseShift, 25.0);
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    const double u = std::fmod(rig.leading() + 25.0, 360.0);
    ASSERT_NEAR(rig.f.setpoint().position.value, rig.wave.function().value(u).position + 7.0, 1e-10);
    ASSERT_NEAR(rig.status().FunctionLeadingValue.Position, u, 1e-9);
  }
}

TEST(MC_CamIn, FollowsTheAdditiveLeadingValueAndCarriesASuperimposedMotion) {
  CamPair rig;
  auto& additive = rig.block<MC_LeadingValueAdditive>();
  auto& superimposed = rig.block<MC_MoveSuperimposed>();
  additive.Axis = superimposed.Axis = &rig.f;
  superimposed.Distance = 40.0;
  superimposed.VelocityDiff = 100.0;
  rig.couple(360.0);
  rig.continuity[1].velocity = false;  // the velocity of what is added is not told
  additive.Enable = true;
  superimposed.Execute = true;
  double added = 0.0;  // in effect
  double carried = 0.0;
  for (int i = 0; i < 3000; ++i) {
    additive.Position = 30.0 * std::sin(0.002 * i);
    rig.tick();
    const double u = std::fmod(rig.leading() + added + 360.0, 360.0);
    added = additive.Position;
    const double rest = rig.f.setpoint().position.value - rig.wave.function().value(u).position;
    ASSERT_NEAR(rig.status().EffectiveLeadingValue.Position, u, 1e-9);
    ASSERT_GE(rest, carried - 1e-9) << i;
    ASSERT_NEAR(rest, rig.f.data.StatusPositioning.SuperimposedDistance, 1e-9);
    carried = rest;
    ASSERT_TRUE(rig.in.InSync);
  }
  EXPECT_TRUE(superimposed.Done);
  EXPECT_NEAR(carried, 40.0, 1e-9);
}

// ---- Refusals
// ---------------------------------------------------------------------------------------------------

TEST(MC_CamIn, RefusesWhatCannotBe) {
  struct Case {
    void (*change)(CamPair&);
    unsigned error;
  };
  const Case cases[] = {
      {[](CamPair& rig) { rig.in.MasterStartDistance = 0.0; }, 0x8026},
      {[](CamPair& rig) { rig.in.MasterScaling = 0.0; }, 0x8023},
      {[](CamPair& rig) { rig.in.SlaveScaling = std::nan(""); }, 0x8024},
      {[](CamPair& rig) { rig.in.MasterScaling = 1e300; }, 0x8023},
      {[](CamPair& rig) { rig.in.SlaveScaling = 1e300; }, 0x8024},
      {[](CamPair& rig) { rig.in.MasterOffset = 1e300; }, 0x8021},
      {[](CamPair& rig) { rig.in.SlaveOffset = 1e300; }, 0x8022},
      {[](CamPair& rig) { rig.in.MasterOffset = std::nan(""); }, 0x8021},
      {[](CamPair& rig) { rig.in.ApplicationMode = 3; }, 0x8027},
      {[](CamPair& rig) { rig.in.SyncProfileReference = 7; }, 0x8036},
      {[](CamPair& rig) { rig.in.MasterSyncPosition = 361.0; }, 0x80AD},
      {[](CamPair& rig) { rig.in.MasterSyncPosition = -1.0; }, 0x80AD},
      {[](CamPair& rig) { rig.in.SyncProfileReference = 5; }, 0x808B},
      {[](CamPair& rig) {
         rig.in.Cam = &rig.feed;
         rig.in.ApplicationMode = 1;
       },
       0x80AC},
  };
  for (const Case& test : cases) {
    CamPair rig;
    rig.in.MasterStartDistance = 10.0;
    rig.start_leading(10.0);
    test.change(rig);
    rig.in.Execute = true;
    rig.run(3);
    EXPECT_TRUE(rig.in.Error) << std::hex << test.error;
    EXPECT_EQ(rig.in.ErrorID, static_cast<WORD>(test.error)) << std::hex << test.error;
    EXPECT_FALSE(rig.in.Busy);
  }
}

TEST(MC_CamIn, RaisesAlarm612ForACamThatIsNotInterpolated) {
  CamPair rig;
  rig.in.Cam = &static_cast<Cam&>(rig.controller.add_object(ObjectKind::TO_Cam, "Empty"));
  rig.in.MasterStartDistance = 10.0;
  rig.in.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.in.ErrorID, WORD{0x8001});
  EXPECT_EQ(rig.f.pending_alarm(), alarm::kCamNotInterpolated);
}

}  // namespace
}  // namespace lockstep::camming_test
