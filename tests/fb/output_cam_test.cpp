// Output cams through their block: when the output switches, more finely than a servo cycle.
#include "fb/output_cam.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"
#include "tech_objects/switching/cam_track.hpp"
#include "tech_objects/switching/output_cam.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::output_cam_test {
namespace {

using test::Rig;

/// A conveyor, and an output cam whose edges are noted.
struct Cams : Rig {
  explicit Cams(const std::function<void(AxisData&)>& conveyor = {},
                const std::function<void(OutputCamData&)>& set = {}, std::int64_t cycle = 1'000'000,
                int ratio = 1)
      : Rig(cycle, ratio),
        c(axis("Conveyor", conveyor)),
        cam(static_cast<OutputCam&>(controller.add_object(ObjectKind::TO_OutputCam, "Cam"))),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        run_c(block<MC_MoveVelocity>()),
        move(block<MC_MoveAbsolute>()),
        fb(block<MC_OutputCam>()),
        second(block<MC_OutputCam>()),
        reset(block<MC_Reset>()) {
    cam.assigned = &c;
    cam.switching_times = {&on_at, &off_at};
    if (set) set(cam.data);
    power.Axis = home.Axis = run_c.Axis = move.Axis = &c;
    fb.OutputCam = second.OutputCam = &cam;
    reset.Axis = &cam;
    run_c.Jerk = move.Jerk = 0.0;
    continuity[0].homing = true;
    power.Enable = true;
    run(5 * ratio);
    home.Execute = true;
    run(3 * ratio);
  }
  void go(double speed) {
    run_c.Velocity = std::abs(speed);
    run_c.Direction = speed < 0.0 ? 2 : 1;
    run_c.Acceleration = run_c.Deceleration = 1000.0;
    run_c.Execute = false;
    tick();
    run_c.Execute = true;
    tick();
  }
  /// Constant speed; tells when the axis would have been at 0 [s].
  double cruise(double speed) {
    go(speed);
    EXPECT_TRUE(run_until([&] { return run_c.InVelocity; }));
    run(20);
    return seen_at() - c.data.Position / speed;
  }
  /// The time at which a cam sees the position that the axis shows now [s]: it is fine-interpolated, one
  /// interpolator cycle later.
  double seen_at() const {
    return static_cast<double>(controller.now() - controller.clock.servo_cycle) * 1e-9 + period();
  }
  void enable(double on, double off, DINT direction = 1) {
    fb.OnPosition = on;
    fb.OffPosition = off;
    fb.Direction = direction;
    fb.Enable = true;
    tick();
  }
  bool output() const { return cam.data.CamOutput; }
  ::testing::AssertionResult switched(bool to, int maximum = 20000) {
    return run_until([&, to] { return output() == to; }, maximum);
  }

  Axis& c;
  OutputCam& cam;
  MC_Power& power;
  MC_Home& home;
  MC_MoveVelocity& run_c;
  MC_MoveAbsolute& move;
  MC_OutputCam &fb, &second;
  MC_Reset& reset;
  double on_at = -1.0, off_at = -1.0;
};

void ring(AxisData& data) {
  data.Modulo.Enable = true;
  data.Modulo.Length = 360.0;
}
void time_cam(OutputCamData& data) {
  data.Parameter.OutputCamType = 1;
}

constexpr double kExact = 2e-11;  // of times below some ten seconds [s]

class SwitchingInstants : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ratio, SwitchingInstants, ::testing::Values(1, 4));

