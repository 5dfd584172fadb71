// The data of a cam at run time: MC_CopyCamData, and MC_Reset with Restart.
#include <gtest/gtest.h>

#include <vector>

#include "fb/cam_in.hpp"
#include "fb/cam_value.hpp"
#include "fb/copy_cam_data.hpp"
#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::cam_data_test {
namespace {

using Point = TO_Cam_Struct_PointData;
using Segment = TO_Cam_Struct_SegmentData;

/// A cam with two points and a segment, and arrays that count from -2 and from 10.
struct CamRig : test::Rig {
  explicit CamRig(ObjectKind kind = ObjectKind::TO_Cam)
      : cam(static_cast<Cam&>(controller.add_object(kind, "Cam"))),
        l(axis("Leading")),
        f(axis("Following")),
        power_l(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home_f(block<MC_Home>()),
        run_l(block<MC_MoveVelocity>()),
        in(block<MC_CamIn>()),
        copy(block<MC_CopyCamData>()),
        interpolate(block<MC_InterpolateCam>()),
        reset(block<MC_Reset>()) {
    cam.define_point(0, {0.0, 0.0});
    cam.define_point(1, {100.0, 100.0});
    cam.define_segment(0, {.xmin = 40.0, .xmax = 60.0, .a1 = 1.0});
    CamInterpolator interpolator(cam.point_count());
    EXPECT_EQ(cam.interpolate(interpolator), ErrorId::none);
    for (std::size_t i = 0; i < points.size(); ++i)
      points[i] = {static_cast<double>(i), 2.0 * static_cast<double>(i)};
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const double x = 20.0 * static_cast<double>(i);
      segments[i] = {.xmin = x, .xmax = x + 10.0, .a1 = 2.0};
    }
    points_array = {&kCamPointElement, -2, static_cast<DINT>(points.size()) - 3, points.data()};
    segments_array = {&kCamSegmentElement, 10, static_cast<DINT>(segments.size()) + 9, segments.data()};
    copy.Cam = interpolate.Cam = &cam;
    copy.ArrayOfPoints = &points_array;
    copy.ArrayOfSegments = &segments_array;
    copy.StartPointArray = -2;
    copy.StartSegmentArray = 10;
    reset.Axis = &cam;
    reset.Restart = true;
    lead(f, l);
    power_l.Axis = run_l.Axis = &l;
    power_f.Axis = home_f.Axis = in.Slave = &f;
    in.Master = &l;
    in.Cam = &cam;
    power_l.Enable = power_f.Enable = true;
    run(3);
    home_f.Execute = true;
    run(3);
  }

  /// The axis follows the cam, y = x without end, at 10 u/s.
  void follow() {
    run_l.Velocity = 10.0;
    run_l.Execute = true;
    in.ApplicationMode = 2;
    in.SyncProfileReference = 2;
    in.Execute = true;
    ASSERT_TRUE(run_until([&] { return in.InSync; }));
  }

  CamData1k& data() { return *static_cast<CamData1k*>(cam.data_block()); }
  bool status(CamStatusBit bit) {
    const VariableAddress word = find_variable(cam.kind, "StatusWord");
    return (word.signal(cam.data_block()).load().u >> static_cast<unsigned>(bit) & 1u) != 0;
  }
  ErrorId copied() {
    copy.Execute = false;
    tick();
    copy.Execute = true;
    tick();
    EXPECT_TRUE(run_until([&] { return !copy.Busy; }, 50));
    EXPECT_NE(copy.Done, copy.Error);
    return static_cast<ErrorId>(copy.ErrorID);
  }

