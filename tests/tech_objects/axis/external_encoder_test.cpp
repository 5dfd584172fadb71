// External encoders: what they measure, homing, faults, and axes that follow them.
#include "tech_objects/sensing/external_encoder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "fb/gear_in.hpp"
#include "fb/gear_in_velocity.hpp"
#include "fb/home.hpp"
#include "fb/leading_value.hpp"
#include "fb/move.hpp"
#include "fb/phasing.hpp"
#include "fb/power.hpp"
#include "fb/stop.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::external_encoder_test {
namespace {

using test::Rig;

/// A conveyor with a drive, an encoder on its load, and an axis that follows the encoder.
struct Line : Rig {
  explicit Line(const std::function<void(ExternalEncoder&)>& set = {}, int ratio = 1,
                bool virtual_axis = false)
      : Rig(1'000'000, ratio),
        c(axis("Conveyor", [&](AxisData& data) { data.VirtualAxis.Mode = virtual_axis ? 1 : 0; })),
        e(static_cast<ExternalEncoder&>(controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"))),
        f(axis("Following")),
        power_c(block<MC_Power>()),
        power_e(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home_c(block<MC_Home>()),
        home_e(block<MC_Home>()),
        home_f(block<MC_Home>()),
        reset_e(block<MC_Reset>()),
        run_c(block<MC_MoveVelocity>()),
        gear(block<MC_GearIn>()),
        pos(block<MC_GearInPos>()),
        velocity(block<MC_GearInVelocity>()),
        phasing(block<MC_PhasingRelative>()) {
    c.drive_settings = {.time_constant = 0.003, .dead_time = 0.002, .resolution = 0.0};
    e.source_settings.follows = &c;
    if (set) set(e);
    f.leading_values.push_back({&e, Coupling::actual});
    power_c.Axis = home_c.Axis = run_c.Axis = &c;
    power_e.Axis = home_e.Axis = &e;
    reset_e.Axis = &e;
    power_f.Axis = home_f.Axis = &f;
    gear.Master = pos.Master = velocity.Master = &e;
    gear.Slave = pos.Slave = velocity.Slave = phasing.Slave = &f;
    phasing.Master = &e;
    power_c.Enable = power_e.Enable = power_f.Enable = true;
    continuity[1].velocity = false;  // what an encoder shows is no profile
    Rig::run(10 * ratio);
    home_c.Execute = home_e.Execute = home_f.Execute = true;
    Rig::run(10 * ratio);
  }

  void run_conveyor(double speed, double acceleration = 1000.0) {
    run_c.Velocity = speed;
    run_c.Acceleration = acceleration;
    run_c.Execute = false;
    tick();
    run_c.Execute = true;
    tick();
  }
  double ahead() const {
    return shortest_distance(e.data.ActualPosition, f.setpoint().position.value, e.modulo());
  }

  Axis& c;
  ExternalEncoder& e;
  Axis& f;
  MC_Power &power_c, &power_e, &power_f;
  MC_Home &home_c, &home_e, &home_f;
  MC_Reset& reset_e;
  MC_MoveVelocity& run_c;
  MC_GearIn& gear;
  MC_GearInPos& pos;
  MC_GearInVelocity& velocity;
  MC_PhasingRelative& phasing;
};

class EncoderOnAnAxis : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Ratios, EncoderOnAnAxis, ::testing::Values(1, 2, 8));

TEST_P(EncoderOnAnAxis, IsWhereItsLoadIsTimesTheRatio) {
  Line line([](ExternalEncoder& e) { e.source_settings.ratio = -2.5; }, GetParam());
  line.run_conveyor(300.0);
  for (int i = 0; i < 3000; ++i) {
    line.tick();
    ASSERT_NEAR(line.e.actual_position().value, -2.5 * line.c.actual_position().value, 1e-9) << i;
  }
  EXPECT_NEAR(line.e.data.ActualVelocity, -750.0, 1e-6);
}

TEST_P(EncoderOnAnAxis, LeavesNoFollowingErrorAtConstantVelocity) {
  Line line({}, GetParam());
  line.e.data.Extrapolation.PositionFilter = {0.004, 0.003};
  line.e.data.Extrapolation.VelocityFilter = {0.02, 0.01};
  line.gear.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return line.gear.InGear; }));
  line.run_conveyor(300.0);
  line.run(4000);
  EXPECT_DOUBLE_EQ(line.e.data.Extrapolation.LeadingAxisDependentTime, line.period() + 0.007);
  for (int i = 0; i < 500; ++i) {
    line.run(GetParam());
    // Its setpoint is ahead by the one interpolator cycle that it takes until it acts.
    ASSERT_NEAR(line.ahead(), 300.0 * line.period(), 1e-6);
    ASSERT_NEAR(line.f.data.Velocity, 300.0, 1e-6);
  }
}