TEST_P(SwitchingInstants, AreExactAtConstantVelocity) {
  for (const double speed : {77.7, 933.3}) {
    Cams rig({}, {}, 500'000, GetParam());
    const double zero = rig.cruise(speed);
    const double on = rig.c.data.Position + 0.1 * speed, off = on + 0.0123 * speed;
    rig.enable(on, off);
    ASSERT_TRUE(rig.switched(true));
    EXPECT_NEAR(rig.on_at, zero + on / speed, kExact);
    const double tick = static_cast<double>(rig.controller.now() - 500'000) * 1e-9;
    EXPECT_LE(rig.on_at, tick) << "the output shows in the tick at or behind the edge";
    EXPECT_GT(rig.on_at, tick - 0.0005 - 1e-12);
    EXPECT_TRUE(rig.fb.CamOutput && rig.fb.Busy && !rig.fb.Error);
    ASSERT_TRUE(rig.switched(false));
    EXPECT_NEAR(rig.off_at, zero + off / speed, kExact);
  }
}

TEST(OutputCamLead, ShiftsTheEdgesByTheirTimes) {
  for (const double speed : {200.0, -200.0}) {
    Cams rig({}, [](OutputCamData& data) {
      data.Parameter.OnCompensation = 12.3;
      data.Parameter.OffCompensation = 4.56;
    });
    const double zero = rig.cruise(speed);
    const double near = rig.c.data.Position + 0.3 * speed, far = rig.c.data.Position + 0.5 * speed;
    rig.enable(std::min(near, far), std::max(near, far), 3);
    ASSERT_TRUE(rig.switched(true));
    EXPECT_NEAR(rig.on_at, zero + near / speed - 0.0123, kExact) << speed;
    ASSERT_TRUE(rig.switched(false));
    EXPECT_NEAR(rig.off_at, zero + far / speed - 0.00456, kExact) << speed;
  }
}

// s = a t² / 2: between two ticks the way is taken as straight, by which it is wrong by a T² / 8 at most.
TEST(OutputCamAcceleration, SwitchesAtTheRightTimeWhileTheAxisAccelerates) {
  Cams rig;
  rig.enable(20.0, 45.0);
  rig.go(900.0);
  const double begin = rig.seen_at() - rig.c.data.Velocity / 1000.0;
  const double slack = 1000.0 * 1e-6 / 8 / 200.0 + 1e-9;
  ASSERT_TRUE(rig.switched(true));
  EXPECT_NEAR(rig.on_at, begin + std::sqrt(2.0 * 20.0 / 1000.0), slack);
  ASSERT_TRUE(rig.switched(false));
  EXPECT_NEAR(rig.off_at, begin + std::sqrt(2.0 * 45.0 / 1000.0), slack);
}

TEST(OutputCamDirection, OfTheCamDecidesWhetherItSwitches) {
  for (const DINT direction : {1, 2, 3})
    for (const double speed : {300.0, -300.0}) {
      Cams rig;
      rig.enable(speed > 0 ? 20.0 : -30.0, speed > 0 ? 30.0 : -20.0, direction);
      rig.go(speed);
      const bool effective = direction == 3 || (direction == 1) == (speed > 0);
      EXPECT_EQ(static_cast<bool>(rig.switched(true, 500)), effective) << direction << " at " << speed;
    }
}

TEST(OutputCamReversal, OutOfTheEffectiveDirectionSwitchesOff) {
  Cams rig;
  rig.enable(20.0, 400.0);
  rig.go(200.0);
  ASSERT_TRUE(rig.switched(true));
  rig.run(100);
  EXPECT_TRUE(rig.output());
  rig.go(-200.0);
  ASSERT_TRUE(rig.switched(false));
  EXPECT_LT(rig.c.data.Velocity, 0.0);
  EXPECT_GT(rig.c.data.Position, 20.0);
  rig.go(200.0);
  ASSERT_TRUE(rig.switched(true)) << "inside, in the effective direction";
  EXPECT_GT(rig.c.data.Velocity, 0.0);
}

TEST(OutputCamStandstill, InsideIsOnWithBothDirectionsOnly) {
  for (const DINT direction : {1, 2, 3}) {
    Cams rig;
    rig.enable(-5.0, 5.0, direction);
    rig.run(5);
    EXPECT_EQ(rig.output(), direction == 3);
  }
}

// The state is held until the axis has gone back by more than the hysteresis.
TEST(OutputCamHysteresis, HoldsTheStateAfterAReversal) {
  for (const double hysteresis : {0.0, 10.0}) {
    Cams rig({}, [&](OutputCamData& data) { data.Parameter.Hysteresis = hysteresis; });
    rig.enable(20.0, 60.0, 3);
    rig.move.Position = 65.0;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
    EXPECT_FALSE(rig.output());
    rig.move.Execute = false;
    rig.tick();
    rig.move.Position = 57.0;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
    EXPECT_EQ(rig.output(), hysteresis == 0.0);
    rig.move.Execute = false;
    rig.tick();
    rig.move.Position = 40.0;
    rig.move.Execute = true;
    ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
    EXPECT_TRUE(rig.output());
  }
}

TEST(OutputCamHysteresis, OfARingIsAQuarterOfItAtMost) {
  Cams rig(ring, [](OutputCamData& data) { data.Parameter.Hysteresis = 1e6; });
  rig.enable(100.0, 300.0, 3);
  rig.move.Position = 310.0;
  rig.move.Direction = 1;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.move.Done; }));
  EXPECT_FALSE(rig.output());
  rig.move.Execute = false;
  rig.tick();
  rig.move.Position = 210.0;
  rig.move.Direction = 2;
  rig.move.Execute = true;
  ASSERT_TRUE(rig.switched(true));
  EXPECT_LT(rig.c.data.Position, 220.0);
}

