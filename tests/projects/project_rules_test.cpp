// Every rule of the project file: what is wrong is told at its place, with what is allowed.
#include <gtest/gtest.h>

#include "changed_project.hpp"
#include "projects/loader/project.hpp"

namespace lockstep::project_rules_test {
namespace {

struct Rule {
  std::string change;  // pointer
  std::string value;   // JSON; empty: removed
  std::string place;   // where the only problem has to be told
  std::string part;    // of its text
};

void PrintTo(const Rule& rule, std::ostream* out) {
  *out << rule.change << " = " << (rule.value.empty() ? "nothing" : rule.value.substr(0, 100));
}

class Rules : public testing::TestWithParam<Rule> {};

TEST_P(Rules, AreToldAtTheirPlace) {
  const Rule& rule = GetParam();
  const LoadedProject loaded = load_project(changed(rule.change, rule.value));
  EXPECT_FALSE(loaded.project.has_value());
  ASSERT_EQ(loaded.problems.size(), 1u) << lines(loaded.problems);
  EXPECT_EQ(loaded.problems[0].place, rule.place) << loaded.problems[0].text;
  EXPECT_NE(loaded.problems[0].text.find(rule.part), std::string::npos) << loaded.problems[0].text;
  EXPECT_LT(loaded.problems[0].text.size(), 700u);
  const LoadedProject looked_at = load_project(changed(rule.change, rule.value), "", {}, LoadedFor::looking);
  EXPECT_EQ(lines(looked_at.problems), lines(loaded.problems));
  EXPECT_EQ(lines(looked_at.warnings), lines(loaded.warnings));
}

class Warnings : public testing::TestWithParam<Rule> {};

TEST_P(Warnings, LeaveTheProjectValid) {
  const Rule& rule = GetParam();
  const LoadedProject loaded = load_project(changed(rule.change, rule.value));
  EXPECT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  const LoadedProject looked_at = load_project(changed(rule.change, rule.value), "", {}, LoadedFor::looking);
  EXPECT_TRUE(looked_at.project.has_value()) << lines(looked_at.problems);
  EXPECT_EQ(lines(looked_at.warnings), lines(loaded.warnings));
  ASSERT_EQ(loaded.warnings.size(), 1u) << lines(loaded.warnings);
  EXPECT_EQ(loaded.warnings[0].place, rule.place) << loaded.warnings[0].text;
  EXPECT_NE(loaded.warnings[0].text.find(rule.part), std::string::npos) << loaded.warnings[0].text;
}

const std::string kConveyor = "/technology_objects/Conveyor";
const std::string kKnife = "/technology_objects/Knife";
const std::string kConfig = "/technology_objects/Knife/config";
const std::string kCalls = "/programs/0/calls";
const std::string kGear = "/programs/0/calls/4/in";
const std::string kNew = "/programs/0/calls/7";  // a call behind the others
const std::string kMap = "/modbus/map/4";        // an entry behind the others

/// A change of a place whose problem is told there.
Rule at(const std::string& place, std::string value, std::string part) {
  return {place, std::move(value), place, std::move(part)};
}
Rule missing(const std::string& key, std::string parent, std::string part) {
  return {parent + "/" + key, "", std::move(parent), std::move(part)};
}

INSTANTIATE_TEST_SUITE_P(
    Retain, Rules,
    testing::Values(at("/retain", "[]", "allowed: an object"),
                    Rule{"/retain", R"({"files": "x"})", "/retain/files", "file"},
                    Rule{"/retain", R"({"file": ""})", "/retain/file", "is no name of a file"},
                    Rule{"/retain", R"({"file": 1})", "/retain/file", "allowed: a string"},
                    Rule{"/retain", R"({"interval": "10us"})", "/retain/interval", "1ms"},
                    Rule{"/retain", R"({"interval": "2h"})", "/retain/interval", "h"}));

INSTANTIATE_TEST_SUITE_P(
    Project, Rules,
    testing::ValuesIn(std::vector<Rule>{
        at("", "[]", "an array is not allowed here; allowed: an object"), at("", "3", "allowed: an object"),
        at("/surprise", "1", "unknown key 'surprise'"), at("/tag", "{}", "(did you mean 'tags'?)"),
        at("/Name", "\"x\"", "(did you mean 'name'?)"), at("/lockstep", "2", "2 is not allowed"),
        at("/lockstep", "\"1\"", "'1' is not allowed"), missing("lockstep", "", "'lockstep' is missing"),
        missing("name", "", "'name' is missing"), at("/name", "\"\"", "1 to 128 bytes"),
        at("/name", "\"a\\u0007b\"", "control characters"), at("/name", "7", "allowed: a string"),
        at("/name", "\"" + std::string(129, 'n') + "\"", "1 to 128 bytes"),
        at("/description", "null", "null is not allowed"), missing("clock", "", "'clock' is missing"),
        at("/tags/more", "[]", "allowed: an object"), at("/stimuli", "{}", "allowed: an array"),
        at("/modbus", "[]", "allowed: an object"), at("/trace", "[]", "allowed: an object")}));

INSTANTIATE_TEST_SUITE_P(Clock, Rules,
                         testing::ValuesIn(std::vector<Rule>{
                             missing("servo_cycle", "/clock", "'servo_cycle' is missing"),
                             at("/clock/servo_cycle", "1", "a duration such as \"10ms\""),
                             at("/clock/servo_cycle", "\"1 ms\"", "is not a duration"),
                             at("/clock/servo_cycle", "\"0ms\"", "from 1us"),
                             at("/clock/servo_cycle", "\"999ns\"", "from 1us"),
                             at("/clock/servo_cycle", "\"-1ms\"", "from 1us"),
                             at("/clock/servo_cycle", "\"0.1ns\"", "whole number of nanoseconds"),
                             at("/clock/servo_cycle", "\"61s\"", "to 1min"),
                             {"/clock/servo_cycle", "\"3ms\"", "/programs/0/cycle",
                              "whole multiple of servo_cycle"},
                             at("/clock/interpolator_ratio", "0", "from 1 to 32"),
                             at("/clock/processors", "0", "from 1 to 64"),
                             at("/clock/processors", "65", "from 1 to 64"),
                             at("/clock/processors", "\"2\"", "from 1 to 64"),
                             at("/clock/interpolator_ratio", "33", "from 1 to 32"),
                             at("/clock/interpolator_ratio", "2.5", "from 1 to 32"),
                             at("/clock/interpolator_ratio", "\"2\"", "from 1 to 32"),
                             at("/clock/interpolator_ratio", "99999999999999999999", "from 1 to 32"),
                             at("/clock/overrun", "\"halt\"", "allowed: report, stop"),
                             at("/clock/overrun", "\"Stop\"", "(did you mean 'stop'?)"),
                             at("/clock/cycle", "\"1ms\"", "unknown key 'cycle'")}));

INSTANTIATE_TEST_SUITE_P(Naming, Rules,
                         testing::ValuesIn(std::vector<Rule>{
                             at("/tags/1st", R"({"type": "BOOL"})", "'1st' is not a name"),
                             at("/tags/", R"({"type": "BOOL"})", "is not a name"),
                             at("/tags/a__b", R"({"type": "BOOL"})", "single underscores"),
                             at("/tags/a_", R"({"type": "BOOL"})", "an underscore last"),
                             at("/tags/a b", R"({"type": "BOOL"})", "is not a name"),
                             at("/tags/grün", R"({"type": "BOOL"})", "is not a name"),
                             at("/tags/a-b", R"({"type": "BOOL"})", "is not a name"),
                             {"/tags/" + std::string(129, 'x'), R"({"type": "BOOL"})",
                              "/tags/" + std::string(60, 'x') + "…", "up to 128 characters"},
                             at("/tags/mod", R"({"type": "BOOL"})", "keyword"),
                             at("/tags/LReal", R"({"type": "BOOL"})", "keyword"),
                             at("/tags/True", R"({"type": "BOOL"})", "keyword"),
                             at("/tags/SPEED", R"({"type": "BOOL"})", "(as 'speed', case does not count)"),
                             {"/tags/knife", R"({"type": "BOOL"})", kKnife, "taken already (as 'knife'"},
                             {"/tags/GEAR", R"({"type": "BOOL"})", kCalls + "/4/name", "taken already"},
                             {kNew, R"({"fb": "F_TRIG", "name": "run", "in": {"CLK": true}})", kNew + "/name",
                              "taken already"},
                             {kNew, R"({"fb": "R_TRIG", "name": "x.y"})", kNew + "/name", "is not a name"},
                             {"/programs/1", R"({"name": "main", "ob": "MC_PreServo", "calls": []})",
                              "/programs/1/name", "there is a program 'main' already"}}));

const std::string kEncoder = "/technology_objects/Encoder";
const std::string kInput = "/technology_objects/Input";

std::string encoder(const std::string& source) {
  return R"({"type": "TO_ExternalEncoder", "encoder": )" + source + "}";
}
std::string input(const std::string& rest) {
  return R"({"type": "TO_MeasuringInput")" + rest + "}";
}

INSTANTIATE_TEST_SUITE_P(
    Encoder, Rules,
    testing::ValuesIn(std::vector<Rule>{
        {kEncoder, R"({"type": "TO_ExternalEncoder"})", kEncoder, "'encoder' is missing"},
        {kEncoder, encoder(R"({"follows": "Knife"})"), kEncoder + "/encoder", "'model' is missing"},
        {kEncoder, encoder(R"({"model": "simulated"})"), kEncoder + "/encoder",
         "'follows' (an axis) and 'signal'"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "signal": "speed"})"),
         kEncoder + "/encoder", "measures one thing"},
        {kEncoder, encoder(R"({"model": "real", "follows": "Knife"})"), kEncoder + "/encoder/model",
         "allowed: simulated"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "speed"})"), kEncoder + "/encoder/follows",
         "is no technology object"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Encoder"})"), kEncoder + "/encoder/follows",
         "allowed: TO_PositioningAxis, TO_SynchronousAxis"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "ratio": 0})"),
         kEncoder + "/encoder/ratio", "any other number"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "wrap": 10})"),
         kEncoder + "/encoder/wrap", "with 'signal' only"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "valid": "start"})"),
         kEncoder + "/encoder/valid", "with 'signal' only"},
        {kEncoder, encoder(R"({"model": "simulated", "signal": "speed", "valid": "speed"})"),
         kEncoder + "/encoder/valid", "the name of a BOOL tag"},
        {kEncoder, encoder(R"({"model": "simulated", "signal": "speed", "ratio": 2})"),
         kEncoder + "/encoder/ratio", "with 'follows' only"},
        {kEncoder, encoder(R"({"model": "simulated", "signal": "start"})"), kEncoder + "/encoder/signal",
         "is of type BOOL; allowed: a number"},
        {kEncoder, encoder(R"({"model": "simulated", "signal": "nothing"})"), kEncoder + "/encoder/signal",
         "unknown name 'nothing'"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "zero_marks": {}})"),
         kEncoder + "/encoder/zero_marks", "'position' is missing"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "reference_cam": [2, 1]})"),
         kEncoder + "/encoder/reference_cam", "from is greater than to"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "noise": -1})"),
         kEncoder + "/encoder/noise", "-1 is not allowed"},
        {kEncoder, encoder(R"({"model": "simulated", "follows": "Knife", "resolution": "fine"})"),
         kEncoder + "/encoder/resolution", "'fine' is not allowed"},
        {kEncoder,
         R"({"type": "TO_ExternalEncoder", "drive": {}, "encoder": {"model": "simulated", "follows": "Knife"}})",
         kEncoder + "/drive", "unknown key 'drive'"}}));