/// A virtual axis acts one interpolator cycle after its setpoint, as if it had a drive without delay.
TEST_P(EncoderOnAnAxis, SeesAVirtualAxisFineInterpolatedOneInterpolatorCycleLater) {
  Line line({}, GetParam(), true);
  line.run_conveyor(240.0);
  line.run(2000 - 2000 % GetParam());
  for (int i = 0; i < 200; ++i) {
    line.tick();
    const std::int64_t ticks = line.controller.now() / 1'000'000 - 1;
    const double since = static_cast<double>(ticks % GetParam()) * 1e-3;
    const double expected = line.c.data.Position + 240.0 * (since - line.period());
    ASSERT_NEAR(line.e.actual_position().value, expected, 1e-9);
  }
}

/// Position filter, velocity filter and extrapolation as the manual has them, written down once more.
struct Reference {
  double period, t1, t2, v1, v2;
  double p1 = 0, p2 = 0, w1 = 0, w2 = 0, last_p = 0, last_f1 = 0, last_v = 0, last_g1 = 0;
  static double lag(double& y, double from, double to, double time, double h) {
    if (time == 0.0) return y = to;
    const double decay = std::exp(-h / time);
    const double slope = (to - from) / h;
    return y = to - slope * time + (y - from + slope * time) * decay;
  }
  double step(double p, double v) {
    const double f1 = lag(p1, last_p, p, t1, period);
    const double f2 = lag(p2, last_f1, f1, t2, period);
    const double g1 = lag(w1, last_v, v, v1, period);
    const double g2 = lag(w2, last_g1, g1, v2, period);
    last_p = p, last_f1 = f1, last_v = v, last_g1 = g1;
    return f2 + g2 * (period + t1 + t2);
  }
};

TEST(EncoderExtrapolation, IsThatOfTheDiscreteReferenceFilterAtConstantAcceleration) {
  Line line;
  line.e.data.Extrapolation.PositionFilter = {0.004, 0.003};
  line.e.data.Extrapolation.VelocityFilter = {0.02, 0.01};
  Reference reference{line.period(), 0.004, 0.003, 0.02, 0.01};
  line.gear.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return line.gear.InGear; }));
  line.run_c.Jerk = 0.0;
  line.run_c.Velocity = 400.0;
  line.run_c.Acceleration = 300.0;
  line.run_c.Execute = true;
  double last = line.e.data.ActualPosition;
  double worst = 0.0;
  for (int i = 0; i < 1200; ++i) {
    line.tick();
    const double here = line.e.data.ActualPosition;
    const double expected = reference.step(here, (here - last) / line.period());
    last = here;
    ASSERT_NEAR(line.f.setpoint().position.value, expected, 1e-8) << i;
    worst = std::max(worst, std::abs(expected - here - line.period() * line.e.data.ActualVelocity));
  }
  EXPECT_GT(worst, 1e-3) << "an acceleration leaves an error, and the reference has it too";
}

TEST(EncoderWithNoise, StaysWithinBandHysteresisAndFilteredNoise) {
  constexpr double kNoise = 0.004;
  Line line([](ExternalEncoder& e) {
    e.source_settings.noise = kNoise;
    e.source_settings.resolution = 0.001;
  });
  auto& settings = line.e.data.Extrapolation;
  settings.PositionFilter = {0.004, 0.003};
  settings.VelocityFilter = {0.05, 0.05};
  settings.VelocityTolerance.Range = 0.6;
  settings.Hysteresis.Value = 0.004;
  line.gear.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return line.gear.InGear; }));
  line.run_conveyor(123.4);
  line.run(4000);
  const double time = settings.LeadingAxisDependentTime;
  // A reading is up to noise and half an increment away; a lag leaves of a velocity at most the jump of the
  // position over its time constant.
  const double deviation = kNoise + 0.0005;
  const double bound = 0.5 * settings.VelocityTolerance.Range * time + settings.Hysteresis.Value + deviation +
                       2.0 * deviation / 0.05 * time;
  double worst = 0.0;
  for (int i = 0; i < 5000; ++i) {
    line.tick();
    const double truth = line.c.data.ActualPosition + 123.4 * line.period();
    ASSERT_LE(std::abs(line.f.setpoint().position.value - truth), bound);
    worst = std::max(worst, std::abs(line.e.data.ActualPosition - line.c.data.ActualPosition));
  }
  EXPECT_GT(worst, 0.8 * kNoise) << "there is noise";
  EXPECT_LE(worst, deviation + 1e-9);
}

