// What the loader refuses of a LinMot controller, with place and text.
#include <algorithm>

#include "projects/loader/project.hpp"
#include "tests/projects/linmot/linmot_run.hpp"
#include "tests/support/directory.hpp"

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
      {"/config/Drives/Drive A/Type", "Magnet", "/config/Drives/Drive A", "'Magnet' are not built yet"},
      {"/config/Drives/Drive A/Type", "Sin/Cos Position Sensor", "/config/Drives/Drive A",
       "allowed: linear motors"},
      {"/config/Drives/Drive A/Advanced/Master ~1 Booster", "Gantry Slave parallel",
       "/config/Drives/Drive A/Advanced/Master ~1 Booster", "needs a master before it (E0008)"},
      {"/config/Drives/Drive B/Advanced/Master ~1 Booster", "Booster parallel",
       "/config/Drives/Drive B/Advanced/Master ~1 Booster", "is not built yet; allowed: Master"},
      {"/config/Drives/Drive D/Advanced/Position Sensor", "External 5um",
       "/config/Drives/Drive D/Advanced/Position Sensor", "no sensor for D (E000A)"},
      {"/config/Drives/Drive A/Advanced/Position Sensor", "AB Enc1 4X",
       "/config/Drives/Drive A/Advanced/Position Sensor", "allowed: Internal Sensor"},
      {"/config/Drives/Drive A/Initialization/Init Mode", "Auto Move Up",
       "/config/Drives/Drive A/Initialization/Init Mode", "Auto Move Out"},
      {"/control_cycle", "2ms", "/control_cycle", "1 to 256 are a servo_cycle"},
      {"/control_cycle", "1us", "/control_cycle", "1 to 256 are a servo_cycle"},
      {"/motors/A/fixed_stops", Json::parse(R"([ { "position": 10.0, "stiffness": 1e9 } ])"), "",
       "0.5 √(mass / stiffness)"},
      {"/motors/A/thermal", Json{{"time_constant", "1s"}}, "/motors/A/thermal", "nominal_current"},
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
      {"/state_table/0/A", Json{{"Curve", {1.5}}}, "/state_table/0/A/Curve/0", "1.5"},
      {"/state_table/0/A", Json{{"Start Cam", {1}}}, "/state_table/0/A", "not built yet"},
      {"/state_table/0/A", Json{{"Stop", {1}}, {"Freeze", Json::array()}}, "/state_table/0/A",
       "one thing in a row"},
      {"/state_table/file", "nowhere.csv", "/state_table/file", "nowhere.csv"},
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
      {"/profibus", Json{{"modules", {"Control/Status", "Command", "Next Drive", "Command"}}},
       "/profibus/modules/3", "there already"},
      {"/profibus", Json{{"modules", {"Control/Status"}}, {"address", "7E"}}, "/profibus/address",
       "allowed: 00 to 7D"},
      {"/profibus", Json{{"modules", {"Control/Status"}}, {"preset", {{"Run Curve", 1}}}},
       "/profibus/preset/Run Curve", "no module with a value"},
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
  controller_of(project)["config"]["System"]["Command Interface"] = "PROFIBUS";
  EXPECT_NE(errors_of(project).find("E400-MT has no PROFIBUS; allowed: one with -DP"), std::string::npos);
  controller_of(project)["hardware"] = "E430-DP";
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

TEST(LinMotProject, WarnsOfMasksThatHideErrors) {
  Json project = linmot_project("1ms");
  drive_of(project)["Error Handling"]["Error Mask"]["Drive Following Error"] = false;
  EXPECT_NE(warnings_of(project).find("/Error Mask/Drive Following Error: that mask hides an error"),
            std::string::npos)
      << warnings_of(project);
}

TEST(LinMotProject, WarnsOfPositionsBeyondWhatProtocolsHave) {
  Json project = linmot_project("1ms");
  drive_of(project)["Initialization"]["Init Config"]["Home Position"] = 700.0;
  EXPECT_NE(warnings_of(project).find("outside of the positions that protocols have, ±630 mm"),
            std::string::npos)
      << warnings_of(project) << errors_of(project);
}

