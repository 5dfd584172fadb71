// Axes that take commands: what the loader makes of them, and how they act, in virtual time.
#include <gtest/gtest.h>

#include <cmath>

#include "changed_project.hpp"
#include "projects/loader/simulation.hpp"

namespace lockstep::commands_test {
namespace {

using namespace std::chrono_literals;

constexpr char kFree[] = R"({
  "lockstep": 1, "name": "panel", "clock": { "servo_cycle": "2ms" },
  "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
    "DynamicDefaults": { "Velocity": 40.0, "Acceleration": 1000.0, "Deceleration": 1000.0, "Jerk": 0.0 } } } },
  "tags": {},
  "programs": [],
  "trace": { "lcm": { "url": "memq://", "channel": "PANEL", "commands": { "axes": { "Slide": {} } } } }
})";

constexpr char kEnabledByAProgram[] = R"({
  "lockstep": 1, "name": "panel", "clock": { "servo_cycle": "2ms" },
  "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
    "DynamicDefaults": { "Velocity": 40.0, "Acceleration": 1000.0, "Deceleration": 1000.0, "Jerk": 0.0 } } } },
  "tags": {},
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "10ms", "calls": [
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Slide", "Enable": true } } ] } ],
  "trace": { "lcm": { "url": "memq://", "channel": "PANEL", "commands": { "axes": { "Slide": {} } } } }
})";

constexpr char kFan[] = R"({
  "lockstep": 1, "name": "panel", "clock": { "servo_cycle": "2ms" },
  "technology_objects": { "Fan": { "type": "TO_SpeedAxis",
    "config": { "DynamicDefaults": { "Velocity": 600.0, "Acceleration": 6000.0, "Deceleration": 6000.0, "Jerk": 0.0 } },
    "drive": { "model": "simulated", "faults": { "drive": "broken" } } } },
  "tags": { "broken": { "type": "BOOL" } },
  "programs": [],
  "trace": { "lcm": { "url": "memq://", "channel": "PANEL", "commands": { "axes": { "Fan": {} } } } }
})";

constexpr char kDevice[] = R"({
  "lockstep": 1, "name": "panel", "clock": { "servo_cycle": "1ms" },
  "technology_objects": { "Teddy": { "type": "MCO_305", "programs": [
    { "number": 0, "autostart": true, "lines": [ "CVEL 20", "CSTART", "rest:", "GOTO rest" ] },
    { "number": 5, "lines": [ "SET 1901 1", "rest:", "GOTO rest" ] },
    { "number": 6, "lines": [ "SET 32-99 1" ] } ] } },
  "tags": {},
  "programs": [],
  "trace": { "lcm": { "url": "memq://", "channel": "PANEL", "commands": { "axes": { "Teddy": {} } } } }
})";

/// A machine with an operator, who writes what commands write.
class Panel : public testing::Test {
 protected:
  explicit Panel(const char* project = kFree) : machine_(Simulation::from_text(project)) {}
  void enable() {
    set(PanelSignal::kEnable, Value{.u = 1});
    machine_.run_for(100ms);
    ASSERT_EQ(machine_.read(machine_.project().commands.axes.at(0).name + ".StatusWord.X0"), 1.0);
  }
  void set(PanelSignal signal, Value value) {
    machine_.project().commands.axes.at(0).signals.at(static_cast<std::size_t>(signal)).store(value);
  }
  void ask(PanelSignal signal) {
    const Signal place = machine_.project().commands.axes.at(0).signals.at(static_cast<std::size_t>(signal));
    place.store(Value{.u = place.load().u + 1});
  }
  void jog(PanelSignal direction, double velocity) {
    set(PanelSignal::kForward, Value{.u = direction == PanelSignal::kForward});
    set(PanelSignal::kBackward, Value{.u = direction == PanelSignal::kBackward});
    set(PanelSignal::kJogVelocity, Value{.r = velocity});
    ask(PanelSignal::kBeat);
  }
  double velocity() const { return machine_.read("Slide.VelocitySetpoint"); }

  Simulation machine_;
};