TEST(EncoderWithNoise, ShowsTheSameBitsInEveryRun) {
  const auto readings = [] {
    Line line([](ExternalEncoder& e) { e.source_settings.noise = 0.01; });
    line.run_conveyor(100.0);
    std::vector<double> values;
    for (int i = 0; i < 500; ++i) {
      line.tick();
      values.push_back(line.e.data.ActualPosition);
    }
    return values;
  };
  EXPECT_EQ(readings(), readings());
}

TEST(MC_SynchronizedMotionSimulation, OfACouplingToAnEncoderNeedsNoExactRest) {
  Line line([](ExternalEncoder& e) { e.source_settings.noise = 0.0001; });
  auto& simulation = line.block<MC_SynchronizedMotionSimulation>();
  auto& halt = line.block<MC_Halt>();
  simulation.Slave = &line.f;
  halt.Axis = &line.c;
  line.run_conveyor(50.0);
  line.gear.Jerk = 0.0;
  line.gear.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return line.gear.InGear; }));
  halt.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return halt.Done; }));
  line.run(500);
  EXPECT_NE(line.f.data.Velocity, 0.0);  // that is the noise
  simulation.Enable = true;
  line.run(2);
  EXPECT_TRUE(simulation.InSimulation);
  EXPECT_EQ(line.f.data.Velocity, 0.0);
  simulation.Enable = false;
  line.run(2);
  EXPECT_FALSE(simulation.InSimulation);
  EXPECT_TRUE(has_bit(line.f.data.StatusWord, StatusBit::Synchronous));
}

// ---- A signal
// ---------------------------------------------------------------------------------------------------

/// An encoder whose position is a number that the test writes.
struct OnSignal : Rig {
  explicit OnSignal(double wrap = 0.0, const std::function<void(ExternalEncoderData&)>& set = {})
      : e(static_cast<ExternalEncoder&>(controller.add_object(ObjectKind::TO_ExternalEncoder, "Encoder"))),
        f(axis("Following")),
        power(block<MC_Power>()),
        power_f(block<MC_Power>()),
        home(block<MC_Home>()),
        reset(block<MC_Reset>()),
        gear(block<MC_GearIn>()) {
    e.source_settings.signal = {&value, Type::LREAL};
    e.source_settings.wrap = wrap;
    if (set) set(e.data);
    f.leading_values.push_back({&e, Coupling::actual});
    power.Axis = home.Axis = &e;
    reset.Axis = &e;
    power_f.Axis = &f;
    gear.Master = &e;
    gear.Slave = &f;
    power.Enable = power_f.Enable = true;
    continuity[0].velocity = false;
  }
  double value = 0.0;
  ExternalEncoder& e;
  Axis& f;
  MC_Power &power, &power_f;
  MC_Home& home;
  MC_Reset& reset;
  MC_GearIn& gear;
};

TEST(EncoderOnASignal, BeginsWhereTheSignalIsAndFollowsIt) {
  OnSignal rig;
  rig.value = 123.5;
  rig.run(3);
  EXPECT_EQ(rig.e.data.ActualPosition, 123.5);
  EXPECT_EQ(rig.e.data.ActualVelocity, 0.0);
  EXPECT_TRUE(rig.power.Status);
  rig.value = 124.0;
  rig.tick();
  EXPECT_EQ(rig.e.data.ActualPosition, 124.0);
  EXPECT_NEAR(rig.e.data.ActualVelocity, 500.0, 1e-9);
}

TEST(EncoderOnASignal, CountsTheTurnsOfASignalThatWraps) {
  OnSignal rig(4096.0, [](ExternalEncoderData& data) {
    data.Modulo.Enable = true;
    data.Modulo.Length = 1000.0;
  });
  double place = 0.0;
  for (int i = 0; i < 20000; ++i) {
    place += 13.0;
    rig.value = std::fmod(place, 4096.0);
    rig.tick();
  }
  EXPECT_EQ(rig.e.data.ActualModuloCycle, 260);
  EXPECT_EQ(rig.e.data.ActualPosition, 0.0);
}