INSTANTIATE_TEST_SUITE_P(
    MeasuringInput, Rules,
    testing::ValuesIn(std::vector<Rule>{
        {kInput, input(R"(, "marks": {"period": 10})"), kInput, "'assigned_to' is missing"},
        {kInput, input(R"(, "assigned_to": "Knife")"), kInput, "an input sees one thing"},
        {kInput, input(R"(, "assigned_to": "speed", "marks": {"period": 10})"), kInput + "/assigned_to",
         "is no technology object"},
        {kInput, input(R"(, "assigned_to": "Knife", "marks": {})"), kInput + "/marks", "'period' is missing"},
        {kInput,
         input(
             R"(, "assigned_to": "Knife", "marks": {"period": 10}, "config": {"Parameter": {"MeasuringInputType": 2}})"),
         kInput + "/config/Parameter/MeasuringInputType", "not supported; allowed: 0 (time stamp)"},
        {kInput, input(R"(, "assigned_to": "Knife", "marks": {"period": 0})"), kInput + "/marks/period",
         "from 0.001"},
        {kInput, input(R"(, "assigned_to": "Knife", "marks": {"period": 10, "width": 10})"),
         kInput + "/marks/width", "less than 'period'"},
        {kInput,
         input(
             R"(, "assigned_to": "Knife", "marks": {"period": 10}, "config": {"Interface": {"Address": "start"}})"),
         kInput + "/marks", "an input sees one thing"},
        {kInput,
         input(
             R"(, "assigned_to": "Knife", "marks": {"period": 10}, "config": {"Parameter": {"CorrectionTime": 1e6}})"),
         kInput + "/config/Parameter/CorrectionTime", "254 servo cycles"},
        {kInput, input(R"(, "assigned_to": "Knife", "marks": {"period": 10}, "config": {"Status": 1})"),
         kInput + "/config/Status", "computed by the runtime"}}));

INSTANTIATE_TEST_SUITE_P(
    TraceChannel, Rules,
    testing::ValuesIn(std::vector<Rule>{
        {"/trace/channels", "{}", "/trace/channels", "allowed: an array"},
        {"/trace/channels", R"([{"signals": []}])", "/trace/channels/0", "'channel' is missing"},
        {"/trace/channels", R"([{"channel": "A"}])", "/trace/channels/0", "'signals' is missing"},
        {"/trace/channels", R"([{"channel": "A", "signals": []}, {"channel": "A", "signals": []}])",
         "/trace/channels/1/channel", "each channel is allowed once"},
        {"/trace/channels", R"([{"channel": "A_HEADER", "signals": []}, {"channel": "A", "signals": []}])",
         "/trace/channels/1/channel", "'A' and 'A_HEADER' collide"},
        {"/trace/channels", R"([{"channel": "ROTARY_KNIFE_EVENTS", "signals": []}])",
         "/trace/channels/0/channel", "'ROTARY_KNIFE_EVENTS' and 'ROTARY_KNIFE' collide"},
        {"/trace/channels", R"([{"channel": "A", "signals": ["nothing"]}])", "/trace/channels/0/signals/0",
         "unknown name"},
        {"/trace/channels", R"([{"channel": "A", "signals": [], "every": 0}])", "/trace/channels/0/every",
         "from 1"},
        {"/trace/channels", R"([{"channel": "A", "signals": [], "trigger": {}}])",
         "/trace/channels/0/trigger", "'on' is missing"},
        {"/trace/channels", R"([{"channel": "A", "signals": [], "trigger": {"on": "rising"}}])",
         "/trace/channels/0/trigger", "'signal' is missing"},
        {"/trace/channels", R"([{"channel": "A", "signals": [], "trigger": {"on": "never"}}])",
         "/trace/channels/0/trigger/on", "allowed: above, below, rising, falling, alarm"},
        {"/trace/channels", R"([{"channel": "A", "signals": [], "trigger": {"on": "alarm", "level": 1}}])",
         "/trace/channels/0/trigger/level", "an alarm has no signal and no level"},
        {"/trace/channels",
         R"([{"channel": "A", "signals": [], "trigger": {"on": "alarm", "before": "11min"}}])",
         "/trace/channels/0/trigger/before", "to 10min"},
        {"/flight_recorder", R"({"file": "a"})", "/flight_recorder", "'before' is missing"},
        {"/flight_recorder", R"({"before": "1s"})", "/flight_recorder", "'file' is missing"},
        {"/flight_recorder", R"({"before": "0s", "file": "a"})", "/flight_recorder/before", "from 1ns"},
        {"/flight_recorder", R"({"before": "1s", "file": ""})", "/flight_recorder/file", "1 to 128 bytes"},
        {"/flight_recorder", R"({"before": "1s", "file": "rec/"})", "/flight_recorder/file", "is a folder"},
        {"/flight_recorder", R"({"before": "1s", "file": ".."})", "/flight_recorder/file", "is a folder"},
        {"/flight_recorder", R"({"before": "1s", "file": "a", "files": 0})", "/flight_recorder/files",
         "from 1"},
        {"/flight_recorder", R"({"before": "1s", "file": "a", "keep": 0})", "/flight_recorder/keep",
         "from 1 to 10000"},
        {"/flight_recorder", R"({"before": "1s", "file": "a", "signals": ["nothing"]})",
         "/flight_recorder/signals/0", "unknown name"}}));

