// The tables of a LinMot controller against the catalogues; increments.
#include <gtest/gtest.h>

#include <array>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tech_objects/linmot/hardware.hpp"
#include "tech_objects/linmot_catalogue/ascii_commands.hpp"
#include "tech_objects/linmot_catalogue/errors.hpp"
#include "tech_objects/linmot_catalogue/increments.hpp"
#include "tech_objects/linmot_catalogue/modules.hpp"
#include "tech_objects/linmot_catalogue/mt_commands.hpp"
#include "tech_objects/linmot_catalogue/parameters.hpp"

namespace lockstep::linmot_catalogue_test {
namespace {

using Json = nlohmann::json;

Json catalogue(const std::string& name) {
  return Json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/linmot/" + name + ".json"));
}

/// The path of a parameter with its name once, and without its drive.
std::string path_of(const Json& one) {
  std::string path = one.at("path").get<std::string>();
  if (path[0] == '\\') path.erase(0, 1);
  const std::string name = one.at("name");
  if (path != name && !path.ends_with("\\" + name)) path += "\\" + name;
  const std::string drive = "Drives\\Drive X\\";
  return path.starts_with(drive) ? path.substr(drive.size()) : path;
}

TEST(LinMotParameters, AreThePublishedOnes) {
  const Json document = catalogue("parameters");
  const auto system = linmot::system_parameters(), motor = linmot::motor_parameters();
  ASSERT_EQ(system.size() + motor.size(), document.at("parameters").size());
  std::size_t of_system = 0, of_motor = 0;
  for (const Json& one : document.at("parameters")) {
    const bool drive = one.at("path").get<std::string>().starts_with("\\Drives");
    const linmot::Parameter& parameter = drive ? motor[of_motor++] : system[of_system++];
    EXPECT_EQ(parameter.path, path_of(one));
    EXPECT_EQ(parameter.read_only(), one.at("attributes").at("readOnly").get<bool>()) << parameter.path;
    if (one.at("attributes").at("live").is_boolean()) {
      EXPECT_EQ(parameter.live(), one.at("attributes").at("live").get<bool>()) << parameter.path;
    }
    if (!one.at("options").is_array()) continue;
    ASSERT_GE(parameter.options.size(), one.at("options").size()) << parameter.path;
    for (std::size_t i = 0; i < one.at("options").size(); ++i)
      EXPECT_EQ(parameter.options[i], one.at("options")[i].at("value").get<std::string>());
  }
}

TEST(LinMotParameters, AreFoundByTheirPathAndNamedAsSignals) {
  EXPECT_NE(linmot::find_motor_parameter("control parameters\\p"), nullptr);
  EXPECT_EQ(linmot::find_motor_parameter("Sensor Configuration\\Sensor Period"), nullptr);
  EXPECT_EQ(linmot::signal_path("Control Parameters\\P"), "ControlParameters.P");
  EXPECT_EQ(linmot::signal_name("'0' Position"), "Position0");
  EXPECT_EQ(linmot::signal_name("0V Position"), "Position0V");
  EXPECT_EQ(linmot::signal_name("10V Position"), "Position10V");
  EXPECT_EQ(linmot::signal_name("In Position+"), "InPositionPlus");
  EXPECT_EQ(linmot::signal_name("Following Error-"), "FollowingErrorMinus");
  std::set<std::string> names;
  for (const linmot::Parameter& parameter : linmot::motor_parameters()) {
    if (parameter.scope > linmot::Scope::linear_motor) continue;
    EXPECT_TRUE(names.insert(linmot::signal_path(parameter.path)).second) << parameter.path;
  }
}

TEST(LinMotIncrements, AreExact) {
  const Json exact = catalogue("scenarios").at("meta").at("increments_exact");
  EXPECT_EQ(linmot::kPositionIncrement, 5.0 / 256.0);
  EXPECT_DOUBLE_EQ(linmot::kVelocityIncrement * 1e3, std::stod(exact.at("velocity_mm_s").get<std::string>()));
  EXPECT_DOUBLE_EQ(linmot::kAccelerationIncrement * 1e3,
                   std::stod(exact.at("acceleration_mm_s2").get<std::string>()));
  EXPECT_EQ(linmot::kCurrentIncrement * 1e3, std::stod(exact.at("current_mA").get<std::string>()));
  EXPECT_EQ(4096 * linmot::kVelocityIncrement, 0.78125);
  EXPECT_EQ(128 * linmot::kAccelerationIncrement, 30.517578125);
  EXPECT_EQ(linmot::increments(50.068, linmot::kAccelerationIncrement), 210);
  EXPECT_EQ(linmot::increments(630.0, linmot::kPositionIncrement), 32256);
  EXPECT_EQ(linmot::increments(-2.5, 1.0), -3);
  EXPECT_EQ(linmot::increments(2.5, 1.0), 3);
}

TEST(LinMotCommands, AreThePublishedOnes) {
  const Json ascii = catalogue("ascii_protocol");
  ASSERT_EQ(linmot::ascii_commands().size(), ascii.at("commands").size());
  for (const Json& one : ascii.at("commands")) {
    const auto* const command = linmot::find_ascii_command(one.at("command").get<std::string>().substr(1));
    ASSERT_NE(command, nullptr) << one.at("command");
    EXPECT_EQ(command->is(linmot::AsciiCommand::kReads), one.at("kind") == "read") << command->name;
    EXPECT_EQ(command->is(linmot::AsciiCommand::kArms), one.at("armsTrigger").get<bool>()) << command->name;
    if (one.at("allowedStates").get<std::string>().starts_with("RUN only")) {
      EXPECT_TRUE(command->is(linmot::AsciiCommand::kInRun)) << command->name;
    }
    if (one.at("range").is_array() && command->form == linmot::AsciiForm::number_drive) {
      EXPECT_EQ(command->lowest, one.at("range")[0].get<int>()) << command->name;
      EXPECT_EQ(command->highest, one.at("range")[1].get<int>()) << command->name;
    }
  }
  const Json mt = catalogue("mt_commands");
  ASSERT_EQ(linmot::mt_commands().size(), mt.at("stateCommands").size());
  for (std::size_t i = 0; i < linmot::mt_commands().size(); ++i) {
    EXPECT_EQ(linmot::mt_commands()[i].name, mt.at("stateCommands")[i].at("name").get<std::string>());
    EXPECT_EQ(linmot::mt_commands()[i].arity(), mt.at("stateCommands")[i].at("arguments").size());
    EXPECT_EQ(static_cast<std::size_t>(linmot::mt_commands()[i].command), i);
  }
}

TEST(LinMotModules, AreThePublishedOnes) {
  const Json bus = catalogue("profibus");
  ASSERT_EQ(linmot::modules().size(), bus.at("modules").size());
  for (std::size_t i = 0; i < linmot::modules().size(); ++i) {
    const linmot::ModuleRow& row = linmot::modules()[i];
    const Json& one = bus.at("modules")[i];
    EXPECT_EQ(row.name, one.at("name").get<std::string>());
    EXPECT_EQ(static_cast<std::size_t>(row.module), i);
    EXPECT_EQ(row.out_words, one.at("outWords").get<int>()) << row.name;
    EXPECT_EQ(row.in_words, one.at("inWords").get<int>()) << row.name;
    if (one.at("range").is_array()) {
      EXPECT_EQ(row.lowest, one.at("range")[0].get<int>()) << row.name;
      EXPECT_EQ(row.highest, one.at("range")[1].get<int>()) << row.name;
    }
  }
}

TEST(LinMotErrors, AreThePublishedOnes) {
  const Json document = catalogue("errors");
  ASSERT_EQ(linmot::errors().size(), document.at("catalog").size());
  for (std::size_t i = 0; i < linmot::errors().size(); ++i) {
    const Json& one = document.at("catalog")[i];
    EXPECT_EQ(linmot::errors()[i].name, one.at("name").get<std::string>());
    const std::string code = one.at("asciiCode").is_null() ? "0" : one.at("asciiCode").get<std::string>();
    EXPECT_EQ(std::to_string(linmot::errors()[i].ascii), code);
  }
  EXPECT_EQ(linmot::warnings().size(), document.at("warnings").size());
}

/// The number in "GE bit 1", "E0010", "E0x03 (x = motor)", "Stat A long, Stat B 2x", "3x" behind a text; -1:
/// it is not there.
int number_in(const Json& text, const std::string& behind, int base = 10) {
  if (!text.is_string()) return -1;
  const auto all = text.get<std::string>();
  const auto found = all.find(behind);
  if (found == all.npos) return -1;
  try {
    return std::stoi(all.substr(found + behind.size()), nullptr, base);
  } catch (const std::exception&) {
    return -1;
  }
}

TEST(LinMotErrors, HaveThePublishedBitsAndCodes) {
  const Json document = catalogue("errors");
  int bits = 0, codes = 0, blinks = 0, masks = 0;
  for (std::size_t i = 0; i < linmot::errors().size(); ++i) {
    const Json& one = document.at("catalog")[i];
    const linmot::ErrorRow& row = linmot::errors()[i];
    const std::string name(row.name);
    if (const int bit = number_in(one.at("asciiStatusBit"), "bit "); bit >= 0) {
      EXPECT_EQ(row.bit, bit) << name;
      ++bits;
    }
    if (const int bit = number_in(one.at("profibusErrorBit"), "bit "); bit >= 0) {
      EXPECT_EQ(row.diagnosis_bit, bit) << name;
    }
    const int code =
        row.of_motor ? number_in(one.at("v3Code"), "E0x", 16) : number_in(one.at("v3Code"), "E", 16);
    if (code >= 0) {
      EXPECT_EQ(row.code, code) << name;
      ++codes;
    }
    // Version 2 flashes as often as the number of the status says.
    int blink = number_in(one.at("v2StatB"), "Stat B ");
    if (blink < 0 && one.at("v2StatB").is_string()) blink = number_in(one.at("v2StatB"), "");
    if (blink >= 0) {
      EXPECT_EQ(row.ascii, blink) << name;
      ++blinks;
    }
    if (one.at("errorMask").is_string() && one.at("errorMask").get<std::string>().starts_with("always")) {
      EXPECT_EQ(row.mask, "") << name;
      ++masks;
    }
  }
  EXPECT_GE(bits, 10);
  EXPECT_GE(codes, 12);
  EXPECT_GE(blinks, 6);
  EXPECT_GE(masks, 5);
}

/// The thresholds of a supply, from low error to high error.
std::array<double, 4> thresholds_of(const Json& row) {
  return {row.at("low").at("error").get<double>(), row.at("low").at("warn").get<double>(),
          row.at("high").at("warn").get<double>(), row.at("high").at("error").get<double>()};
}
std::array<double, 4> as_array(const linmot::SupplyThresholds& one) {
  return {one.low_error, one.low_warning, one.high_warning, one.high_error};
}

TEST(LinMotHardware, HasThePublishedThresholdsOfItsSupplies) {
  const Json table = catalogue("errors").at("supplyThresholds");
  for (const linmot::Hardware& one : linmot::all_hardware()) {
    const bool third = one.version == 3;
    const bool high = one.name.size() >= 5 && one.name[4] >= '0' && one.name[4] <= '9';  // E1000 and above
    const Json& rows = table.at(third ? "v3" : "v2");
    EXPECT_EQ(as_array(one.signal), thresholds_of(rows[0])) << one.name;
    EXPECT_EQ(as_array(one.power), thresholds_of(rows[third ? 1 : high ? 2 : 1])) << one.name;
    EXPECT_EQ(one.range_switch, !third && !high) << one.name;
    EXPECT_EQ(one.mt, one.name.ends_with("-MT")) << one.name;
    EXPECT_EQ(one.profibus, one.name.ends_with("-DP")) << one.name;
    EXPECT_EQ(one.motors, one.name[1] - '0') << one.name;
  }
  EXPECT_EQ(linmot::find_hardware("E100")->power.low_error, 18.24);
  EXPECT_EQ(linmot::find_hardware("E5000"), nullptr);
}

}  // namespace
}  // namespace lockstep::linmot_catalogue_test