TEST(EncoderOnASignal, TurnsRoundWithInverseDirection) {
  OnSignal rig(0.0, [](ExternalEncoderData& data) { data.Sensor.InverseDirection = true; });
  rig.value = 5.0;
  rig.run(2);
  rig.value = 7.0;
  rig.run(2);
  EXPECT_EQ(rig.e.data.ActualPosition, -7.0);
}

TEST(EncoderOnASignal, FailsWithAlarm411WhileTheSignalIsNoNumberAndStopsWhatFollows) {
  OnSignal rig;
  rig.run(5);
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  for (int i = 0; i < 300; ++i) {
    rig.value += 0.1;
    rig.tick();
  }
  EXPECT_NEAR(rig.f.data.Velocity, 100.0, 1e-6);
  rig.continuity[0].velocity = true;  // it stops without a step
  rig.value = NAN;
  rig.run(2);
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 411u);
  EXPECT_EQ(rig.e.data.ErrorDetail.Reaction, 10);
  EXPECT_EQ(rig.e.data.StatusSensor.State, 0);
  EXPECT_TRUE(has_bit(rig.e.data.ErrorWord, ErrorBit::SensorFault));
  EXPECT_FALSE(rig.power.Status);
  EXPECT_TRUE(rig.power.Error);
  EXPECT_EQ(rig.power.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  EXPECT_EQ(rig.f.pending_alarm(), 601);
  EXPECT_TRUE(rig.gear.Error);
  rig.run(2000);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
  // Acknowledged while the cause is there, it fails again.
  rig.reset.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 411u);
  rig.reset.Execute = false;
  rig.value = 500.0;
  rig.run(2);
  const double before = rig.e.data.ActualPosition;
  rig.reset.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 0u);
  EXPECT_TRUE(rig.power.Status);
  EXPECT_NEAR(rig.e.data.ActualPosition, before, 1e-9) << "it goes on from where it was seen last";
}

/// A signal that comes from elsewhere, so that it may not be heard of.
struct OnHeardSignal : OnSignal {
  explicit OnHeardSignal(double wrap = 0.0, const std::function<void(ExternalEncoderData&)>& set = {})
      : OnSignal(wrap, set) {
    e.source_settings.valid = &valid;
  }
  /// Ticks in which the material goes on by 0.1 u each.
  void go(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      value += 0.1;
      tick();
    }
  }
  bool valid = false;
};

TEST(EncoderOnASignal, ThatIsNotHeardOfYetIsAwaitedAndBeginsAtItsFirstValue) {
  OnHeardSignal rig;
  rig.run(50);
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 0u);
  EXPECT_EQ(rig.e.data.StatusSensor.State, 0);
  EXPECT_FALSE(rig.e.data.StatusSensor.CommunicationOK);
  EXPECT_FALSE(rig.power.Status);
  rig.gear.Execute = true;
  rig.run(3);
  EXPECT_TRUE(rig.gear.Error) << "there is nothing to follow yet";
  rig.value = 4000.0;
  rig.run(3);
  EXPECT_EQ(rig.e.data.ActualPosition, 0.0);
  rig.valid = true;
  rig.tick();
  EXPECT_EQ(rig.e.data.ActualPosition, 4000.0);
  EXPECT_EQ(rig.e.data.ActualVelocity, 0.0);
  EXPECT_EQ(rig.e.data.StatusSensor.State, 2);
  EXPECT_TRUE(rig.e.data.StatusSensor.CommunicationOK);
}

TEST(EncoderOnASignal, ThatIsNotHeardOfAnyMoreFailsWithAlarm411AndLaterGoesOnFromWhereItWasSeenLast) {
  OnHeardSignal rig;
  rig.valid = true;
  rig.run(5);
  rig.gear.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.gear.InGear; }));
  rig.go(300);
  EXPECT_NEAR(rig.f.data.Velocity, 100.0, 1e-6);
  const double seen = rig.e.data.ActualPosition;
  rig.continuity[0].velocity = true;  // from here on without a step
  rig.valid = false;
  rig.go(2);
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 411u);
  EXPECT_TRUE(rig.e.data.StatusSensor.Error);
  EXPECT_FALSE(rig.e.data.StatusSensor.CommunicationOK);
  EXPECT_EQ(rig.f.pending_alarm(), 601);
  EXPECT_FALSE(rig.gear.InGear);
  rig.go(1000);
  rig.valid = true;
  rig.go(100);
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 411u) << "until it is acknowledged";
  EXPECT_TRUE(rig.e.data.StatusSensor.CommunicationOK);
  EXPECT_EQ(rig.e.data.ActualPosition, seen);
  EXPECT_EQ(rig.f.data.Velocity, 0.0);
  rig.reset.Execute = true;
  rig.go(3);
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 0u);
  const double again = rig.e.data.ActualPosition;
  EXPECT_NEAR(again, seen, 0.3) << "what it goes from there on counts";
  rig.go(10);
  EXPECT_NEAR(rig.e.data.ActualPosition, again + 1.0, 1e-9);
  EXPECT_NEAR(rig.e.data.ActualVelocity, 100.0, 1e-6);
}