const std::string kOutputCamObject = "/technology_objects/Glue";

std::string output_cam(const std::string& rest) {
  return R"({"type": "TO_OutputCam")" + rest + "}";
}

INSTANTIATE_TEST_SUITE_P(
    OutputCam, Rules,
    testing::ValuesIn(std::vector<Rule>{
        {kOutputCamObject, output_cam(""), kOutputCamObject, "'assigned_to' is missing"},
        {kOutputCamObject, R"({"type": "TO_CamTrack"})", kOutputCamObject, "'assigned_to' is missing"},
        {kOutputCamObject, output_cam(R"(, "assigned_to": "speed")"), kOutputCamObject + "/assigned_to",
         "is no technology object"},
        {kOutputCamObject, output_cam(R"(, "assigned_to": "Knife", "marks": {})"),
         kOutputCamObject + "/marks", "unknown key 'marks'"},
        {kOutputCamObject, output_cam(R"(, "assigned_to": "Knife", "switching_times": {"on": "start"})"),
         kOutputCamObject + "/switching_times/on", "an LREAL tag"},
        {kOutputCamObject, output_cam(R"(, "assigned_to": "Knife", "switching_times": {"at": "speed"})"),
         kOutputCamObject + "/switching_times/at", "unknown key 'at'"},
        {kOutputCamObject,
         output_cam(R"(, "assigned_to": "Knife", "config": {"Interface": {"Address": "speed"}})"),
         kOutputCamObject + "/config/Interface/Address", "the name of a BOOL tag"},
        {kOutputCamObject,
         output_cam(R"(, "assigned_to": "Knife", "config": {"Parameter": {"OutputCamType": 2}})"),
         kOutputCamObject + "/config/Parameter/OutputCamType", "not supported; allowed: 0"},
        {kOutputCamObject, output_cam(R"(, "assigned_to": "Knife", "config": {"CamOutput": true})"),
         kOutputCamObject + "/config/CamOutput", "computed by the runtime"}}));

TEST(SensorsOfADrive, AreLoadedAndCheckedOneByOne) {
  Json project = Json::parse(kExampleProject);
  Json& knife = project["technology_objects"]["Knife"];
  knife["config"]["Sensor[2]"] = Json::parse(R"({"Existent": true})");
  knife["config"]["PositionControl"]["InitialOperativeSensor"] = 2;
  knife["drive"]["sensors"] =
      Json::parse(R"([{"sensor": 2, "ratio": 1.5, "inverted": true, "fault": "start"}])");
  knife["drive"]["position_cycle"] = "250us";
  const LoadedProject loaded = load_project(project.dump());
  ASSERT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  knife["drive"]["sensors"] =
      Json::parse(R"([{"sensor": 2, "ratio": 0}, {"sensor": 2}, {"sensor": 3, "fault": "speed"}])");
  const std::string problems = lines(load_project(project.dump()).problems);
  for (const char* text : {"/sensors/0/ratio", "any other number", "/sensors/1/sensor", "already",
                           "/sensors/2/sensor", "/sensors/2/fault", "the name of a BOOL tag"})
    EXPECT_NE(problems.find(text), std::string::npos) << text << " in\n" << problems;
}

TEST(OutputCamProject, OfAnEncoderCountsItsActualPosition) {
  Json project = Json::parse(kExampleProject);
  auto& objects = project["technology_objects"];
  objects["Encoder"] = Json::parse(encoder(R"({"model": "simulated", "follows": "Conveyor"})"));
  objects["Glue"] = Json::parse(output_cam(R"(, "assigned_to": "Encoder")"));
  EXPECT_TRUE(load_project(project.dump()).project.has_value());
  objects["Glue"]["config"] = Json::parse(R"({"Parameter": {"PositionType": 0}})");
  const LoadedProject refused = load_project(project.dump());
  ASSERT_EQ(refused.problems.size(), 1u) << lines(refused.problems);
  EXPECT_NE(refused.problems[0].text.find("no setpoint; allowed: 1"), std::string::npos);
}

TEST(OutputCamProject, CamsOnOneOutputAgreeOnItsLogic) {
  Json project = Json::parse(kExampleProject);
  auto& objects = project["technology_objects"];
  objects["A"] = Json::parse(output_cam(
      R"(, "assigned_to": "Knife", "config": {"Interface": {"Address": "start", "LogicOperation": 1}})"));
  objects["B"] = objects["A"];
  EXPECT_TRUE(load_project(project.dump()).project.has_value());
  objects["B"]["config"]["Interface"]["LogicOperation"] = 0;
  const LoadedProject refused = load_project(project.dump());
  ASSERT_EQ(refused.problems.size(), 1u) << lines(refused.problems);
  EXPECT_NE(refused.problems[0].text.find("one LogicOperation"), std::string::npos);
}