TEST(OutputCamOnARing, RepeatsOnEveryTurnWhereverItsPlacesAreGiven) {
  for (const double turn : {0.0, 720.0, -360.0}) {
    Cams rig(ring);
    const double zero = rig.cruise(1000.0);
    rig.enable(350.0 + turn, 10.0 - turn);
    double on = -1.0;
    for (int pass = 0; pass < 5; ++pass) {
      ASSERT_TRUE(rig.switched(false));
      ASSERT_TRUE(rig.switched(true));
      if (on > 0.0) {
        EXPECT_NEAR(rig.on_at - on, 0.36, kExact);
        EXPECT_NEAR(rig.off_at - on, 0.02, kExact);
      }
      on = rig.on_at;
      EXPECT_NEAR(std::remainder((on - zero) * 1000.0 - 350.0, 360.0), 0.0, 1e-7);
    }
  }
}

TEST(OutputCamWithItsEndBeforeItsBeginning, IsOnBeyondBoth) {
  Cams rig;
  rig.enable(60.0, 20.0, 3);
  rig.run(3);
  EXPECT_TRUE(rig.output());
  const double zero = rig.cruise(100.0);
  ASSERT_TRUE(rig.switched(false));
  EXPECT_NEAR(rig.off_at, zero + 0.2, kExact);
  ASSERT_TRUE(rig.switched(true));
  EXPECT_NEAR(rig.on_at, zero + 0.6, kExact);
}

TEST(TimeCam, IsOnForItsDurationFromItsPlaceOn) {
  Cams rig({}, [](OutputCamData& data) {
    time_cam(data);
    data.Parameter.OnCompensation = 7.5;
    data.Parameter.OffCompensation = 2.0;
  });
  const double zero = rig.cruise(321.0);
  const double on = rig.c.data.Position + 100.0;
  rig.fb.Duration = 33.4;
  rig.enable(on, 0.0);
  ASSERT_TRUE(rig.switched(true));
  EXPECT_NEAR(rig.on_at, zero + on / 321.0 - 0.0075, kExact);
  ASSERT_TRUE(rig.switched(false));
  EXPECT_NEAR(rig.off_at, zero + on / 321.0 + 0.0334 - 0.002, kExact);
  EXPECT_FALSE(rig.switched(true, 200));
}

TEST(TimeCam, RunsOnThroughAReversalAndIsNotStartedAgainMeanwhile) {
  Cams rig({}, time_cam);
  rig.fb.Duration = 600.0;
  rig.enable(20.0, 0.0, 3);
  rig.go(200.0);
  ASSERT_TRUE(rig.switched(true));
  rig.go(-200.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.c.data.Position < 10.0; }, 550));
  EXPECT_TRUE(rig.output());
  ASSERT_TRUE(rig.switched(false));
  EXPECT_NEAR(rig.off_at - rig.on_at, 0.6, kExact);
  rig.go(200.0);
  ASSERT_TRUE(rig.switched(true)) << "the next crossing starts it anew";
}

TEST(TimeCam, IsNotSwitchedByHomingOverItsPlaceAndADistanceCamIs) {
  for (const bool timed : {true, false}) {
    Cams rig({}, [&](OutputCamData& data) { data.Parameter.OutputCamType = timed ? 1 : 0; });
    rig.fb.Duration = 50.0;
    rig.enable(100.0, 200.0, 3);
    rig.home.Execute = false;
    rig.tick();
    rig.continuity[0].velocity = false;
    rig.home.Mode = 0;
    rig.home.Position = 150.0;
    rig.home.Execute = true;
    rig.run(10);
    EXPECT_EQ(rig.output(), !timed);
  }
}