/// Whenever it is acknowledged, and on a ring too: the way that nobody has seen is none.
TEST(EncoderOnASignal, NeverStepsWhenItIsHeardOfAgain) {
  for (const bool ring : {false, true}) {
    for (int wait = 0; wait < 6; ++wait) {
      SCOPED_TRACE(testing::Message() << "heard of again " << wait << " ticks after the reset");
      OnHeardSignal rig(0.0, [&](ExternalEncoderData& data) {
        data.Modulo.Enable = ring;
        data.Modulo.Length = 100.0;
      });
      rig.valid = true;
      rig.go(20);
      rig.valid = false;
      rig.run(3);
      const double seen = rig.e.data.ActualPosition;
      rig.value += 777.0;
      rig.reset.Execute = true;
      rig.run(wait);
      rig.valid = true;
      for (int i = 0; i < 5; ++i) {
        rig.tick();
        ASSERT_NEAR(rig.e.data.ActualPosition, seen, 1e-9);
        ASSERT_NEAR(rig.e.data.ActualVelocity, 0.0, 1e-9);
        ASSERT_NE(rig.e.data.ErrorDetail.Number, 412u);
        ASSERT_EQ(rig.e.true_line().rounded(), rig.e.last_true_line().rounded()) << "no mark has passed";
      }
    }
  }
}

TEST(EncoderOnASignal, FailsWithAlarm412BeyondHalfATurnOfItsRingInOneCycleWhereItLeads) {
  OnSignal rig(0.0, [](ExternalEncoderData& data) {
    data.Modulo.Enable = true;
    data.Modulo.Length = 100.0;
  });
  rig.run(3);
  rig.value = 49.0;
  rig.tick();
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 0u);
  rig.value = 100.0;
  rig.tick();
  EXPECT_EQ(rig.e.data.ErrorDetail.Number, 412u);
}

TEST(EncoderOnASignal, RefusesAJobThatWouldFollowItWhileItFails) {
  OnSignal rig;
  rig.value = NAN;
  rig.run(5);
  rig.gear.Execute = true;
  rig.run(3);
  EXPECT_EQ(rig.f.pending_alarm(), 601);
  EXPECT_TRUE(rig.gear.Error);
}

// ---- Homing, status, jobs
// ---------------------------------------------------------------------------------------

TEST(EncoderHoming, GivesThePositionAnotherName) {
  Line line;
  line.run_conveyor(100.0);
  line.run(500);
  line.home_e.Execute = false;
  line.tick();
  line.home_e.Mode = 0;
  line.home_e.Position = 1000.0;
  line.home_e.Execute = true;
  line.run(2);
  const double at = line.c.data.ActualPosition;
  EXPECT_TRUE(line.home_e.Done);
  EXPECT_EQ(line.e.data.ActualPosition, 1000.0);
  line.tick();
  EXPECT_TRUE(has_bit(line.e.data.StatusWord, StatusBit::HomingDone));
  EXPECT_NEAR(line.e.data.ActualPosition, 1000.0 + (line.c.data.ActualPosition - at), 1e-9);
  line.home_e.Execute = false;
  line.tick();
  line.home_e.Mode = 1;
  line.home_e.Position = -250.0;
  line.home_e.Execute = true;
  line.run(2);
  EXPECT_NEAR(line.e.data.ActualPosition, 750.0 + (line.c.data.ActualPosition - at), 1e-9);
  EXPECT_NEAR(line.e.data.ActualVelocity, 100.0, 0.01) << "a name is no motion";
}

TEST(EncoderHoming, OfTheAxisOnWhichItSitsDoesNotMoveIt) {
  for (const bool virtual_axis : {false, true}) {
    Line line({}, 1, virtual_axis);
    line.continuity[0].velocity = false;  // homing is a step
    line.run_conveyor(100.0);
    line.run(300);
    line.home_c.Execute = false;
    line.tick();
    line.home_c.Mode = 1;
    line.home_c.Position = 5000.0;
    line.home_c.Execute = true;
    for (int i = 0; i < 20; ++i) {
      const double before = line.e.data.ActualPosition;
      line.tick();
      ASSERT_NEAR(line.e.data.ActualPosition - before, 0.1, 0.005) << i;
    }
    EXPECT_GT(line.c.data.ActualPosition, 5000.0);
  }
}