TEST(LinMotProject, WarnsOfPositionsOfRowsAndCurvesBeyondWhatProtocolsHave) {
  Json project = linmot_project("1ms");
  controller_of(project)["state_table"] = Json::parse(
      R"({ "0": { "A": { "Abs. Position": [631, 1, 10] } }, "1": { "A": { "Rel. Position": [-631, 1, 10] } } })");
  EXPECT_NE(warnings_of(project).find(
                "/state_table/0/A/Abs. Position/0: 631 mm lies outside of the positions that protocols have"),
            std::string::npos)
      << warnings_of(project);
  EXPECT_EQ(warnings_of(project).find("-631"), std::string::npos) << "a distance may be longer";
  controller_of(project).erase("state_table");
  for (const char* const curve : {R"({ "end": 700.0, "time": "1s" })",
                                  R"({ "parts": [ { "start": -640, "end": 0.0, "time": "1s" } ] })",
                                  R"({ "points": [[0,0],[500,630.1],[1000,0]] })"}) {
    controller_of(project)["curves"]["1"] = Json::parse(curve);
    EXPECT_NE(warnings_of(project).find("/curves/1: positions outside of those that protocols have, ±630 mm"),
              std::string::npos)
        << warnings_of(project);
  }
}

TEST(LinMotProject, RefusesRowsCurvesAndLimitsThatContradictEachOther) {
  Json project = linmot_project("1ms");
  controller_of(project)["state_table"] =
      Json::parse(R"({ "0": { "A": { "Freeze": [] } }, "00": { "A": { "Unfreeze": [] } } })");
  EXPECT_NE(errors_of(project).find("/state_table/00: row 0 is there already"), std::string::npos)
      << errors_of(project);
  project = linmot_project("1ms");
  controller_of(project)["curves"] =
      Json::parse(R"({ "1": { "end": 1, "time": "1s" }, "01": { "end": 2, "time": "1s" } })");
  EXPECT_NE(errors_of(project).find("/curves/01: curve 1 is there already"), std::string::npos)
      << errors_of(project);
  project = linmot_project("1ms");
  drive_of(project)["Set Value Generation"]["Set Value Configuration"] = {{"Minimal Position", 50.0},
                                                                          {"Maximal Position", -50.0}};
  EXPECT_NE(errors_of(project).find("/config/Drives/Drive A: Minimal Position, 50 mm, is above Maximal "
                                    "Position, -50 mm; allowed: at most that"),
            std::string::npos)
      << errors_of(project);
}

TEST(LinMotProject, WarnsOfCurvesThatTheirMotorsCannotFollow) {
  Json project = linmot_project("1ms");
  // 2.029 kg · 8 · 0.1 m / (0.05 s)² and 10 N: 659 N, and 40 N/A · 5 A.
  controller_of(project)["curves"]["1"] = Json::parse(R"({ "time": "50ms", "end": 100.0 })");
  EXPECT_EQ(warnings_of(project).find("would need"), std::string::npos);  // nobody runs it
  controller_of(project)["state_table"] = Json::parse(R"({ "0": { "A": { "Curve": [1] } } })");
  EXPECT_NE(warnings_of(project).find("/curves/1: motor A would need 659.28 N and makes 200 N with 5 A"),
            std::string::npos)
      << warnings_of(project);
  // At half of the speed it takes a quarter.
  drive_of(project)["Set Value Generation"]["Set Value Configuration"]["Curve Speed"] = 50.0;
  EXPECT_EQ(warnings_of(project).find("would need"), std::string::npos) << warnings_of(project);
}

TEST(LinMotProject, WarnsOfAStepWhereACurveBeginsAnew) {
  Json project = linmot_project("1ms");
  controller_of(project)["curves"]["1"] = Json::parse(R"({ "time": "200ms", "end": 10.0 })");
  drive_of(project)["Set Value Generation"] = {{"Run Mode", "Continuous Curve"},
                                               {"Set Value Configuration", {{"Curve Number", 1}}}};
  EXPECT_NE(warnings_of(project).find("a step of the position by -10 mm at 200 ms, where it begins anew"),
            std::string::npos)
      << warnings_of(project);
}

// ---- State tables in files

std::string errors_with_table(const std::string& csv, LinMotController* loaded = nullptr) {
  const test::Directory directory;
  std::ofstream(directory.file("table.csv")) << csv;
  Json project = linmot_project("1ms");
  controller_of(project)["curves"]["3"] = Json::parse(R"({ "time": "200ms", "end": 10.0 })");
  controller_of(project)["state_table"] = {{"file", "table.csv"}};
  std::ofstream(directory.file("project.json")) << project.dump();
  LoadedProject result = load_project_file(directory.file("project.json"));
  if (loaded != nullptr && result.project)
    for (const auto& object : result.project->controller->objects)
      if (object->kind == ObjectKind::LinMot_Controller)
        loaded->table = static_cast<LinMotController*>(object.get())->table;
  std::string text;
  for (const Problem& problem : result.problems) text += problem.place + ": " + problem.text + "\n";
  return text;
}