class DevicePanel : public Panel {
 protected:
  DevicePanel() : Panel(kDevice) {}
  double operator[](const std::string& name) const { return machine_.read("Teddy." + name); }
  void start(double number) {
    set(PanelSignal::kProgram, Value{.r = number});
    ask(PanelSignal::kStarts);
    machine_.run_for(20ms);
  }
};

TEST_F(DevicePanel, StopsAndStartsItsPrograms) {
  machine_.run_for(100ms);
  EXPECT_EQ(machine_.project().commands.axes.at(0).type, "MCO_305");
  EXPECT_EQ((*this)["Program.Number"], 0.0);
  EXPECT_GT((*this)["AVEL"], 0.0);
  ask(PanelSignal::kStops);
  machine_.run_for(3s);
  EXPECT_EQ((*this)["AVEL"], 0.0) << "as with [Esc] it stops";
  EXPECT_EQ((*this)["Program.State"], 4.0) << "and is not started again by itself";
  start(5.0);
  EXPECT_EQ((*this)["Program.Number"], 5.0);
  EXPECT_EQ((*this)["P1901"], 1.0);
  start(-1.0);
  EXPECT_EQ((*this)["Program.Number"], 0.0) << "the one that starts by itself";
  start(77.0);
  EXPECT_EQ((*this)["Program.Number"], 0.0) << "there is none";
}

TEST_F(DevicePanel, ClearsAnErrorBeforeWhichNothingStarts) {
  start(6.0);
  machine_.run_for(20ms);
  EXPECT_EQ((*this)["ERRNO"], 112.0);
  start(5.0);
  EXPECT_EQ((*this)["Program.Number"], 6.0);
  ask(PanelSignal::kResets);
  machine_.run_for(20ms);
  EXPECT_EQ((*this)["ERRNO"], 0.0);
  start(5.0);
  EXPECT_EQ((*this)["Program.Number"], 5.0);
}

class SpeedPanel : public Panel {
 protected:
  SpeedPanel() : Panel(kFan) {}
  double turns() const { return machine_.read("Fan.VelocitySetpoint"); }
};

TEST_F(SpeedPanel, EnablesJogsOverridesAndResetsASpeedAxis) {
  const CommandAxis& fan = machine_.project().commands.axes.at(0);
  EXPECT_EQ(fan.type, "TO_SpeedAxis");
  EXPECT_EQ(fan.velocity_unit, "1/min");
  EXPECT_FALSE(fan.has_position);
  EXPECT_EQ(fan.jog_velocity, 600.0) << "DynamicDefaults.Velocity";
  ASSERT_EQ(fan.signals.size(), kPanelSignals);
  enable();
  jog(PanelSignal::kForward, 300.0);
  machine_.run_for(200ms);
  EXPECT_DOUBLE_EQ(turns(), 300.0);
  EXPECT_NEAR(fan.signals[static_cast<std::size_t>(PanelSignal::kVelocity)].load().r, 300.0, 1.0);
  machine_.run_for(300ms);
  EXPECT_EQ(turns(), 0.0) << "nobody asks for it any more";
  set(PanelSignal::kOverride, Value{.r = 50.0});
  ask(PanelSignal::kOverrides);
  jog(PanelSignal::kBackward, 300.0);
  machine_.run_for(200ms);
  EXPECT_DOUBLE_EQ(turns(), -150.0);
  machine_.write("broken", 1.0);
  machine_.run_for(200ms);
  EXPECT_NE(machine_.read("Fan.ErrorDetail.Number"), 0.0);
  machine_.write("broken", 0.0);
  machine_.run_for(50ms);
  ask(PanelSignal::kResets);
  machine_.run_for(200ms);
  EXPECT_EQ(machine_.read("Fan.ErrorDetail.Number"), 0.0);
}

TEST_F(SpeedPanel, AsksNoHomingOfIt) {
  enable();
  set(PanelSignal::kHomePosition, Value{.r = 12.5});
  ask(PanelSignal::kHomings);
  machine_.run_for(100ms);
  for (const Instance& instance : machine_.project().controller->instances)
    EXPECT_NE(instance.name, "panel.Fan.home");
}