  std::vector<Point> points = std::vector<Point>(10000);
  std::vector<Segment> segments = std::vector<Segment>(60);
  Array points_array, segments_array;
  Cam& cam;
  Axis& l;
  Axis& f;
  MC_Power& power_l;
  MC_Power& power_f;
  MC_Home& home_f;
  MC_MoveVelocity& run_l;
  MC_CamIn& in;
  MC_CopyCamData& copy;
  MC_InterpolateCam& interpolate;
  MC_Reset& reset;
};

// ---- MC_CopyCamData
// -----------------------------------------------------------------------------------------------------

TEST(MC_CopyCamData, CopiesPointsAndSegmentsOfOneJobToWhereTheyAreWanted) {
  CamRig rig;
  rig.copy.StartPointArray = 5;  // the eighth of an array from -2
  rig.copy.StartPointCam = 101;
  rig.copy.NumberOfPoints = 3;
  rig.copy.StartSegmentArray = 12;
  rig.copy.StartSegmentCam = 50;
  rig.copy.NumberOfSegments = 1;
  ASSERT_EQ(rig.copied(), ErrorId::none);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(rig.data().Point[100 + i].x, rig.points[7 + i].x);
    EXPECT_EQ(rig.data().Point[100 + i].y, rig.points[7 + i].y);
  }
  EXPECT_EQ(rig.data().Point[103].x, 0.0);
  EXPECT_EQ(rig.data().Segment[49].xmin, 40.0);
  EXPECT_EQ(rig.data().Segment[48].xmax, 0.0);
}

TEST(MC_CopyCamData, Mode0LeavesOnlyWhatItHasCopiedValid) {
  CamRig rig;
  rig.copy.StartPointCam = 2;
  rig.copy.NumberOfPoints = 2;
  rig.copy.StartSegmentCam = 3;
  rig.copy.NumberOfSegments = 1;
  ASSERT_EQ(rig.copied(), ErrorId::none);
  for (std::size_t i = 0; i < kCamPoints; ++i) ASSERT_EQ(rig.data().ValidPoint[i], i == 1 || i == 2) << i;
  for (std::size_t i = 0; i < kCamSegments; ++i) ASSERT_EQ(rig.data().ValidSegment[i], i == 2) << i;
}

TEST(MC_CopyCamData, Mode1LeavesWhatWasValidAndOverwritesInPart) {
  CamRig rig;
  rig.copy.Mode = 1;
  rig.copy.StartPointCam = 2;
  rig.copy.NumberOfPoints = 2;
  rig.copy.StartSegmentCam = 3;
  rig.copy.NumberOfSegments = 1;
  ASSERT_EQ(rig.copied(), ErrorId::none);
  for (std::size_t i = 0; i < kCamPoints; ++i) ASSERT_EQ(rig.data().ValidPoint[i], i <= 2) << i;
  for (std::size_t i = 0; i < kCamSegments; ++i) ASSERT_EQ(rig.data().ValidSegment[i], i == 0 || i == 2) << i;
  EXPECT_EQ(rig.data().Point[0].y, 0.0);
  EXPECT_EQ(rig.data().Point[1].y, 0.0) << "100 before";
}

TEST(MC_CopyCamData, OfNothingMakesTheCamEmptyInMode0AndLeavesItInMode1) {
  for (const DINT mode : {1, 0}) {
    CamRig rig;
    rig.copy.Mode = mode;
    ASSERT_EQ(rig.copied(), ErrorId::none);
    EXPECT_EQ(rig.data().ValidPoint[0], mode == 1);
    EXPECT_EQ(rig.data().ValidSegment[0], mode == 1);
  }
}

TEST(MC_CopyCamData, CountsOnlyAfterTheNextInterpolation) {
  CamRig rig;
  rig.copy.NumberOfPoints = 101;
  ASSERT_EQ(rig.copied(), ErrorId::none);
  EXPECT_TRUE(rig.status(CamStatusBit::CamDataChanged));
  EXPECT_TRUE(rig.status(CamStatusBit::Interpolated));
  EXPECT_EQ(rig.cam.function().value(50.0).position, 50.0);
  rig.run(100);
  EXPECT_TRUE(rig.status(CamStatusBit::CamDataChanged));
  rig.interpolate.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.interpolate.Done);
  EXPECT_FALSE(rig.status(CamStatusBit::CamDataChanged));
  EXPECT_EQ(rig.cam.function().value(50.0).position, 100.0);
}

TEST(MC_CopyCamData, TellsThatTheDataHaveChangedEvenWhereTheyAreTheSame) {
  CamRig rig;
  rig.points[0] = {0.0, 0.0};
  rig.copy.Mode = 1;
  rig.copy.NumberOfPoints = 1;
  EXPECT_FALSE(rig.status(CamStatusBit::CamDataChanged));
  ASSERT_EQ(rig.copied(), ErrorId::none);
  EXPECT_TRUE(rig.status(CamStatusBit::CamDataChanged));
}

