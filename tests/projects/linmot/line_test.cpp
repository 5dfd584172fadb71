// Commands of a line one after the other: which check comes first, every way to start a motion, names of
// positions, and the time that characters take.
#include <algorithm>

#include "tests/projects/linmot/linmot_run.hpp"

namespace lockstep::linmot_line_test {
namespace {

using linmot::State;

/// A motor that is where its set-point is; curve 1 ends at 30 mm, curve 2 where it has begun.
Json exact() {
  Json project = linmot_project("1ms");
  controller_of(project).erase("motors");
  controller_of(project)["curves"] = Json::parse(
      R"({ "1": { "end": 30.0, "time": "200ms" },
           "2": { "parts": [ { "end": 10.0, "time": "100ms" }, { "start": 10.0, "time": "100ms" } ] } })");
  return project;
}

// ---- Of two faults the first is told

TEST(LinMotAscii, TellsTheFirstOfTwoFaults) {
  Json project = exact();
  drive_of(project)["Set Value Generation"]["Run Mode"] = "Analog";
  controller_of(project)["config"]["System"]["IO Configuration"]["Freeze Input"] = true;
  LinMotRun analog(project);
  analog.send("!SR-1");
  analog.send("!SI-1");
  analog.step();
  ASSERT_EQ(analog.state(), State::disable);
  const std::pair<const char*, const char*> in_analog[] = {
      {"1234567890123456789012345678901234", "#E65"},   // length, form
      {"!XX11111111111111111111111111111111", "#E65"},  // length, command
      {"XX1", "#E59"},                                  // form, command
      {"!", "#E59"},
      {"!SV-A", "#E59"},   // form, sign
      {"!SR", "#E59"},     // form, sign
      {"!SRA", "#E59"},    // form, sign
      {"!GS+1", "#E59"},   // form alone
      {"!XX-9", "#E58"},   // command, sign
      {"!SV-6E", "#E60"},  // sign, addressee
      {"!SR2", "#E60"},    // sign, addressee
      {"!RC64E", "#E56"},  // addressee, range
      {"!RC64B", "#E57"},  // no drive, range
      {"!RC64A", "#E66"},  // Run Mode, state, range
      {"!SP1A", "#E66"},
      {"!MH40000A", "#E51"},  // state, range
      {"!SF+B", "#E57"},      // no drive, owner
      {"!SF+1", "#E61"},
      {"!SF+A", "#E61"},
  };
  for (const auto& [text, answer] : in_analog) EXPECT_EQ(analog.send(text), answer) << text;
  LinMotRun run(exact());
  run.send("!SR-1");
  run.send("!SI-1");
  run.step();
  EXPECT_EQ(run.send("!RC64A"), "#E51");  // state, range, curve
  run.send("!SI+1");
  run.step();
  EXPECT_EQ(run.send("!RC64A"), "#E52");
  run.send("!SR+1");
  run.send("!SI-1");
  run.step();
  ASSERT_EQ(run.state(), State::run);
  EXPECT_EQ(run.send("!RC64A"), "#E64");  // range, curve
  EXPECT_EQ(run.send("!RC63A"), "#E62");
  EXPECT_EQ(run.send("!CC2A"), "#");
  EXPECT_EQ(run.send("!RC64A"), "#E54");  // state, range
}

// ---- Every way to start a motion

struct Start {
  const char* command;
  double end;  // [mm] from 20 mm; of a cyclic curve its lowest place
  bool cyclic = false, armed = false;
};

TEST(LinMotAscii, StartsEveryMotionAtOnceOrAtTheTrigger) {
  const Start starts[] = {{"SP2560", 50.0},
                          {"SW2560", 50.0},
                          {"IP512", 30.0},
                          {"RC1", 30.0},
                          {"RA1", 50.0},
                          {"CC2", 0.0, true},
                          {"CA2", 20.0, true},
                          {"TP2560", 50.0, false, true},
                          {"TW2560", 50.0, false, true},
                          {"TI512", 30.0, false, true},
                          {"TC1", 30.0, false, true},
                          {"TA1", 50.0, false, true},
                          {"CT2", 0.0, true, true},
                          {"CB2", 20.0, true, true}};
  for (const Start& one : starts) {
    LinMotRun run(exact());
    run.start();
    run.send("!SP1024A");
    run.run(0.3);
    ASSERT_EQ(run.motor().SetPoint, 20.0);
    EXPECT_EQ(run.send(std::string("!") + one.command + "A"), "#") << one.command;
    if (one.armed) {
      run.run(0.3);
      EXPECT_EQ(run.motor().SetPoint, 20.0) << one.command;
      run.write("t_a", 1);
      run.run(0.05);
      run.write("t_a", 0);
      run.run(0.05);
      run.write("t_a", 1);  // once more: only the first edge counts
    }
    run.run(0.3);
    run.samples.clear();
    run.run(1.0);
    EXPECT_EQ(run.motor().CurveActive, one.cyclic) << one.command;
    double lowest = 1e9, highest = -1e9;
    for (const auto& sample : run.samples) {
      lowest = std::min(lowest, sample.setpoint);
      highest = std::max(highest, sample.setpoint);
    }
    EXPECT_NEAR(lowest, one.end, 1e-3) << one.command;
    EXPECT_NEAR(highest, one.end + (one.cyclic ? 10.0 : 0.0), 1e-3) << one.command;
    if (!one.cyclic) continue;
    EXPECT_EQ(run.send("!CS1A"), "#");
    run.run(0.3);
    EXPECT_FALSE(run.motor().CurveActive) << one.command;
    EXPECT_NEAR(run.motor().SetPoint, one.end, 1e-9) << one.command;
  }
}

TEST(LinMotAscii, GoesFromTheActualPositionWithItsVelocity) {
  // Beyond a stop at 10 mm: with SP the demand has to come back first.
  const auto leaves_after = [](const char* command) {
    Json project = linmot_project("1ms");
    controller_of(project)["motors"]["A"]["fixed_stops"] = Json::parse(
        R"([ { "position": 10.0, "direction": "positive", "stiffness": 1e6, "damping": 1500.0 } ])");
    drive_of(project)["Set Value Generation"]["Filter Parameter"]["Max Acceleration"] = 10.0;
    LinMotRun run(project);
    run.start();
    run.send("!SP1024A");
    run.run(0.5);
    const double begin = run.time();
    EXPECT_EQ(run.send(command), "#");
    while (run.motor().ActualPosition > 9.99 && run.time() < begin + 1.0) run.step();
    return run.time() - begin;
  };
  EXPECT_GT(leaves_after("!SP0A"), 0.040);
  EXPECT_LT(leaves_after("!SW0A"), 0.015);
  // In motion the limiter begins with the velocity of the slider: no step of it.
  LinMotRun run(linmot_project());
  run.start();
  run.send("!SP5120A");
  run.run(0.06);
  const double actual = run.motor().ActualVelocity, position = run.motor().ActualPosition;
  ASSERT_GT(actual, 0.5);
  run.samples.clear();
  EXPECT_EQ(run.send("!SW5120A"), "#");
  EXPECT_NEAR(run.samples.front().velocity, actual, 0.05);
  EXPECT_NEAR(run.samples.front().setpoint, position, 0.2);
}

TEST(LinMotAscii, MakesTheActualPositionTheDemand) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  run.send("!SP5120A");
  run.run(0.05);
  EXPECT_EQ(run.send("!RQA"), "#");
  EXPECT_EQ(run.motor().SetPointVelocity, 0.0);
  const double demand = run.motor().DemandPosition;
  EXPECT_LT(demand, 60.0);
  run.run(0.5);
  EXPECT_EQ(run.motor().SetPoint, demand);
  EXPECT_NEAR(run.motor().ActualPosition, demand, 0.25);
}

