// Camming on virtual axes, through the blocks: MC_CamIn, MC_CamOut, MC_InterpolateCam.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fb/cam_in.hpp"
#include "fb/cam_value.hpp"
#include "fb/gear_in.hpp"
#include "fb/home.hpp"
#include "fb/interpolate_cam.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/offset.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "fb/superimposed.hpp"
#include "fb/sync_out.hpp"
#include "tests/support/coupled_rig.hpp"

namespace lockstep::camming_test {
namespace {

using test::CoupledRig;
using test::line;

void ring(AxisData& data) {
  data.Modulo.Enable = true;
  data.DynamicLimits.MaxVelocity = data.DynamicLimits.Velocity = 1e6;
  data.DynamicLimits.MaxAcceleration = 1e7;
}

/// A leading and a following axis and two cams.
struct CamPair : CoupledRig {
  explicit CamPair(const Shape& leading = ring, const Shape& following = line)
      : CoupledRig(leading, following),
        wave(cam("Wave", {{0, 0}, {90, 30}, {180, 50}, {270, 10}, {360, 0}}, 1)),
        feed(cam("Feed", {{0, 0}, {120, 5}, {240, 35}, {360, 40}}, 1)),
        in(block<MC_CamIn>()),
        next(block<MC_CamIn>()),
        out(block<MC_CamOut>()),
        move_f(block<MC_MoveRelative>()),
        interpolate(block<MC_InterpolateCam>()) {
    move_f.Axis = &f;
    in.Master = next.Master = &l;
    in.Slave = next.Slave = out.Slave = &f;
    in.Cam = &wave;
    next.Cam = &feed;
    interpolate.Cam = &wave;
    begin();
    continuity[1].highest_jerk = 1e10;
    continuity[0].highest_acceleration = 1e7;
    continuity[0].highest_jerk = 1e12;
  }

  Cam& cam(const char* name, const std::vector<TO_Cam_Struct_PointData>& points, DINT boundary) {
    Cam& made = static_cast<Cam&>(controller.add_object(ObjectKind::TO_Cam, name));
    auto& data = *static_cast<CamData1k*>(made.data_block());
    data.InterpolationSettings = {1, boundary};
    for (std::size_t i = 0; i < points.size(); ++i) made.define_point(i, points[i]);
    CamInterpolator interpolator(kCamPoints);
    EXPECT_EQ(made.interpolate(interpolator), ErrorId::none);
    return made;
  }

  void start_leading(double velocity) {
    run_l.Acceleration = run_l.Deceleration = 1e6;
    run_l.Jerk = 0.0;
    CoupledRig::start_leading(velocity);
    ASSERT_TRUE(run_until([&] { return run_l.InVelocity; }));
  }

  /// Camming, cyclic, synchronous.
  void couple(double velocity = 720.0) {
    start_leading(velocity);
    in.ApplicationMode = 1;
    in.MasterStartDistance = 100.0;
    in.Execute = true;
    ASSERT_TRUE(run_until([&] { return in.InSync; }));
  }

  const TO_Struct_StatusSynchronizedMotion& status() const { return f.data.StatusSynchronizedMotion; }
  double leading() const { return l.setpoint().position.value; }

  Cam& wave;
  Cam& feed;
  MC_CamIn& in;
  MC_CamIn& next;
  MC_CamOut& out;
  MC_MoveRelative& move_f;
  MC_InterpolateCam& interpolate;
};

bool bit(const Axis& axis, StatusBit which) {
  return has_bit(axis.data.StatusWord, which);
}
bool bit(const Cam& cam, CamStatusBit which) {
  return has_bit(static_cast<CamData1k*>(const_cast<Cam&>(cam).data_block())->StatusWord, which);
}

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
  CamPair rig(ring, ring);
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

// ---- Ways of synchronizing; the rig watches that nothing steps
// ----------------------------------------------

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
    CamPair rig(ring, ring);
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
        CamPair rig(ring, ring);
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
    CamPair rig(ring, [](AxisData& data) {
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
  CamPair rig(line, ring);
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

// ---- Interpolation at run time
// ----------------------------------------------------------------------------------------

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
}  // namespace lockstep::camming_test