TEST(EncoderProject, LeadsAFollowingAxisByItsActualValueAlone) {
  Json project = Json::parse(kExampleProject);
  project["technology_objects"]["Encoder"] =
      Json::parse(encoder(R"({"model": "simulated", "follows": "Conveyor", "resolution": 0.1})"));
  auto& values = project["technology_objects"]["Knife"]["leading_values"];
  values.push_back(Json::parse(R"({"to": "Encoder"})"));
  const LoadedProject loaded = load_project(project.dump());
  ASSERT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  const Axis* knife = nullptr;
  for (const Axis* axis : loaded.project->controller->axes)
    if (axis->name == "Knife") knife = axis;
  ASSERT_NE(knife, nullptr);
  EXPECT_EQ(knife->leading_values.back().coupling, Coupling::actual);
  EXPECT_EQ(knife->leading_values.back().source->kind, ObjectKind::TO_ExternalEncoder);
  EXPECT_EQ(knife->leading_values.back().source->name, "Encoder");
  values.back()["coupling"] = "setpoint";
  const LoadedProject refused = load_project(project.dump());
  ASSERT_EQ(refused.problems.size(), 1u) << lines(refused.problems);
  EXPECT_NE(refused.problems[0].text.find("no setpoint; allowed: 'actual', 'delayed'"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Tags, Rules,
    testing::ValuesIn(std::vector<Rule>{
        at("/tags/more", "{}", "'type' is missing"),
        at("/tags/start/typ", "1", "unknown key 'typ'"),
        {"/tags/more", R"({"type": "LREALL"})", "/tags/more/type", "(did you mean 'LREAL'?)"},
        {"/tags/more", R"({"type": "bool"})", "/tags/more/type", "(did you mean 'BOOL'?)"},
        {"/tags/more", R"({"type": "DB_ANY"})", "/tags/more/type", "unknown type 'DB_ANY'"},
        {"/tags/more", R"({"type": "STRING"})", "/tags/more/type", "allowed: STRING[n], n from 1 to 254"},
        {"/tags/more", R"({"type": "ARRAY[3..1] OF INT"})", "/tags/more/type",
         "is less than the lower bound"},
        {"/tags/more", R"({"type": 3})", "/tags/more/type", "allowed: a string"},
        at("/tags/start/init", "1", "allowed: true, false"),
        at("/tags/start/init", "null", "null"),
        at("/tags/start/retain", "1", "allowed: true, false"),
        at("/tags/start/comment", "[]", "allowed: a string"),
        {"/tags/more", R"({"type": "SINT", "init": 128})", "/tags/more/init", "from -128 to 127 (SINT)"},
        {"/tags/more", R"({"type": "SINT", "init": -129})", "/tags/more/init", "from -128 to 127"},
        {"/tags/more", R"({"type": "USINT", "init": -1})", "/tags/more/init", "from 0 to 255"},
        {"/tags/more", R"({"type": "DINT", "init": 3.0})", "/tags/more/init", "without fraction"},
        {"/tags/more", R"({"type": "LINT", "init": 9223372036854775808})", "/tags/more/init", "(LINT)"},
        {"/tags/more", R"({"type": "ULINT", "init": 18446744073709551616})", "/tags/more/init", "(ULINT)"},
        {"/tags/more", R"({"type": "WORD", "init": 65536})", "/tags/more/init", "to 65535 (WORD)"},
        {"/tags/more", R"({"type": "WORD", "init": "16#10000"})", "/tags/more/init", "WORD"},
        {"/tags/more", R"({"type": "REAL", "init": 1e39})", "/tags/more/init", "(REAL)"},
        {"/tags/more", R"({"type": "LREAL", "init": "1.0 / 0.0"})", "/tags/more/init", "no finite constant"},
        {"/tags/more", R"({"type": "LREAL", "init": "speed"})", "/tags/more/init",
         "only constants can stand here"},
        {"/tags/more", R"({"type": "LREAL", "init": true})", "/tags/more/init", "a number (LREAL)"},
        {"/tags/more", R"({"type": "TIME", "init": 5})", "/tags/more/init", "a duration"},
        {"/tags/more", R"({"type": "TIME", "init": "5"})", "/tags/more/init", "is not a duration"}}));

INSTANTIATE_TEST_SUITE_P(
    Objects, Rules,
    testing::ValuesIn(std::vector<Rule>{
        at("/technology_objects/More", "{}", "'type' is missing"),
        {"/technology_objects/More", R"({"type": "TO_Kinematics"})", "/technology_objects/More/type",
         "not yet supported"},
        {"/technology_objects/More", R"({"type": "TO_SynchronAxis"})", "/technology_objects/More/type",
         "(did you mean 'TO_SynchronousAxis'?)"},
        at(kKnife + "/points", "[]", "unknown key 'points'"),
        missing("drive", kKnife, "neither virtual"),
        {kKnife + "/config/VirtualAxis", R"({"Mode": 1})", kKnife + "/drive", "allowed is one of the two"},
        missing("model", kKnife + "/drive", "'model' is missing"),
        at(kKnife + "/drive/model", "\"real\"", "allowed: simulated"),
        at(kKnife + "/drive/time_constant", "\"11s\"", "to 10s"),
        at(kKnife + "/drive/time_constant", "\"-1ms\"", "from 0ns"),
        at(kKnife + "/drive/dead_time", "\"255ms\"", "to 254ms"),
        at(kKnife + "/drive/dead_time", "1", "a duration"),
        at(kKnife + "/drive/encoder_resolution", "-0.1", "from 0 to"),
        at(kKnife + "/drive/encoder_resolution", "\"1\"", "a number"),
        at(kKnife + "/drive/inertance", "1", "unknown key"),
        at(kKnife + "/drive/position_cycle", "\"1us\"", "to 1s"),
        at(kKnife + "/drive/sensors", "{}", "an array"),
        {kKnife + "/drive/sensors", "[{}]", kKnife + "/drive/sensors/0", "'sensor' is missing"},
        {kKnife + "/drive/sensors", R"([{"sensor": 5}])", kKnife + "/drive/sensors/0/sensor", "from 2 to 4"},
        {kKnife + "/drive/sensors", R"([{"sensor": 2}])", kKnife + "/drive/sensors/0/sensor",
         "the axis has no such encoder"},
        {kKnife + "/config/PositionControl", R"({"InitialOperativeSensor": 2})", kKnife + "/drive",
         "no such encoder"},
        at(kKnife + "/drive/start_position", "1e13", "a number from -1e+12 to 1e+12"),
        at(kKnife + "/drive/zero_marks", "[]", "an object"),
        {kKnife + "/drive/zero_marks", R"({"period": 10})", kKnife + "/drive/zero_marks",
         "'position' is missing"},
        {kKnife + "/drive/zero_marks", R"({"position": 1, "period": -1})",
         kKnife + "/drive/zero_marks/period", "from 0 to"},
        {kKnife + "/drive/zero_marks", R"({"position": "a"})", kKnife + "/drive/zero_marks/position",
         "a number"},
        at(kKnife + "/drive/reference_cam", "[1]", "two positions [from, to]"),
        at(kKnife + "/drive/reference_cam", "[2, 1]", "from is greater than to"),
        {kKnife + "/drive/reference_cam", R"([1, true])", kKnife + "/drive/reference_cam/1", "a number"},
        at(kKnife + "/drive/limit_switches", R"({"min": 5, "max": 5})", "min has to be less than max"),
        {kKnife + "/drive/limit_switches", R"({"low": 5})", kKnife + "/drive/limit_switches/low",
         "allowed: min, max"},
        at(kKnife + "/drive/digital_inputs", "{}", "an array"),
        {kKnife + "/drive/digital_inputs", R"([{"tag": "start"}])", kKnife + "/drive/digital_inputs/0",
         "'range' is missing"},
        {kKnife + "/drive/digital_inputs", R"([{"tag": "speed", "range": [0, 1]}])",
         kKnife + "/drive/digital_inputs/0/tag", "the name of a BOOL tag"},
        {kKnife + "/drive/digital_inputs", R"([{"tag": "nowhere", "range": [0, 1]}])",
         kKnife + "/drive/digital_inputs/0/tag", "nowhere"},
        at(kKnife + "/drive/quick_stop_deceleration", "-1", "from 0 to"),
        {kKnife + "/drive/plant", "{}", kKnife + "/drive/plant", "'inertia' is missing"},
        {kKnife + "/drive/plant", R"({"inertia": 0})", kKnife + "/drive/plant/inertia", "from 1e-12 to"},
        {kKnife + "/drive/plant", R"({"inertia": 1, "friction": -1})", kKnife + "/drive/plant/friction",
         "from 0 to"},
        {kKnife + "/drive/plant", R"({"inertia": 1, "maximum_torque": 0})",
         kKnife + "/drive/plant/maximum_torque", "from 1e-12 to"},
        {kKnife + "/drive/plant", R"({"inertia": 1, "mass": 1})", kKnife + "/drive/plant/mass",
         "allowed: inertia, friction"},
        {kKnife + "/drive/plant", R"({"inertia": 1, "fixed_stop": {"position": 1}})",
         kKnife + "/drive/plant/fixed_stop", "'stiffness' is missing"},
        {kKnife + "/drive/plant",
         R"({"inertia": 1, "fixed_stop": {"position": 1, "stiffness": 1, "direction": "up"}})",
         kKnife + "/drive/plant/fixed_stop/direction", "positive, negative"},
        {kKnife + "/drive/faults", R"({"drive": "speed"})", kKnife + "/drive/faults/drive",
         "the name of a BOOL tag"},
        {kKnife + "/drive/faults", R"({"encoder": 1})", kKnife + "/drive/faults/encoder", "a string"},
        {kKnife + "/drive/faults", R"({"brake": "start"})", kKnife + "/drive/faults/brake",
         "allowed: drive, encoder"},
        at(kKnife + "/drive", "true", "allowed: an object"),
        at(kConveyor + "/leading_values", R"([{"to": "Knife"}])", "allowed with: TO_SynchronousAxis"),
        at(kKnife + "/leading_values", "{}", "allowed: an array"),
        {kKnife + "/leading_values/1", "{}", kKnife + "/leading_values/1", "'to' is missing"},
        at(kKnife + "/leading_values/0/to", "\"Conveior\"", "(did you mean 'Conveyor'?)"),
        at(kKnife + "/leading_values/0/to", "\"speed\"", "is no technology object"),
        at(kKnife + "/leading_values/0/to", "\"Knife\"", "cannot follow itself"),
        at(kKnife + "/leading_values/0/to", "1", "allowed: a string"),
        {kKnife + "/leading_values/1", R"({"to": "conveyor"})", kKnife + "/leading_values/1/to", "already"},
        at(kKnife + "/leading_values/0/coupling", "\"actuel\"", "(did you mean 'actual'?)")}));

INSTANTIATE_TEST_SUITE_P(Configuration, Rules,
                         testing::ValuesIn(std::vector<Rule>{
                             at(kConfig + "/Surprise", "{}", "unknown key 'Surprise'"),
                             at(kConfig + "/modulo", R"({"Enable": true})", "(did you mean 'Modulo'?)"),
                             at(kConfig + "/Modulo/length", "10.0", "(did you mean 'Length'?)"),
                             at(kConfig + "/Modulo.Length", "10.0", "structures are nested"),
                             at(kConfig + "/Modulo", "10.0", "an object with Enable, Length, StartValue"),
                             at(kConfig + "/Modulo/Length", "{}", "a number (LREAL)"),
                             at(kConfig + "/Modulo/Length", "0", "allowed: from"),
                             at(kConfig + "/Modulo/Length", "1e13", "to 1e+12"),
                             at(kConfig + "/Modulo/Length", "\"360.0\"", "a number"),
                             at(kConfig + "/Modulo/Enable", "1", "allowed: true, false"),
                             at(kConfig + "/Properties/MotionType", "2", "allowed: 0, 1"),
                             at(kConfig + "/Properties/MotionType", "1.0", "without fraction"),
                             at(kConfig + "/Properties/MotionType", "true", "without fraction"),
                             {kConfig + "/VirtualAxis", R"({"Mode": -1})", kConfig + "/VirtualAxis/Mode",
                              "(UDINT)"},
                             at(kConfig + "/Position", "1.0", "computed by the runtime"),
                             at(kConfig + "/OperativeSensor", "1", "computed by the runtime"),
                             at(kConfig + "/ModuloCycle", "1", "computed by the runtime"),
                             at(kConfig + "/VelocitySetpoint", "1", "computed by the runtime"),
                             at(kConfig + "/StatusWord", "1", "computed by the runtime"),
                             at(kConfig + "/ErrorWord", "1", "computed by the runtime"),
                             at(kConfig + "/WarningWord", "1", "computed by the runtime"),
                             at(kConfig + "/ErrorDetail", R"({"Number": 1})", "computed by the runtime"),
                             at(kConfig + "/StatusSensor[1]", R"({"State": 1})", "computed by the runtime"),
                             {kConfig + "/Extrapolation", R"({"LeadingAxisDependentTime": 1})",
                              kConfig + "/Extrapolation/LeadingAxisDependentTime", "computed by the runtime"},
                             at(kConfig + "/Sensor", "{}", "'Sensor[1]' to 'Sensor[4]'"),
                             at(kConfig + "/Sensor", "[]", "'Sensor[1]' to 'Sensor[4]'"),
                             at(kConfig + "/Sensor[0]", "{}", "unknown key 'Sensor[0]'"),
                             at(kConfig + "/Sensor[5]", "{}", "'Sensor[1]' to 'Sensor[4]'"),
                             at(kConfig + "/Sensor[01]", "{}", "unknown key"),
                             at(kConfig + "/Sensor[-1]", "{}", "unknown key"),
                             at(kConfig + "/Sensor[99999999999999999999]", "{}", "unknown key"),
                             at(kConfig + "/Modulo[1]", "{}", "'Modulo' is no array"),
                             {kConfig + "/Sensor[1]", R"({"Parameter": {"Resolution": 0}})",
                              kConfig + "/Sensor[1]/Parameter/Resolution", "allowed: from"},
                             {kConfig + "/PositionLimits_SW", R"({"MinPosition": 5, "MaxPosition": 5})",
                              kConfig + "/PositionLimits_SW", "less than MaxPosition"},
                             {kConfig + "/PositionLimits_HW", R"({"MinSwitchAddress": 4})",
                              kConfig + "/PositionLimits_HW/MinSwitchAddress", "the name of a BOOL tag"},
                             {kConfig + "/PositionLimits_HW", R"({"MinSwitchAddress": "speed"})",
                              kConfig + "/PositionLimits_HW/MinSwitchAddress", "the name of a BOOL tag"},
                             {kConfig + "/PositionLimits_HW", R"({"MinSwitchAddress": "power_c.Status"})",
                              kConfig + "/PositionLimits_HW/MinSwitchAddress", "the name of a BOOL tag"},
                             {kConfig + "/PositionLimits_HW", R"({"MinSwitchAddress": "sinced"})",
                              kConfig + "/PositionLimits_HW/MinSwitchAddress", "(did you mean 'synced'?)"}}));

INSTANTIATE_TEST_SUITE_P(
    Programs, Rules,
    testing::ValuesIn(std::vector<Rule>{
        missing("ob", "/programs/0", "'ob' is missing"),
        {"/programs/1", R"({"name": "p", "ob": "MC_PreServo"})", "/programs/1", "'calls' is missing"},
        missing("name", "/programs/0", "'name' is missing"),
        missing("cycle", "/programs/0", "'cycle' is missing"),
        at("/programs/0/ob", "\"OB1\"", "MC_PreServo, MC_PostServo, MC_PreInterpolator, Cyclic, Main"),
        at("/programs/0/ob", "\"main\"", "(did you mean 'Main'?)"),
        at("/programs/0/cycle", "\"10.5ms\"", "whole multiple of servo_cycle"),
        at("/programs/0/cycle", "\"0s\"", "from 1ns"),
        at("/programs/0/cycle", "\"25h\"", "to 24h"),
        at("/programs/0/cycle", "10", "a duration"),
        at("/programs/0/priority", "3", "allowed with: Cyclic"),
        {"/programs/1", R"({"name": "p", "ob": "MC_PreServo", "cycle": "1ms", "calls": []})",
         "/programs/1/cycle", "has no cycle"},
        {"/programs/1", R"({"name": "p", "ob": "Cyclic", "calls": []})", "/programs/1", "'cycle' is missing"},
        {"/programs/1", R"({"name": "p", "ob": "Cyclic", "cycle": "2ms", "priority": 0, "calls": []})",
         "/programs/1/priority", "from 1 to 26"},
        {"/programs/1", R"({"name": "p", "ob": "Cyclic", "cycle": "2ms", "priority": 27, "calls": []})",
         "/programs/1/priority", "from 1 to 26"},
        {"/programs/1", R"({"name": "TO", "ob": "MC_PreServo", "calls": []})", "/programs/1/name", "keyword"},
        at("/programs/1", "[]", "allowed: an object"),
        at("/programs/0/start", "1", "unknown key"),
        at(kNew, "{}", "one of the keys 'fb', 'set', 'set_start', 'if' is missing"),
        at(kNew, "3", "allowed: an object"),
        at(kNew, R"({"call": "MC_Power"})", "one of the keys")}));

INSTANTIATE_TEST_SUITE_P(
    Calls, Rules,
    testing::ValuesIn(std::vector<Rule>{
        at(kCalls + "/4/fb", "\"MC_GearInPoss\"", "(did you mean 'MC_GearInPos'?)"),
        at(kCalls + "/3/fb", "\"mc_movevelocity\"", "(did you mean 'MC_MoveVelocity'?)"),
        at(kCalls + "/3/fb", "5", "allowed: a string"),
        {kNew, R"({"fb": "R_TRIG"})", kNew, "'name' is missing"},
        {kNew, R"({"fb": "R_TRIG", "name": 5})", kNew + "/name", "allowed: a string"},
        {kNew, R"({"fb": "R_TRIG", "name": "edge", "out": {}})", kNew + "/out", "unknown key 'out'"},
        {kNew, R"({"fb": "R_TRIG", "name": "edge", "set": "speed"})", kNew + "/set", "unknown key 'set'"},
        {kNew, R"({"fb": "R_TRIG", "name": "edge", "in": []})", kNew + "/in", "allowed: an object"},
        at(kGear + "/Ratio", "3", "has no input 'Ratio'"),
        at(kGear + "/ratioNumerator", "3", "(did you mean 'RatioNumerator'?)"),
        at(kGear + "/InSync", "true", "is an output of MC_GearInPos; it is read as gear.InSync"),
        missing("Slave", kGear, "'Slave' is missing"),
        {kNew, R"({"fb": "MC_Power", "name": "p"})", kNew, "'Axis' is missing"},
        at(kGear + "/Slave", "\"Conveyor\"", "is a TO_PositioningAxis; allowed: TO_SynchronousAxis"),
        at(kGear + "/Slave", "\"Knive\"", "(did you mean 'Knife'?)"),
        at(kGear + "/Slave", "\"speed\"", "is no technology object"),
        at(kGear + "/Slave", "\"Knife.Position\"", "there is no technology object"),
        at(kGear + "/Slave", "2", "the name of a technology object"),
        at(kGear + "/RatioNumerator", "1.5", "without fraction"),
        at(kGear + "/RatioNumerator", "3000000000", "(DINT)"),
        at(kGear + "/RatioNumerator", "true", "(DINT)"),
        at(kGear + "/RatioNumerator", "null", "null"),
        at(kGear + "/RatioNumerator", "\"1.5\"", "DINT"),
        at(kGear + "/RatioNumerator", "\"speed\"", "LREAL"),
        at(kGear + "/Execute", "1", "allowed: true, false"),
        at(kGear + "/Execute", "\"speed\"", "BOOL"),
        at(kGear + "/Execute", "\"start AND\"", "found where a value is expected"),
        at(kGear + "/Execute", "\"\"", "the expression is empty"),
        at(kGear + "/Execute", "\"home_k.Don\"", "has no pin 'Don' (did you mean 'Done'?)"),
        at(kGear + "/Execute", "\"home_k\"", "one of its pins has to follow"),
        at(kGear + "/Execute", "\"home_k.Axis\"", "takes a technology object and has no value"),
        at(kGear + "/Execute", "\"stort\"", "unknown name 'stort' (did you mean 'start'?)"),
        at(kGear + "/Execute", "\"Knife\"", "one of its variables has to follow"),
        at(kGear + "/Execute", "\"Knife.Pos > 0.0\"", "has no variable 'Pos'"),
        at(kGear + "/Execute", "\"Knife.StatusWord.X32\"", "X3"),
        at(kGear + "/Execute", "\"start.X0\"", "BOOL")}));

INSTANTIATE_TEST_SUITE_P(
    Assignments, Rules,
    testing::ValuesIn(std::vector<Rule>{
        {kNew, R"({"set": "synced"})", kNew, "'to' is missing"},
        {kNew, R"({"set": 3, "to": 1})", kNew + "/set", "allowed: a string"},
        {kNew, R"({"set": "sinced", "to": true})", kNew + "/set", "(did you mean 'synced'?)"},
        {kNew, R"({"set": "synced", "to": 1})", kNew + "/to", "allowed: true, false"},
        {kNew, R"({"set": "speed", "to": "start"})", kNew + "/to", "BOOL"},
        {kNew, R"({"set": "speed", "to": {}})", kNew + "/to", "an object is not allowed"},
        {kNew, R"({"set": "speed.X1", "to": true})", kNew + "/set", "has no bits"},
        {kNew, R"({"set": "speed.foo", "to": true})", kNew + "/set", "has no part 'foo'"},
        {kNew, R"({"set": "speed.", "to": true})", kNew + "/set", "has to follow the point"},
        {kNew, R"({"set": "run.Velocity", "to": 1})", kNew + "/set", "a pin cannot be written"},
        {kNew, R"({"set": "Knife.Position", "to": 1})", kNew + "/set", "computed by the runtime"},
        {kNew, R"({"set": "Knife.StatusWord.X1", "to": true})", kNew + "/set", "computed by the runtime"},
        {kNew, R"({"set": "Knife.Modulo.Length", "to": 1})", kNew + "/set",
         "restart of the technology object (RES)"},
        {kNew, R"({"set": "Knife.VirtualAxis.Mode", "to": 1})", kNew + "/set", "read-only at run time (RON)"},
        {kNew, R"({"set": "Knife.Override.Velocity", "to": true})", kNew + "/to", "a number (LREAL)"},
        {kNew, R"({"if": "start"})", kNew, "'then' is missing"},
        {kNew, R"({"if": "speed", "then": []})", kNew + "/if", "BOOL"},
        {kNew, R"({"if": 1, "then": []})", kNew + "/if", "allowed: true, false"},
        {kNew, R"({"if": true, "then": {}})", kNew + "/then", "allowed: an array"},
        {kNew, R"({"if": true, "then": [], "elsif": []})", kNew + "/elsif", "unknown key 'elsif'"},
        {kNew, R"({"if": true, "then": [{"if": true, "then": [], "else": [{"set": "speed", "to": true}]}]})",
         kNew + "/then/0/else/0/to", "a number (LREAL)"}}));

INSTANTIATE_TEST_SUITE_P(
    Stimuli, Rules,
    testing::ValuesIn(std::vector<Rule>{
        missing("at", "/stimuli/0", "'at' is missing"), missing("set", "/stimuli/0", "'set' is missing"),
        at("/stimuli/0/at", "0.5", "a duration"), at("/stimuli/0/at", "\"-1s\"", "from 0ns"),
        at("/stimuli/0/set", "[]", "allowed: an object"), at("/stimuli/0/set/start", "1", "true, false"),
        at("/stimuli/0/set/stert", "true", "(did you mean 'start'?)"),
        at("/stimuli/0/set/gear.Execute", "true", "is no tag"),
        at("/stimuli/0/set/Knife.Override.Velocity", "50.0", "is no tag"),
        at("/stimuli/0/set/speed", "\"start\"", "only constants can stand here"),
        at("/stimuli/0/wait", "1", "unknown key"), at("/stimuli/1", "1", "allowed: an object")}));

INSTANTIATE_TEST_SUITE_P(
    Modbus, Rules,
    testing::ValuesIn(std::vector<Rule>{
        at("/modbus/client", "{}", "unknown key 'client'"),
        at("/modbus/server", "1", "allowed: an object"),
        missing("listen", "/modbus/server", "'listen' is missing"),
        at("/modbus/server/listen", "\"localhost\"", "is not HOST:PORT"),
        at("/modbus/server/listen", "\"a:70000\"", "a port from 0 to 65535"),
        at("/modbus/server/listen", "502", "allowed: a string"),
        at("/modbus/map", "{}", "allowed: an array"),
        missing("tag", "/modbus/map/0", "'tag' is missing"),
        missing("table", "/modbus/map/0", "'table' is missing"),
        missing("address", "/modbus/map/0", "'address' is missing"),
        at("/modbus/map/0/tag", "\"strt\"", "(did you mean 'start'?)"),
        at("/modbus/map/0/table", "\"coils\"", "(did you mean 'coil'?)"),
        at("/modbus/map/0/address", "65536", "from 0 to 65535"),
        at("/modbus/map/0/address", "-1", "from 0 to 65535"),
        at("/modbus/map/1/type", "\"FLOAT\"", "unknown type 'FLOAT'; allowed: LREAL, REAL"),
        at("/modbus/map/1/type", "\"INT\"", "allowed: LREAL, REAL"),
        at("/modbus/map/1/word_order", "\"middle\"", "allowed: big, little"),
        at("/modbus/map/1/access", "\"rw\"", "allowed: read, write"),
        at("/modbus/map/1/unit", "1", "unknown key"),
        {"/modbus/map/1/table", "\"coil\"", "/modbus/map/1/table", "does not fit the one bit"},
        at("/modbus/map/3/access", "\"write\"", "computed by the runtime"),
        at("/modbus/map/2/access", "\"write\"", "allowed: coil, holding_register"),
        {kMap, R"({"tag": "gear.Execute", "table": "coil", "address": 9, "access": "write"})",
         kMap + "/access", "a pin cannot be written"},
        {kMap,
         R"({"tag": "Knife.Modulo.Length", "table": "holding_register", "address": 100, "access": "write"})",
         kMap + "/access", "(RES)"},
        {kMap, R"({"tag": "synced", "table": "coil", "address": 0})", kMap + "/address",
         "is taken by entry 0"},
        {kMap, R"({"tag": "speed", "table": "holding_register", "address": 7})", kMap + "/address",
         "is taken by entry 1"},
        {kMap, R"({"tag": "speed", "table": "holding_register", "address": 65533})", kMap + "/address",
         "beyond 65535"},
        at("/modbus/server/listen", "[]", "nowhere to listen"),
        at("/modbus/server/allow", "[]", "lets nobody in"),
        at("/modbus/server/allow", "\"10.0.0.0/8\"", "allowed: an array"),
        {"/modbus/server/allow", R"(["10.0.0.0/8", "10.0.0.1/8"])", "/modbus/server/allow/1",
         "bits behind the prefix"},
        {"/modbus/server/listen", R"(["127.0.0.1:1", "[::1]:1", "127.0.0.1:1"])", "/modbus/server/listen/2",
         "is there twice"},
        at("/modbus/server/max_clients", "0", "from 1 to 1000"),
        at("/modbus/server/max_requests_per_second", "0", "from 1 to"),
        at("/modbus/server/idle_timeout", "\"0s\"", "from 1s to 24h"),
        at("/modbus/server/map", "{}", "allowed: an array"),
        {"/modbus/server", R"([{"listen": "127.0.0.1:1"}, {}])", "/modbus/server/1", "'listen' is missing"},
        {"/modbus/server", R"([{"listen": "127.0.0.1:1"}, {"listen": ["[::1]:1", "127.0.0.1:1"]}])",
         "/modbus/server/1/listen", "server 0 listens at 127.0.0.1:1 already"},
        {"/modbus/units", R"([{"unit": 256, "map": []}])", "/modbus/units/0/unit", "from 0 to 255"},
        {"/modbus/units", R"([{"unit": 1, "map": []}, {"unit": 1, "map": []}])", "/modbus/units/1/unit",
         "is there twice"},
        {"/modbus/units", R"([{"unit": 1, "map": [{"tag": "strt", "table": "coil", "address": 0}]}])",
         "/modbus/units/0/map/0/tag", "(did you mean 'start'?)"},
        {kMap, R"({"diagnostic": "tick", "table": "input_register", "address": 100})", kMap + "/diagnostic",
         "(did you mean 'ticks'?)"},
        {kMap, R"({"diagnostic": "ticks", "tag": "start", "table": "coil", "address": 100})",
         kMap + "/diagnostic", "one of the two"},
        {kMap, R"({"diagnostic": "ticks", "table": "holding_register", "address": 100, "access": "write"})",
         kMap + "/access", "cannot be written"},
        {kMap, R"({"diagnostic": "clients", "table": "coil", "address": 100})", kMap + "/table",
         "does not fit the one bit"},
        {kMap, R"({"tag": "start", "table": "holding_register", "address": 100, "bit": 16})", kMap + "/bit",
         "from 0 to 15"},
        {kMap, R"({"tag": "speed", "table": "holding_register", "address": 100, "bit": 1})", kMap + "/bit",
         "only a BOOL"},
        {kMap, R"({"tag": "speed", "table": "holding_register", "address": 100, "scale": 0.1})", kMap,
         "'type' is missing"},
        {kMap, R"({"tag": "speed", "table": "holding_register", "address": 100, "type": "INT", "scale": 0})",
         kMap + "/scale", "scale of 0"},
        {kMap, R"({"tag": "speed", "table": "holding_register", "address": 100, "type": "REAL", "scale": 2})",
         kMap + "/type", "a scaled value of type LREAL cannot go as REAL"},
        {kMap, R"({"tag": "start", "table": "holding_register", "address": 100, "type": "INT", "scale": 2})",
         kMap + "/scale", "cannot be scaled"},
        {kMap, R"({"tag": "speed", "table": "holding_register", "address": 100, "byte_order": "middle"})",
         kMap + "/byte_order", "allowed: big, little"},
        {kMap, R"({"tag": "gear.Slave", "table": "coil", "address": 9})", kMap + "/tag", "has no value"},
        {kMap, R"({"tag": "gear", "table": "coil", "address": 9})", kMap + "/tag", "one of its pins"}}));

INSTANTIATE_TEST_SUITE_P(Audit, Rules,
                         testing::ValuesIn(std::vector<Rule>{
                             at("/audit", "1", "allowed: an object"),
                             {"/audit", "{}", "/audit", "'file' is missing"},
                             {"/audit", R"({"file": ""})", "/audit/file", ""},
                             {"/audit", R"({"file": "a", "size": 100})", "/audit/size", "from 4096 to"},
                             {"/audit", R"({"file": "a", "files": 1})", "/audit/files", "from 2 to 1000"},
                             {"/audit", R"({"file": "a", "keep": 1})", "/audit/keep", "unknown key"}}));

const std::string kLine = R"({"serial": {"device": "/dev/ttyS0")";
const std::string kDevices = R"({"connect": "10.0.0.5:502", "devices": [{"name": "meter", "cycle": "1s")";

INSTANTIATE_TEST_SUITE_P(
    ModbusLines, Rules,
    testing::ValuesIn(std::vector<Rule>{
        {"/modbus/server", R"({"serial": {}})", "/modbus/server/serial", "'device' is missing"},
        {"/modbus/server", kLine + R"(, "baud": 9601}})", "/modbus/server/serial/baud", "9600, 19200"},
        {"/modbus/server", kLine + R"(, "parity": "mark"}})", "/modbus/server/serial/parity",
         "allowed: none, even, odd"},
        {"/modbus/server", kLine + R"(, "stop_bits": 3}})", "/modbus/server/serial/stop_bits", "from 1 to 2"},
        {"/modbus/server", kLine + R"(, "silence": "2s"}})", "/modbus/server/serial/silence",
         "from 100us to 1s"},
        {"/modbus/server", kLine + R"(}, "unit": 248})", "/modbus/server/unit", "from 1 to 247"},
        {"/modbus/server", kLine + R"(}, "listen": "127.0.0.1:1"})", "/modbus/server/listen",
         "a server has it or 'serial'"},
        {"/modbus/server", "[" + kLine + "}}, " + kLine + "}}]", "/modbus/server/1/serial/device",
         "'/dev/ttyS0' is the line of another server or client already"},
        at("/modbus/server/unit", "1", "allowed with 'serial' only")}));

INSTANTIATE_TEST_SUITE_P(
    ModbusClients, Rules,
    testing::ValuesIn(std::vector<Rule>{
        at("/modbus/clients", "{}", "allowed: an array"),
        {"/modbus/clients",
         R"([{"serial": {"device": "/dev/ttyS0"}, "devices": []},
             {"serial": {"device": "/dev/ttyS0"}, "devices": []}])",
         "/modbus/clients/1/serial/device", "each line is allowed once"},
        {"/modbus/clients", R"([{"devices": []}])", "/modbus/clients/0",
         "one of the keys 'connect', 'serial'"},
        {"/modbus/clients", R"([{"connect": "10.0.0.5:502"}])", "/modbus/clients/0", "'devices' is missing"},
        {"/modbus/clients", R"([{"connect": "10.0.0.5:0", "devices": []}])", "/modbus/clients/0/connect",
         "from 1 to 65535"},
        {"/modbus/clients", R"([{"connect": "10.0.0.5:502", "timeout": "2min", "devices": []}])",
         "/modbus/clients/0/timeout", "from 1ms to 1min"},
        {"/modbus/clients", R"([{"connect": "10.0.0.5:502", "devices": [{"name": "meter"}]}])",
         "/modbus/clients/0/devices/0", "'cycle' is missing"},
        {"/modbus/clients", "[" + kDevices + R"(, "unit": 250}]}])", "/modbus/clients/0/devices/0/unit",
         "from 0 to 247, 255"},
        {"/modbus/clients", "[" + kDevices + R"(, "quality": "speed"}]}])",
         "/modbus/clients/0/devices/0/quality", "no tag of type BOOL"},
        {"/modbus/clients", "[" + kDevices + R"(, "age": "speed"}]}])", "/modbus/clients/0/devices/0/age",
         "no tag of type TIME"},
        {"/modbus/clients",
         "[" + kDevices + R"(, "read": [{"tag": "gear.InSync", "table": "coil", "address": 0}]}]}])",
         "/modbus/clients/0/devices/0/read/0/tag", "a pin cannot be written"},
        {"/modbus/clients",
         "[" + kDevices + R"(, "read": [{"tag": "speed", "table": "coil", "address": 0}]}]}])",
         "/modbus/clients/0/devices/0/read/0/table", "does not fit the one bit"},
        {"/modbus/clients",
         "[" + kDevices + R"(, "write": [{"tag": "start", "table": "discrete_input", "address": 0}]}]}])",
         "/modbus/clients/0/devices/0/write/0/table", "allowed: coil, holding_register"},
        {"/modbus/clients",
         "[" + kDevices +
             R"(, "read": [{"tag": "start", "table": "coil", "address": 0, "access": "read"}]}]}])",
         "/modbus/clients/0/devices/0/read/0/access", "unknown key"}}));

INSTANTIATE_TEST_SUITE_P(
    Trace, Rules,
    testing::ValuesIn(std::vector<Rule>{
        at("/trace/csv", "1", "unknown key"), at("/trace/lcm", "\"x\"", "allowed: an object"),
        missing("url", "/trace/lcm", "'url' is missing"),
        missing("channel", "/trace/lcm", "'channel' is missing"),
        at("/trace/lcm/url", "\"http://x\"", "no address of an LCM network"),
        at("/trace/lcm/channel", "\"\"", "allowed: a text"),
        at("/trace/lcm/channel", "\"" + std::string(57, 'C') + "\"", "allowed: a text of 1 to 56 bytes"),
        at("/trace/lcm/commands", "true", "allowed: an object"),
        at("/trace/signals", "{}", "allowed: an array"), at("/trace/signals/4", "1", "allowed: a string"),
        at("/trace/signals/4", "\"Knife.Positon\"", "(did you mean 'Position'?)"),
        at("/trace/signals/4", "\"Knife.StatusWord.X32\"", "X0 to X31"),
        at("/trace/signals/4", "\"Knife.Position.X1\"", "has no bits"),
        at("/trace/signals/4", "\"knife.position\"", "is there twice"),
        at("/trace/signals/4", "\"Knife.Sensor[5].Type\"", "has no variable"),
        at("/trace/signals/4", "\"Knife.PositionLimits_HW.MinSwitchAddress\"", "has no value"),
        at("/trace/signals/4", "\"\"", "unknown name ''"),
        at("/trace/signals/4", "\".\"", "unknown name ''")}));

INSTANTIATE_TEST_SUITE_P(
    Looks, Warnings,
    testing::ValuesIn(std::vector<Rule>{
        Rule{kGear + "/SyncProfileReference", "7", kGear + "/SyncProfileReference", "allowed: 0, 1, 3"},
        Rule{kGear + "/SyncProfileReference", "\"3 + 4\"", kGear + "/SyncProfileReference",
             "7 is not permitted"},
        Rule{kGear + "/RatioNumerator", "0", kGear + "/RatioNumerator", "without 0"},
        Rule{kGear + "/MasterStartDistance", "\"1.0 / 0.0\"", kGear + "/MasterStartDistance",
             "inf is not permitted"},
        Rule{kGear + "/Master", "\"Knife\"", kGear + "/Master", "not among the leading_values of 'Knife'"},
        Rule{"/modbus/clients", "[" + kDevices + R"(, "quality": "synced"}, {"name": "other", "cycle": "1s",
               "quality": "synced"}]}])",
             "/modbus/clients/0/devices/1/quality", "'synced' is filled from several places"},
        Rule{"/modbus/clients",
             "[" + kDevices + R"(, "read": [{"tag": "speed", "table": "input_register", "address": 0},
               {"tag": "speed", "table": "input_register", "address": 8}]}]}])",
             "/modbus/clients/0/devices/0/read/1/tag", "'speed' is filled from several places"},
        Rule{"/modbus/server/listen", "\"0.0.0.0:1502\"", "/modbus/server/listen", "'allow' says"},
        Rule{"/tags/spare", R"({"type": "BOOL"})", "/tags/spare", "nothing uses the tag 'spare'"},
        Rule{"/technology_objects/Spare",
             R"({"type": "TO_PositioningAxis", "config": {"VirtualAxis": {"Mode": 1}}})",
             "/technology_objects/Spare", "nothing uses the technology object 'Spare'"},
        Rule{kNew, R"({"set": "Knife.Override.Velocity", "to": 300})", kNew + "/to",
             "allowed: from 0 to 200"},
        Rule{kNew, R"({"set": "speed", "to": "1 / 2"})", kNew + "/to", "integer division truncates"},
        Rule{kConfig + "/Actor", R"({"Type": 0})", kConfig + "/Actor/Type", "no effect yet"}}));

TEST(ModbusServers, ThatDoNotSayWhereTheyAreAreEachToldOf) {
  const LoadedProject loaded = load_project(changed("/modbus/server", "[{}, {}]"));
  ASSERT_EQ(loaded.problems.size(), 2u) << lines(loaded.problems);
  EXPECT_EQ(loaded.problems[0].place, "/modbus/server/0");
  EXPECT_EQ(loaded.problems[1].place, "/modbus/server/1");
}

}  // namespace
}  // namespace lockstep::project_rules_test
