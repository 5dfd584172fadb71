// The acceptance scenarios of device and language: parameters, programs and numbers are those of the file.
#include <algorithm>
#include <cmath>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep {
namespace {

TEST(Mco305Scenario, S01UserUnits) {
  const Json& scenario = mco305_scenario("S01");
  const Json& expected = scenario.at("expect").at(0).at("after_each");
  ASSERT_EQ(expected.size(), 6u);
  std::string text = joined(scenario.at("program"));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::string number = std::to_string(i);
    text += expected[i].at("program").get<std::string>() + "\nset" + number + " = SYSVAR[4097]\nactual" +
            number + " = APOS\n";
  }
  DeviceRun run;
  run.set_all(scenario.at("parameters"));
  run.add_program(text);
  run.begin();
  ASSERT_TRUE(run.run_to_end(scenario.at("duration_ms")));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(run.variable("set" + std::to_string(i)), expected[i].at("SYSVAR[4097]")) << expected[i];
    EXPECT_EQ(run.variable("actual" + std::to_string(i)), expected[i].at("APOS")) << expected[i];
  }
}

struct Jerk {
  std::vector<std::int32_t> positions;
  std::vector<int> phases;
};

// What the scenario looks at while the program runs.
Jerk watch(DeviceRun& run, int duration) {
  Jerk seen;
  for (int i = 0; i < duration && !run.object.machine().over(); ++i) {
    run.step();
    seen.positions.push_back(run.system_variable(4097));
    const int phase = run.system_variable(4275);
    if (seen.phases.empty() || seen.phases.back() != phase) seen.phases.push_back(phase);
  }
  return seen;
}

TEST(Mco305Scenario, S16LimitedJerk) {
  const Json& scenario = mco305_scenario("S16");
  DeviceRun run;
  run.set_all(scenario.at("parameters"));
  run.add_program(joined(scenario.at("program")));
  run.begin();
  const Jerk seen = watch(run, scenario.at("duration_ms"));
  ASSERT_TRUE(run.object.machine().over());
  for (const Json& one : scenario.at("expect"))
    if (one.contains("final")) {
      const double tolerance = one.at("tolerance");
      EXPECT_NEAR(run.variable(one.at("final")), one.at("value").get<double>(), tolerance);
    }
  // Set velocity, and its change over 40 ms; DEF ORIGIN jumps once.
  std::vector<double> velocity;
  for (std::size_t i = 1; i < seen.positions.size(); ++i) {
    const double v = seen.positions[i] - seen.positions[i - 1];
    velocity.push_back(std::abs(v) > 1000.0 ? velocity.back() : v);
    EXPECT_LE(std::abs(velocity.back()), 101.0);
  }
  for (std::size_t i = 40; i < velocity.size(); ++i)
    EXPECT_LE(std::abs(velocity[i] - velocity[i - 40]) / 40.0, 0.22 + 1.0 / 40.0) << i;  // whole counts
  const std::vector<int> sequence = scenario.at("expect").back().at("value");
  EXPECT_NE(std::search(seen.phases.begin(), seen.phases.end(), sequence.begin(), sequence.end()),
            seen.phases.end());
}

TEST(Mco305Scenario, S16LimitedJerkOfFourSlopes) {
  const Json& scenario = mco305_scenario("S16");
  const Json& variant = scenario.at("variants").at(0);
  DeviceRun run;
  run.set_all(scenario.at("parameters"));
  run.set_all(variant);
  run.add_program(joined(scenario.at("program")));
  run.begin();
  ASSERT_TRUE(run.run_to_end(scenario.at("duration_ms")));
  EXPECT_NEAR(run.variable("x1"), variant.at("x1").get<double>(), variant.at("tolerance").get<double>());
  EXPECT_NEAR(run.variable("t1"), variant.at("t1").get<double>(), 6.0);
}

DeviceRun& with_drive(DeviceRun& run) {
  run.object.settings.has_drive = true;
  return run;
}

