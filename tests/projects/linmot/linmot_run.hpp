/// A project with one LinMot controller, stepped tick by tick, and its acceptance scenarios.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "tech_objects/linmot/ascii_line.hpp"
#include "tech_objects/linmot/controller.hpp"

namespace lockstep {

using Json = nlohmann::ordered_json;

inline const Json& linmot_document(const std::string& name) {
  static std::map<std::string, Json> documents;
  Json& document = documents[name];
  if (document.is_null())
    document = Json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/linmot/" + name + ".json"));
  return document;
}

inline const Json& linmot_scenario(const std::string& id) {
  for (const Json& scenario : linmot_document("scenarios").at("scenarios"))
    if (scenario.at("id") == id) return scenario;
  throw std::runtime_error("no scenario " + id);
}

/// What has been looked at in this process: scenario and expectation, or step.
inline std::set<std::pair<std::string, std::string>>& looked_at() {
  static std::set<std::pair<std::string, std::string>> all;
  return all;
}

/// What a scenario expects, or its steps; what is taken from it counts as looked at.
class ScenarioList {
 public:
  ScenarioList(std::string id, std::string list)
      : id_(std::move(id)), list_(std::move(list)), all_(linmot_scenario(id_).at(list_)) {}
  const Json& operator[](std::size_t index) const {
    looked_at().insert({id_, list_ + " " + std::to_string(index)});
    return all_.at(index);
  }
  std::size_t size() const { return all_.size(); }

 private:
  std::string id_, list_;
  const Json& all_;
};

inline ScenarioList expectations(const std::string& id) {
  return {id, "expect"};
}

/// The controller of the scenarios: one motor A, the reference plant, ASCII on a line.
inline Json linmot_project(const std::string& servo_cycle = "100us") {
  Json json = Json::parse(R"({
    "lockstep": 1, "name": "linmot", "clock": { "servo_cycle": "1ms" },
    "tags": { "t_a": { "type": "BOOL" }, "t_b": { "type": "BOOL" }, "t_c": { "type": "BOOL" }, "t_d": { "type": "BOOL" },
              "force": { "type": "LREAL" }, "volts": { "type": "LREAL" }, "power": { "type": "LREAL", "init": 24.0 },
              "hot": { "type": "BOOL" }, "missing": { "type": "BOOL" }, "r": { "type": "BOOL" },
              "warning": { "type": "BOOL" }, "error": { "type": "BOOL" }, "third": { "type": "BOOL" } },
    "technology_objects": { "C": {
      "type": "LinMot_Controller", "control_cycle": "100us",
      "config": {
        "System": { "Command Interface": "ASCII RS232" },
        "Drives": { "Drive A": {
          "Type": "LinMot P0x-37",
          "Control Parameters": { "Maximal Current": 5.0, "P": 1.0, "D": 4.0, "I": 0.0 } } } },
      "motors": { "A": { "force_constant": 40.0, "slider_mass": 0.829, "load_mass": 1.2, "friction": 10.0, "external_force": "force" } },
      "io": { "TRIG A": "t_a", "TRIG B": "t_b", "TRIG C": "t_c", "TRIG D": "t_d", "ANALOG A": "volts",
              "OUT 1": "warning", "OUT 2": "error", "OUT 3": "third" },
      "faults": { "power_voltage": "power", "heat_sink_hot": "hot", "A": { "slider_missing": "missing" } } } },
    "ascii": [ { "mode": "RS232", "controllers": { "1": "C" } } ]
  })");
  json["clock"]["servo_cycle"] = servo_cycle;
  json["technology_objects"]["C"]["faults"].erase("power_voltage");
  return json;
}

inline Json& controller_of(Json& project) {
  return project["technology_objects"]["C"];
}
inline Json& drive_of(Json& project, const std::string& letter = "A") {
  return controller_of(project)["config"]["Drives"]["Drive " + letter];
}

class LinMotRun {
 public:
  struct Sample {
    double time, setpoint, velocity, actual, current;
  };

  explicit LinMotRun(const Json& project) : simulation_(Simulation::from_text(project.dump())) {
    for (const auto& object : simulation_.project().controller->objects)
      if (object->kind == ObjectKind::LinMot_Controller)
        controller_ = static_cast<LinMotController*>(object.get());
  }

  LinMotController& controller() { return *controller_; }
  linmot::AsciiLine& line() { return simulation_.project().ascii_lines.front(); }
  LinMotMotorData& motor(std::size_t index = 0) { return controller_->data.Motors[index]; }
  linmot::State state() const { return controller_->state(); }
  void write(const std::string& path, double value) { simulation_.write(path, value); }
  double read(const std::string& path) { return simulation_.read(path); }
  double time() const { return static_cast<double>(simulation_.now().count()) * 1e-9; }

  void step() {
    const double now = time();
    simulation_.step();
    samples.push_back(
        {now, motor().SetPoint, motor().SetPointVelocity, motor().ActualPosition, motor().DemandCurrent});
  }
  void until(double end) {
    while (time() < end - 1e-9) step();
  }
  void run(double seconds) { until(time() + seconds); }
  /// Sends a command in the next tick. @return the answer
  std::string send(const std::string& text) {
    linmot::ScriptedCommand& sent = line().script.emplace_back();
    sent.at = simulation_.now().count();
    sent.text = text;
    sent.request = linmot::read_ascii(text);
    step();
    const linmot::ScriptedCommand& command = line().script.back();
    return command.answered_at < 0 ? "no answer" : linmot::ascii_text(command.answer);
  }
  /// From power-up into RUN, homed.
  void start() {
    EXPECT_EQ(send("!SR-1"), "#");
    EXPECT_EQ(send("!SI-1"), "#");
    EXPECT_EQ(send("!GS1"), "#D");
    EXPECT_EQ(send("!SI+1"), "#");
    for (int i = 0; i < 100'000 && send("!EX1") != "#1024"; ++i) step();
    EXPECT_EQ(send("!SR+1"), "#");
    EXPECT_EQ(send("!SI-1"), "#");
    EXPECT_EQ(send("!GS1"), "#R");
  }

  std::vector<Sample> samples;

 private:
  Simulation simulation_;
  LinMotController* controller_ = nullptr;
};

}  // namespace lockstep
