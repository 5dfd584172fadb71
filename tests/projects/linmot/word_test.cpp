// Words of PROFIBUS: every module, every command, every bit of the control word.
#include <algorithm>

#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tech_objects/linmot_catalogue/modules.hpp"
#include "tests/projects/linmot/bus.hpp"
#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_word_test {
namespace {

using linmot::State;

Json bus(const Json& modules, int motors = 1) {
  Json project = linmot_project("1ms");
  project.erase("ascii");
  controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
  controller_of(project)["profibus"] = {{"modules", modules}};
  if (motors == 2) {
    drive_of(project, "B") = drive_of(project);
    controller_of(project)["motors"]["B"] = controller_of(project)["motors"]["A"];
  }
  return project;
}

const std::string kSettings = "SetValueGeneration.SetValueConfiguration.";
const std::string kFilter = "SetValueGeneration.FilterParameter.";

struct ValueModule {
  const char* name;
  std::string parameter;
  double increment;
  int lowest, highest;
};
const ValueModule kValues[] = {
    {"Max. Acceleration", kFilter + "MaxAcceleration", linmot::kAccelerationIncrement, 1, 1536},
    {"Max. Speed", kFilter + "MaxSpeed", linmot::kVelocityIncrement, 1, 24576},
    {"Max. Current", "ControlParameters.MaximalCurrent", linmot::kCurrentIncrement, 0, 255},
    {"Set Curve Speed", kSettings + "CurveSpeed", linmot::kPercentIncrement, 0, 4096},
    {"Set Curve Amplitude", kSettings + "CurveAmplitude", linmot::kPercentIncrement, 0, 4096},
    {"Set Curve Offset", kSettings + "CurvePosOffset", linmot::kPositionIncrement, -32256, 32256},
};

TEST(LinMotProfibus, TakesTheValueOfEveryModuleWithinItsRange) {
  for (const ValueModule& one : kValues) {
    Json project = bus({"Control/Status", one.name});
    controller_of(project)["profibus"]["preset"] = {{one.name, 100}};
    Bus run(project);
    run.into_run();
    EXPECT_EQ(run.read("C.A." + one.parameter), 100 * one.increment) << one.name;  // the preset
    for (const int value : {one.highest, std::max(one.lowest, 6), 77}) {
      run.out(2, value);
      run.step();
      EXPECT_EQ(run.read("C.A." + one.parameter), value * one.increment) << one.name << value;
      EXPECT_EQ(run.state(), State::run);
    }
    for (const int value : {one.highest + 1, one.lowest - 1}) {
      Bus wrong(project);
      wrong.into_run();
      wrong.out(2, value);
      wrong.run(0.002);
      EXPECT_EQ(wrong.state(), State::error) << one.name << value;
      EXPECT_EQ(static_cast<int>(wrong.controller().data.Display), 0x8002) << one.name << value;
      EXPECT_EQ(wrong.read("C.A." + one.parameter), 100 * one.increment) << one.name << value;
    }
  }
  for (const int value : {32257, -32257}) {
    Bus run(bus({"Control/Status", "Set Position"}));
    run.into_run();
    run.out(2, value);
    run.run(0.002);
    EXPECT_EQ(static_cast<int>(run.controller().data.Display), 0x8002) << value;
    EXPECT_EQ(run.motor().SetPoint, 0.0);
  }
}

TEST(LinMotProfibus, CarriesOutEveryCommandForTheMotorsOfItsBits) {
  const std::string c = "ControlParameters.";
  const std::pair<int, std::pair<std::string, double>> commands[] = {
      {0x10, {c + "P", linmot::kProportionalIncrement}},
      {0x11, {c + "I", linmot::kIntegralIncrement}},
      {0x12, {c + "D", linmot::kDerivativeIncrement}},
      {0x13, {c + "FFFriction", linmot::kCurrentIncrement}},
      {0x14, {c + "FFAcceleration", linmot::kFeedForwardIncrement}},
      {0x15, {c + "FFDeceleration", linmot::kFeedForwardIncrement}},
      {0x16, {c + "CurrentOffset", linmot::kCurrentIncrement}}};
  Bus run(bus({"Control/Status", "Command"}, 2));
  run.into_run();
  int toggle = 0, done = 0;
  const auto command = [&](int motors, int id, int value) {
    toggle ^= 0x0800;
    run.out(3, value);
    run.out(2, motors << 12 | toggle | id);
    run.step();
    done ^= 0x20;
    EXPECT_EQ(run.in(1) & 0x20, done) << id;
  };
  for (const auto& [id, what] : commands) {
    const double before = run.read("C.A." + what.first);
    command(2, id, 7);  // B
    EXPECT_EQ(run.read("C.A." + what.first), before) << id;
    EXPECT_EQ(run.read("C.B." + what.first), 7 * what.second) << id;
    command(3, id, 20);  // both
    EXPECT_EQ(run.read("C.A." + what.first), 20 * what.second) << id;
    EXPECT_EQ(run.read("C.B." + what.first), 20 * what.second) << id;
    // Without a toggle nothing is done.
    run.out(3, 30);
    run.run(0.01);
    EXPECT_EQ(run.read("C.A." + what.first), 20 * what.second) << id;
    for (const linmot::ModuleCommand& row : linmot::module_commands())
      if (row.id == id) {
        Bus wrong(bus({"Control/Status", "Command"}, 2));
        wrong.into_run();
        wrong.out(3, row.highest + 1);
        wrong.out(2, 0x1800 | id);
        wrong.run(0.002);
        EXPECT_EQ(static_cast<int>(wrong.controller().data.Display), 0x8002) << id;
      }
  }
  command(3, 0x16, -5);
  EXPECT_EQ(run.read("C.A." + c + "CurrentOffset"), -5 * linmot::kCurrentIncrement);
}

TEST(LinMotProfibus, MovesTheNamesOfPositionsAndUnlocks) {
  Json project = bus({"Control/Status", "Command", "Set Position", "Get Position"});
  controller_of(project).erase("motors");
  Bus run(project);
  run.into_run();
  run.out(4, 512);
  run.run(0.3);
  EXPECT_EQ(run.in(2), 512);
  run.out(3, 256);
  run.out(2, 0x1802);  // Move Home Position: the zero goes 5 mm out
  run.run(0.3);
  EXPECT_EQ(run.in(2), 256);
  EXPECT_EQ(run.motor().DemandPosition, 5.0);  // Set Position is locked: 512 is of the old names
  run.out(4, 256);
  run.run(0.1);
  run.out(2, 0x1003);  // Unlock
  run.run(0.3);
  EXPECT_EQ(run.in(2), 256);
  run.out(4, 0);
  run.run(0.01);
  ASSERT_NE(run.motor().SetPointVelocity, 0.0);
  run.out(2, 0x1804);  // demand to actual
  run.step();
  EXPECT_EQ(run.motor().SetPointVelocity, 0.0);
  const double demand = run.motor().DemandPosition;
  EXPECT_GT(demand, 0.0);
  run.run(0.3);
  EXPECT_EQ(run.motor().SetPoint, demand);
}

TEST(LinMotProfibus, FreezesAndStopsByTheControlWord) {
  Json project = bus({"Control/Status", "Set Position", "Next Drive", "Set Position"}, 2);
  Bus run(project);
  run.into_run();
  const auto both_to = [&run](int value) {
    run.out(2, value);
    run.out(3, value);
    run.run(0.05);
  };
  both_to(5120);
  run.out(1, 0x1002);  // FREEZE A
  run.run(0.4);
  EXPECT_TRUE(run.motor(0).Frozen);
  EXPECT_EQ(run.motor(0).SetPointVelocity, 0.0);
  EXPECT_LT(run.motor(0).SetPoint, 60.0);
  EXPECT_NEAR(run.motor(1).SetPoint, 100.0, 1e-9);
  run.out(1, 0x0002);
  run.run(0.4);
  EXPECT_NEAR(run.motor(0).SetPoint, 100.0, 1e-9);
  both_to(0);
  run.out(1, 0x0012);  // FREEZE ALL
  run.run(0.4);
  EXPECT_TRUE(run.motor(0).Frozen);
  EXPECT_TRUE(run.motor(1).Frozen);
  EXPECT_GT(run.motor(0).SetPoint, 0.0);
  EXPECT_GT(run.motor(1).SetPoint, 0.0);
  EXPECT_EQ(run.in(1) & 0x3000, 0);  // not in position
  run.out(1, 0x0002);
  run.run(0.5);
  EXPECT_NEAR(run.motor(1).SetPoint, 0.0, 1e-9);
  EXPECT_EQ(run.in(1) & 0x3000, 0x3000);
  run.out(1, 0x0006);  // STOP
  run.step();
  EXPECT_EQ(run.state(), State::stop);
  run.out(1, 0x0002);
  run.step();
  EXPECT_EQ(run.state(), State::stop);
  run.out(1, 0x0000);
  run.step();
  EXPECT_EQ(run.state(), State::disable);
}

// A further Control/Status begins the next motor as Next Drive does; only the first one's requests count.
TEST(LinMotProfibus, HasTheModulesOfEachMotorInTheirOrder) {
  for (const char* const next : {"Next Drive", "Control/Status"}) {
    const bool status = std::string(next) == "Control/Status";
    Bus run(bus({"Control/Status", "Get Position", "Get Current", "Set Position", next, "Set Position",
                 "Get Position"},
                2));
    run.into_run();
    const int second = status ? 4 : 3;  // Set Position of B
    if (status) run.out(3, 0x0014);
    run.out(2, 256);
    run.out(second, -512);
    run.run(0.5);
    EXPECT_EQ(run.state(), State::run);
    EXPECT_NEAR(run.motor(0).SetPoint, 5.0, 1e-9) << next;
    EXPECT_NEAR(run.motor(1).SetPoint, -10.0, 1e-9) << next;
    EXPECT_NEAR(run.in(2), 256, 13);
    EXPECT_NEAR(static_cast<std::int16_t>(run.in(status ? 5 : 4)), -512, 13);
    EXPECT_EQ(static_cast<std::int16_t>(run.in(3)),
              linmot::increments(run.motor().DemandCurrent, linmot::kCurrentIncrement));
    if (status) {
      EXPECT_EQ(run.in(4), run.in(1));
    }
  }
}

}  // namespace
}  // namespace lockstep::linmot_word_test
