// What the loader refuses of a LinMot controller, with place and text.
#include <algorithm>

#include "projects/loader/project.hpp"
#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_refusal_test {
namespace {

/// All errors of a project, each with its place.
std::string errors_of(const Json& project) {
  std::string text;
  for (const Problem& problem : load_project(project.dump()).problems)
    text += problem.place + ": " + problem.text + "\n";
  return text;
}

std::string warnings_of(const Json& project) {
  std::string text;
  for (const Problem& problem : load_project(project.dump()).warnings)
    text += problem.place + ": " + problem.text + "\n";
  return text;
}

struct Case {
  const char* pointer;  // to what is put there
  Json value;
  const char* place;
  const char* text;
};

TEST(LinMotProject, NamesWhatIsWrong) {
  const std::string c = "/technology_objects/C";
  const Case cases[] = {
      {"/hardware", "E123", "/hardware", "is no controller"},
      {"/config/System/Startup Mode/Auto Stat", true, "/config/System/Startup Mode",
       "did you mean 'Auto Start'?"},
      {"/config/System/Command Interface", "CAN", "/config/System/Command Interface", "ASCII RS232"},
      {"/config/System/Command Interface", "Application", "/config", "not described"},
      {"/config/System/Error Handling/DCLV Monitoring/Power Low Warn", 20.0, "/config/System/Error Handling",
       "read only"},
      {"/config/Drives/Drive E/Type", "No Drive", "/config/Drives", "there is no drive 'Drive E'"},
      {"/config/Drives/Drive A/Type", "Stepper", "/config/Drives/Drive A", "not built yet"},
      {"/config/Drives/Drive A/Control Parameters/P", 100.0, "/config/Drives/Drive A/Control Parameters/P",
       "76.5"},
      {"/config/Drives/Drive A/Control Parameters/Q", 1.0, "/config/Drives/Drive A/Control Parameters",
       "there is no parameter"},
      {"/motors/B", Json{{"force_constant", 40.0}, {"slider_mass", 1.0}}, "/motors/B", "'No Drive'"},
      {"/motors/E", Json{{"force_constant", 40.0}, {"slider_mass", 1.0}}, "/motors", "there is no motor 'E'"},
      {"/control_cycle", "300us", "/control_cycle", "1 to 256 are a servo_cycle"},
      {"/curves/64", Json{{"time", "1s"}}, "/curves", "allowed: 1 to 63"},
      {"/curves/1", Json{{"type", "Ramp"}}, "/curves/1/type", "Manual"},
      {"/curves/1", Json{{"type", "Sine"}, {"end", 10.0}}, "/curves/1", "makes no curve"},
      {"/curves/1", Json{{"points", {{0.0, 0.0}, {10.0, 1.0}, {10.0, 2.0}}}}, "/curves/1/points/2",
       "not behind"},
      {"/state_table/64", Json::object(), "/state_table", "allowed: 0 to 63"},
      {"/state_table/0/A", Json{{"Abs. Positon", {0, 1, 1}}}, "/state_table/0/A",
       "did you mean 'Abs. Position'?"},
      {"/state_table/0/A", Json{{"Abs. Position", {0, 1}}}, "/state_table/0/A/Abs. Position",
       "Acceleration [m/s²]"},
      {"/state_table/0/A", Json{{"Curve", {7}}}, "/state_table/0/A/Curve", "there is no curve 7"},
      {"/state_table/0/A", Json{{"Abs. Current", {1}}}, "/state_table/0/A", "magnets"},
      {"/state_table/0/B", Json{{"Stop", {1}}}, "/state_table/0", "'No Drive'"},
      {"/input_table", Json{{"0001", {"Goto state", 3}}}, "/input_table/0001/1", "there is no row 3"},
      {"/input_table", Json{{"active_inputs", "A"}, {"0010", "Goto next state"}}, "/input_table",
       "active_inputs"},
      {"/input_table", Json{{"0012", "No operation"}}, "/input_table", "is no code"},
      {"/profibus", Json{{"modules", {"Get Position"}}}, "/profibus/modules/0",
       "Control/Status is the first"},
      {"/profibus", Json{{"modules", {"Control/Status", "Set Position", "Set Position"}}},
       "/profibus/modules/2", "there already"},
      {"/profibus",
       Json{{"modules", {"Control/Status", "Next Drive", "Next Drive", "Next Drive", "Next Drive"}}},
       "/profibus/modules/4", "behind D"},
      {"/profibus", Json{{"modules", {"Control/Status", "Max. Sped"}}}, "/profibus/modules/1", "Max. Speed"},
  };
  for (const Case& one : cases) {
    Json project = linmot_project("1ms");
    controller_of(project)["curves"] = Json::object();
    controller_of(project)["state_table"] = Json::parse(R"({ "0": {} })");
    controller_of(project)[Json::json_pointer(one.pointer)] = one.value;
    const std::string errors = errors_of(project);
    EXPECT_NE(errors.find(c + one.place), errors.npos) << one.pointer << one.value << "\n" << errors;
    EXPECT_NE(errors.find(one.text), errors.npos) << one.pointer << one.value << "\n" << errors;
  }
}

TEST(LinMotProject, NeedsHardwareForWhatItIsToDo) {
  Json project = linmot_project("1ms");
  controller_of(project)["hardware"] = "E400";
  controller_of(project)["config"]["System"]["Command Interface"] = "MT";
  EXPECT_NE(errors_of(project).find("E0004"), std::string::npos);
  controller_of(project)["hardware"] = "E100-MT";
  drive_of(project, "B")["Type"] = "LinMot P0x-37";
  EXPECT_NE(errors_of(project).find("1 motors, and B is none"), std::string::npos);
  controller_of(project)["hardware"] = "E400-MT";
  EXPECT_EQ(errors_of(project), "");
}

TEST(LinMotProject, WarnsOfCurvesThatAreBad) {
  Json project = linmot_project("1ms");
  controller_of(project)["curves"]["1"]["points"] = Json::parse("[[0,0],[100,10]]");
  EXPECT_NE(warnings_of(project).find("a step of the velocity"), std::string::npos);
  Json points = Json::array();
  for (int i = 0; i < 100; ++i) points.push_back({i * 0.5, 0.001 * i});
  controller_of(project)["curves"]["1"]["points"] = points;
  EXPECT_NE(warnings_of(project).find("nearer than 1 ms"), std::string::npos);
  controller_of(project)["curves"]["1"] = Json::parse(R"({ "time": "200ms", "end": 10.0 })");
  EXPECT_EQ(warnings_of(project).find("curves"), std::string::npos);
}

TEST(LinMotProject, RefusesLinesAndCommandsThatLeadNowhere) {
  Json project = linmot_project("1ms");
  project["ascii"][0]["controllers"]["2"] = "C";
  EXPECT_NE(errors_of(project).find("allowed: 1 with RS232"), std::string::npos);
  project = linmot_project("1ms");
  project["stimuli"] = Json::parse(R"([ { "at": "1s", "ascii": { "line": 3, "send": "!GS1" } } ])");
  EXPECT_NE(errors_of(project).find("there is no line 3"), std::string::npos);
  project["stimuli"] = Json::parse(R"([ { "at": "1s" } ])");
  EXPECT_NE(errors_of(project).find("'set' is missing"), std::string::npos);
}

TEST(LinMotProject, CarriesOutCommandsThatAreStimuli) {
  Json project = linmot_project("1ms");
  project["stimuli"] = Json::parse(
      R"([ { "at": "10ms", "ascii": { "send": "!SR-1" } }, { "at": "10ms", "ascii": { "send": "!SI-1" } },
                                        { "at": "20ms", "ascii": { "send": "!GS1" } } ])");
  LinMotRun run(project);
  run.run(0.1);
  EXPECT_EQ(run.state(), linmot::State::disable);
}

TEST(LinMotProject, LetsProgramsChangeParametersThatAreLive) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  run.write("C.A.ControlParameters.P", 2.0);
  run.step();
  EXPECT_EQ(run.send("!EPA"), "#853");
  EXPECT_THROW(run.write("C.A.Initialization.InitMode", 1.0), std::out_of_range);
  EXPECT_THROW(run.write("C.A.ControlParameters.P", 1000.0), std::domain_error);
}

}  // namespace
}  // namespace lockstep::linmot_refusal_test
