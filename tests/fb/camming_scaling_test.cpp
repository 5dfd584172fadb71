// MC_CamIn with scalings at the ends of what is permitted, and profile 6 with both axes in their places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "fb/cam_in.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/coupled_rig.hpp"

namespace lockstep::camming_scaling_test {
namespace {

constexpr double kLength = 360.0;  // of the cams [leading u]

void ring(AxisData& data) {
  data.Modulo.Enable = true;
  data.Modulo.Length = kLength;
}

/// Both axes homed, the leading one at `place`, and two cams that rise and come back.
struct Scaled : test::CoupledRig {
  explicit Scaled(const Shape& leading, const Shape& following, double place = 0.0,
                  double following_place = 0.0)
      : CoupledRig(leading, following),
        in(block<MC_CamIn>()),
        next(block<MC_CamIn>()),
        wave(cam("Wave", {{0, 0}, {90, 45}, {180, 90}, {270, 45}, {kLength, 0}})),
        ramp(cam("Ramp", {{0, 0}, {kLength, 180}})) {
    in.Master = next.Master = &l;
    in.Slave = next.Slave = &f;
    in.Cam = &wave;
    next.Cam = &ramp;
    in.MasterStartDistance = 60.0;
    home_l.Mode = home_f.Mode = 0;
    home_l.Position = place;
    home_f.Position = following_place;
    continuity[0].homing = continuity[1].homing = true;
    begin();
    continuity[1].highest_acceleration = 1e7;
    continuity[1].highest_jerk = 1e11;
  }

  Cam& cam(const char* name, const std::vector<TO_Cam_Struct_PointData>& points) {
    Cam& made = static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, name));
    static_cast<CamData1k*>(made.data_block())->InterpolationSettings = {1, 1};
    for (std::size_t i = 0; i < points.size(); ++i) made.define_point(i, points[i]);
    CamInterpolator interpolator(kCamPoints);
    EXPECT_EQ(made.interpolate(interpolator), ErrorId::none);
    return made;
  }

  MC_CamIn& in;
  MC_CamIn& next;
  Cam& wave;
  Cam& ramp;
};

TEST(CamScaling, SlaveScaling0BringsTheAxisToSlaveOffsetAndKeepsItThere) {
  for (const auto& following : {test::line, ring})
    for (const DINT mode : {0, 1, 2})
      for (const DINT profile : {0, 1, 3, 4, 6}) {
        SCOPED_TRACE(::testing::Message() << "mode " << mode << " profile " << profile);
        Scaled rig(ring, following, 0.0, 20.0);
        rig.in.SlaveScaling = 0.0;
        rig.in.SlaveOffset = 35.0;
        rig.in.ApplicationMode = mode;
        rig.in.SyncProfileReference = profile;
        rig.in.MasterSyncPosition = profile == 4 ? 0.0 : 80.0;
        rig.in.Execute = true;
        rig.start_leading(200.0);
        ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync || rig.in.Error; }, 8000));
        ASSERT_TRUE(rig.in.InSync) << static_cast<unsigned>(rig.in.ErrorID);
        for (int i = 0; i < 1000; ++i) {
          rig.tick();
          ASSERT_EQ(rig.f.data.Position, 35.0);
          ASSERT_EQ(rig.f.data.Velocity, 0.0);
        }
        EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.SlaveScaling, 0.0);
      }
}

TEST(CamScaling, SlaveScaling0LeavesTheAxisWhereItIsSetSynchronous) {
  Scaled rig(ring, ring, 10.0, 20.0);
  rig.in.SlaveScaling = 0.0;
  rig.in.ApplicationMode = 1;
  rig.in.SyncProfileReference = 2;
  rig.in.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.in.InSync);
  rig.start_leading(200.0);
  for (int i = 0; i < 4000; ++i) {
    rig.tick();
    ASSERT_EQ(rig.f.data.Position, 20.0);
  }
  EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.SlaveOffset, 20.0);
}

/// Profile 5: out of a cam and into it again, at its ends.
TEST(CamScaling, SlaveScaling0TakesTurnsWithAnotherAtTheEndOfTheCam) {
  Scaled rig(ring, test::line);
  rig.in.ApplicationMode = rig.next.ApplicationMode = 1;
  rig.in.SyncProfileReference = 2;
  rig.in.Execute = true;
  rig.start_leading(200.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  rig.next.Cam = &rig.wave;
  rig.next.SyncProfileReference = 5;
  rig.next.SlaveScaling = 0.0;
  rig.next.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.next.InSync; }));
  const double end = rig.f.data.Position;
  EXPECT_NEAR(end, 0.0, 1e-9);
  for (int i = 0; i < 500; ++i) {
    rig.tick();
    ASSERT_EQ(rig.f.data.Position, end);
  }
  rig.in.Execute = false;
  rig.tick();
  rig.in.SyncProfileReference = 5;
  rig.in.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  double highest = 0.0;
  for (int i = 0; i < 1800; ++i) {
    rig.tick();
    highest = std::max(highest, rig.f.data.Position);
  }
  EXPECT_NEAR(highest, end + 90.0, 0.1);
}

