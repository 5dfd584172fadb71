// Couplings at given positions need a following axis that is homed; others do not.
#include <gtest/gtest.h>

#include "fb/cam_in.hpp"
#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "tests/support/bent_cam.hpp"
#include "tests/support/coupled_rig.hpp"

namespace lockstep::not_homed_test {
namespace {

constexpr double kPass = 100.0;  // of the cam [u]

/// Both axes enabled; none is homed before `home_f` is told so.
struct NotHomed : test::CoupledRig {
  /// @param driven the following axis has a drive, and a zero mark that it does not come to
  explicit NotHomed(bool driven = false)
      : CoupledRig(ring, driven ? driven_ring : ring),
        gear(block<MC_GearIn>()),
        velocity(block<MC_GearInVelocity>()),
        pos(block<MC_GearInPos>()),
        cam_in(block<MC_CamIn>()),
        reset(block<MC_Reset>()) {
    gear.Master = velocity.Master = pos.Master = cam_in.Master = &l;
    gear.Slave = velocity.Slave = pos.Slave = cam_in.Slave = &f;
    reset.Axis = &f;
    cam_in.Cam = &test::add_bent_cam(controller, kPass);
    cam_in.ApplicationMode = 2;
    home_f.Mode = 0;
    f.drive_settings.signals.zero_marks = ZeroMarks{1e6, 0.0};
    power_l.Enable = power_f.Enable = true;
    run(3);
    continuity[1].highest_acceleration = 1e7;
    continuity[1].highest_jerk = 1e10;
  }
  static void ring(AxisData& data) {
    data.Modulo.Enable = true;
    data.Modulo.Length = kPass;
  }
  static void driven_ring(AxisData& data) {
    ring(data);
    data.VirtualAxis.Mode = 0;
  }
  bool homed() const { return has_bit(f.data.StatusWord, StatusBit::HomingDone); }
  void acknowledge() {
    reset.Execute = false;
    run(2);
    reset.Execute = true;
    run(3);
    ASSERT_TRUE(reset.Done);
    ASSERT_EQ(f.data.ErrorDetail.Number, 0u);
  }

  MC_GearIn& gear;
  MC_GearInVelocity& velocity;
  MC_GearInPos& pos;
  MC_CamIn& cam_in;
  MC_Reset& reset;
};

/// Refused in every profile, with the axis at rest; one homing later taken over.
template <class Block>
void expect_refused_until_homed(NotHomed& rig, Block& block, DINT profile) {
  SCOPED_TRACE(profile);
  block.SyncProfileReference = profile;
  block.MasterStartDistance = 10.0;
  block.Execute = true;
  rig.run(3);
  EXPECT_TRUE(block.Error);
  EXPECT_EQ(block.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  EXPECT_EQ(rig.f.data.ErrorDetail.Number, 321u);
  EXPECT_FALSE(block.Busy);
  block.Execute = false;
  rig.acknowledge();
  rig.home_f.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.homed());
  block.Execute = true;
  rig.run(3);
  EXPECT_FALSE(block.Error);
  EXPECT_EQ(block.ErrorID, WORD{});
  EXPECT_TRUE(block.Busy);
  EXPECT_EQ(rig.f.data.ErrorDetail.Number, 0u);
}

TEST(NotHomed, MC_GearInPosIsRefusedInEveryProfile) {
  for (const DINT profile : {0, 1, 3}) {
    NotHomed rig;
    expect_refused_until_homed(rig, rig.pos, profile);
  }
}

TEST(NotHomed, MC_CamInIsRefusedInEveryProfile) {
  for (const DINT profile : {0, 1, 2, 3, 4, 6}) {
    NotHomed rig;
    expect_refused_until_homed(rig, rig.cam_in, profile);
  }
}

TEST(NotHomed, OtherGearsNeedNoHoming) {
  NotHomed rig;
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.velocity.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.velocity.InSync; }));
  EXPECT_FALSE(rig.homed());
  EXPECT_EQ(rig.f.data.ErrorDetail.Number, 0u);
}

TEST(NotHomed, InMotionTheAxisIsBrakedByTheReactionOfTheAlarm) {
  NotHomed rig;
  rig.start_leading(50.0);
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear && rig.run_l.InVelocity; }));
  rig.pos.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.pos.Error);
  EXPECT_TRUE(rig.gear.Error);
  EXPECT_EQ(rig.f.data.ErrorDetail.Number, 321u);
  ASSERT_TRUE(rig.run_until([&] { return rig.f.data.Velocity == 0.0; }));
}

/// The table of overriding lets passive homing run beside a coupling that waits.
TEST(NotHomed, ACouplingThatWaitsStaysWhenItsAxisLooksForAnotherMark) {
  NotHomed rig(true);
  rig.run(20);
  rig.home_f.Execute = true;
  rig.run(3);
  rig.pos.SyncProfileReference = 3;
  rig.pos.MasterSyncPosition = 20.0;
  rig.pos.MasterStartDistance = 40.0;
  rig.pos.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.pos.Busy);
  rig.home_f.Execute = false;
  rig.run(2);
  rig.home_f.Mode = 8;
  rig.home_f.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.pos.Busy);
  EXPECT_FALSE(rig.homed());
  rig.start_leading(50.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.pos.InSync; }));
  EXPECT_TRUE(rig.home_f.Busy);
}

}  // namespace
}  // namespace lockstep::not_homed_test