TEST(OutputCamMode, InvertsTheOutputOrHoldsItOn) {
  Cams rig;
  rig.fb.Mode = 2;
  rig.enable(20.0, 30.0);
  rig.run(3);
  EXPECT_TRUE(rig.output());
  EXPECT_TRUE(has_bit(rig.cam.data.StatusWord, InputOutputBit::OutputInverted));
  const double zero = rig.cruise(100.0);
  rig.fb.OnPosition = rig.c.data.Position + 20.0;
  rig.fb.OffPosition = rig.fb.OnPosition + 10.0;
  ASSERT_TRUE(rig.switched(false));
  EXPECT_NEAR(rig.off_at, zero + rig.fb.OnPosition / 100.0, kExact);
  rig.fb.Mode = 3;
  rig.run(2);
  EXPECT_TRUE(rig.output());
  rig.fb.Enable = false;
  rig.run(2);
  EXPECT_FALSE(rig.output());
  EXPECT_FALSE(rig.fb.Busy);
}

TEST(OutputCamInputs, CountInEveryCallAndTheLastPermittedOnesGoOn) {
  Cams rig;
  rig.enable(-5.0, 5.0, 3);
  rig.run(2);
  EXPECT_TRUE(rig.output());
  rig.fb.OnPosition = NAN;
  rig.run(2);
  EXPECT_TRUE(rig.fb.Error && rig.fb.Busy && rig.output());
  EXPECT_EQ(rig.fb.ErrorID, static_cast<WORD>(ErrorId::on_position));
  rig.fb.OnPosition = 1.0;
  rig.run(2);
  EXPECT_FALSE(rig.fb.Error || rig.output());
}

TEST(OutputCamInputs, RefusedAtTheBeginningStartNothing) {
  Cams rig({}, time_cam);
  rig.enable(0.0, 0.0, 3);
  EXPECT_EQ(rig.fb.ErrorID, static_cast<WORD>(ErrorId::cam_duration));
  EXPECT_FALSE(rig.fb.Busy);
  rig.fb.Duration = 10.0;
  rig.run(2);
  EXPECT_TRUE(rig.fb.Error) << "until Enable falls";
  rig.fb.Enable = false;
  rig.tick();
  rig.fb.Enable = true;
  rig.run(2);
  EXPECT_TRUE(rig.fb.Busy && !rig.fb.Error);
}

TEST(OutputCamInstances, ASecondOneIsRefused) {
  Cams rig;
  rig.enable(-5.0, 5.0, 3);
  rig.second.Enable = true;
  rig.run(2);
  EXPECT_EQ(rig.second.ErrorID, static_cast<WORD>(ErrorId::one_instance_only));
  EXPECT_TRUE(rig.output());
}

TEST(OutputCamAlarms, EndTheProcessingUntilTheyAreAcknowledged) {
  Cams rig;
  rig.enable(-5.0, 5.0, 3);
  rig.run(2);
  EXPECT_TRUE(rig.output());
  rig.fb.OffPosition = -5.0;
  rig.run(3);
  EXPECT_EQ(rig.cam.data.ErrorDetail.Number, 704u);
  EXPECT_EQ(rig.cam.data.ErrorDetail.Reaction, 6);
  EXPECT_FALSE(rig.output());
  EXPECT_EQ(rig.fb.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  rig.fb.OffPosition = 5.0;
  rig.run(3);
  EXPECT_FALSE(rig.output());
  rig.reset.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.reset.Done && rig.output() && !rig.fb.Error);
}

TEST(OutputCamAlarms, TellOfATimeCamWhoseLeadsLeaveNothing) {
  Cams rig({}, [](OutputCamData& data) {
    time_cam(data);
    data.Parameter.OffCompensation = 20.0;
  });
  rig.fb.Duration = 20.0;
  rig.enable(10.0, 0.0);
  rig.run(2);
  EXPECT_EQ(rig.cam.data.ErrorDetail.Number, 704u);
}

TEST(OutputCamAlarms, TellOfALeadBeyondTheRangeOfPositions) {
  Cams rig;
  rig.cruise(500.0);
  rig.cam.data.Parameter.OnCompensation = 1e12;
  rig.run(2);
  rig.enable(1e6, 2e6);
  rig.run(2);
  EXPECT_EQ(rig.cam.data.ErrorDetail.Number, 0u) << "500 u/s times 1e9 s are 5e11 u";
  rig.cruise(1500.0);
  EXPECT_EQ(rig.cam.data.ErrorDetail.Number, 700u);
}

