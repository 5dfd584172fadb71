// lockstep describe against the declarations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "fb/block.hpp"
#include "tech_objects/alarms/alarms.hpp"
#include "tech_objects/alarms/error_remedies.hpp"
#include "tech_objects/data_blocks/variable.hpp"
#include "tech_objects/jobs/override.hpp"
#include "tests/cli/command_run.hpp"

namespace lockstep::cli::describe_test {
namespace {

using nlohmann::json;

json described(std::vector<std::string> names) {
  names.insert(names.begin(), "describe");
  names.emplace_back("--json");
  const Ended ended = lockstep(names);
  EXPECT_EQ(ended.status, 0) << names[1] << ": " << ended.err;
  return json::parse(ended.out, nullptr, false);
}

// A bound is shown where the type has values beyond it.
void expect_range(const json& object, Type type, const Range& range, const std::string& what) {
  constexpr double kMaximum = std::numeric_limits<double>::max();
  const bool wide = is_real(type) || type == Type::TIME;
  const double minimum = wide ? -kMaximum : static_cast<double>(lowest(type));
  const double maximum = wide ? kMaximum : static_cast<double>(highest(type));
  const json bounds = object.value("range", json::object());
  json expected = json::object();
  if (range.lowest > minimum) expected["lowest"] = range.lowest;
  if (range.highest < maximum) expected["highest"] = range.highest;
  if (!std::isnan(range.excluded)) expected["excluded"] = range.excluded;
  EXPECT_EQ(bounds, expected) << what;
}

void expect_choices(const json& object, std::span<const Choice> choices, const std::string& what) {
  const json list = object.value("choices", json::array());
  ASSERT_EQ(list.size(), choices.size()) << what;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    const std::int64_t value =
        list[i]["value"].is_boolean() ? list[i]["value"].get<bool>() : list[i]["value"].get<std::int64_t>();
    EXPECT_EQ(value, choices[i].value) << what;
    EXPECT_EQ(list[i]["text"], choices[i].text) << what;
  }
}

void expect_value(const json& shown, Value value, Type type, const std::string& what) {
  if (type >= Type::AXIS)
    EXPECT_TRUE(shown.is_null()) << what;
  else if (type == Type::BOOL)
    EXPECT_EQ(shown, value.u != 0) << what;
  else if (type == Type::TIME)
    EXPECT_TRUE(shown.is_string()) << what;
  else
    EXPECT_EQ(shown.get<double>(), as_double(value, type)) << what;
}

TEST(Describe, WithoutANameListsEveryBlockAndObject) {
  const json list = described({});
  ASSERT_EQ(list["function_blocks"].size(), block_types().size());
  for (std::size_t i = 0; i < block_types().size(); ++i)
    EXPECT_EQ(list["function_blocks"][i]["name"], block_types()[i].name);
  EXPECT_EQ(list["technology_objects"].size(), kObjectKinds.size());
  const Ended text = lockstep({"describe"});
  for (const BlockType& type : block_types())
    EXPECT_NE(text.out.find("\n" + std::string(type.name) + " "), std::string::npos) << type.name;
}

TEST(Describe, TellsEveryPinOfEveryBlockAsItIsDeclared) {
  for (const BlockType& type : block_types()) {
    const json shown = described({std::string(type.name)});
    const auto block = type.create();
    ASSERT_EQ(shown["pins"].size(), type.pins.size()) << type.name;
    for (std::size_t i = 0; i < type.pins.size(); ++i) {
      const Pin& pin = type.pins[i];
      const json& own = shown["pins"][i];
      const std::string what = std::string(type.name) + "." + std::string(pin.name);
      EXPECT_EQ(own["name"], pin.name);
      EXPECT_EQ(own["class"], pin.pin_class == PinClass::input    ? "input"
                              : pin.pin_class == PinClass::output ? "output"
                                                                  : "in_out")
          << what;
      EXPECT_EQ(own["type"], pin.type == Type::AXIS ? "object" : type_name(pin.type)) << what;
      EXPECT_EQ(own.value("unit", ""), unit_text(pin.unit)) << what;
      EXPECT_EQ(own["text"], pin.text) << what;
      if (pin.type != Type::AXIS) expect_value(own["default"], pin.signal(*block).load(), pin.type, what);
      expect_range(own, pin.type, pin.range, what);
      expect_choices(own, pin.choices, what);
    }
  }
}

TEST(Describe, NamesEveryPinInTheTextOfEveryBlock) {
  for (const BlockType& type : block_types()) {
    const Ended text = lockstep({"describe", std::string(type.name)});
    EXPECT_EQ(text.status, 0);
    for (const Pin& pin : type.pins)
      EXPECT_NE(text.out.find("\n" + std::string(pin.name) + " "), std::string::npos)
          << type.name << pin.name;
  }
}

TEST(Describe, SaysThatAValueHasToBeGreaterThanZeroAsPeopleDo) {
  const Ended text = lockstep({"describe", "MC_GearInPos.MasterStartDistance"});
  EXPECT_NE(text.out.find("allowed: > 0.0; else"), std::string::npos) << text.out;
}

TEST(Describe, KeepsToEightyColumnsInAPipe) {
  for (const char* name : {"MC_GearInPos", "MC_Home", "alarms", "StatusWord"}) {
    const Ended text = lockstep({"describe", name});
    std::istringstream lines(text.out);
    for (std::string line; std::getline(lines, line);) {
      const auto width = std::count_if(line.begin(), line.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
      const bool one_word = line.find(' ', line.find_first_not_of(' ')) == std::string::npos;
      ASSERT_TRUE(width <= 80 || one_word) << name << ": " << line;
    }
  }
}

TEST(Describe, TellsEveryVariableOfEveryObjectAsItIsDeclared) {
  for (const ObjectKindText& object : kObjectKinds) {
    const DataBlock& block = data_block_of(object.kind);
    std::map<std::string, json> shown;
    const json all = described({std::string(object.name)});
    for (const json& variable : all["variables"]) shown[variable["path"]] = variable;
    EXPECT_EQ(shown.size(), block.configuration.size() + block.status.size());
    for (const auto list : block.lists()) {
      for (const Variable& variable : list) {
        const std::string what(variable.path);
        ASSERT_TRUE(shown.contains(what)) << what;
        const json& own = shown[what];
        EXPECT_EQ(own["type"], variable.type == Type::TAG ? "VREF" : type_name(variable.type)) << what;
        EXPECT_EQ(own.value("unit", ""), unit_text(variable.unit)) << what;
        EXPECT_EQ(own.value("elements", std::size_t{0}), variable.count) << what;
        EXPECT_EQ(own["computed"], variable.computed) << what;
        EXPECT_EQ(own["later"], variable.later) << what;
        EXPECT_EQ(own.contains("bits"), variable.bits != nullptr) << what;
        const json& first = own["default"].is_array() ? own["default"][0] : own["default"];
        if (variable.type != Type::TAG) expect_value(first, variable.start_value(), variable.type, what);
        expect_range(own, variable.type, variable.range, what);
        expect_choices(own, variable.choices, what);
      }
    }
  }
}

TEST(Describe, FindsAPartOfAnObjectInAnySpelling) {
  EXPECT_EQ(described({"to_synchronousaxis.DYNAMICLIMITS"})["variables"].size(),
            described({"DynamicLimits"})["variables"].size());
  EXPECT_EQ(described({"dynamiclimits.maxvelocity"})["variables"][0]["path"], "DynamicLimits.MaxVelocity");
  EXPECT_EQ(described({"Sensor[2].Type"})["variables"][0]["path"], "Sensor[].Type");
  EXPECT_EQ(described({"Sensor.Existent"})["variables"][0]["default"].size(), 4u);
  EXPECT_EQ(described({"StatusWord.X5"})["name"], "HomingDone");
  EXPECT_EQ(described({"StatusWord.X22"})["objects"], json::array({"TO_SynchronousAxis"}));
  EXPECT_EQ(described({"mc_gearinpos.insync"})["pins"][0]["name"], "InSync");
  const Ended word = lockstep({"describe", "StatusWord"});
  EXPECT_NE(word.out.find("X22 Synchronous"), std::string::npos);
}

TEST(Describe, TellsEveryAlarmAndError) {
  EXPECT_EQ(described({"alarms"})["alarms"].size(), alarms().size());
  EXPECT_EQ(described({"errors"})["errors"].size(), error_texts().size());
  EXPECT_EQ(described({"608"})["text"], find_alarm(608)->text);
  EXPECT_EQ(described({"608"})["reaction"], find_alarm(608)->reaction);
  EXPECT_FALSE(described({"608"}).contains("not_raised"));
  EXPECT_EQ(described({"701"})["not_raised"], find_alarm(701)->not_raised);
  EXPECT_EQ(described({"16#8026"})["text"], error_text(ErrorId::leading_distance));
  EXPECT_EQ(described({"0x8026"}), described({"32806"}));
  const json errors = described({"errors"})["errors"];
  for (const json& error : errors)
    EXPECT_EQ(error["remedy"].get<std::string>().empty(), error["id"] == "16#0000") << error;
  EXPECT_EQ(described({"16#800F"})["remedy"], error_remedy(ErrorId::locked));
  EXPECT_NE(lockstep({"describe", "16#8019"}).out.find("Remedy: end the coupling"), std::string::npos);
  const json pins = described({"16#8026"})["pins"];
  EXPECT_NE(std::find(pins.begin(), pins.end(), "MC_GearInPos.MasterStartDistance"), pins.end());
}

TEST(Describe, TellsTheOverrideTablesAsTheyAre) {
  const json gear = described({"override", "mc_gearinpos"});
  ASSERT_EQ(gear["new_jobs"].size(), 2u);
  const json& active = gear["new_jobs"][1];
  EXPECT_EQ(gear["new_jobs"][0]["which"], "waiting");
  EXPECT_EQ(active["which"], "active");
  constexpr int kClassesOfAxes = static_cast<int>(JobClass::measuring);
  ASSERT_EQ(active["running_jobs"].size(), static_cast<std::size_t>(kClassesOfAxes));
  constexpr std::string_view kNames[] = {"none", "abort", "reject", "abort_by_rank"};
  for (int i = 0; i < kClassesOfAxes; ++i) {
    const auto running = static_cast<JobClass>(i);
    const json& cell = active["running_jobs"][static_cast<std::size_t>(i)];
    const auto name = [&](bool controlled) {
      return kNames[static_cast<int>(override_effect(JobClass::gear_in_pos_active, running, controlled))];
    };
    EXPECT_EQ(cell["effect"], name(true)) << i;
    EXPECT_EQ(cell["effect_without_position_control"], name(false)) << i;
    EXPECT_EQ(cell.contains("exception"), running == JobClass::motion_in) << i;
    EXPECT_EQ(cell["line"], running < JobClass::gear_in ? 7221 : 7286) << i;
  }
  const json all = described({"override"});
  for (const json& name : all["instructions"])
    EXPECT_GT(described({"override", name})["new_jobs"].size(), 0u) << name;
}

TEST(Describe, TellsTheOverrideTableOfMeasuringInputs) {
  const json measuring = described({"override", "MC_MeasuringInput"});
  ASSERT_EQ(measuring["new_jobs"].size(), 1u);
  ASSERT_EQ(measuring["new_jobs"][0]["running_jobs"].size(), 1u) << "jobs of an axis are not its own";
  const std::map<std::string, std::pair<std::string, int>> homing = {
      {"Mode 2, 8, 10", {"abort", 7317}},
      {"Mode 3, 5", {"abort", 7317}},
      {"Mode 9", {"abort", 7317}},
      {"Mode 0, 1, 6, 7, 11, 12, 13", {"none", 7318}}};
  std::size_t found = 0;
  const json by_homing = described({"override", "MC_Home"});
  for (const json& row : by_homing["new_jobs"]) {
    const json& cell = row["running_jobs"].back();
    const auto& [effect, line] = homing.at(row["which"]);
    EXPECT_EQ(cell["running"], json({"MC_MeasuringInput", "MC_MeasuringInputCyclic"}));
    EXPECT_EQ(cell["effect"], effect) << row["which"];
    EXPECT_EQ(cell["line"], line) << row["which"];
    ++found;
  }
  EXPECT_EQ(found, homing.size());
}

TEST(Describe, KeysOfTheProjectFile) {
  const json cycle = described({"keys", "clock.servo_cycle"});
  EXPECT_EQ(cycle["value"], "duration from 1us to 1min");
  EXPECT_EQ(cycle["required"], true);
  const json plant = described({"keys", "technology_objects.drive.plant"});
  EXPECT_EQ(plant["structures"][0]["keys"][0]["name"], "inertia");
  EXPECT_GT(described({"keys"})["structures"].size(), 40u);
}

TEST(Describe, AWordThatIsNoNameFindsWhatHasToDoWithItNearestFirst) {
  const auto names_of = [](const json& search) {
    std::vector<std::string> names;
    for (const json& one : search["found"]) names.push_back(one["name"]);
    return names;
  };
  const auto at = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  const std::vector<std::string> gear = names_of(described({"gear"}));
  for (const char* const name : {"MC_GearIn", "MC_GearInPos", "MC_GearOut", "LoadGear.Numerator"})
    EXPECT_LT(at(gear, name), at(gear, "16#8077")) << "a name counts for more than a mention: " << name;
  EXPECT_LT(at(gear, "16#8077"), static_cast<std::ptrdiff_t>(gear.size()));
  const std::string shown = lockstep({"describe", "gear"}).out;
  EXPECT_LT(std::count(shown.begin(), shown.end(), '\n'), 80) << "short: " << shown;
  const std::vector<std::string> two = names_of(described({"following", "error"}));
  for (const char* const name : {"521", "FollowingError.MaxValue", "StatusPositioning.FollowingError"})
    EXPECT_LT(at(two, name), static_cast<std::ptrdiff_t>(two.size())) << name;
  const json found = described({"servo_cycle"});
  EXPECT_EQ(found["found"][0]["name"], "keys clock.servo_cycle");
  for (const json& one : found["found"]) EXPECT_TRUE(one["kind"].is_string() && one["text"].is_string());
}

TEST(Describe, TakesAsManyWordsAsAreGiven) {
  EXPECT_NE(lockstep({"describe", "following", "error", "large"}).out.find("Following error too large"),
            std::string::npos);
  for (const char* const topic : {"keys", "override", "functions"}) {
    const Ended ended = lockstep({"describe", topic, "clock", "servo_cycle"});
    EXPECT_EQ(ended.status, 1);
    EXPECT_NE(ended.err.find(std::string("'") + topic + "' takes no third name"), std::string::npos)
        << ended.err;
  }
}

TEST(Describe, TellsCauseAndRemedyOfAnAlarm) {
  const Ended ended = lockstep({"describe", "531"});
  for (const char* const name : {"Cause ", "Remedy ", "Told with it"})
    EXPECT_NE(ended.out.find(name), std::string::npos) << ended.out;
  const Ended all = lockstep({"describe", "alarms"});
  EXPECT_NE(all.out.find("remedy: "), std::string::npos);
}

/// A text without the ends of its lines and their indentation.
std::string on_one_line(const std::string& text) {
  std::string result;
  std::istringstream words(text);
  for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
  return result;
}

TEST(Describe, TheTablesOfAlarmsAndErrorsSayOfEachWhatHelps) {
  const std::string table = on_one_line(lockstep({"describe", "alarms"}).out);
  std::size_t raised = 0;
  for (const Alarm& alarm : alarms()) {
    if (!alarm.not_raised.empty()) continue;
    for (const std::string_view part : {alarm.text, alarm.cause, alarm.remedy})
      EXPECT_NE(table.find(on_one_line(std::string(part))), std::string::npos)
          << alarm.number << ": " << part;
    ++raised;
  }
  EXPECT_GT(raised, 40u);
  const std::string errors = on_one_line(lockstep({"describe", "errors"}).out);
  for (const ErrorText& error : error_texts())
    for (const std::string_view part :
         {std::string_view(error.text), std::string_view(error_remedy(error.id))})
      EXPECT_NE(errors.find(on_one_line(std::string(part))), std::string::npos) << part;
}

TEST(Describe, ACommandThatThereIsNotNamesTheNearestOne) {
  const Ended wrong = lockstep({"decribe", "521"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("there is no command 'decribe' (did you mean 'describe'?)"), std::string::npos)
      << wrong.err;
  EXPECT_NE(lockstep({"simulate"}).err.find("commands: "), std::string::npos);
}

TEST(CommandLine, AnOptionOrACommandOfACommandThatThereIsNotNamesTheNearestOne) {
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"run", "x.json", "--simulat"}, "lockstep run has no option '--simulat' (did you mean '--simulate'?)"},
      {{"run", "--trase=x.csv", "x.json"}, "lockstep run has no option '--trase' (did you mean '--trace'?)"},
      {{"plot", "--outpt", "x", "y"}, "lockstep plot has no option '--outpt' (did you mean '--output'?)"},
      {{"cam", "check", "x", "--jsn"}, "lockstep cam check has no option '--jsn'"},
      {{"cam", "chek"}, "there is no command 'chek' (did you mean 'check'?) of lockstep cam; commands: "},
      {{"--verson"}, "lockstep has no option '--verson' (did you mean '--version'?)"}};
  for (const auto& [words, message] : cases) {
    const Ended ended = lockstep(words);
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.err.find("lockstep: " + message), 0u) << ended.err;
  }
  EXPECT_EQ(lockstep({"run", "--help", "--simulat"}).status, 0) << "help is given";
  const Ended value = lockstep({"run", "x.json", "--fail-on", "alrm"});
  EXPECT_NE(value.err.find("alrm not in"), std::string::npos) << "any other mistake as before: " << value.err;
}

