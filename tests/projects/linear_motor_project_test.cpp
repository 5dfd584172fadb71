// A project whose axis has a linear motor as its drive: what it says of it, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "changed_project.hpp"
#include "projects/loader/project.hpp"
#include "projects/loader/simulation.hpp"

namespace lockstep::linear_motor_project_test {
namespace {

using namespace std::chrono_literals;

Json slide() {
  return Json::parse(R"({
    "lockstep": 1, "name": "slide", "clock": { "servo_cycle": "1ms" },
    "technology_objects": {
      "Slide": {
        "type": "TO_PositioningAxis",
        "config": {
          "Actor": { "MotorType": 1, "LinearMotorDriveParameter": { "MaxVelocity": 2000.0 } },
          "DynamicLimits": { "MaxVelocity": 1000.0, "Velocity": 1000.0, "MaxAcceleration": 10000.0, "MaxDeceleration": 10000.0 }
        },
        "drive": {
          "model": "linear_motor", "force_constant": 40.0, "slider_mass": 0.829, "load_mass": 1.2, "friction": 10.0,
          "P": 1.0, "D": 4.0, "FF Friction": 0.25, "FF Acceleration": 50.7, "FF Deceleration": 50.7,
          "maximal_current": 5.0, "external_force": "push",
          "fixed_stops": [ { "position": 150.0, "stiffness": 1e6, "damping": 1500.0 } ]
        }
      }
    },
    "tags": { "push": { "type": "LREAL" }, "flag": { "type": "BOOL" } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
      { "fb": "MC_Power", "name": "power", "in": { "Axis": "Slide", "Enable": true } },
      { "fb": "MC_Home", "name": "home", "in": { "Axis": "Slide", "Execute": "power.Status", "Mode": 0, "Position": 0.0 } },
      { "fb": "MC_MoveAbsolute", "name": "move", "in": { "Axis": "Slide", "Execute": "home.Done", "Position": 100.0, "Velocity": 500.0 } }
    ] } ]
  })");
}

const std::string kDrive = "/technology_objects/Slide/drive";
const std::string kConfig = "/technology_objects/Slide/config";

std::string refusal(const std::string& place, const Json& value) {
  Json project = slide();
  project[Json::json_pointer(place)] = value;
  const LoadedProject loaded = load_project(project.dump(), "", {}, LoadedFor::looking);
  EXPECT_FALSE(loaded.project.has_value()) << place << " = " << value;
  return lines(loaded.problems);
}

void expect_refused(const std::string& place, const Json& value, const std::string& at,
                    const std::string& text) {
  const std::string told = refusal(place, value);
  EXPECT_NE(told.find(at), std::string::npos) << told;
  EXPECT_NE(told.find(text), std::string::npos) << told;
}

TEST(LinearMotorProject, MovesAnAxisByItsForce) {
  Simulation machine = Simulation::from_text(slide().dump());
  machine.run_for(2s);
  EXPECT_EQ(machine.read("Slide.ErrorDetail.Number"), 0.0);
  EXPECT_NEAR(machine.read("Slide.Position"), 100.0, 1e-9);
  EXPECT_NEAR(machine.read("Slide.ActualPosition"), 100.0, 0.25);
}

// 40 N against P 1 A/mm and 40 N/A, less what the friction of 10 N carries: the position control of the axis
// takes that over with its own time constant.
TEST(LinearMotorProject, GivesWayToAForceFromOutside) {
  Json project = slide();
  project[Json::json_pointer(kDrive + "/friction")] = 0.0;
  project["stimuli"] = Json::parse(R"([ { "at": "2s", "set": { "push": -40.0 } } ])");
  Simulation machine = Simulation::from_text(project.dump());
  machine.run_for(2s);
  double furthest = 0.0;
  for (int i = 0; i < 100; ++i) {
    machine.step();
    furthest = std::max(furthest, 100.0 - machine.read("Slide.ActualPosition"));
  }
  EXPECT_GT(furthest, 0.8);
  EXPECT_LT(furthest, 1.399);  // the overshoot of the loop
  machine.run_for(1s);
  EXPECT_NEAR(machine.read("Slide.ActualPosition"), 100.0, 0.01);
}

TEST(LinearMotorProject, NeedsAnAxisThatCountsInMillimetresAndNewtons) {
  expect_refused(kConfig + "/Actor/MotorType", 0, kDrive, "Actor.MotorType is 0; allowed: 1, linear");
  expect_refused(kConfig + "/Properties", Json{{"MotionType", 1}}, kDrive,
                 "Properties.MotionType is 1; allowed: 0, linear");
  expect_refused(kConfig + "/Units", Json{{"LengthUnit", 1010}}, kDrive,
                 "Units.LengthUnit is 1010; allowed: 1013 or 1536, mm");
  Json project = slide();
  project["technology_objects"]["Slide"]["type"] = "TO_SpeedAxis";
  project["technology_objects"]["Slide"]["config"] = Json::object();
  project.erase("programs");
  const LoadedProject loaded = load_project(project.dump(), "", {}, LoadedFor::looking);
  EXPECT_NE(lines(loaded.problems).find("a speed axis has no position; allowed: an axis with positions"),
            std::string::npos)
      << lines(loaded.problems);
}

TEST(LinearMotorProject, NeedsAControlCycleThatDividesTheServoCycleAndIsShortForItsStops) {
  const std::string cycle = kDrive + "/control_cycle";
  expect_refused(cycle, "300us", cycle, "allowed: one of which 1 to 256 are a servo_cycle, 1ms");
  expect_refused(cycle, "2ms", cycle, "allowed: one of which 1 to 256 are a servo_cycle, 1ms");
  expect_refused(cycle, "2us", cycle, "allowed: one of which 1 to 256 are a servo_cycle, 1ms");
  // 0.5 √(2.029 kg / 1e6 N/m) = 0.71 ms
  expect_refused(cycle, "1ms", cycle, "allowed with a stop of that stiffness: at most 712");
}

TEST(LinearMotorProject, TellsWhatIsMissingOrOfAnotherKind) {
  Json project = slide();
  project["technology_objects"]["Slide"]["drive"].erase("P");
  const LoadedProject loaded = load_project(project.dump(), "", {}, LoadedFor::looking);
  EXPECT_NE(lines(loaded.problems).find("'P'"), std::string::npos) << lines(loaded.problems);
  expect_refused(kDrive + "/slider_mass", 0.0, kDrive + "/slider_mass", "allowed: a number");
  expect_refused(kDrive + "/inclination", 91.0, kDrive + "/inclination", "from -90 to 90");
  expect_refused(kDrive + "/external_force", "flag", kDrive + "/external_force", "LREAL");
  expect_refused(kDrive + "/time_constant", "1ms", kDrive + "/time_constant", "unknown key");
  expect_refused(kDrive + "/fixed_stops/0/stiffness", -1.0, kDrive + "/fixed_stops/0/stiffness", "allowed");
}

}  // namespace
}  // namespace lockstep::linear_motor_project_test