TEST(LinMotAscii, GivesPositionsOtherNames) {
  LinMotRun run(exact());
  run.start();
  run.send("!SP512A");
  run.run(0.3);
  EXPECT_EQ(run.send("!MH256A"), "#");  // the zero goes 5 mm out
  EXPECT_EQ(run.send("!GPA"), "#256");
  EXPECT_EQ(run.send("!GDA"), "#256");
  EXPECT_EQ(run.send("!RP-100A"), "#");
  EXPECT_EQ(run.send("!GPA"), "#-100");
  EXPECT_EQ(run.send("!ZDA"), "#");
  EXPECT_EQ(run.send("!GPA"), "#0");
  EXPECT_EQ(run.motor().SetPointVelocity, 0.0);
  EXPECT_NEAR(run.controller().motor(0).actual() + run.controller().motor(0).shift(), 10.0, 1e-9);
  run.send("!SP256A");
  run.run(0.3);
  EXPECT_NEAR(run.controller().motor(0).actual() + run.controller().motor(0).shift(), 15.0, 1e-9);
}

/// EX, as the states have it.
/// What is read as a sint16 of ±32256 is one wherever the slider is, and whatever it is called.
TEST(LinMotAscii, TellsNoPositionBeyondItsRange) {
  LinMotRun run(linmot_project("1ms"));
  run.start();
  EXPECT_EQ(run.send("!MH32000A"), "#");
  EXPECT_EQ(run.send("!GPA"), "#-32000");
  EXPECT_EQ(run.send("!MH257A"), "#E64");
  EXPECT_EQ(run.send("!MH256A"), "#");
  EXPECT_EQ(run.send("!GDA"), "#-32256");
  run.write("force", -100.0);
  run.run(1.0);
  EXPECT_LT(run.motor().ActualPosition, -630.0);
  EXPECT_EQ(run.send("!GPA"), "#-32256");
  EXPECT_EQ(run.send("!SR-1"), "#");
  run.write("force", 1000.0);
  run.run(2.0);
  EXPECT_GT(run.motor().ActualPosition, 630.0);
  EXPECT_EQ(run.send("!GPA"), "#32256");
}