TEST(MC_CopyCamData, SpreadsTenThousandPointsOverTenCycles) {
  CamRig rig(ObjectKind::TO_Cam_10k);
  const auto& data = *static_cast<CamData10k*>(rig.cam.data_block());
  rig.copy.NumberOfPoints = 10000;
  rig.copy.NumberOfSegments = 50;
  rig.copy.Execute = true;
  rig.tick();
  EXPECT_TRUE(rig.copy.Busy);
  EXPECT_TRUE(rig.status(CamStatusBit::CopyCamDataActive));
  std::size_t before = 0;
  for (int part = 1; part <= 10; ++part) {
    rig.tick();
    std::size_t there = before;
    while (there < 10000 && data.Point[there].y == rig.points[there].y) ++there;
    EXPECT_EQ(there - before, 1000u) << part;
    before = there;
    EXPECT_EQ(rig.copy.Busy, part < 10);
    EXPECT_EQ(data.ValidPoint[9999], part == 10) << "what is not complete does not count";
    EXPECT_EQ(rig.status(CamStatusBit::CopyCamDataActive), part < 10);
  }
  EXPECT_TRUE(rig.copy.Done);
  EXPECT_EQ(data.Segment[49].xmin, rig.segments[49].xmin);
  EXPECT_TRUE(data.ValidSegment[49]);
}

TEST(MC_CopyCamData, IsTheOnlyOneOfACamAndExcludesInterpolation) {
  CamRig rig(ObjectKind::TO_Cam_10k);
  auto& other = rig.block<MC_CopyCamData>();
  other.Cam = &rig.cam;
  rig.copy.NumberOfPoints = 5000;
  rig.copy.Execute = true;
  rig.tick();
  other.Execute = rig.interpolate.Execute = rig.reset.Execute = true;
  rig.tick();
  EXPECT_EQ(other.ErrorID, WORD{0x80E7});
  EXPECT_EQ(rig.interpolate.ErrorID, WORD{0x80E7});
  EXPECT_EQ(rig.reset.ErrorID, WORD{0x80E7});
  EXPECT_TRUE(rig.copy.Busy) << "nothing aborts it";
  ASSERT_TRUE(rig.run_until([&] { return rig.copy.Done; }, 10));
  rig.controller.interpolate_cams_elsewhere(true);
  rig.interpolate.Execute = other.Execute = rig.reset.Execute = false;
  rig.tick();
  rig.interpolate.Execute = true;
  rig.tick();
  other.Execute = rig.reset.Execute = true;
  rig.tick();
  EXPECT_EQ(other.ErrorID, WORD{0x80E8});
  EXPECT_EQ(rig.reset.ErrorID, WORD{0x80E8});
  EXPECT_TRUE(rig.interpolate.Busy) << "nothing aborts that either";
}

TEST(MC_CopyCamData, RefusesWhatIsOutsideOfTheCamOrOfTheArrays) {
  struct Row {
    DINT MC_CopyCamData::*pin;
    DINT value;
    DINT number;  // of points and segments
    int error;
  };
  for (const Row& row : std::initializer_list<Row>{{&MC_CopyCamData::Mode, 2, 1, 0x800A},
                                                   {&MC_CopyCamData::Mode, -1, 1, 0x800A},
                                                   {&MC_CopyCamData::StartPointCam, 0, 1, 0x80E1},
                                                   {&MC_CopyCamData::StartPointCam, 1001, 1, 0x80E1},
                                                   {&MC_CopyCamData::StartPointCam, 1000, 1, 0},
                                                   {&MC_CopyCamData::StartPointCam, 1000, 2, 0x80E5},
                                                   {&MC_CopyCamData::StartSegmentCam, 0, 1, 0x80E2},
                                                   {&MC_CopyCamData::StartSegmentCam, 51, 1, 0x80E2},
                                                   {&MC_CopyCamData::StartSegmentCam, 50, 1, 0},
                                                   {&MC_CopyCamData::StartSegmentCam, 50, 2, 0x80E6},
                                                   {&MC_CopyCamData::StartPointArray, -3, 1, 0x80E3},
                                                   {&MC_CopyCamData::StartPointArray, 9997, 1, 0},
                                                   {&MC_CopyCamData::StartPointArray, 9997, 2, 0x80E5},
                                                   {&MC_CopyCamData::StartPointArray, 9998, 1, 0x80E3},
                                                   {&MC_CopyCamData::StartSegmentArray, 9, 1, 0x80E4},
                                                   {&MC_CopyCamData::StartSegmentArray, 69, 1, 0},
                                                   {&MC_CopyCamData::StartSegmentArray, 69, 2, 0x80E6},
                                                   {&MC_CopyCamData::StartSegmentArray, 70, 1, 0x80E4},
                                                   {&MC_CopyCamData::NumberOfPoints, -1, 1, 0x80E5},
                                                   {&MC_CopyCamData::NumberOfPoints, 1000, 1, 0},
                                                   {&MC_CopyCamData::NumberOfPoints, 1001, 1, 0x80E5},
                                                   {&MC_CopyCamData::NumberOfPoints, 2147483647, 1, 0x80E5},
                                                   {&MC_CopyCamData::NumberOfSegments, -1, 1, 0x80E6},
                                                   {&MC_CopyCamData::NumberOfSegments, 51, 1, 0x80E6}}) {
    CamRig rig;
    rig.copy.NumberOfPoints = rig.copy.NumberOfSegments = row.number;
    rig.copy.*row.pin = row.value;
    EXPECT_EQ(static_cast<int>(rig.copied()), row.error) << row.value << ", " << row.number;
    if (row.error == 0) continue;
    EXPECT_TRUE(rig.data().ValidPoint[0]) << "a job that is rejected changes nothing";
    EXPECT_FALSE(rig.status(CamStatusBit::CamDataChanged));
  }
}