/// The cam ends with a slope, which the scaling takes away: nothing has to be braked.
TEST(CamScaling, SlaveScaling0RestsAtTheEndOfACamThatIsPassedOnce) {
  Scaled rig(test::line, test::line);
  rig.in.Cam = &rig.ramp;
  rig.in.SlaveScaling = 0.0;
  rig.in.SyncProfileReference = 2;
  rig.in.Execute = true;
  rig.start_leading(200.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.EndOfProfile; }));
  EXPECT_TRUE(rig.f.setpoint().standing());
  EXPECT_EQ(rig.f.data.Position, 0.0);
  EXPECT_FALSE(rig.in.Error);
}

TEST(CamScaling, MasterScalingCountsByTheLengthOfAPass) {
  struct Case {
    double scaling;
    DINT mode;
    bool permitted;
  };
  const Case cases[] = {{1e-9, 0, true},     {1e-14, 0, true},   {1e-15, 0, false}, {3e-9, 1, true},
                        {2e-9, 1, false},    {-3e-9, 2, true},   {1e-9, 2, false},  {1e10, 0, true},
                        {1e10, 1, true},     {-1e10, 2, true},   {1e12, 1, true},   {1.1e12, 1, false},
                        {-1.1e12, 0, false}, {5e-324, 0, false}, {0.0, 0, false}};
  for (const Case& one : cases) {
    SCOPED_TRACE(::testing::Message() << one.scaling << " mode " << one.mode);
    Scaled rig(test::line, test::line);
    rig.continuity[1].velocity = false;
    rig.in.MasterScaling = one.scaling;
    rig.in.ApplicationMode = one.mode;
    rig.in.SyncProfileReference = 2;
    rig.in.Execute = true;
    rig.run(3);
    EXPECT_EQ(rig.in.InSync, one.permitted);
    EXPECT_EQ(rig.in.ErrorID, one.permitted ? WORD{} : static_cast<WORD>(ErrorId::master_scaling));
  }
}

TEST(CamScaling, AMasterScalingOf1E10CreepsAlongTheCamWithoutRounding) {
  Scaled rig(test::line, test::line);
  rig.in.MasterScaling = 1e10;
  rig.in.ApplicationMode = 1;
  rig.in.SyncProfileReference = 2;
  rig.in.Execute = true;
  rig.start_leading(5000.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
  for (int i = 0; i < 3000; ++i) {
    rig.tick();
    const CamValue at = rig.wave.function().value(rig.l.data.Position / 1e10);
    ASSERT_NEAR(rig.f.data.Position, at.position, 1e-15);
  }
}

/// Nothing is shifted, and the axes are synchronous at once.
TEST(CamProfile6, WithBothAxesStandingOnTheirSynchronousPositionsIsSynchronousAtOnce) {
  for (const auto& following : {test::line, ring})
    for (const double place : {0.0, 90.0, 200.0}) {
      SCOPED_TRACE(place);
      Scaled rig(ring, following, place);
      const double value = rig.wave.function().value(place).position;
      rig.home_f.Execute = false;
      rig.run(2);
      rig.home_f.Position = value + 5.0;
      rig.home_f.Execute = true;
      rig.run(3);
      rig.in.SyncProfileReference = 6;
      rig.in.ApplicationMode = 1;
      rig.in.MasterSyncPosition = place;
      rig.in.SlaveOffset = 5.0;
      rig.in.Execute = true;
      rig.run(2);
      EXPECT_TRUE(rig.in.InSync);
      EXPECT_EQ(rig.f.data.StatusSynchronizedMotion.MasterOffset, 0.0);
      rig.start_leading(100.0);
      for (int i = 0; i < 2000; ++i) {
        rig.tick();
        ASSERT_NEAR(rig.f.data.Position, rig.wave.function().value(rig.l.data.Position).position + 5.0, 1e-9);
      }
    }
}

TEST(CamProfile6, WithOneAxisElsewhereWaitsForMotion) {
  Scaled rig(ring, test::line, 90.0, 40.0);
  rig.in.SyncProfileReference = 6;
  rig.in.ApplicationMode = 1;
  rig.in.MasterSyncPosition = 90.0;
  rig.in.Execute = true;
  rig.run(50);
  EXPECT_TRUE(rig.in.Busy && !rig.in.InSync);
  rig.start_leading(100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.in.InSync; }));
}

}  // namespace
}  // namespace lockstep::camming_scaling_test