TEST(LinMotTable, ComesFromAFile) {
  LinMotController read("C", DB_ANY{1});
  EXPECT_EQ(
      errors_with_table("state;A\n0;Abs. Position 5, 0.5, 10\n"
                        "7;rel. position -10 mm, 0.49992 m/s, 10.0136 m/s²\r\n\n12;Curve ActPos 3\n13;\n"
                        "14;Freeze\n",
                        &read),
      "");
  const auto& rows = read.table.rows;
  EXPECT_EQ(rows[0].cells[0].command, linmot::MtCommand::absolute_position);
  EXPECT_EQ(rows[0].cells[0].arguments[2], 10.0);
  EXPECT_EQ(rows[7].cells[0].command, linmot::MtCommand::relative_position);
  EXPECT_EQ(rows[7].cells[0].arguments[0], -10.0);
  EXPECT_EQ(rows[7].cells[0].arguments[1], 0.49992);
  EXPECT_EQ(rows[12].cells[0].command, linmot::MtCommand::curve_from_demand);
  EXPECT_EQ(rows[14].cells[0].command, linmot::MtCommand::freeze);
  EXPECT_TRUE(rows[13].exists);
  EXPECT_FALSE(rows[1].exists);
}

TEST(LinMotTable, WarnsOfAPositionOfAFileBeyondWhatProtocolsHave) {
  const test::Directory directory;
  // As a spreadsheet writes it, with a byte order mark.
  std::ofstream(directory.file("table.csv")) << "\xEF\xBB\xBFstate;A\n0;Abs. Position 631, 1, 10\n";
  Json project = linmot_project("1ms");
  controller_of(project)["state_table"] = {{"file", "table.csv"}};
  std::ofstream(directory.file("project.json")) << project.dump();
  const LoadedProject result = load_project_file(directory.file("project.json"));
  EXPECT_TRUE(result.project);
  std::string text;
  for (const Problem& warning : result.warnings) text += warning.text + "\n";
  EXPECT_NE(text.find("table.csv:2: 631 mm lies outside of the positions that protocols have"),
            std::string::npos)
      << text;
}

TEST(LinMotTable, NamesTheLineOfAFileThatIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"A;B\n", "table.csv:1: allowed as the first line: state;A;B;C;D"},
      {"state;E\n", "table.csv:1: allowed as the first line"},
      {"state;A\n64;Freeze\n", "table.csv:2: '64' is no row; allowed: 0 to 63"},
      {"state;A\n0;Freeze;Freeze\n", "table.csv:2: has more cells than the first line"},
      {"state;A\n0;Frieze\n", "table.csv:2: 'Frieze' is no command with its arguments"},
      {"state;A\n0;Stop\n", "table.csv:2: Stop takes [Acceleration [m/s²]]"},
      {"state;A\n\n0;Stop x\n", "table.csv:3: 'Stop x' is no command"},
      {"state;A\n0;Stop 1000\n", "table.csv:2: 'Stop 1000': Acceleration is allowed from 0.2 to 366.2109375"},
      {"state;A\n0;Curve 1.5\n", "table.csv:2: 'Curve 1.5': Curve number"},
      {"state;A\n0;Curve 7\n", "table.csv:2: there is no curve 7"},
      {"state;A\n0;Abs. Current 1\n", "table.csv:2: Abs. Current is one of magnets"},
      {"state;A;B\n0;;Freeze\n", "table.csv:2: Drive B is 'No Drive'"},
      {"state;A;A\n0;Freeze;Unfreeze\n", "table.csv:1: allowed as the first line: state;A;B;C;D"},
      {"state;A\n0;Freeze\n1;Freeze\n0;Unfreeze\n", "table.csv:4: row 0 is there already"},
  };
  for (const auto& [csv, text] : cases) {
    const std::string errors = errors_with_table(csv);
    EXPECT_NE(errors.find("/technology_objects/C/state_table/file: "), errors.npos) << csv << errors;
    EXPECT_NE(errors.find(text), errors.npos) << csv << "\n" << errors;
  }
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