TEST(MC_CopyCamData, NeedsTheArraysOfWhichItCopies) {
  CamRig rig;
  rig.copy.ArrayOfPoints = rig.copy.ArrayOfSegments = nullptr;
  EXPECT_EQ(rig.copied(), ErrorId::none);
  rig.copy.NumberOfPoints = 1;
  EXPECT_EQ(rig.copied(), ErrorId::points_array);
  rig.copy.NumberOfPoints = 0;
  rig.copy.NumberOfSegments = 1;
  EXPECT_EQ(rig.copied(), ErrorId::segments_array);
  rig.copy.ArrayOfSegments = &rig.points_array;
  EXPECT_EQ(rig.copied(), ErrorId::segments_array);
  rig.copy.Cam = nullptr;
  EXPECT_EQ(rig.copied(), ErrorId::no_technology_object);
}

TEST(MC_CopyCamData, LeavesAnAxisThatFollowsTheCamAlone) {
  CamRig rig;
  rig.follow();
  rig.copy.NumberOfPoints = 101;
  ASSERT_EQ(rig.copied(), ErrorId::none);
  EXPECT_TRUE(rig.status(CamStatusBit::CamDataChanged));
  EXPECT_TRUE(rig.status(CamStatusBit::Control));
  for (int i = 0; i < 1000; ++i) {
    rig.tick();
    ASSERT_TRUE(rig.in.InSync);
    ASSERT_NEAR(rig.f.data.Position, rig.l.data.Position, 1e-9);
  }
  rig.interpolate.Execute = true;
  rig.tick();
  EXPECT_EQ(rig.interpolate.ErrorID, WORD{0x80AB});
}

// ---- MC_Reset with Restart
// ----------------------------------------------------------------------------------------------

TEST(RestartOfACam, TakesOverTheStartValuesAndInterpolatesThem) {
  for (const ObjectKind kind : {ObjectKind::TO_Cam, ObjectKind::TO_Cam_10k}) {
    CamRig rig(kind);
    const auto start = [&](const char* path) {
      return find_variable(kind, path).signal(rig.cam.start_values());
    };
    const auto now = [&](const char* path) {
      const Signal signal = find_variable(kind, path).signal(rig.cam.data_block());
      return as_double(signal.load(), signal.type);
    };
    rig.copy.NumberOfPoints = 101;
    ASSERT_EQ(rig.copied(), ErrorId::none);
    start("Point[2].y").store({.r = 300.0});
    start("ValidSegment[1]").store({.u = 0});
    start("InterpolationSettings.InterpolationMode").store({.i = 0});
    rig.cam.start_values_changed = true;
    rig.tick();
    EXPECT_TRUE(rig.status(CamStatusBit::OnlineStartValuesChanged));

    rig.reset.Execute = true;
    rig.tick();
    EXPECT_TRUE(rig.reset.Busy);
    EXPECT_TRUE(rig.status(CamStatusBit::RestartActive));
    ASSERT_TRUE(rig.run_until([&] { return rig.reset.Done; }, 12));
    EXPECT_FALSE(rig.status(CamStatusBit::RestartActive));
    EXPECT_FALSE(rig.status(CamStatusBit::OnlineStartValuesChanged));
    EXPECT_FALSE(rig.status(CamStatusBit::CamDataChanged));
    EXPECT_TRUE(rig.status(CamStatusBit::Interpolated));
    EXPECT_EQ(now("Point[2].y"), 300.0);
    EXPECT_EQ(now("ValidPoint[3]"), 0.0) << "what has been copied is gone";
    EXPECT_EQ(now("StatusCam.NumberOfValidPoints"), 2.0);
    EXPECT_EQ(now("StatusCam.NumberOfValidSegments"), 0.0);
    EXPECT_EQ(rig.cam.function().value(50.0).position, 150.0);
    rig.run(100);
    EXPECT_FALSE(rig.status(CamStatusBit::CamDataChanged));
  }
}