TEST(Describe, AnUnknownNameExitsWith1AndASuggestion) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> unknown = {
      {{"MC_GaerInPos"}, "did you mean 'MC_GearInPos'?"},
      {{"MC_Power.Statu"}, "did you mean 'Status'?"},
      {{"TO_SynchronousAxis.DynamicLimit"}, "did you mean 'DynamicLimits'?"},
      {{"StatusWrod"}, "did you mean 'StatusWord'?"},
      {{"StatusWord.X32"}, "there is nothing called"},
      {{"Sensor[5]"}, "there is nothing called"},
      {{"8026"}, "did you mean '16#8026'?"},
      {{"16#9999"}, "there is no error"},
      {{"99999999999999999999"}, "there is nothing called"},
      {{"override", "MC_GaerIn"}, "did you mean 'MC_GearIn'?"},
      {{"alarms", "608"}, "takes no second name"},
      {{"gear", "elephant"}, "there is nothing that has to do with all of"},
      {{"keys", "clock.servo_cycel"}, "did you mean 'clock.servo_cycle'?"},
  };
  for (const auto& [names, suggestion] : unknown) {
    std::vector<std::string> arguments = names;
    arguments.insert(arguments.begin(), "describe");
    const Ended ended = lockstep(arguments);
    EXPECT_EQ(ended.status, 1) << names.back();
    EXPECT_EQ(ended.out, "") << names.back();
    EXPECT_NE(ended.err.find(suggestion), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace lockstep::cli::describe_test