TEST(Mco305Scenario, S17PositionController) {
  const Json& scenario = mco305_scenario("S17");
  DeviceRun plain;
  with_drive(plain).set_all(scenario.at("parameters"));
  plain.add_program(joined(scenario.at("program")));
  plain.begin();
  plain.run(3001);
  EXPECT_NEAR(plain.object.data.Read.TRACKERR, 5243, 60);
  EXPECT_NEAR(plain.object.data.Read.Reference, 524'288, 6000);
  std::vector<std::int64_t> raised;
  for (const Json& variant : scenario.at("variants")) {
    DeviceRun run;
    with_drive(run).set_all(scenario.at("parameters"));
    run.set_all(variant);
    run.add_program(joined(scenario.at("program")));
    run.begin();
    if (variant.contains("TRACKERR")) {
      run.run(3001);
      EXPECT_NEAR(run.object.data.Read.TRACKERR, 0, 55);
      continue;
    }
    ASSERT_TRUE(run.run_to_end(scenario.at("duration_ms")));
    EXPECT_EQ(run.object.machine().error(), variant.at("raises"));
    EXPECT_FALSE(run.object.device().controlled());
    raised.push_back(run.now());
  }
  ASSERT_EQ(raised.size(), 2u);
  EXPECT_GE(raised[1] - raised[0], 300);
  EXPECT_LE(raised[1] - raised[0], 340);
}

TEST(Mco305Scenario, S19Interrupts) {
  const Json& scenario = mco305_scenario("S19");
  DeviceRun run;
  run.set_all(scenario.at("parameters"));
  run.add_program(joined(scenario.at("program")));
  run.begin();
  std::map<std::int64_t, const Json*> points;
  for (const Json& one : scenario.at("expect")) points[one.at("at").get<std::int64_t>()] = &one;
  for (std::int64_t t = 0; t < scenario.at("duration_ms").get<std::int64_t>(); ++t) {
    for (const Json& stimulus : scenario.at("stimuli"))
      if (stimulus.at("t_ms") == t)
        run.object.device().io().set_input(stimulus.at("input").get<std::size_t>(),
                                           stimulus.at("value") == 1);
    run.step();
    const auto point = points.find(t);
    if (point == points.end()) continue;
    const Json& one = *point->second;
    EXPECT_NEAR(run.variable(one.at("signal")), one.at("value").get<int>(), one.at("tolerance").get<int>())
        << one;
  }
}

TEST(Mco305Scenario, S20Operators) {
  for (const Json& part : mco305_scenario("S20").at("expect")) {
    for (const Json& row : part.value("rows", Json::array())) {
      DeviceRun run;
      run.add_program("r = " + row.at(0).get<std::string>() + "\n");
      run.begin();
      run.run(2);
      EXPECT_EQ(run.variable("r"), row.at(1)) << row;
    }
    for (const Json& row : part.value("assignments", Json::array())) {
      std::string text = row.at(0).get<std::string>();
      std::replace(text.begin(), text.end(), ';', '\n');
      DeviceRun run;
      run.add_program("DIM f[3]\n" + text + "\nr = " + row.at(1).get<std::string>() + "\n");
      run.begin();
      run.run(2);
      EXPECT_EQ(run.variable("r"), row.at(2)) << row;
    }
  }
}

struct Provoked {
  std::string row;      ///< as the scenario names it
  std::string program;  ///< what provokes it
  std::vector<std::pair<std::string, double>> parameters{};
  bool drive = false;
  int input = 0;  ///< that rises after 100 ms
  bool fault = false, encoder_fault = false, blocked = false;
};

const std::vector<Provoked>& provoked() {
  static const std::string kThirteen = [] {
    std::string text, subs;
    for (int i = 1; i <= 13; ++i) {
      text += "ON PERIOD 1000 GOSUB s" + std::to_string(i) + "\n";
      subs += "SUBPROG s" + std::to_string(i) + "\nRETURN\n";
    }
    return text + "#" + subs;
  }();
  static const std::string kTwentyOne = [] {
    std::string text;
    for (int i = 1; i <= 21; ++i) text += "ON +APOS " + std::to_string(1000 * i) + " GOSUB s\n";
    return text + "#SUBPROG s\nRETURN\n";
  }();
  static const std::string kEleven = [] {
    std::string text;
    for (int i = 0; i <= 10; ++i) text += "ON PARAM " + std::to_string(1900 + i) + " GOSUB s\n";
    return text + "#SUBPROG s\nRETURN\n";
  }();
  // Lines behind # stand in the part of the subprograms.
  static const std::vector<Provoked> kRows = {
      {"DIM a[5]; a[6] = 1", "!DIM a[5]\n!a[6] = 1"},
      {"DIM a[5]; x = a[0]", "!DIM a[5]\n!x = a[0]"},
      {"SUBPROG r; GOSUB r (11th level)", "GOSUB r\n#SUBPROG r\nGOSUB r\nRETURN\n"},
      {"GOTO out of a SUBPROG, then RETURN",
       "GOSUB a\n#SUBPROG a\nGOTO inside\nRETURN\nSUBPROG b\ninside:\nRETURN\n"},
      {"13th ON TIME/ON PERIOD", kThirteen},
      {"21st position interrupt", kTwentyOne},
      {"11th ON PARAM", kEleven},
      {"SET of an unknown parameter", "SET 32-99 1"},
      {"33-00 = 1, POSA 100 before HOME", "POSA 100", {{"33-00", 1}}},
      {"33-03 = 0, HOME", "HOME", {{"33-03", 0}}},
      {"HOME type 0 without zero pulse", "HOME", {{"33-50", 1}, {"33-04", 0}, {"33-02", 50}}, false, 1},
      {"33-44 = 1, 33-42 = 1000, POSA 1001 (no motion)", "POSA 1001", {{"33-44", 1}, {"33-42", 1000}}},
      {"33-44 = 1, CVEL across 33-42 (controller off)", "CVEL 10\nCSTART", {{"33-44", 1}, {"33-42", 1000}}},
      {"end switch input [5]", "CVEL 10\nCSTART", {{"33-50", 5}}, false, 1},
      {"POSA while an error is not cleared", "SET ERRCOND 5\nDELAY 10"},
      {"drive fault while controlled, 33-82 = 1", "", {{"33-82", 1}}, true, 0, true},
      {"WAITNDX 100 at standstill", "WAITNDX 100"},
      {"LINKGPAR 2000 \"x\" 0 1 0", "LINKGPAR 2000 \"x\" 0 1 0"},
      {"encoder fault with 32-09 = 1", "", {{"32-09", 1}}, true, 0, false, true},
      {"drive blocked, error above 32-67", "CVEL 50\nCSTART", {{"32-67", 1000}}, true, 0, false, false, true},
      {"break input [9]", "", {{"33-50", 9}}, false, 1},
      {"SETCURVE of an array without identification 999000001", "!SETCURVE a"},
  };
  return kRows;
}

// The handler leaves what it was called with, and when.
int errno_of(const Provoked& one) {
  std::string program = one.program, subprograms, head;
  if (const std::size_t hash = program.find('#'); hash != program.npos) {
    subprograms = program.substr(hash + 1);
    program.resize(hash);
  }
  if (program.starts_with("!")) {
    head = "DIM a[5]\n";
    program = program.find("SETCURVE") != program.npos ? "SETCURVE a"
              : program.find("x = ") != program.npos   ? "i = 0\nx = a[i]"
                                                       : "i = 6\na[i] = 1";
  }
  DeviceRun run;
  run.set_all(mco305_scenario("S21").at("parameters"));
  for (const auto& [name, value] : one.parameters) run.set(name, value);
  bool drive_fault = false, encoder_fault = false, blocked = false;
  run.object.settings.has_drive = one.drive;
  run.object.settings.drive.faults.drive = &drive_fault;
  run.object.settings.drive.faults.encoder = &encoder_fault;
  run.object.settings.drive.faults.blocked = &blocked;
  run.add_program(
      head + "found = 0\nON ERROR GOSUB handler\n" + program +
      "\nwait:\nGOTO wait\nSUBMAINPROG\nSUBPROG handler\nIF (found == 0) THEN\nfound = ERRNO\nENDIF\n"
      "RETURN\n" +
      subprograms + "ENDPROG\n");
  run.begin();
  run.run(100);
  drive_fault = one.fault;
  encoder_fault = one.encoder_fault;
  blocked = one.blocked;
  if (one.input != 0) run.object.device().io().set_input(static_cast<std::size_t>(one.input), true);
  if (one.row.starts_with("HOME type 0")) {
    run.run(300);
    run.object.device().io().set_input(1, false);
  }
  run.run(4000);
  return run.variable("found");
}

TEST(Mco305Scenario, S21Errors) {
  // The arrays of two programs and a second error have a test of their own.
  const std::vector<std::string> elsewhere = {"DIM a[10] where the stored array has 12",
                                              "POSA while an error is not cleared"};
  for (const Json& row : mco305_scenario("S21").at("expect").at(0).at("rows")) {
    const auto name = row.at(0).get<std::string>();
    if (std::ranges::find(elsewhere, name) != elsewhere.end()) continue;
    const auto found = std::ranges::find(provoked(), name, &Provoked::row);
    ASSERT_NE(found, provoked().end()) << name;
    EXPECT_EQ(errno_of(*found), row.at(1)) << name;
  }
}

TEST(Mco305Scenario, S21ASecondErrorAndArraysThatDoNotFit) {
  DeviceRun waiting;
  waiting.add_program(
      "second = 0\nON ERROR GOSUB handler\nSET 32-99 1\nDELAY 5\nwait:\nGOTO wait\nSUBMAINPROG\nSUBPROG "
      "handler\n"
      "POSA 100\nERRCLR\nsecond = ERRNO\nRETURN\nENDPROG\n");
  waiting.begin();
  waiting.run(20);
  EXPECT_EQ(waiting.variable("second"), 105);
  for (const bool later : {false, true}) {
    DeviceRun arrays;
    arrays.object.settings.later_edition = later;
    arrays.set("33-80", 1);
    arrays.add_program("DIM a[12]\nx = 1\n", 0, true);
    arrays.add_program("DIM a[10]\nx = 1\n", 1, false);
    arrays.begin();
    arrays.run(10);
    EXPECT_EQ(arrays.object.machine().error(), later ? 176 : 170);
  }
}

TEST(Mco305Scenario, S22Homing) {
  const Json& scenario = mco305_scenario("S22");
  const auto home = [&](const Json& parameters, int type, double place, double tolerance) {
    DeviceRun run;
    run.object.settings.drive.signals.reference_cam = PositionRange{5000.0, 6000.0};
    run.object.settings.drive.signals.zero_marks = ZeroMarks{0.0, 4000.0};
    run.set_all(scenario.at("parameters"));
    run.set_all(parameters);
    run.set("33-04", type);
    run.add_program(joined(scenario.at("program")));
    run.begin();
    ASSERT_TRUE(run.run_to_end(scenario.at("duration_ms"))) << type;
    EXPECT_EQ(run.object.machine().state(), aposs::ProgramState::kEnded);
    EXPECT_NEAR(run.object.device().actual_units(), 0, 2) << type;
    EXPECT_NEAR(run.object.device().machine_position(), place, tolerance) << type;
  };
  for (const Json& row : scenario.at("expect").at(1).at("rows"))
    home(Json::object(), row.at(0), row.at(1), scenario.at("expect").at(1).at("tolerance"));
  const Json& variant = scenario.at("variants").at(0);
  for (const Json& row : variant.at("rows")) home(variant, row.at(0), row.at(1), variant.at("tolerance"));
}

// What happens, and when.
struct Happened {
  std::string what;
  std::int64_t at;
};

TEST(Mco305Scenario, S23Brake) {
  const Json& scenario = mco305_scenario("S23");
  DeviceRun run;
  run.set_all(scenario.at("parameters"));
  run.add_program(joined(scenario.at("program")));
  run.begin();
  run.object.steps_per_millisecond = 1;  // what follows each other is seen apart
  std::vector<Happened> seen;
  bool on = true, output = true, moving = false;
  for (int i = 0; i < scenario.at("duration_ms").get<int>(); ++i) {
    run.step();
    const auto note = [&](bool& last, bool now, const char* rises, const char* falls) {
      if (last != now) seen.push_back({now ? rises : falls, run.now()});
      last = now;
    };
    note(output, run.object.device().io().output(3), "OUT 3 = 1", "OUT 3 = 0");
    note(moving, run.object.device().moving(), "motion begins", "motion ends");
    note(on, run.object.device().controlled(), "MOTOR ON", "MOTOR OFF");
  }
  const std::vector<std::string> expected = scenario.at("expect").at(0).at("value");
  std::string all;
  for (const Happened& one : seen) all += one.what + " " + std::to_string(one.at) + ", ";
  ASSERT_EQ(seen.size(), expected.size()) << all;
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i].what, expected[i]) << i;
  EXPECT_NEAR(static_cast<double>(seen[3].at - seen[2].at), 150, 2);
  EXPECT_NEAR(static_cast<double>(seen[7].at - seen[6].at), 100, 2);
}