TEST_F(Panel, JogsWhileItIsAskedForAndAtMost300MillisecondsLonger) {
  enable();
  for (int i = 0; i < 10; ++i) {
    jog(PanelSignal::kForward, 20.0);
    machine_.run_for(100ms);
    EXPECT_DOUBLE_EQ(velocity(), 20.0) << i;
  }
  machine_.run_for(198ms);
  EXPECT_DOUBLE_EQ(velocity(), 20.0) << "still held";
  machine_.run_for(6ms);
  EXPECT_LT(velocity(), 20.0) << "300 ms and two interpolator cycles after the last command it brakes";
  machine_.run_for(100ms);
  EXPECT_EQ(velocity(), 0.0);
  const double position = machine_.read("Slide.Position");
  machine_.run_for(2s);
  EXPECT_EQ(machine_.read("Slide.Position"), position) << "nothing moves it without a command";
  jog(PanelSignal::kBackward, 5.0);
  machine_.run_for(100ms);
  EXPECT_DOUBLE_EQ(velocity(), -5.0);
  set(PanelSignal::kBackward, Value{});
  machine_.run_for(50ms);
  EXPECT_EQ(velocity(), 0.0) << "a stop comes at once";
}

TEST_F(Panel, HomesResetsAndSetsTheOverrideOnceForEachCommand) {
  enable();
  set(PanelSignal::kHomePosition, Value{.r = 12.5});
  ask(PanelSignal::kHomings);
  machine_.run_for(20ms);
  EXPECT_EQ(machine_.read("Slide.Position"), 12.5);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X5"), 1.0);
  for (const double position : {1.0, 2.0}) {  // in ticks that follow each other
    set(PanelSignal::kHomePosition, Value{.r = position});
    ask(PanelSignal::kHomings);
    machine_.step();
  }
  machine_.run_for(20ms);
  EXPECT_EQ(machine_.read("Slide.Position"), 2.0);
  set(PanelSignal::kOverride, Value{.r = 50.0});
  ask(PanelSignal::kOverrides);
  machine_.run_for(10ms);
  EXPECT_EQ(machine_.read("Slide.Override.Velocity"), 50.0);
  machine_.write("Slide.Override.Velocity", 70.0);
  machine_.run_for(100ms);
  EXPECT_EQ(machine_.read("Slide.Override.Velocity"), 70.0) << "a program keeps its right";
  jog(PanelSignal::kForward, 10.0);
  machine_.run_for(100ms);
  EXPECT_DOUBLE_EQ(velocity(), 7.0);
}

/// StatusWord.X4 (ControlPanelActive); meanwhile X6 (Done) is FALSE.
TEST_F(Panel, HasTheAxisInItsHandsWhileItHasEnabledIt) {
  machine_.run_for(100ms);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X4"), 0.0);
  enable();
  EXPECT_EQ(machine_.read("Slide.StatusWord.X4"), 1.0);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X6"), 0.0) << "a panel is active";
  set(PanelSignal::kEnable, Value{});
  machine_.run_for(100ms);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X4"), 0.0);
}

class PanelBesideAProgram : public Panel {
 protected:
  PanelBesideAProgram() : Panel(kEnabledByAProgram) {}
};

TEST_F(PanelBesideAProgram, HasTheAxisInItsHandsWhileAJobOfItRuns) {
  machine_.run_for(100ms);
  ASSERT_EQ(machine_.read("Slide.StatusWord.X0"), 1.0);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X4"), 0.0) << "a program has enabled it";
  EXPECT_EQ(machine_.read("Slide.StatusWord.X6"), 1.0);
  jog(PanelSignal::kForward, 20.0);
  machine_.run_for(100ms);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X4"), 1.0);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X6"), 0.0);
  machine_.run_for(500ms);
  ASSERT_EQ(velocity(), 0.0) << "nobody asks for the jog any more";
  EXPECT_EQ(machine_.read("Slide.StatusWord.X4"), 0.0);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X6"), 1.0);
  ask(PanelSignal::kHomings);
  bool shown = false;
  for (int i = 0; i < 10; ++i) {
    machine_.step();
    shown |= machine_.read("Slide.StatusWord.X4") == 1.0;
  }
  EXPECT_TRUE(shown);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X4"), 0.0);
}

