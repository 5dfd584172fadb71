/// A program in APOSS that runs in an MCO 305, step by step.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "projects/aposs/compiler.hpp"
#include "projects/aposs/parameter_names.hpp"
#include "scheduler/mco305/mco305.hpp"

namespace lockstep {

using Json = nlohmann::json;

inline const Json& mco305_scenario(const std::string& id) {
  static const Json document =
      Json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/scenarios.json"));
  for (const Json& scenario : document.at("scenarios"))
    if (scenario.at("id") == id) return scenario;
  throw std::runtime_error("no scenario " + id);
}

inline std::string joined(const Json& lines) {
  std::string text;
  for (const Json& line : lines) text += line.get<std::string>() + "\n";
  return text;
}

class DeviceRun {
 public:
  Mco305 object{"Device", DB_ANY{1}};

  /// As a project says it: numbers or mnemonics, values as printed.
  void set(const std::string& name, double value) {
    const auto number = aposs::parameter_of(name);
    ASSERT_TRUE(number) << name;
    if (!mco305::is_application_parameter(*number))
      for (int i = 0; i < mco305::parameters()[mco305::parameter_index(*number)].decimals; ++i) value *= 10.0;
    ASSERT_EQ(object.parameters().set(*number, static_cast<std::int32_t>(value + (value < 0 ? -0.5 : 0.5))),
              0)
        << name;
  }
  void set_all(const Json& parameters) {
    for (const auto& [name, value] : parameters.items())
      if (name.size() == 5 && name[2] == '-' && value.is_number()) set(name, value.get<double>());
  }
  void add_program(const std::string& text, std::int32_t number = 0, bool autostart = true) {
    aposs::CompiledProgram compiled = aposs::compile_program("test.m", text);
    ASSERT_TRUE(compiled.image) << text << (compiled.errors.empty() ? "" : compiled.errors[0].text);
    object.programs.push_back({number, autostart, std::move(*compiled.image), compiled.files, 0});
  }
  void begin(bool repeats = false) {
    object.repeats = repeats;
    object.configure(1e-3, 1);
  }
  void step() {
    object.servo(now_ * 1'000'000);
    object.run_program(now_ * 1'000'000);
    ++now_;
  }
  void run(int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) step();
  }
  /// Until the program is over. @return whether it is
  bool run_to_end(int maximum) {
    for (int i = 0; i < maximum && !object.machine().over(); ++i) step();
    return object.machine().over();
  }
  std::int64_t now() const { return now_; }

  std::int32_t variable(const std::string& name) {
    if (object.program() == nullptr) {
      ADD_FAILURE() << "no program";
      return 0;
    }
    const auto& names = object.program()->image.variables;
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i] == name) return object.machine().variable(i);
    ADD_FAILURE() << "no variable " << name;
    return 0;
  }
  std::int32_t system_variable(std::int32_t index) {
    std::int32_t value = 0;
    EXPECT_TRUE(object.device().system_variable(index, value)) << index;
    return value;
  }

 private:
  std::int64_t now_ = 0;
};

}  // namespace lockstep