TEST(LinMotAscii, ShowsEveryStateInEX) {
  LinMotRun run(linmot_project("1ms"));
  run.send("!SR-1");
  run.send("!SI-1");
  run.step();
  EXPECT_EQ(run.send("!EX1"), "#608");  // DISABLE, INIT NOT DONE, WARN
  run.send("!SI+1");
  run.step();
  EXPECT_EQ(run.send("!EX1"), "#1024");
  run.send("!SI-1");
  run.step();
  EXPECT_EQ(run.send("!EX1"), "#512");
  run.send("!SR+1");
  run.run(0.1);
  EXPECT_EQ(run.send("!EX1"), "#129");
  run.send("!SS+1");
  run.step();
  EXPECT_EQ(run.send("!EX1"), "#2080");
  run.send("!SS-1");
  run.send("!SR-1");
  run.step();
  run.write("hot", 1);
  run.run(5.1);
  EXPECT_EQ(run.send("!EX1"), "#304");  // ERROR with its warning
}

// ---- The time of 9600 baud: ten bits a character, the CR among them

TEST(LinMotAscii, TakesTheTimeOfItsCharactersWithPace) {
  constexpr double kCharacter = 10.0 / 9600.0;
  Json project = linmot_project("1ms");
  project["ascii"][0]["pace"] = true;
  project["stimuli"] = Json::parse(
      R"([ { "at": "10ms", "ascii": { "send": "!PV1" } }, { "at": "10ms", "ascii": { "send": "!PIA" } },
           { "at": "100ms", "ascii": { "send": "!GS1" } } ])");
  LinMotRun run(project);
  run.run(0.2);
  const auto& script = run.line().script;
  ASSERT_EQ(script.size(), 3u);
  // "!PV1" and CR; then the tick at or behind that; then "#2" and CR.
  const auto tick_behind = [](double time) { return std::ceil(time * 1e3 - 1e-9) * 1e-3; };
  const double first = tick_behind(0.010 + 5 * kCharacter) + 3 * kCharacter;
  EXPECT_NEAR(static_cast<double>(script[0].answered_at) * 1e-9, first, 1e-8);
  // The next one begins when that answer is there; "#19531250" and CR.
  const double second = tick_behind(first + 5 * kCharacter) + 10 * kCharacter;
  EXPECT_NEAR(static_cast<double>(script[1].answered_at) * 1e-9, second, 1e-8);
  EXPECT_NEAR(static_cast<double>(script[2].answered_at) * 1e-9,
              tick_behind(0.1 + 5 * kCharacter) + 3 * kCharacter, 1e-8);
  project["ascii"][0]["pace"] = false;
  LinMotRun at_once(project);
  at_once.run(0.2);
  EXPECT_EQ(at_once.line().script[0].answered_at, 10'000'000);
  EXPECT_EQ(at_once.line().script[1].answered_at, 11'000'000);
}

TEST(LinMotAscii, CountsTheCharactersOfItsAnswers) {
  using linmot::AsciiAnswer;
  using enum AsciiAnswer::Kind;
  const AsciiAnswer answers[] = {{done},           {error, 64},        {number, 0},
                                 {number, -32256}, {number, 19531250}, {number, -2147483647 - 1},
                                 {status, 0, 'R'}, {status, 10, 'E'},  {status, 3, 'E', 'A'}};
  for (const AsciiAnswer& answer : answers)
    EXPECT_EQ(linmot::ascii_length(answer), linmot::ascii_text(answer).size()) << linmot::ascii_text(answer);
}

}  // namespace
}  // namespace lockstep::linmot_line_test