TEST(EncoderHoming, RefusesModesThatAnIncrementalEncoderDoesNotHave) {
  Line line;
  for (const auto& [mode, error] :
       {std::pair{HomeMode::adjust_absolute_relative, ErrorId::homing_mode_incremental},
        {HomeMode::adjust_absolute, ErrorId::homing_mode_incremental}}) {
    Job job;
    job.kind = JobKind::MC_Home;
    job.asks = HomingJob{.mode = mode};
    line.e.submit(job);
    line.tick();
    EXPECT_EQ(job.phase, JobPhase::failed);
    EXPECT_EQ(job.error, error);
  }
}

/// A conveyor whose encoder is homed in passing. The machine has zero marks at 3, 13, 23 …, and a cam from 40
/// to 50.
struct Passing : Line {
  explicit Passing(const std::function<void(ExternalEncoder&)>& set = {})
      : Line([&](ExternalEncoder& e) {
          e.source_settings.signals.zero_marks = ZeroMarks{3.0, 10.0};
          e.source_settings.signals.reference_cam = PositionRange{40.0, 50.0};
          e.data.Homing.HomePosition = 77.0;
          if (set) set(e);
        }),
        other(block<MC_Home>()) {
    other.Axis = &e;
  }
  void start(MC_Home& home, INT mode, double position) {
    home.Execute = false;
    run(2);
    home.Mode = mode;
    home.Position = position;
    home.Execute = true;
    run(3);
  }
  /// The position that a place of the machine has got.
  double position_of(double place) const {
    const double on_its_line = e.data.Sensor.InverseDirection ? -place : place;
    return e.data.ActualPosition - (e.true_line().rounded() - on_its_line);
  }
  bool shows(StatusBit bit) const { return has_bit(e.data.StatusWord, bit); }

  MC_Home& other;
};

TEST(EncoderPassiveHoming, GivesTheNextZeroMarkItsPosition) {
  Passing line;
  ASSERT_TRUE(line.shows(StatusBit::HomingDone));
  line.start(line.home_e, 8, 1000.0);
  EXPECT_TRUE(line.home_e.Busy);
  EXPECT_TRUE(line.shows(StatusBit::HomingCommand));
  EXPECT_FALSE(line.shows(StatusBit::HomingDone)) << "Mode 8 begins anew";
  line.run_conveyor(50.0);
  ASSERT_TRUE(line.run_until([&] { return line.home_e.Done; }, 1000));
  EXPECT_NEAR(line.position_of(3.0), 1000.0, 1e-9);
  EXPECT_EQ(line.home_e.ReferenceMarkPosition, 1000.0);
  EXPECT_EQ(line.e.data.StatusSensor.Adjusted, 1);
  line.tick();
  EXPECT_TRUE(line.shows(StatusBit::HomingDone));
  EXPECT_FALSE(line.shows(StatusBit::HomingCommand));
  EXPECT_NEAR(line.e.data.ActualVelocity, line.c.data.ActualVelocity, 1.0) << "a name is no motion";
}

TEST(EncoderPassiveHoming, Mode2KeepsHomingDoneAndMode10TakesHomePosition) {
  Passing line;
  line.start(line.home_e, 2, 5.0);
  EXPECT_TRUE(line.shows(StatusBit::HomingDone));
  line.run_conveyor(50.0);
  ASSERT_TRUE(line.run_until([&] { return line.home_e.Done; }, 1000));
  EXPECT_NEAR(line.position_of(3.0), 5.0, 1e-9);
  line.start(line.home_e, 10, 5.0);
  ASSERT_TRUE(line.run_until([&] { return line.home_e.Done; }, 1000));
  EXPECT_NEAR(line.position_of(13.0), 77.0, 1e-9);
  EXPECT_EQ(line.home_e.ReferenceMarkPosition, 77.0);
}

TEST(EncoderPassiveHoming, TakesOnlyMarksThatArePassedInItsDirection) {
  Passing line([](ExternalEncoder& e) { e.data.Sensor.PassiveHoming.Direction = 1; });
  line.start(line.home_e, 8, 0.0);
  line.run_conveyor(50.0);
  line.run(500);
  EXPECT_TRUE(line.home_e.Busy);
  line.run_c.Direction = 2;
  line.run_conveyor(50.0);
  ASSERT_TRUE(line.run_until([&] { return line.home_e.Done; }, 2000));
  const double marks = (line.e.true_line().rounded() - line.e.data.ActualPosition - 3.0) / 10.0;
  EXPECT_NEAR(marks, std::round(marks), 1e-9);
}

