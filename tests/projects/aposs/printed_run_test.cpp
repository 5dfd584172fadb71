// What the printed programs do, with the corrections that the print needs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/projects/aposs/printed_programs.hpp"
#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::aposs::printed_run_test {
namespace {

using printed_programs::corrected;
using printed_programs::Correction;

/// A printed program in a device of 100 qc/ms whose master turns.
class PrintedRun : public DeviceRun {
 public:
  explicit PrintedRun(const std::string& text) {
    for (const auto& [name, value] : {std::pair{"ENCODER", 500.0},
                                      {"MENCODER", 500.0},
                                      {"VELMAX", 3000.0},
                                      {"RAMPMIN", 0.5},
                                      {"SYNCTYPE", 1.0}})
      set(name, value);
    object.master.signal = &turned_;
    object.steps_per_millisecond = 3;  // so that what a pass begins is seen before the next one
    object.settings.drive.signals.reference_cam = PositionRange{5000.0, 6000.0};
    object.settings.markers = {.period = 4040.0};
    object.settings.master_marks = {.period = 4000.0};
    add_program(text);
  }
  void turn(int steps, int by) {
    for (int i = 0; i < steps; ++i) {
      turned_ += by;
      step();
      changes_ += object.device().following() != followed_ ? 1 : 0;
      followed_ = object.device().following();
    }
  }
  /// What has been printed since the last call.
  Lines printed() {
    Lines lines;
    for (ProgramNote note; object.take_note(note);)
      if (note.printed && note.error == 0) object.take_line(lines.emplace_back());
    return lines;
  }
  void input(std::size_t number, bool on) { object.device().io().set_input(number, on); }
  std::int32_t position() { return object.device().actual_units(); }
  bool output(std::size_t number) { return object.device().io().output(number); }
  int changes() const { return changes_; }