TEST_F(Panel, DoesNothingWithoutACommand) {
  machine_.run_for(3s);
  EXPECT_EQ(machine_.read("Slide.StatusWord.X0"), 0.0);
  EXPECT_EQ(machine_.read("Slide.Override.Velocity"), 100.0);
  EXPECT_EQ(machine_.read("Slide.Position"), 0.0);
  jog(PanelSignal::kForward, 10.0);
  machine_.run_for(1s);
  EXPECT_EQ(machine_.read("Slide.Position"), 0.0) << "an axis that is not enabled";
}

std::size_t panel_instances(const Project& project) {
  std::size_t count = 0;
  for (const Instance& instance : project.controller->instances)
    if (instance.name.starts_with("panel.")) ++count;
  return count;
}

TEST(PanelProject, HasNothingOfThePanelUnlessItSaysSo) {
  const LoadedProject loaded = load_project(kExampleProject);
  ASSERT_TRUE(loaded.project);
  EXPECT_TRUE(loaded.project->commands.axes.empty());
  EXPECT_EQ(panel_instances(*loaded.project), 0u);
  for (const Program& program : loaded.project->controller->programs) EXPECT_NE(program.name(), "panel");
}

TEST(PanelProject, LeavesTheEnableToTheProgramThatHasIt) {
  const LoadedProject loaded = load_project(changed("/trace/lcm/commands", R"({"axes": {"Knife": {}}})"));
  ASSERT_TRUE(loaded.project) << lines(loaded.problems);
  const auto& axes = loaded.project->commands.axes;
  ASSERT_EQ(axes.size(), 1u);
  EXPECT_FALSE(axes[0].enabled_by.empty());
  EXPECT_EQ(axes[0].signals.size(), kPanelSignals);
  EXPECT_EQ(panel_instances(*loaded.project), 4u) << "hold, jog, home, reset";
}

std::string problems_of(const std::string& commands) {
  return lines(load_project(changed("/trace/lcm/commands", commands)).problems);
}

TEST(PanelProject, TellsWhatIsWrong) {
  EXPECT_NE(problems_of("true").find("FILE:/trace/lcm/commands: "), std::string::npos) << problems_of("true");
  EXPECT_NE(problems_of("{}").find("'axes' is missing"), std::string::npos) << problems_of("{}");
  EXPECT_NE(problems_of(R"({"axes": {}})").find("no axis is named"), std::string::npos);
  EXPECT_NE(problems_of(R"({"axes": {"Nobody": {}}})").find("Nobody"), std::string::npos);
  EXPECT_NE(problems_of(R"({"axes": {"Knife": {"jog_velocity": 0}}})").find("/axes/Knife/jog_velocity"),
            std::string::npos);
  EXPECT_NE(problems_of(R"({"axes": {"Knife": {}, "knife": {}}})").find("is there twice"), std::string::npos);
  EXPECT_NE(problems_of(R"({"axes": {"Knife": {"speed": 1}}})").find("unknown key"), std::string::npos);
}

TEST(PanelProject, WarnsOfANetworkThatLeavesTheMachine) {
  const auto warnings = [](const std::string& url) {
    Json project = Json::parse(kFree);
    project["trace"]["lcm"]["url"] = url;
    return lines(load_project(project.dump()).warnings);
  };
  EXPECT_NE(warnings("udpm://239.255.76.67:7667?ttl=1").find("no passwords"), std::string::npos);
  EXPECT_EQ(warnings("udpm://239.255.76.67:7667?ttl=0").find("no passwords"), std::string::npos);
  EXPECT_EQ(warnings("udpm://").find("no passwords"), std::string::npos);
}

}  // namespace
}  // namespace lockstep::commands_test