TEST(Mco305Scenario, S23ReactionToAnError) {
  for (const Json& variant : mco305_scenario("S23").at("variants")) {
    DeviceRun run;
    run.set_all(mco305_scenario("S23").at("parameters"));
    run.set_all(variant);
    run.add_program(
        "ON ERROR GOSUB handler\nCVEL 50\nCSTART\nwait:\nGOTO wait\nSUBMAINPROG\nSUBPROG handler\nDELAY 50\n"
        "IF (GET ERRCOND == 5) THEN\nMOTOR OFF\nENDIF\nRETURN\nENDPROG\n");
    run.begin();
    run.run(1000);
    const double before = run.object.device().set_velocity_now();
    EXPECT_GT(before, 0.0);
    run.object.device().raise(108);
    run.step();  // taken by the program
    run.step();
    const int condition = variant.at("33-83");
    EXPECT_EQ(run.object.device().controlled(), condition != 1);
    EXPECT_EQ(run.object.device().io().output(4), condition == 1);
    run.run(20);
    EXPECT_EQ(run.object.device().set_velocity_now() == before, condition == 5) << condition;
    for (int i = 0; i < 1000; ++i) {
      run.step();
      const bool braked = run.object.device().io().output(4);
      EXPECT_FALSE(braked && run.object.device().set_velocity_now() != 0.0);
    }
    EXPECT_EQ(run.object.device().io().output(4), condition != 5);
    EXPECT_FALSE(run.object.device().controlled());
  }
}

}  // namespace
}  // namespace lockstep
