// The examples with LinMot controllers do what their READMEs say.
#include <algorithm>
#include <array>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_example_test {
namespace {

struct Moment {
  double time;
  std::array<double, 3> setpoint, actual, velocity, current;
  int state, row;
};

std::vector<Moment> course_of(Simulation& machine, const std::string& object, std::size_t motors,
                              double seconds) {
  std::vector<Moment> all;
  while (static_cast<double>(machine.now().count()) * 1e-9 < seconds) {
    Moment now{};
    now.time = static_cast<double>(machine.now().count()) * 1e-9;
    machine.step();
    for (std::size_t i = 0; i < motors; ++i) {
      const std::string motor = object + "." + static_cast<char>('A' + i) + ".";
      now.setpoint[i] = machine.read(motor + "SetPoint");
      now.actual[i] = machine.read(motor + "ActualPosition");
      now.velocity[i] = machine.read(motor + "SetPointVelocity");
      now.current[i] = machine.read(motor + "DemandCurrent");
    }
    now.state = static_cast<int>(machine.read(object + ".State"));
    now.row = static_cast<int>(machine.read(object + ".StateNumber"));
    all.push_back(now);
  }
  return all;
}

Simulation example(const std::string& name) {
  return Simulation(std::string(LOCKSTEP_SOURCE_DIR) + "/projects/" + name + "/project.json");
}

constexpr int kInit = 2, kRun = 3;

TEST(LidExample, PutsLidsOnByTwoRows) {
  Simulation machine = example("27_lid");
  const std::vector<Moment> all = course_of(machine, "Lid", 3, 5.0);
  EXPECT_GE(machine.read("lids"), 4.0);
  EXPECT_EQ(machine.read("error"), 0.0);
  // A searches with 50 mm/s and at most 15 % of 5 A; where it can go no further is -5 mm, 7 mm behind the
  // scale.
  double searching = 0.0, fastest = 0.0;
  for (const Moment& now : all) {
    if (now.state != kInit) continue;
    searching = std::max(searching, std::abs(now.current[0]));
    fastest = std::max(fastest, std::abs(now.velocity[0]));
  }
  EXPECT_NEAR(searching, 0.75, 1e-9);
  EXPECT_NEAR(fastest, 0.05, 1e-3);
  for (const auto& object : machine.project().controller->objects)
    if (object->kind == ObjectKind::LinMot_Controller) {
      EXPECT_NEAR(static_cast<LinMotController&>(*object).motor(0).shift(), -7.0, 0.1);
    }
  // B and C begin in the same control cycle; A does so 150 ms later, by its curve.
  const auto row_0 = std::find_if(all.begin(), all.end(), [](const Moment& now) { return now.row == 0; });
  ASSERT_NE(row_0, all.end());
  const auto begins = [&](std::size_t motor) {
    return std::find_if(row_0, all.end(), [&](const Moment& now) { return now.velocity[motor] != 0.0; })
        ->time;
  };
  EXPECT_EQ(begins(1), begins(2));
  EXPECT_NEAR(begins(0) - begins(1), 0.150, 0.0011);
  // Row 1: back with 1 m/s. Nothing is more than 0.1 mm from where it should be while it moves.
  double back = 0.0, away = 0.0;
  for (const Moment& now : all) {
    if (now.state != kRun) continue;
    if (now.row == 1) back = std::max(back, std::abs(now.velocity[1]));
    for (std::size_t i = 0; i < 3; ++i) away = std::max(away, std::abs(now.setpoint[i] - now.actual[i]));
  }
  EXPECT_NEAR(back, 1.00002, 1e-5);
  EXPECT_LT(away, 0.5);
}

TEST(PressExample, PressesWithWhatItIsAllowedAndLeavesFromThere) {
  Simulation machine = example("28_press");
  const std::vector<Moment> all = course_of(machine, "Press", 1, 2.5);
  EXPECT_EQ(machine.read("step"), 60.0);
  EXPECT_EQ(machine.read("error"), 0.0);
  EXPECT_NEAR(machine.read("pressed"), 50.0, 1.0);  // 1.5 A are 60 N, 10 N of which the friction keeps
  double searching = 0.0, pressing = 0.0, deepest = 0.0, aimed = 0.0;
  for (const Moment& now : all) {
    if (now.state == kInit) searching = std::max(searching, std::abs(now.current[0]));
    deepest = std::max(deepest, now.actual[0]);
    if (now.row != 2) continue;
    pressing = std::max(pressing, now.current[0]);
    aimed = std::max(aimed, now.setpoint[0]);
  }
  EXPECT_NEAR(searching, 0.6, 1e-9);  // 12 % of 5 A
  EXPECT_NEAR(pressing, 1.5, 0.02);
  EXPECT_NEAR(aimed, 90.0, 1e-9);
  EXPECT_NEAR(deepest, 60.0, 0.5);
  // Row 3 begins where the slider is, not at 90 mm.
  const auto leaves = std::find_if(all.begin(), all.end(), [](const Moment& now) { return now.row == 3; });
  ASSERT_NE(leaves, all.end());
  EXPECT_NEAR(leaves->setpoint[0], 60.0, 0.5);
  EXPECT_NEAR(all.back().actual[0], 10.0, 0.3);
}

}  // namespace
}  // namespace lockstep::linmot_example_test