// The job ends with the restart of its axis, and not with an alarm; a new edge begins another one.
TEST(OutputCamAxis, RestartedEndsTheJob) {
  Cams rig;
  auto& restart = rig.block<MC_Reset>();
  restart.Axis = &rig.c;
  restart.Restart = true;
  rig.enable(-5.0, 5.0, 3);
  rig.run(5);
  ASSERT_TRUE(rig.output());
  rig.power.Enable = false;
  rig.run(5);
  restart.Execute = true;
  rig.run(5);
  ASSERT_TRUE(restart.Done);
  EXPECT_TRUE(rig.fb.Error && !rig.fb.Busy && !rig.fb.CamOutput);
  EXPECT_EQ(rig.fb.ErrorID, static_cast<WORD>(ErrorId::restarting));
  EXPECT_EQ(rig.cam.data.ErrorDetail.Number, 0u);
  EXPECT_FALSE(rig.output());
  rig.run(20);
  EXPECT_TRUE(rig.fb.Error && !rig.fb.Busy) << "until Enable falls";
  rig.fb.Enable = false;
  rig.run(3);
  EXPECT_FALSE(rig.fb.Error);
  rig.fb.Enable = true;
  rig.run(5);
  EXPECT_TRUE(rig.fb.Busy && !rig.fb.Error && rig.output());
}

TEST(OutputCamAxis, RestartedBetweenTwoJobsIsNoAlarm) {
  Cams rig;
  auto& restart = rig.block<MC_Reset>();
  restart.Axis = &rig.c;
  restart.Restart = true;
  rig.power.Enable = false;
  rig.run(5);
  restart.Execute = true;
  rig.run(5);
  ASSERT_TRUE(restart.Done);
  rig.enable(-5.0, 5.0, 3);
  rig.run(5);
  EXPECT_TRUE(rig.fb.Busy && !rig.fb.Error && rig.output());
}

TEST(OutputCamOnSetpoints, IsOffWithoutPositionControlAndFollowsADriveTheOtherWay) {
  for (const DINT type : {0, 1}) {
    Cams rig([](AxisData& data) { data.VirtualAxis.Mode = 0; },
             [&](OutputCamData& data) { data.Parameter.PositionType = type; });
    rig.run(20);
    rig.enable(20.0, 1e6, 3);
    rig.run_c.PositionControlled = false;
    rig.go(300.0);
    EXPECT_EQ(static_cast<bool>(rig.switched(true, 500)), type == 1);
  }
}

TEST(OutputCamOnActualPositions, SwitchesWhereTheDriveIs) {
  for (const DINT type : {0, 1}) {
    Cams rig(
        [](AxisData& data) {
          data.VirtualAxis.Mode = 0;
          data.PositionControl.Kpc = 0.0;
        },
        [&](OutputCamData& data) { data.Parameter.PositionType = type; });
    rig.run(20);
    rig.cruise(100.0);
    rig.run(2000);
    const double on = rig.c.data.Position + 50.0;
    rig.enable(on, on + 1e5);
    ASSERT_TRUE(rig.switched(true));
    const double seen = type == 1 ? rig.c.data.ActualPosition : rig.c.data.Position;
    EXPECT_NEAR(seen, on, 0.25);
    EXPECT_GT(rig.c.data.Position - rig.c.data.ActualPosition, 0.5) << "the two have to differ here";
  }
}

TEST(OutputsOfSeveralCams, AreOredOrAnded) {
  for (const bool all : {false, true}) {
    Rig rig;
    Axis& c = rig.axis("Conveyor");
    bool output = false;
    MC_OutputCam* blocks[2];
    for (int i = 0; i < 2; ++i) {
      auto& cam = static_cast<OutputCam&>(
          rig.controller.add_object(ObjectKind::TO_OutputCam, i == 0 ? "CamA" : "CamB"));
      cam.assigned = &c;
      cam.data.Interface.Address = &output;
      cam.data.Interface.LogicOperation = all ? 1 : 0;
      blocks[i] = &rig.block<MC_OutputCam>();
      blocks[i]->OutputCam = &cam;
      blocks[i]->Mode = 3;
    }
    blocks[0]->Enable = true;
    rig.run(3);
    EXPECT_EQ(output, !all);
    blocks[1]->Enable = true;
    rig.run(3);
    EXPECT_TRUE(output);
    blocks[0]->Enable = blocks[1]->Enable = false;
    rig.run(3);
    EXPECT_FALSE(output);
  }
}

// ---- Cam tracks

