// MC_InterpolateCam on cams that virtual axes follow, and what the curve in effect gives.
#include <gtest/gtest.h>

#include "fb/cam_value.hpp"
#include "tests/fb/cam_pair.hpp"

namespace lockstep::cam_interpolation_at_run_time_test {
namespace {

using test::bit;
using test::CamPair;

TEST(MC_InterpolateCam, TakesEffectAtTheNextInterpolatorTick) {
  CamPair rig;
  auto& data = *static_cast<CamData1k*>(rig.wave.data_block());
  rig.run(6);
  EXPECT_TRUE(bit(rig.wave, CamStatusBit::Interpolated));
  EXPECT_FALSE(bit(rig.wave, CamStatusBit::CamDataChanged));
  data.Point[2].y = 60.0;
  rig.run(5);
  EXPECT_TRUE(bit(rig.wave, CamStatusBit::CamDataChanged));
  EXPECT_TRUE(bit(rig.wave, CamStatusBit::Interpolated));
  EXPECT_EQ(rig.wave.function().value(180.0).position, 50.0);
  rig.interpolate.Execute = true;
  rig.tick();
  EXPECT_TRUE(rig.interpolate.Busy);
  EXPECT_TRUE(bit(rig.wave, CamStatusBit::InInterpolation));
  EXPECT_EQ(rig.wave.function().value(180.0).position, 50.0);
  rig.tick();
  EXPECT_TRUE(rig.interpolate.Done);
  EXPECT_FALSE(bit(rig.wave, CamStatusBit::InInterpolation));
  EXPECT_FALSE(bit(rig.wave, CamStatusBit::CamDataChanged));
  EXPECT_EQ(rig.wave.function().value(180.0).position, 60.0);
}

TEST(MC_InterpolateCam, LeavesTheCurveInEffectAfterAnError) {
  CamPair rig;
  auto& data = *static_cast<CamData1k*>(rig.wave.data_block());
  data.ValidPoint.fill(false);
  rig.interpolate.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.interpolate.ErrorID, WORD{0x80AA});
  EXPECT_TRUE(bit(rig.wave, CamStatusBit::Interpolated));
  EXPECT_TRUE(bit(rig.wave, CamStatusBit::CamDataChanged));
  EXPECT_EQ(rig.wave.function().value(180.0).position, 50.0);
}

TEST(MC_InterpolateCam, IsRefusedWhileTheCamIsInUseAndWritingChangesNothing) {
  CamPair rig;
  rig.couple();
  static_cast<CamData1k*>(rig.wave.data_block())->Point[2].y = 60.0;
  rig.interpolate.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.interpolate.ErrorID, WORD{0x80AB});
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    ASSERT_LE(rig.f.setpoint().position.value, 52.0);
  }
}

TEST(MC_InterpolateCam, ShutsACamForJobsMeanwhile) {
  CamPair rig;
  rig.start_leading(10.0);
  rig.in.MasterStartDistance = 10.0;
  rig.interpolate.Execute = rig.in.Execute = true;  // MC_CamIn is called first, its job starts later
  rig.controller.interpolate_cams_elsewhere(true);
  rig.run(3);
  EXPECT_EQ(rig.in.ErrorID, WORD{0x80E8});
  EXPECT_TRUE(rig.interpolate.Busy);
  EXPECT_TRUE(rig.controller.interpolate_cams());
  EXPECT_FALSE(rig.controller.interpolate_cams());
  rig.tick();
  EXPECT_TRUE(rig.interpolate.Done);
}

TEST(MC_GetCamValue, ReadsTheCurveInBothDirections) {
  CamPair rig;
  auto& following = rig.block<MC_GetCamFollowingValue>();
  auto& leading = rig.block<MC_GetCamLeadingValue>();
  following.Cam = leading.Cam = &rig.wave;
  following.LeadingValue = 100.0;
  following.Execute = true;
  rig.tick();
  ASSERT_TRUE(following.Done);
  const CamValue reference = rig.wave.function().value(100.0);
  EXPECT_EQ(following.Value, reference.position);
  EXPECT_EQ(following.FirstDerivative, reference.first_derivative);
  EXPECT_EQ(following.SecondDerivative, reference.second_derivative);
  leading.FollowingValue = following.Value;
  for (const double approach : {80.0, 300.0}) {
    leading.ApproachLeadingValue = approach;
    leading.Execute = false;
    rig.tick();
    leading.Execute = true;
    rig.tick();
    ASSERT_TRUE(leading.Done);
    EXPECT_NEAR(rig.wave.function().value(leading.Value).position, following.Value, 1e-10);
    EXPECT_EQ(leading.Value < 180.0, approach < 180.0);
  }
  following.LeadingValue = 361.0;
  leading.FollowingValue = 1000.0;
  following.Execute = leading.Execute = false;
  rig.tick();
  following.Execute = leading.Execute = true;
  rig.tick();
  EXPECT_EQ(following.ErrorID, WORD{0x8064});
  EXPECT_EQ(leading.ErrorID, WORD{0x8063});
}

}  // namespace
}  // namespace lockstep::cam_interpolation_at_run_time_test
