// The tables of commands and parameters against the catalogues.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "projects/aposs/names.hpp"
#include "projects/aposs/parameter_names.hpp"
#include "tests/projects/aposs/program_run.hpp"

namespace lockstep::aposs::catalogue_test {
namespace {

nlohmann::json catalogue(const std::string& name) {
  return nlohmann::json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/" + name));
}

const CommandRow* row_named(const std::string& name) {
  for (const CommandRow& row : commands())
    if (row.name == name) return &row;
  return nullptr;
}

TEST(AposCatalogue, HasEveryCommandAndNoOther) {
  std::set<std::string> published;
  const nlohmann::json document = catalogue("commands.json");
  for (const auto& command : document.at("commands")) published.insert(command.at("name"));
  EXPECT_EQ(published.size(), 168u);
  for (const std::string& name : published) EXPECT_NE(row_named(name), nullptr) << name;
  for (const CommandRow& row : commands())
    EXPECT_EQ(published.contains(std::string(row.name)), row.kind != CommandKind::kForm) << row.name;
}

// What is refused is of the later edition alone, but for what needs a bus or an encoder that is not there;
// what is taken of that edition is not taken before it.
TEST(AposCatalogue, RefusesNoCommandOfBothEditions) {
  const nlohmann::json document = catalogue("commands.json");
  int taken = 0, later_ones = 0;
  for (const auto& command : document.at("commands")) {
    const bool later = command.at("edition").get<std::string>().starts_with("de-only");
    const CommandRow& row = *row_named(command.at("name"));
    EXPECT_EQ(row.refusal != Refusal::kNone || row.later_edition, later) << row.name;
    taken += later ? 0 : 1;
    later_ones += row.later_edition ? 1 : 0;
  }
  EXPECT_EQ(taken, 112);
  EXPECT_EQ(later_ones, 1) << "SYNCMARKERSTART";
}

TEST(AposCatalogue, TakesACommandOfTheLaterEditionFromThereOn) {
  EXPECT_TRUE(compile_program("x.m", "SYNCMARKERSTART 1\n").errors.empty());
  const CompiledProgram before = compile_program("x.m", "SYNCMARKERSTART 1\n", {}, {.later_edition = false});
  ASSERT_EQ(before.errors.size(), 1u);
  EXPECT_EQ(to_string(before.files, before.errors[0]),
            "x.m:1:1: SYNCMARKERSTART is of the later edition; allowed with firmware 5.00");
}

TEST(AposCatalogue, HasTheArgumentsOfEachCommandOfTheDevice) {
  const nlohmann::json document = catalogue("commands.json");
  int compared = 0;
  for (const auto& command : document.at("commands")) {
    const CommandRow& row = *row_named(command.at("name"));
    if (row.kind != CommandKind::kStatement && row.kind != CommandKind::kFunction) continue;
    EXPECT_EQ(row.kind == CommandKind::kFunction, !command.at("returns").is_null()) << row.name;
    ++compared;
    if (row.command == Command::kTestsetp) {  // ms, "vi1..vi3", array
      EXPECT_EQ(row.arity(), 5u);
      continue;
    }
    ASSERT_EQ(row.arity(), command.at("parameters").size()) << row.name;
    for (std::size_t i = 0; i < row.arity(); ++i) {
      const std::string type = command["parameters"][i].at("type");
      EXPECT_EQ(row.arguments[i] == Argument::kArray, type.starts_with("array")) << row.name << i;
    }
  }
  EXPECT_GT(compared, 60);
}

TEST(AposCatalogue, KnowsEveryOtherSpellingOfACommand) {
  const nlohmann::json document = catalogue("commands.json");
  for (const auto& command : document.at("commands"))
    for (const std::string alias : command.at("aliases")) {
      if (alias == "SAVE part" || alias.starts_with("SAVE ")) continue;  // its argument
      Messages messages;
      const Tokens tokens = cut("x", alias, {}, messages);
      EXPECT_TRUE(command_at(tokens.list) || is_reserved(tokens.list[0].folded)) << alias;
    }
}

TEST(AposCatalogue, HasEveryParameterWithItsMnemonic) {
  std::set<std::pair<std::string, std::string>> published, declared;
  const nlohmann::json document = catalogue("parameters.json");
  for (const auto& parameter : document.at("parameters")) {
    const std::string number = parameter.at("number"), name = parameter.at("name");
    if (number.find("..") == number.npos) published.insert({number, name.starts_with('(') ? "" : name});
  }
  for (const mco305::Parameter& parameter : mco305::parameters()) {
    declared.insert({parameter_text(parameter.number), std::string(parameter.mnemonic)});
    if (!parameter.mnemonic.empty()) {
      EXPECT_EQ(parameter_number(parameter.mnemonic), parameter.number);
    }
    EXPECT_TRUE(is_parameter(parameter.number));
  }
  EXPECT_EQ(declared, published);
  EXPECT_TRUE(is_parameter(1900) && is_parameter(1999) && !is_parameter(2000) && !is_parameter(1899));
}

// Each command of the device can be written as published, and reaches the device with its arguments.
TEST(AposCatalogue, LetsEveryCommandOfTheDeviceReachIt) {
  const std::map<Argument, std::string> written = {
      {Argument::kValue, "3"},     {Argument::kOptionalValue, "3"}, {Argument::kState, "ON"},
      {Argument::kIndex, "[3]"},   {Argument::kArray, "field"},     {Argument::kParameter, "32-67"},
      {Argument::kDrive, "19-01"}, {Argument::kText, "\"text\""},   {Argument::kOutput, "3"},
      {Argument::kPart, "AXPARS"}};
  for (const CommandRow& row : commands()) {
    const bool statement = row.kind == CommandKind::kStatement, function = row.kind == CommandKind::kFunction;
    if ((!statement && !function) || row.command == Command::kPid) continue;
    std::string text = "DIM field[5]\n" + std::string(function ? "x = " : "") + std::string(row.name);
    for (std::size_t i = 0; i < row.arity(); ++i)
      text += (row.arguments[i] == Argument::kIndex ? "" : " ") + written.at(row.arguments[i]);
    const CompiledProgram compiled = compile_program("x.m", text + "\n");
    ASSERT_TRUE(compiled.image) << text << (compiled.errors.empty() ? "" : compiled.errors[0].text);
    bool found = false;
    for (const Instruction& at : compiled.image->code)
      found =
          found || (at.operation == Operation::kCommand && at.a == static_cast<std::uint16_t>(row.command));
    EXPECT_TRUE(found) << text;
  }
}

}  // namespace
}  // namespace lockstep::aposs::catalogue_test