struct Track : Rig {
  explicit Track(const std::function<void(AxisData&)>& conveyor = {},
                 const std::function<void(CamTrackData&)>& set = {})
      : c(axis("Conveyor", conveyor)),
        track(static_cast<CamTrack&>(controller.add_object(ObjectKind::TO_CamTrack, "Track"))),
        power(block<MC_Power>()),
        home(block<MC_Home>()),
        run_c(block<MC_MoveVelocity>()),
        fb(block<MC_CamTrack>()),
        second(block<MC_CamTrack>()),
        reset(block<MC_Reset>()) {
    track.assigned = &c;
    track.switching_times = {&on_at, &off_at};
    auto& parameter = track.data.Parameter;
    parameter.ReferencePosition = 20.0;
    parameter.CamTrackLength = 100.0;
    parameter.Cam[0] = {.OnPosition = 10.0, .OffPosition = 20.0, .Existent = true};
    parameter.Cam[1] = {.OnPosition = 60.0, .OffPosition = 90.0, .Existent = true};
    if (set) set(track.data);
    continuity[0].acceleration = false;
    power.Axis = home.Axis = run_c.Axis = &c;
    fb.CamTrack = second.CamTrack = &track;
    reset.Axis = &track;
    run_c.Jerk = 0.0;
    power.Enable = true;
    run(5);
    home.Execute = true;
    run(3);
  }
  double cruise(double speed) {
    run_c.Velocity = std::abs(speed);
    run_c.Direction = speed < 0.0 ? 2 : 1;
    run_c.Acceleration = run_c.Deceleration = 1e4;
    run_c.Execute = false;
    tick();
    run_c.Execute = true;
    EXPECT_TRUE(run_until([&] { return run_c.InVelocity; }));
    run(3);
    return static_cast<double>(controller.now()) * 1e-9 - c.data.Position / speed;
  }
  bool output() const { return track.data.TrackOutput; }
  ::testing::AssertionResult switched(bool to, int maximum = 20000) {
    return run_until([&, to] { return output() == to; }, maximum);
  }
  std::uint32_t cams() const { return static_cast<std::uint32_t>(track.data.SingleCamState); }

  Axis& c;
  CamTrack& track;
  MC_Power& power;
  MC_Home& home;
  MC_MoveVelocity& run_c;
  MC_CamTrack &fb, &second;
  MC_Reset& reset;
  double on_at = -1.0, off_at = -1.0;
};

// The published example: on from 30 to 40 and from 80 to 110, and every 100 from there.
TEST(CamTrackRepeats, InBothDirectionsFromItsReferencePosition) {
  for (const double speed : {123.0, -123.0}) {
    Track rig;
    rig.fb.Enable = true;
    const double zero = rig.cruise(speed);
    const double up[] = {30.0, 40.0, 80.0, 110.0, 130.0, 140.0, 180.0, 210.0};
    const double down[] = {-60.0, -70.0, -90.0, -120.0, -160.0, -170.0, -190.0, -220.0};
    ASSERT_TRUE(rig.switched(false));
    for (int i = 0; i < 8; i += 2) {
      ASSERT_TRUE(rig.switched(true));
      EXPECT_NEAR(rig.on_at, zero + (speed > 0 ? up : down)[i] / speed, kExact);
      EXPECT_EQ(rig.cams(), i % 4 == 0 ? 1u : 2u);
      ASSERT_TRUE(rig.switched(false));
      EXPECT_NEAR(rig.off_at, zero + (speed > 0 ? up : down)[i + 1] / speed, kExact);
    }
  }
}

TEST(CamTrackPosition, CountsFromTheLeftBorderOfTheTrack) {
  for (const double speed : {100.0, -100.0}) {
    Track rig;
    rig.fb.Enable = true;
    rig.cruise(speed);
    for (int i = 0; i < 300; ++i) {
      rig.run(10);
      const auto& data = rig.track.data;
      EXPECT_GE(data.TrackPosition, 0.0);
      EXPECT_LT(data.TrackPosition, 100.0);
      EXPECT_NEAR(std::remainder(data.MatchPosition - 20.0, 100.0), 0.0, 1e-9);
      EXPECT_NEAR(data.MatchPosition + data.TrackPosition, rig.c.data.Position - 0.001 * speed, 1e-9);
    }
  }
}

TEST(CamTrackOnARing, GoesOnOverTheEndOfTheRing) {
  Track rig([](AxisData& data) {
    data.Modulo.Enable = true;
    data.Modulo.Length = 360.0;
  });
  rig.fb.Enable = true;
  rig.cruise(1000.0);
  ASSERT_TRUE(rig.switched(false));
  double last = -1.0;
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(rig.switched(true));
    if (rig.cams() != 1u) {
      ASSERT_TRUE(rig.switched(false));
      continue;
    }
    if (last > 0.0) {
      EXPECT_NEAR(rig.on_at - last, 0.1, kExact);
    }
    last = rig.on_at;
    ASSERT_TRUE(rig.switched(false));
  }
}