TEST(EncoderPassiveHoming, CountsTheOtherWayRoundWithInverseDirection) {
  Passing line([](ExternalEncoder& e) {
    e.data.Sensor.InverseDirection = true;
    e.data.Sensor.PassiveHoming.Direction = 0;
  });
  line.start(line.home_e, 8, 1000.0);
  line.run_conveyor(50.0);
  line.run(300);
  EXPECT_TRUE(line.home_e.Busy) << "the encoder counts down, and only marks on the way up count";
  line.run_c.Direction = 2;
  line.run_conveyor(50.0);
  ASSERT_TRUE(line.run_until([&] { return line.home_e.Done; }, 2000));
  const double marks = (line.position_of(3.0) - 1000.0) / 10.0;
  EXPECT_NEAR(marks, std::round(marks), 1e-9);
}

TEST(EncoderPassiveHoming, WaitsForTheZeroMarkBehindTheReferenceCam) {
  Passing line([](ExternalEncoder& e) { e.data.Sensor.PassiveHoming.Mode = 1; });
  line.start(line.home_e, 8, 0.0);
  line.run_conveyor(100.0);
  ASSERT_TRUE(line.run_until([&] { return line.home_e.Done; }, 2000));
  EXPECT_NEAR(line.position_of(53.0), 0.0, 1e-9);
}

TEST(EncoderPassiveHoming, TakesTheConfiguredEdgeOfADigitalInputWithItsLevel) {
  bool input = true;
  Passing line([&](ExternalEncoder& e) {
    e.data.Sensor.PassiveHoming.Mode = 2;
    e.data.Sensor.PassiveHoming.DigitalInputAddress = &input;  // active while FALSE
    e.data.Sensor.PassiveHoming.SideInput = true;
  });
  line.start(line.home_e, 8, 0.0);
  line.run_conveyor(100.0);
  line.run(500);
  input = false;
  line.run(100);
  EXPECT_TRUE(line.home_e.Busy) << "the other edge";
  input = true;
  const double here = line.e.true_line().rounded();
  line.run(3);
  EXPECT_TRUE(line.home_e.Done);
  EXPECT_NEAR(line.position_of(here), 0.0, 0.11) << "to a servo cycle";
}

TEST(EncoderPassiveHoming, EndsByMode9ByAnotherOneAndWithTheEnable) {
  Passing line;
  line.start(line.home_e, 8, 0.0);
  line.start(line.other, 9, 0.0);
  EXPECT_TRUE(line.other.Done);
  EXPECT_TRUE(line.home_e.CommandAborted);
  line.start(line.home_e, 8, 0.0);
  line.start(line.other, 8, 0.0);
  EXPECT_TRUE(line.home_e.CommandAborted);
  EXPECT_TRUE(line.other.Busy);
  line.power_e.Enable = false;
  line.run(3);
  EXPECT_TRUE(line.other.CommandAborted);
  line.start(line.home_e, 8, 0.0);
  EXPECT_EQ(line.home_e.ErrorID, static_cast<WORD>(ErrorId::locked));
  line.start(line.home_e, 3, 0.0);
  EXPECT_EQ(line.home_e.ErrorID, static_cast<WORD>(ErrorId::mode)) << "it moves nothing";
}

TEST(EncoderPassiveHoming, WithoutSuchAMarkIsAlarm343) {
  Passing line([](ExternalEncoder& e) { e.source_settings.signals.zero_marks.reset(); });
  line.start(line.home_e, 8, 0.0);
  EXPECT_EQ(line.home_e.ErrorID, static_cast<WORD>(ErrorId::technology_alarm));
  EXPECT_EQ(line.e.data.ErrorDetail.Number, static_cast<UDINT>(alarm::kHomingNotSupported));
  EXPECT_FALSE(line.shows(StatusBit::HomingCommand));
  line.reset_e.Execute = true;
  line.run(3);
  EXPECT_EQ(line.e.data.ErrorDetail.Number, 0u);
}