TEST(RestartOfACam, OfWhichNoElementIsValidAtTheStartLeavesNoCurve) {
  CamRig rig;
  static_cast<CamData1k*>(rig.cam.start_values())->ValidPoint.fill(false);
  static_cast<CamData1k*>(rig.cam.start_values())->ValidSegment.fill(false);
  rig.reset.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.reset.Done; }, 5));
  EXPECT_FALSE(rig.status(CamStatusBit::Interpolated));
  EXPECT_FALSE(rig.status(CamStatusBit::CamDataChanged));
  EXPECT_EQ(rig.data().StatusCam.EndLeadingValue, 0.0);
}

TEST(RestartOfACam, WithStartValuesThatMakeNoCurveTellsSoAndLeavesNone) {
  CamRig rig;
  static_cast<CamData1k*>(rig.cam.start_values())->Segment[0].xmax = 30.0;  // below xmin
  rig.reset.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return !rig.reset.Busy; }, 5));
  EXPECT_EQ(rig.reset.ErrorID, WORD{0x80AC});
  EXPECT_FALSE(rig.status(CamStatusBit::Interpolated));
}

TEST(RestartOfACam, IsRefusedWhileTheCamIsInUse) {
  CamRig rig;
  rig.follow();
  rig.reset.Execute = true;
  rig.tick();
  EXPECT_EQ(rig.reset.ErrorID, WORD{0x80AB});
  EXPECT_TRUE(rig.in.InSync);
  const auto warned = [&] {
    return has_bit(static_cast<CamData1k*>(rig.cam.data_block())->WarningWord,
                   WarningBit::CommandNotAccepted);
  };
  EXPECT_TRUE(warned()) << "warning 322";
  rig.reset.Restart = false;
  rig.reset.Execute = false;
  rig.tick();
  rig.reset.Execute = true;
  rig.tick();
  EXPECT_TRUE(rig.reset.Done);
  EXPECT_FALSE(warned());
}

TEST(RestartOfACam, ShutsTheCamForEveryJob) {
  CamRig rig;
  auto& value = rig.block<MC_GetCamFollowingValue>();
  auto& leading = rig.block<MC_GetCamLeadingValue>();
  auto& again = rig.block<MC_Reset>();
  auto& acknowledge = rig.block<MC_Reset>();
  value.Cam = leading.Cam = &rig.cam;
  again.Axis = acknowledge.Axis = &rig.cam;
  again.Restart = true;
  rig.in.SyncProfileReference = 2;
  rig.controller.interpolate_cams_elsewhere(true);  // so that it lasts
  rig.reset.Execute = true;
  rig.run(3);
  ASSERT_TRUE(rig.reset.Busy);
  rig.copy.Execute = rig.interpolate.Execute = value.Execute = leading.Execute = again.Execute =
      acknowledge.Execute = rig.in.Execute = true;
  rig.run(3);
  const ExecuteBlock* const blocks[] = {&rig.copy, &rig.interpolate, &value, &leading,
                                        &again,    &acknowledge,     &rig.in};
  for (const ExecuteBlock* block : blocks) EXPECT_EQ(block->ErrorID, WORD{0x800D});
  EXPECT_TRUE(rig.controller.interpolate_cams());
  rig.tick();
  EXPECT_TRUE(rig.reset.Done);
}

}  // namespace
}  // namespace lockstep::cam_data_test