TEST(CamTrackCams, CountWithExistentAndMaskAndAPlaceInTheTrack) {
  Track rig({}, [](CamTrackData& data) {
    data.Parameter.CamMasking = DWORD{0xFFFFFFFDu};
    data.Parameter.Cam[2] = {.OnPosition = 150.0, .OffPosition = 160.0, .Existent = true};
    data.Parameter.Cam[3] = {.OnPosition = 30.0, .OffPosition = 40.0, .Existent = false};
    data.Parameter.Cam[31] = {.OnPosition = 95.0, .OffPosition = 130.0, .Existent = true};
  });
  rig.fb.Enable = true;
  const double zero = rig.cruise(100.0);
  ASSERT_TRUE(rig.run_until([&] { return rig.c.data.Position > 21.0; }));
  ASSERT_TRUE(rig.switched(true));
  EXPECT_EQ(rig.cams(), 1u);
  EXPECT_NEAR(rig.on_at, zero + 0.3, kExact);
  ASSERT_TRUE(rig.switched(false));
  ASSERT_TRUE(rig.switched(true));
  EXPECT_EQ(rig.cams(), 0x80000000u);
  EXPECT_NEAR(rig.on_at, zero + 1.15, kExact);
  ASSERT_TRUE(rig.switched(false));
  EXPECT_NEAR(rig.off_at, zero + 1.2, kExact) << "a distance cam ends with its track";
}

TEST(CamTrackTimeCams, RunOnPastTheEndOfTheTrack) {
  Track rig({}, [](CamTrackData& data) {
    data.Parameter.CamTrackType = 1;
    data.Parameter.OnCompensation = 2.0;
    data.Parameter.Cam[0] = {.OnPosition = 95.0, .Duration = 80.0, .Existent = true};
    data.Parameter.Cam[1].Existent = false;
  });
  rig.fb.Enable = true;
  const double zero = rig.cruise(100.0);
  for (int track = 0; track < 3; ++track) {
    ASSERT_TRUE(rig.switched(true));
    EXPECT_NEAR(rig.on_at, zero + 0.15 + track - 0.002 + (zero + 0.15 < 0.0 ? 1.0 : 0.0), 1.0 + 1e-9);
    EXPECT_NEAR(std::remainder(rig.on_at - zero - 0.15 + 0.002, 1.0), 0.0, kExact);
    ASSERT_TRUE(rig.switched(false));
    EXPECT_NEAR(rig.off_at - rig.on_at, 0.082, kExact);
  }
}

TEST(CamTrackData, ActWithTheNextTrackInMode1AndAtOnceInMode0) {
  for (const DINT mode : {0, 1}) {
    Track rig;
    rig.fb.Mode = mode;
    rig.fb.Enable = true;
    const double zero = rig.cruise(100.0);
    ASSERT_TRUE(rig.run_until([&] { return std::abs(rig.track.data.TrackPosition - 30.0) < 2.0; }));
    rig.track.data.Parameter.Cam[1].OnPosition = 0.0;
    rig.track.data.Parameter.Cam[1].OffPosition = 5.0;
    rig.run(3);
    EXPECT_EQ(rig.track.data.Status, mode == 1 ? 2 : 1);
    ASSERT_TRUE(rig.switched(true));
    if (mode == 1) {
      EXPECT_NEAR(std::remainder(rig.on_at - zero - 0.8, 1.0), 0.0, kExact) << "the old data until then";
      ASSERT_TRUE(rig.switched(false));
      ASSERT_TRUE(rig.switched(true));
      EXPECT_EQ(rig.track.data.Status, 1);
    }
    EXPECT_NEAR(std::remainder(rig.on_at - zero - 0.2, 1.0), 0.0, kExact);
    ASSERT_TRUE(rig.switched(false));
    EXPECT_NEAR(rig.off_at - rig.on_at, 0.05, kExact);
  }
}

