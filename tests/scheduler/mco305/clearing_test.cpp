// What becomes of an axis when errors are cleared, beyond its limits, and when one program follows another.
#include <cmath>
#include <random>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep {
namespace clearing_test {
namespace {

/// A device of 100 qc/ms and 0.2 qc/ms², on a drive or with its set position alone.
struct Axis : DeviceRun {
  explicit Axis(bool with_drive) {
    for (const auto& [name, value] : {std::pair{"ENCODER", 500.0},
                                      {"VELMAX", 3000.0},
                                      {"RAMPMIN", 0.5},
                                      {"FFVEL", 10'486.0},
                                      {"KPROP", 300.0},
                                      {"POSERR", 30'000.0}})
      set(name, value);
    object.settings.has_drive = with_drive;
    object.settings.drive.time_constant = 0.003;
  }
  void begin_with(const std::string& text, const std::string& subprograms = "") {
    add_program("VEL 100\nACC 100\nDEC 100\n" + text + "wait:\nGOTO wait\nSUBMAINPROG\n" + subprograms +
                "ENDPROG\n");
    begin();
  }
  mco305::Device& device() { return object.device(); }
};

// ERRCLR holds the axis where it is; what it is told then, it does.
TEST(Mco305Clearing, WithoutAnErrorLetsTheDriveGoOn) {
  for (const bool drive : {false, true}) {
    Axis run(drive);
    run.begin_with("POSA 1000\nERRCLR\nPOSA 5000\na = CPOS\nDELAY 200\nb = APOS\n");
    run.run(2000);
    EXPECT_EQ(run.variable("a"), 5000);
    EXPECT_NEAR(run.variable("b"), 5000, 20) << drive;
  }
}

TEST(Mco305Clearing, LetsAnAxisGoOnThatItsErrorHasHeld) {
  for (const int reaction : {0, 1, 2, 3, 5}) {
    Axis run(true);
    run.set("ERRCOND", reaction);
    run.begin_with("ON ERROR GOSUB trouble\nn = 0\nSET 99-99 1\nDELAY 200\nPOSA 5000\nDELAY 300\nb = APOS\n",
                   "SUBPROG trouble\nn = n + 1\nDELAY 100\nERRCLR\nRETURN\n");
    run.run(3000);
    EXPECT_EQ(run.variable("n"), 1);
    EXPECT_NEAR(run.variable("b"), 5000, 20) << reaction;
  }
}

// Whatever it has been told before, in whatever order: then a drive follows where it is told to go.
TEST(Mco305Clearing, AnyCommandsLeaveADriveThatFollows) {
  constexpr unsigned kPrograms = 80;
  const char* const commands[] = {"POSA %",    "POSR %",      "CVEL 40\nCSTART", "CVEL -40\nCSTART",
                                  "CSTOP",     "MOTOR STOP",  "MOTOR OFF",       "MOTOR ON",
                                  "ERRCLR",    "CONTINUE",    "SYNCV",           "SYNCP",
                                  "SYNCM",     "DEF ORIGIN",  "SET ORIGIN %",    "RST ORIGIN",
                                  "OUTAN 400", "SET 99-99 1", "SET RAMPTYPE 2",  "MOVESYNCORIGIN %",
                                  "DEC 40",    "NOWAIT OFF",  "NOWAIT ON",       "SET SYNCPOSOFFS %"};
  for (unsigned seed = 0; seed < kPrograms; ++seed) {
    std::mt19937 random(seed);
    Axis run(true);
    run.set("POSERR", 1'000'000);
    run.set("ERRCOND", seed % 6 == 4 ? 5 : seed % 6);
    DINT turned = 0;
    run.object.master.signal = &turned;
    std::string text = "NOWAIT ON\n";
    for (int i = 0; i < 10; ++i) {
      std::string command = commands[random() % std::size(commands)];
      if (const auto at = command.find('%'); at != std::string::npos)
        command.replace(at, 1, "(" + std::to_string(static_cast<int>(random() % 20'000) - 10'000) + ")");
      text += command + "\nDELAY " + std::to_string(random() % 120) + "\n";
    }
    run.begin_with("ON ERROR GOSUB trouble\nd = 0\n" + text +
                       "MOTOR ON\nMOTOR STOP\nDELAY 1500\na = CPOS\nVEL 100\nPOSR 5000\nDELAY 1500\nb = "
                       "CPOS\nc = APOS\nd = 1\n",
                   "SUBPROG trouble\nDELAY 20\nERRCLR\nRETURN\n");
    for (int i = 0; i < 12'000 && run.variable("d") == 0; ++i) turned += 5, run.step();
    ASSERT_EQ(run.variable("d"), 1) << text;
    EXPECT_NEAR(run.variable("b") - run.variable("a"), 5000, 60) << text;
    EXPECT_NEAR(run.variable("c"), run.variable("b"), 60) << text;
  }
}

// The place of the zero for each type, from before the switch, from behind it and from within it.
TEST(Mco305Homing, FindsItsPlaceFromEverywhere) {
  constexpr double kFrom = 5000.0, kTo = 6000.0, kMarks = 2000.0;
  const auto place = [&](int type, bool forwards) {
    const bool leaves_forwards = forwards == (type >= 2);
    const double edge = leaves_forwards ? kTo : kFrom;
    if (type % 2 != 0) return edge;
    return (leaves_forwards ? std::floor(edge / kMarks) + 1.0 : std::ceil(edge / kMarks) - 1.0) * kMarks;
  };
  for (const int offset : {0, 500, -700})
    for (int type = 0; type < 4; ++type)
      for (const auto& [start, velocity] : {std::pair{0.0, 10}, {9000.0, -10}, {5500.0, 10}, {5500.0, -10}}) {
        Axis run(true);
        run.object.settings.drive.signals.start_position = start;
        run.object.settings.drive.signals.zero_marks = ZeroMarks{0.0, kMarks};
        run.object.settings.drive.signals.reference_cam = PositionRange{kFrom, kTo};
        run.set("HOME_TYPE", type);
        run.set("HOME_VEL", velocity);
        run.set("HOME_RAMP", 50);
        run.set("HOME_OFFSET", offset);
        run.set("I_FUNCTION_3", 1);
        run.begin_with("n = 0\nHOME\nDELAY 300\na = APOS\nn = 1\n");
        for (int i = 0; i < 12'000 && run.variable("n") == 0; ++i) run.step();
        ASSERT_EQ(run.variable("n"), 1) << type << " " << start << " " << velocity;
        EXPECT_NEAR(run.variable("a"), 0, 2);
        EXPECT_NEAR(run.device().machine_position(), place(type, velocity > 0) + offset, 12.0)
            << type << " " << start << " " << velocity << " " << offset;
      }
}

TEST(Mco305Limits, RefuseASpeedFurtherOut) {
  for (const bool later : {true, false}) {
    Axis run(false);
    run.object.settings.later_edition = later;
    run.set("33-42", 5000);
    run.set("33-44", 1);
    run.set("ERRCOND", 2);
    run.begin_with(
        "ON ERROR GOSUB trouble\ne = 0\nCVEL 40\nCSTART\nDELAY 1000\na = APOS\nf = e\nCSTART\nDELAY 300\nb = "
        "APOS\ng = e\nCVEL -40\nCSTART\nDELAY 200\nCVEL 40\nDELAY 600\nc = APOS\nh = e\nDELAY 500\nd = "
        "APOS\n",
        "SUBPROG trouble\ne = ERRNO\nDELAY 500\nERRCLR\nRETURN\n");
    run.run(4000);
    EXPECT_EQ(run.variable("f"), 111);
    EXPECT_GT(run.variable("a"), 5000);
    EXPECT_EQ(run.variable("g"), later ? 198 : 111) << "further out";
    EXPECT_EQ(run.variable("b"), run.variable("a"));
    // Back is allowed; a CVEL that turns round again is not.
    EXPECT_EQ(run.variable("h"), later ? 198 : 111);
    EXPECT_LT(run.variable("c"), run.variable("a"));
    EXPECT_EQ(run.variable("d"), run.variable("c"));
  }
}

TEST(Mco305Limits, RefuseAMasterThatLeadsFurtherOut) {
  Axis run(false);
  DINT turned = 0;
  run.object.master.signal = &turned;
  run.set("33-42", 5000);
  run.set("33-44", 1);
  run.set("ERRCOND", 2);
  run.begin_with(
      "ON ERROR GOSUB trouble\nn = 0\ne = 0\nSYNCP\nDELAY 1000\nf = e\na = APOS\nSYNCP\nDELAY 1000\n",
      "SUBPROG trouble\ne = ERRNO\nn = n + 1\nDELAY 300\nERRCLR\nRETURN\n");
  const auto turn = [&](int steps, int by) {
    for (int i = 0; i < steps; ++i) turned += by, run.step();
  };
  turn(980, 10);
  EXPECT_EQ(run.variable("e"), 111);
  turn(60, 0);
  turn(50, -2);
  EXPECT_EQ(run.variable("n"), 1) << "back is allowed";
  turn(100, 2);
  EXPECT_EQ(run.variable("e"), 198);
}

// 33-40 [1]: a controlled stop, whatever ERRCOND says.
TEST(Mco305Limits, AreAControlledStopWhereEndswmodSaysSo) {
  for (const int reaction : {0, 1, 2, 3, 5}) {
    Axis run(false);
    run.set("ENDSWMOD", 1);
    run.set("ERRCOND", reaction);
    run.set("I_FUNCTION_1", 5);
    run.begin_with("ON ERROR GOSUB trouble\nCVEL 40\nCSTART\n", "SUBPROG trouble\nDELAY 5000\nRETURN\n");
    run.run(500);
    const double before = run.device().set_position();
    run.device().io().set_input(1, true);
    run.run(210);
    EXPECT_EQ(run.device().set_velocity_now(), 0.0) << reaction;
    EXPECT_NEAR(run.device().set_position() - before, 40.0 * 40.0 / 0.4, 80.0) << reaction;
  }
}

// CSTOP ends the motion; CONTINUE is for what has been interrupted.
TEST(Mco305Continue, DoesNothingBehindCstop) {
  Axis run(false);
  run.begin_with(
      "CVEL 30\nCSTART\nDELAY 300\nCSTOP\nDELAY 500\na = APOS\nCONTINUE\nDELAY 300\nb = APOS\nNOWAIT "
      "ON\nPOSA "
      "100000\nDELAY 100\nCSTOP\nDELAY 500\nc = APOS\nCONTINUE\nDELAY 300\nd = APOS\n");
  run.run(3000);
  EXPECT_EQ(run.variable("b"), run.variable("a"));
  EXPECT_GT(run.variable("c"), run.variable("b"));
  EXPECT_EQ(run.variable("d"), run.variable("c"));
}

// ERRNO is one for all programs.
TEST(Mco305Programs, SeeTheErrorThatHasEndedTheOneBefore) {
  Axis run(false);
  run.set("33-42", 1000);
  run.set("33-44", 1);
  run.set("PRGPAR", 3);
  run.add_program("DELAY 50\nPOSA 5000\n");
  run.add_program(
      "a = ERRNO\nn = 0\nON ERROR GOSUB trouble\nDELAY 10\nb = ERRNO\nPOSA 500\nc = APOS\nwait:\nGOTO wait\n"
      "SUBMAINPROG\nSUBPROG trouble\nn = n + 1\nERRCLR\nRETURN\nENDPROG\n",
      3, false);
  run.begin();
  run.run(51);
  ProgramNote note;
  ASSERT_TRUE(run.object.take_note(note));
  EXPECT_EQ(note.error, 111);
  EXPECT_EQ(note.program, 0) << "not the one that has begun since";
  EXPECT_EQ(note.line, 2);
  run.run(1000);
  EXPECT_EQ(run.variable("a"), 111);
  EXPECT_EQ(run.variable("n"), 1) << "it is still there when the handler is said";
  EXPECT_EQ(run.variable("b"), 0);
  EXPECT_EQ(run.variable("c"), 500);
}

}  // namespace
}  // namespace clearing_test
}  // namespace lockstep