TEST(EncoderPassiveHoming, CountsTheTurnsOfItsRingAnew) {
  for (const auto& [position, turns] : {std::pair{20.0, 0}, {80.0, -1}}) {
    Passing line([](ExternalEncoder& e) {
      e.data.Modulo.Enable = true;
      e.data.Modulo.Length = 100.0;
      e.data.Sensor.PassiveHoming.Mode = 1;
    });
    line.run_conveyor(100.0);
    line.run(4000);
    line.start(line.home_e, 8, position);
    ASSERT_TRUE(line.run_until([&] { return line.home_e.Done; }, 2000));
    line.tick();
    EXPECT_EQ(line.e.data.ActualModuloCycle, turns);
  }
}

TEST(EncoderStatus, TellsOfStandstillAndOfItsEnable) {
  Line line;
  line.run(50);
  EXPECT_TRUE(has_bit(line.e.data.StatusWord, StatusBit::Standstill));
  EXPECT_TRUE(has_bit(line.e.data.StatusWord, StatusBit::Enable));
  line.run_conveyor(100.0);
  line.run(500);
  EXPECT_FALSE(has_bit(line.e.data.StatusWord, StatusBit::Standstill));
  line.power_e.Enable = false;
  line.run(3);
  EXPECT_FALSE(line.power_e.Status);
  EXPECT_FALSE(line.power_e.Busy);
  EXPECT_FALSE(has_bit(line.e.data.StatusWord, StatusBit::Enable));
  EXPECT_NEAR(line.e.data.ActualVelocity, 100.0, 0.01) << "actual values are shown all the same";
}

TEST(EncoderRestart, IsRefusedWhileEnabledAndEndsWhatFollows) {
  Line line;
  line.reset_e.Restart = true;
  line.reset_e.Execute = true;
  line.run(3);
  EXPECT_EQ(line.reset_e.ErrorID, static_cast<WORD>(ErrorId::restart_refused));
  EXPECT_TRUE(has_bit(line.e.data.WarningWord, WarningBit::CommandNotAccepted)) << "warning 322";
  EXPECT_EQ(line.e.data.ErrorDetail.Number, 0u);
  line.gear.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return line.gear.InGear; }));
  line.power_e.Enable = false;
  line.reset_e.Execute = false;
  line.run(3);
  EXPECT_TRUE(line.gear.InGear);
  line.reset_e.Execute = true;
  line.run(3);
  EXPECT_TRUE(line.reset_e.Done);
  EXPECT_EQ(line.f.pending_alarm(), 601);
  EXPECT_FALSE(has_bit(line.e.data.StatusWord, StatusBit::HomingDone));
}

// ---- Jobs that follow
// -------------------------------------------------------------------------------------------

TEST(FollowingAnEncoder, GearInPosPlacesTheFunctionAndPhasingShiftsIt) {
  Line line;
  line.pos.RatioNumerator = 2;
  line.pos.MasterSyncPosition = 100.0;
  line.pos.SlaveSyncPosition = 30.0;
  line.pos.MasterStartDistance = 60.0;
  line.pos.SyncProfileReference = 1;
  line.pos.Execute = true;
  line.run_conveyor(60.0);
  ASSERT_TRUE(line.run_until([&] { return line.pos.InSync; })) << static_cast<unsigned>(line.pos.ErrorID);
  const auto expected = [&] {
    return 30.0 + 2.0 * (line.e.data.StatusExtrapolation.ExtrapolatedPosition - 100.0);
  };
  for (int i = 0; i < 200; ++i) {
    line.tick();
    ASSERT_NEAR(line.f.setpoint().position.value, expected(), 1e-9);
  }
  line.phasing.PhaseShift = 5.0;
  line.phasing.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return line.phasing.Done; }));
  line.run(5);
  EXPECT_NEAR(line.f.setpoint().position.value, expected() + 10.0, 1e-9);
}

TEST(FollowingAnEncoder, GearInVelocityTakesItsVelocity) {
  Line line;
  line.run_conveyor(60.0);
  line.velocity.RatioNumerator = -3;
  line.velocity.RatioDenominator = 2;
  line.velocity.Execute = true;
  ASSERT_TRUE(line.run_until([&] { return line.velocity.InSync; }));
  line.run(2000);
  EXPECT_NEAR(line.f.data.Velocity, -90.0, 1e-6);
}

TEST(FollowingAnEncoder, NeedsNoEnableOfTheEncoder) {
  Line line;
  line.power_e.Enable = false;
  line.run(3);
  line.gear.Execute = true;
  EXPECT_TRUE(line.run_until([&] { return line.gear.InGear; }));
}

}  // namespace
}  // namespace lockstep::external_encoder_test