TEST(CamTrackTimeCams, AtTheBeginningOfNewDataAreNotLost) {
  Track rig({}, [](CamTrackData& data) {
    data.Parameter.CamTrackType = 1;
    data.Parameter.Cam[0] = {.OnPosition = 50.0, .Duration = 10.0, .Existent = true};
    data.Parameter.Cam[1].Existent = false;
  });
  rig.fb.Enable = true;
  const double zero = rig.cruise(100.0);
  ASSERT_TRUE(rig.switched(true));
  rig.track.data.Parameter.Cam[0].OnPosition = 0.0;
  ASSERT_TRUE(rig.switched(false));
  ASSERT_TRUE(rig.switched(true));
  EXPECT_NEAR(std::remainder(rig.on_at - zero - 0.2, 1.0), 0.0, kExact);
}

TEST(CamTrackLetGo, EndsAtOnceOrWithItsTrack) {
  for (const DINT mode : {0, 1, 2}) {
    Track rig;
    rig.fb.Mode = mode;
    rig.fb.Enable = true;
    const double zero = rig.cruise(100.0);
    ASSERT_TRUE(rig.run_until([&] { return rig.track.data.TrackPosition > 65.0; }));
    EXPECT_TRUE(rig.output());
    rig.fb.Enable = false;
    rig.run(3);
    EXPECT_EQ(rig.output(), mode == 1);
    EXPECT_EQ(rig.fb.Busy, mode == 1);
    ASSERT_TRUE(rig.run_until([&] { return !rig.fb.Busy; }));
    EXPECT_EQ(rig.track.data.Status, 0);
    if (mode == 1) {
      EXPECT_NEAR(std::remainder(rig.off_at - zero - 0.1, 1.0), 0.0, kExact);
      EXPECT_NEAR(std::remainder(rig.c.data.Position, 100.0), 20.0, 0.5);
    }
  }
}

TEST(CamTrackOutput, IsInvertedOrHeldOn) {
  Track rig;
  rig.fb.InvertOutput = true;
  rig.fb.Enable = true;
  const double zero = rig.cruise(100.0);
  ASSERT_TRUE(rig.switched(true));
  ASSERT_TRUE(rig.switched(false));
  EXPECT_NEAR(std::remainder(rig.off_at - zero - 0.3, 1.0), 0.0, kExact);
  rig.fb.Mode = 2;
  rig.run(3);
  for (int i = 0; i < 200; ++i) {
    rig.run(10);
    EXPECT_TRUE(rig.output());
  }
}

TEST(CamTrackAlarms, TellOfWrongData) {
  Track rig;
  rig.fb.Mode = 0;
  rig.fb.Enable = true;
  rig.run(3);
  rig.track.data.Parameter.Cam[1].OffPosition = 60.0;
  rig.run(3);
  EXPECT_EQ(rig.track.data.ErrorDetail.Number, 703u);
  EXPECT_EQ(rig.track.data.ErrorDetail.Reaction, 7);
  EXPECT_EQ(rig.fb.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  EXPECT_EQ(rig.track.data.Status, 0);
  rig.track.data.Parameter.Cam[1].OffPosition = 90.0;
  rig.reset.Execute = true;
  rig.run(4);
  EXPECT_EQ(rig.track.data.Status, 1);
  EXPECT_FALSE(rig.fb.Error);
}

TEST(CamTrackAxis, RestartedEndsTheJob) {
  Track rig;
  auto& restart = rig.block<MC_Reset>();
  restart.Axis = &rig.c;
  restart.Restart = true;
  rig.fb.Enable = true;
  rig.run(5);
  ASSERT_TRUE(rig.fb.Busy);
  rig.power.Enable = false;
  rig.run(5);
  restart.Execute = true;
  rig.run(5);
  ASSERT_TRUE(restart.Done);
  EXPECT_TRUE(rig.fb.Error && !rig.fb.Busy);
  EXPECT_EQ(rig.fb.ErrorID, static_cast<WORD>(ErrorId::restarting));
  EXPECT_EQ(rig.track.data.ErrorDetail.Number, 0u);
  EXPECT_EQ(rig.track.data.Status, 0);
  rig.fb.Enable = false;
  rig.run(3);
  rig.fb.Enable = true;
  rig.run(5);
  EXPECT_TRUE(rig.fb.Busy && !rig.fb.Error);
  EXPECT_EQ(rig.track.data.Status, 1);
}

TEST(CamTrackInstances, ASecondOneIsRefused) {
  Track rig;
  rig.fb.Enable = rig.second.Enable = true;
  rig.run(3);
  EXPECT_TRUE(rig.fb.Busy && !rig.fb.Error);
  EXPECT_EQ(rig.second.ErrorID, static_cast<WORD>(ErrorId::one_instance_only));
}

}  // namespace
}  // namespace lockstep::output_cam_test
