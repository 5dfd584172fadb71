/// Projects of systems: a leading axis, what follows it behind a proxy, and the system file around them.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/directory.hpp"

namespace lockstep::test {

using SystemJson = nlohmann::ordered_json;

/// A controller of a system: objects and programs are added to it.
class ControllerFile {
 public:
  explicit ControllerFile(const std::string& name, const std::string& servo_cycle = "1ms", int ratio = 1) {
    json = {{"lockstep", 1}, {"name", name}, {"clock", {{"servo_cycle", servo_cycle}}}};
    if (ratio != 1) json["clock"]["interpolator_ratio"] = ratio;
    json["technology_objects"] = SystemJson::object();
    json["programs"][0] = {{"name", "all"}, {"ob", "Main"}, {"cycle", servo_cycle}};
    json["programs"][0]["calls"] = SystemJson::array();
  }

  /// A virtual axis on a ring of `length`, enabled by the program.
  SystemJson& axis(const std::string& name, double length = 360.0) {
    SystemJson& made = json["technology_objects"][name];
    made = {{"type", "TO_SynchronousAxis"},
            {"config", {{"VirtualAxis", {{"Mode", 1}}}, {"Modulo", {{"Enable", true}, {"Length", length}}}}}};
    call({{"fb", "MC_Power"}, {"name", "power_" + name}, {"in", {{"Axis", name}, {"Enable", "TRUE"}}}});
    return made;
  }

  /// Has an axis provide its leading value.
  void provide(const std::string& name, double delay, int interface = 1) {
    SystemJson& config = json["technology_objects"][name]["config"]["CrossPlcSynchronousOperation"];
    config["Interface[" + std::to_string(interface) + "]"]["EnableLeadingValueOutput"] = true;
    config["LocalLeadingValueDelayTime"] = delay;
  }

  /// @param tolerance, local_delay [s]
  void proxy(const std::string& name, double tolerance = 0.1, double local_delay = 0.0) {
    SystemJson& made = json["technology_objects"][name];
    made["type"] = "TO_LeadingAxisProxy";
    made["config"]["Parameter"]["ToleranceTimeExternalLeadingValueInvalid"] = tolerance;
    if (local_delay != 0.0) made["config"]["Parameter"]["LocalLeadingValueDelayTime"] = local_delay;
  }

  /// Has an axis follow by MC_GearIn when `couple` is TRUE.
  void gear(const std::string& follower, const std::string& leading, int numerator = 1, int denominator = 1,
            const std::string& coupling = "setpoint") {
    interconnect(follower, leading, coupling);
    json["tags"]["couple"]["type"] = "BOOL";
    call({{"fb", "MC_GearIn"},
          {"name", "gear_" + follower},
          {"in",
           {{"Master", leading},
            {"Slave", follower},
            {"Execute", "couple"},
            {"RatioNumerator", std::to_string(numerator)},
            {"RatioDenominator", std::to_string(denominator)}}}});
  }

  void interconnect(const std::string& follower, const std::string& leading,
                    const std::string& coupling = "setpoint") {
    json["technology_objects"][follower]["leading_values"].push_back(
        {{"to", leading}, {"coupling", coupling}});
  }

  void call(const SystemJson& one) { json["programs"][0]["calls"].push_back(one); }

  SystemJson json;
};

/// A folder with a system file and the projects that it names.
class SystemFiles {
 public:
  SystemFiles() { json = {{"lockstep_system", 1}, {"name", "test"}}; }

  /// Writes the project of a controller.
  void add(const std::string& controller, const ControllerFile& file, const std::string& phase = "") {
    directory_->write(controller + ".json", file.json.dump(2));
    json["controllers"][controller]["project"] = controller + ".json";
    if (!phase.empty()) json["controllers"][controller]["phase"] = phase;
  }
  void area(const std::string& name, const std::string& from, const std::vector<std::string>& to,
            int interface = 1) {
    json["transfer_areas"][name] = {{"from", from}, {"interface", interface}, {"to", to}};
  }
  /// Writes the system file. @return its path
  std::string path() const {
    directory_->write("system.json", json.dump(2));
    return directory_->file("system.json");
  }
  const Directory& directory() const { return *directory_; }

  SystemJson json;

 private:
  std::shared_ptr<const Directory> directory_ = std::make_shared<const Directory>();
};

}  // namespace lockstep::test
