// An axis with a drive that nobody but this test knows.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tech_objects/drive/drive_models.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::drive_of_another_kind_test {
namespace {

using test::Rig;

/// A drive that follows its setpoint at once, and has neither torque nor a position loop nor signals.
class Stepper final : public Drive {
 public:
  DriveProperties configure(const DriveSettings& /*settings*/, double servo_cycle,
                            double /*motor_angle*/) noexcept override {
    cycle_ = servo_cycle;
    const double held = 0.5 * servo_cycle;
    return {.known_delay = held, .transport_delay = held};
  }

  DriveActual read() noexcept override {
    return {.position = position_,
            .velocity = velocity_,
            .enabled = states_.operation(),
            .trouble = states_.fault(),
            .fault = states_.fault(),
            .inhibited = states_.state() == DriveStates::State::inhibited};
  }
  void write(double velocity) noexcept override {
    velocity_ = states_.operation() ? velocity : 0.0;
    position_ = position_ + velocity_ * cycle_;
    if (states_.stopping()) states_.stopped();
  }
  void control(std::uint16_t stw1, std::uint16_t stw2) noexcept override {
    words_ = {stw1, stw2, 0};
    states_.control(stw1);
  }

  DriveWords words() const noexcept override { return {words_.stw1, words_.stw2, states_.zsw1()}; }
  bool in_trouble() const noexcept override { return states_.fault(); }

  void fail() noexcept { states_.fail(false); }
  double position() const noexcept { return position_.rounded(); }
  double velocity() const noexcept { return velocity_; }

 private:
  DoubleDouble position_;
  double velocity_ = 0.0;
  double cycle_ = 0.0;
  DriveStates states_;
  DriveWords words_;
};

constexpr DriveModel kStepper{"stepper", make_drive<Stepper>};

struct Stepping : Rig {
  explicit Stepping(bool dsc = false)
      : a(axis("Slide",
               [dsc](AxisData& data) {
                 data.VirtualAxis.Mode = 0;
                 data.PositionControl.EnableDSC = dsc;
                 data.PositioningMonitoring.MinDwellTime = 0.02;
               })),
        power(block<MC_Power>()),
        reset(block<MC_Reset>()),
        move(block<MC_MoveRelative>()) {
    a.drive_model = &kStepper;
    power.Axis = move.Axis = &a;
    reset.Axis = &a;
    continuity[0].velocity = false;
    power.Enable = true;
    EXPECT_TRUE(run_until([&] { return power.Status; }));
  }

  Stepper& stepper() { return const_cast<Stepper&>(static_cast<const Stepper&>(a.drive())); }

  Axis& a;
  MC_Power& power;
  MC_Reset& reset;
  MC_MoveRelative& move;
};

class DriveOfAnotherKind : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(WithAndWithoutDsc, DriveOfAnotherKind, ::testing::Bool());

TEST_P(DriveOfAnotherKind, PositionsAnAxis) {
  Stepping rig(GetParam());
  EXPECT_EQ(rig.stepper().words().stw1, kControlOn);
  rig.move.Distance = 50.0;
  rig.move.Velocity = 100.0;
  rig.move.Execute = true;
  double fastest = 0.0;
  ASSERT_TRUE(rig.run_until([&] {
    fastest = std::max(fastest, rig.stepper().velocity());
    return rig.move.Done || rig.move.Error;
  }));
  EXPECT_TRUE(rig.move.Done);
  EXPECT_NEAR(fastest, 100.0, 1.0);
  rig.run(2000);  // position control comes to its end
  EXPECT_NEAR(rig.stepper().position(), 50.0, 1e-6);
  EXPECT_NEAR(rig.a.data.ActualPosition, 50.0, 1e-6);
  EXPECT_EQ(rig.a.pending_alarm(), 0);
}

TEST(AnotherDrive, LosesItsTorqueByAFaultThatMC_ResetAcknowledges) {
  Stepping rig;
  rig.stepper().fail();
  rig.run(2);
  EXPECT_EQ(rig.a.pending_alarm(), alarm::kDriveFault);
  ASSERT_TRUE(rig.run_until([&] { return rig.a.off(); }));
  rig.reset.Execute = true;
  ASSERT_TRUE(rig.run_until([&] { return rig.reset.Done; }));
  EXPECT_FALSE(rig.stepper().in_trouble());
  EXPECT_EQ(rig.a.pending_alarm(), 0);
  ASSERT_TRUE(rig.run_until([&] { return rig.a.enabled(); }));
}

TEST(AnotherDrive, WithoutSignalsHasNoMarkToHomeAt) {
  Stepping rig;
  EXPECT_FALSE(rig.a.drive().signals().zero_marks.has_value());
  Job job;
  job.kind = JobKind::MC_WriteParameter;
  job.asks = LimitSwitchesJob{.active = true};
  rig.a.submit(job);
  EXPECT_EQ(job.error, ErrorId::limit_switches_missing);
}

TEST(DriveModels, AreFoundByTheNamesOfProjects) {
  ASSERT_FALSE(kDriveModelNames.empty());
  EXPECT_EQ(kDriveModelNames[0], "simulated");
  for (const DriveModel& model : kDriveModels) EXPECT_NE(model.make(), nullptr) << model.name;
}

}  // namespace
}  // namespace lockstep::drive_of_another_kind_test