 private:
  DINT turned_ = 0;
  bool followed_ = false;
  int changes_ = 0;
};

// A4: as printed, SYNCV is stopped and started again while the input stays on.
TEST(AposPrintedPrograms, A4FollowsByVelocityAndStopsEverySecondPass) {
  const auto text = corrected("A4");
  if (!text) return;
  PrintedRun run(*text);
  run.begin();
  run.turn(100, 20);
  EXPECT_EQ(run.changes(), 0);
  run.input(1, true);
  run.turn(3000, 20);
  EXPECT_GE(run.changes(), 2);
  EXPECT_EQ(run.object.machine().error(), 0);
  run.input(1, false);
  run.turn(1000, 20);
  EXPECT_EQ(run.object.device().set_velocity_now(), 0.0);
  EXPECT_FALSE(run.object.device().following());
}

// A5: steps of the offset come at most every 500 ms, none before the timer has run once; GET 132 is error
// 112.
TEST(AposPrintedPrograms, A5MovesItsOffsetAtMostEvery500Milliseconds) {
  const auto text = corrected("A5");
  if (!text) return;
  PrintedRun run(*text);
  run.set("33-03", 10);
  run.set("33-04", 1);
  run.set("1900", 100);
  run.set("1901", 1);
  run.begin();
  run.input(2, true);
  run.turn(50, 0);
  run.input(2, false);
  run.turn(8000, 0);
  ASSERT_TRUE(run.output(2)) << "homed";
  run.input(1, true);
  run.turn(2000, 20);
  ASSERT_TRUE(run.object.device().following());
  EXPECT_TRUE(run.output(1)) << "accurate";
  const auto apart = [&] {
    return run.object.device().actual_units() - run.object.device().master().shown();
  };
  const std::int32_t before = apart();
  const auto press = [&](int pause) {
    run.input(4, true);
    run.turn(100, 20);
    run.input(4, false);
    run.turn(pause, 20);
  };
  press(700);
  EXPECT_NEAR(apart(), before, 1) << "no step is enabled yet";
  for (int i = 0; i < 4; ++i) press(700);
  EXPECT_NEAR(apart(), before + 400, 1);
  press(200);
  press(700);
  EXPECT_NEAR(apart(), before + 500, 1) << "the second one comes within 500 ms";
  run.input(4, false);
  run.input(1, false);
  run.turn(1000, 20);
  EXPECT_EQ(run.object.device().pending().first(), 112);
  EXPECT_TRUE(run.output(8));
  run.input(8, true);
  run.turn(100, 0);
  EXPECT_EQ(run.object.device().pending().first(), 0);
}

// A6: the mean distances of markers become SYNCMPULSS and SYNCMPULSM, and it follows by them.
TEST(AposPrintedPrograms, A6MeasuresTheDistancesOfMarkers) {
  const auto text = corrected("A6", {{"old_mipos = new_mipos", "old_ipos = new_ipos"},
                                     {"old_mipos = MIPOS", "OUT 2 1\nold_mipos = MIPOS"}});
  if (!text) return;
  std::string program = *text;
  const std::size_t second = program.rfind("WHILE (IN 2 == 1)");
  ASSERT_NE(second, program.npos);
  program.replace(second, 17, "WHILE (IN 3 == 1)");
  PrintedRun run(program);
  run.set("1900", 20);
  run.begin();
  run.input(2, true);
  run.turn(3000, 0);
  EXPECT_TRUE(run.output(2));
  run.input(2, false);
  run.turn(1000, 0);
  EXPECT_EQ(run.object.parameters()[mco305::kSyncMPulsS], 4040);
  run.input(3, true);
  run.turn(3000, 20);
  run.input(3, false);
  run.turn(10, 20);
  EXPECT_EQ(run.object.parameters()[mco305::kSyncMPulsM], 4000);
  run.input(1, true);
  run.turn(500, 20);
  EXPECT_GE(run.changes(), 1);
  EXPECT_EQ(run.object.machine().error(), 0);
}

/// Puts one text in place of another wherever it stands.
std::string replaced(std::string text, const std::string& piece, const std::string& by) {
  EXPECT_NE(text.find(piece), text.npos) << piece;
  for (std::size_t at = text.find(piece); at != text.npos; at = text.find(piece, at + by.size()))
    text.replace(at, piece.size(), by);
  return text;
}

const Correction kOnlyWhenLow = {"ELSE", "ELSEIF (IN 1 == 0) AND (flag == 1) THEN"};  // as A11 prints it

// A1: home; input 1 alone to one position, input 2 alone to the other; a limit calls the error handler.
TEST(AposPrintedPrograms, A1PositionsAbsolutely) {
  const auto text = corrected("A1");
  if (!text) return;
  PrintedRun run(*text);
  for (const auto& [name, value] : {std::pair{"33-03", 10.0},
                                    {"33-04", 1.0},
                                    {"33-44", 1.0},
                                    {"33-42", 9000.0},
                                    {"1900", 3000.0},
                                    {"1901", 8000.0}})
    run.set(name, value);
  run.begin();
  run.turn(8000, 0);
  ASSERT_EQ(run.position(), 0) << "homed";
  run.input(1, true);
  run.turn(10, 0);
  EXPECT_FALSE(run.output(1)) << "not yet there";
  run.turn(1000, 0);
  EXPECT_EQ(run.position(), 3000);
  EXPECT_TRUE(run.output(1));
  run.input(2, true);
  run.turn(500, 0);
  EXPECT_EQ(run.position(), 3000) << "both";
  run.input(1, false);
  run.turn(20, 0);
  EXPECT_FALSE(run.output(1));
  EXPECT_FALSE(run.output(2));
  run.turn(1000, 0);
  EXPECT_EQ(run.position(), 8000);
  EXPECT_TRUE(run.output(2));
  run.object.device().set_parameter(1901, 9500);
  run.turn(50, 0);
  EXPECT_TRUE(run.output(8)) << "beyond the limit";
  EXPECT_EQ(run.object.device().pending().first(), 111);
  run.input(2, false);
  run.input(8, true);
  run.turn(50, 0);
  EXPECT_FALSE(run.output(8));
  EXPECT_EQ(run.object.device().pending().first(), 0);
}

// A2: one box height a pass; as printed again and again while the input stays on, corrected once for each
// edge.
TEST(AposPrintedPrograms, A2PositionsByOneHeightAPass) {
  for (const bool once : {false, true}) {
    const auto text = corrected("A2", once ? std::vector{kOnlyWhenLow} : std::vector<Correction>{});
    if (!text) return;
    PrintedRun run(*text);
    run.set("1900", 500);
    run.begin();
    run.input(1, true);
    run.turn(1500, 0);
    if (once) {
      EXPECT_EQ(run.position(), 500);
      EXPECT_TRUE(run.output(1));
    } else {
      EXPECT_GE(run.position(), 3 * 500);
    }
    run.input(1, false);
    run.turn(300, 0);
    const std::int32_t rests = run.position();
    EXPECT_EQ(rests % 500, 0);
    run.input(1, true);
    run.turn(60, 0);
    run.input(1, false);
    run.turn(1000, 0);
    EXPECT_EQ(run.position(), rests + 500);
  }
}

// A3: from the edge of the probe on so far, and within the two milliseconds in which an interrupt comes.
TEST(AposPrintedPrograms, A3PositionsBehindATouchProbe) {
  for (const bool runs_on : {false, true}) {
    const auto text = corrected("A3", runs_on ? std::vector{kOnlyWhenLow} : std::vector<Correction>{});
    if (!text) return;
    PrintedRun run(*text);
    run.set("1900", 20'000);
    run.begin();
    run.input(1, true);
    run.turn(700, 0);
    const double velocity = run.object.device().set_velocity_now();
    if (runs_on) {
      EXPECT_EQ(velocity, 80.0);
    }
    run.input(2, true);
    const std::int32_t at = run.position();
    run.turn(1, 0);
    run.input(1, false);
    run.turn(1500, 0);
    EXPECT_GE(run.position(), at + 20'000);
    EXPECT_LE(run.position(), at + 20'000 + 2 * 80);
    if (runs_on) {
      EXPECT_GT(run.position(), at + 20'000) << "it was on its way";
    }
    EXPECT_TRUE(run.output(1));
    const std::int32_t rests = run.position();
    run.input(2, false);
    run.turn(10, 0);
    run.input(2, true);
    run.turn(500, 0);
    EXPECT_EQ(run.position(), rests) << "a second edge is nothing";
  }
}

// A11: the motor holds before the brake opens, and the brake is shut before it lets go; relay 21 for
// output 11.
TEST(AposPrintedPrograms, A11OpensAndShutsItsBrakeInOrder) {
  const auto text = corrected("A11");
  if (!text) return;
  PrintedRun run(replaced(*text, "OUT 11", "OUT 21"));
  run.set("1900", 500);
  run.set("1901", 40);
  run.set("1902", 60);
  run.begin();
  run.turn(100, 0);
  EXPECT_FALSE(run.output(21));
  EXPECT_FALSE(run.object.device().controlled()) << "shut, and then off";
  int on = -1, open = -1, moves = -1, rests = -1, shut = -1, off = -1;
  run.input(1, true);
  for (int i = 0; i < 2000; ++i) {
    if (i == 1000) run.input(1, false);
    run.turn(1, 0);
    const auto note = [i](int& when, bool now) { when = when < 0 && now ? i : when; };
    const mco305::Device& device = run.object.device();
    note(on, device.controlled());
    note(open, run.output(21));
    note(moves, device.set_velocity_now() != 0.0);
    if (moves >= 0) note(rests, device.set_velocity_now() == 0.0);
    if (open >= 0) note(shut, !run.output(21));
    if (on >= 0) note(off, !device.controlled());
  }
  EXPECT_NEAR(open - on, 60, 3);
  EXPECT_GT(moves, open);
  EXPECT_GT(rests, moves);
  EXPECT_GE(shut, 1000);
  EXPECT_NEAR(off - shut, 40, 3);
  EXPECT_EQ(run.position(), 500);
}

// A11: an error shuts the brake first.
TEST(AposPrintedPrograms, A11ShutsItsBrakeInAnError) {
  const auto text = corrected("A11");
  if (!text) return;
  PrintedRun run(replaced(*text, "OUT 11", "OUT 21"));
  run.set("1900", 100'000);
  run.begin();
  run.input(1, true);
  run.turn(300, 0);
  ASSERT_TRUE(run.output(21));
  run.object.device().raise(mco305::kPositionError);
  run.turn(5, 0);
  EXPECT_FALSE(run.output(21));
  EXPECT_TRUE(run.output(8));
  EXPECT_FALSE(run.object.device().controlled());
  run.input(8, true);
  run.turn(20, 0);
  EXPECT_FALSE(run.output(8));
  EXPECT_EQ(run.object.device().pending().first(), 0);
}

// B2: the number, the choice by it (25 is printed for 125), and the end after ten seconds.
TEST(AposPrintedPrograms, B2TellsItsErrorAndEnds) {
  for (const bool right : {false, true}) {
    const auto text = corrected(
        "B2", right ? std::vector<Correction>{{"ERRNO == 25", "ERRNO == 125"}} : std::vector<Correction>{});
    if (!text) return;
    PrintedRun run(*text);
    run.set("33-51", 3);  // input 2: negative limit
    run.begin();
    run.turn(10, 0);
    EXPECT_EQ(run.printed().size(), 2u);
    run.input(2, true);
    run.turn(20, 0);
    const Lines said = run.printed();
    ASSERT_EQ(said.size(), 3u);
    EXPECT_EQ(said[0], "Current error number: 125");
    EXPECT_EQ(said[1], right ? "HW end limit activated" : "It's o.k., although it wasn't a limit switch");
    run.input(2, false);
    run.turn(9950, 0);
    EXPECT_FALSE(run.object.machine().over());
    EXPECT_EQ(run.object.device().pending().first(), 125);
    run.turn(100, 0);
    EXPECT_TRUE(run.object.machine().over());
    EXPECT_EQ(run.object.device().pending().first(), 0);
    EXPECT_EQ(run.printed().size(), 2u);
  }
}

std::int32_t number_behind(const std::string& line, const std::string& text) {
  EXPECT_EQ(line.find(text), 0u) << line;
  return std::atoi(line.c_str() + std::min(text.size(), line.size()));
}

// B9: where the marker was, to a count, and where the interrupt saw the axis.
TEST(AposPrintedPrograms, B9LatchesThePositionOfAMarker) {
  const auto text = corrected("B9");
  if (!text) return;
  PrintedRun run(*text);
  run.object.settings.markers = {};
  run.begin();
  run.turn(300, 0);
  run.input(6, true);
  const std::int32_t at = run.position();
  run.turn(20, 0);
  const Lines said = run.printed();
  ASSERT_EQ(said.size(), 2u);
  const std::int32_t seen = number_behind(said[0], "Interrupt position:"),
                     latched = number_behind(said[1], "Triggered position:");
  EXPECT_NEAR(latched, at, 1);
  EXPECT_GE(seen, latched);
  EXPECT_LE(seen, latched + 2 * 10);
}

// B10: the same of the master.
TEST(AposPrintedPrograms, B10LatchesThePositionOfAMarkerOfTheMaster) {
  const auto text = corrected("B10");
  if (!text) return;
  PrintedRun run(*text);
  run.object.settings.master_marks = {};
  run.begin();
  run.turn(300, 10);
  run.input(5, true);
  const std::int32_t at = run.object.device().master().shown();
  run.turn(20, 10);
  const Lines said = run.printed();
  ASSERT_EQ(said.size(), 2u);
  const std::int32_t seen = number_behind(said[0], "Interrupt master position:"),
                     latched = number_behind(said[1], "Triggered master position:");
  EXPECT_NEAR(latched, at, 10) << "the edge of an input that is sampled";
  EXPECT_GE(seen, latched);
  EXPECT_LE(seen, latched + 2 * 10);
}

// B11: with NOWAIT ON the second target takes the place of the first, else they are driven one by one.
TEST(AposPrintedPrograms, B11WaitsForItsTargetsOrDoesNot) {
  const auto both = corrected("B11");
  if (!both) return;
  const std::size_t second = both->find("NOWAIT OFF");
  ASSERT_NE(second, both->npos);
  for (const bool waits : {false, true}) {
    // A velocity at which the first target takes two seconds.
    PrintedRun run("VEL 1\n" + (waits ? both->substr(second) : both->substr(0, second)) +
                   "\nend:\nGOTO end\nSUBMAINPROG\nENDPROG\n");
    run.begin();
    std::int32_t farthest = 0;
    int switched = -1;
    for (int i = 0; i < 6000; ++i) {
      run.turn(1, 0);
      farthest = std::max(farthest, run.position());
      if (switched < 0 && run.output(1)) switched = i;
    }
    EXPECT_NEAR(switched, waits ? 3000 : 1000, 20);
    EXPECT_NEAR(farthest, waits ? 2000 : 1000, 1) << "it turned where it was told to";
    EXPECT_EQ(run.position(), 1000);
  }
}

const std::string kTour =
    "\nPOSA 1000\nPOSA (-15000)\nPOSA 120000\nPOSA (-15000)\nOUT 1 1\nend:\nGOTO end\nSUBMAINPROG\n"
    "SUBPROG hitinfo\nPRINT \"info\"\nRETURN\nSUBPROG hitzero\nPRINT \"zero\"\nRETURN\n"
    "SUBPROG hitposdir\nPRINT \"posdir\"\nRETURN\nENDPROG\n";

// B13: those of positions are deleted, the input and the other subprogram stay, and a new one is taken.
TEST(AposPrintedPrograms, B13DeletesThePositionsOfASubprogram) {
  const auto text = corrected("B13", {}, kTour);
  if (!text) return;
  PrintedRun run("VEL 100\nACC 100\nDEC 100\n" + *text);
  run.begin();
  for (int i = 0; i < 20'000 && !run.output(1); ++i) run.turn(1, 0);
  ASSERT_TRUE(run.output(1));
  EXPECT_EQ(run.printed(), (Lines{"zero", "zero", "info", "zero"})) << "-0, +0, +99999, -0";
  run.input(3, true);
  run.turn(10, 0);
  EXPECT_EQ(run.printed(), Lines{"info"});
}

// B14: the second definition of a direction and a position takes the place of the first.
TEST(AposPrintedPrograms, B14ReroutesAPosition) {
  const auto text = corrected("B14", {}, kTour);
  if (!text) return;
  PrintedRun run("VEL 100\nACC 100\nDEC 100\n" + *text);
  run.begin();
  for (int i = 0; i < 20'000 && !run.output(1); ++i) run.turn(1, 0);
  ASSERT_TRUE(run.output(1));
  EXPECT_EQ(run.printed(), (Lines{"posdir", "info"})) << "+10000, and -10000 as before";
}

// B22: two motors in turn; the leads of the motors are output 1.
TEST(AposPrintedPrograms, B22TurnsTwoMotorsInTurn) {
  const auto text = corrected("B22");
  if (!text) return;
  DeviceRun run;
  for (const auto& [name, value] :
       {std::pair{"ENCODER", 500.0}, {"MENCODER", 500.0}, {"VELMAX", 3000.0}, {"RAMPMIN", 0.5}})
    run.set(name, value);
  run.add_program("POSA 3000\n" + *text);
  run.begin();
  bool led = false;
  for (int i = 0; i < 6000 && !run.object.machine().over(); ++i) {
    run.step();
    if (!run.object.device().io().output(1) || run.object.device().actual_units() != 10'000) continue;
    led = true;
    EXPECT_EQ(run.object.device().master().shown(), 3000) << "the other one rests where it was";
  }
  EXPECT_TRUE(led);
  EXPECT_TRUE(run.object.machine().over());
  EXPECT_EQ(run.object.machine().error(), 0);
  EXPECT_EQ(run.object.device().actual_units(), 0);
  EXPECT_EQ(run.object.device().master().shown(), 10'000);
  EXPECT_FALSE(run.object.device().io().output(1));
}

// B1 is a loop alone: what it calls is added, and it goes to one of two subprograms as input 3 says.
TEST(AposPrintedPrograms, B1ChoosesBetweenTwoSubprograms) {
  const auto text = corrected("B1", {},
                              "SUBMAINPROG\nSUBPROG syncprog\ns = s + 1\nDELAY 5\nRETURN\n"
                              "SUBPROG speedprog\nv = v + 1\nDELAY 5\nRETURN\nENDPROG\n");
  if (!text) return;
  PrintedRun run("s = 0\nv = 0\n" + *text);
  run.begin();
  run.turn(100, 10);
  EXPECT_EQ(run.variable("s"), 0);
  const auto passes = run.variable("v");
  EXPECT_GT(passes, 10);
  run.input(3, true);
  run.turn(100, 10);
  EXPECT_GT(run.variable("s"), 10);
  EXPECT_LE(run.variable("v"), passes + 1);
  EXPECT_EQ(run.object.machine().error(), 0);
}

// B26: three lines every ten milliseconds.
TEST(AposPrintedPrograms, B26PrintsPositionsAndTheirError) {
  const auto text = corrected("B26");
  if (!text) return;
  PrintedRun run(*text);
  run.object.steps_per_millisecond = 200;
  run.begin();
  while (run.printed().empty() && run.now() < 2000) run.turn(1, 0);
  run.turn(9, 0);
  run.printed();
  run.turn(100, 0);
  const Lines said = run.printed();
  ASSERT_EQ(said.size(), 30u);
  for (std::size_t i = 0; i < said.size(); i += 3) {
    EXPECT_EQ(said[i], "Command Position 500");
    EXPECT_EQ(said[i + 1], "Actual Position 500");
    EXPECT_EQ(said[i + 2], "Error 0");
  }
}

// B28: the brake output stays as the error has put it until OUT says otherwise.
TEST(AposPrintedPrograms, B28ReleasesItsBrakeByOut) {
  const auto text = corrected("B28", {{"// Main program loop", "OUT 4 1\nrest:\nGOTO rest"}});
  if (!text) return;
  PrintedRun run(*text);
  run.set("33-66", 6);
  run.begin();
  run.turn(10, 0);
  EXPECT_TRUE(run.output(4));
  run.object.device().raise(mco305::kPositionError);
  run.turn(500, 0);
  EXPECT_FALSE(run.output(4)) << "0 V: the brake is shut";
  EXPECT_NE(run.object.device().pending().first(), 0);
  run.input(1, true);
  run.turn(10, 0);
  EXPECT_EQ(run.object.device().pending().first(), 0);
  EXPECT_TRUE(run.output(4));
}

}  // namespace
}  // namespace lockstep::aposs::printed_run_test
