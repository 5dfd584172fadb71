// Waiting, errors, and going on in the middle of a line.
#include "tests/projects/aposs/program_run.hpp"
#include "tests/support/allocations.hpp"

namespace lockstep::aposs::running_test {
namespace {

TEST(AposMachine, WaitsForMotionsWithNowaitOffOnly) {
  Running off("POSA 2000\nOUT 1 1\nPOSA 1000\nOUT 2 1\n");
  off.device.busy[Command::kPosa] = 5;
  off.run(20);
  EXPECT_EQ(off.device.commands, (Lines{"0 POSA 2000", "5 OUT 1 1", "5 POSA 1000", "10 OUT 2 1"}));
  Running on("NOWAIT ON\nPOSA 2000\nOUT 1 1\nPOSA 1000\nWAITAX\nOUT 2 1\n");
  on.device.busy[Command::kPosa] = on.device.busy[Command::kWaitax] = 5;
  on.run(20);
  EXPECT_EQ(on.device.commands, (Lines{"0 POSA 2000", "0 OUT 1 1", "0 POSA 1000", "0 WAITAX", "5 OUT 2 1"}));
}

TEST(AposMachine, WaitsForHomeWithNowaitOnToo) {
  Running program("NOWAIT ON\nHOME\nOUT 1 1\n");
  program.device.busy[Command::kHome] = 3;
  program.run(10);
  EXPECT_EQ(program.device.commands, (Lines{"0 HOME", "3 OUT 1 1"}));
}

TEST(AposMachine, WaitsForTimesAndInputs) {
  Running program(
      "DELAY 5\na = TIME\nWAITT 3\nb = TIME\nWAITI 4 ON\nc = TIME\nWAITI 4 OFF\nd = TIME\nDELAY 0\n");
  program.run(12);
  EXPECT_EQ(program.machine().state(), ProgramState::kWaits);
  program.device.set_input(4, true);
  program.run(3);
  program.device.set_input(4, false);
  program.run(3);
  EXPECT_EQ(program["a"], 5);
  EXPECT_EQ(program["b"], 8);
  EXPECT_EQ(program["c"], 12);
  EXPECT_EQ(program["d"], 15);
  EXPECT_EQ(program.machine().state(), ProgramState::kEnded);
}

TEST(AposMachine, WaitsAsLongAsInkeyAndGetvelSay) {
  Running program("a = INKEY (-1)\nb = INKEY 7\nt = TIME\nx = _GETVEL 20\nu = TIME\n");
  program.run(40);
  EXPECT_EQ(program["t"], 7);
  EXPECT_EQ(program["u"], 27);
}

const std::string kSieve =
    "DIM composite[200]\nn = 2\ncount = 0\nWHILE n <= 200 DO\n IF composite[n] == 0 THEN\n  count = count + "
    "1\n"
    "  k = n + n\n  WHILE k <= 200 DO\n   composite[k] = 1\n   k = k + n\n  ENDWHILE\n ENDIF\n n = n + "
    "1\nENDWHILE\n"
    "sum = 0\nagain:\n GOSUB add\nLOOP 20 again\nPRINT count, sum\n"
    "SUBMAINPROG\nSUBPROG add\n sum = sum * 3 + (count - sum % 7) * (n mod 5 + 1)\nRETURN\nENDPROG\n";

TEST(AposMachine, GoesOnAnywhereInALineWhateverItsBudgetIs) {
  Running whole(kSieve);
  whole.run(1, 1'000'000);
  ASSERT_EQ(whole.machine().state(), ProgramState::kEnded);
  EXPECT_EQ(whole["count"], 46);
  for (const std::int32_t budget : {1, 2, 3, 5, 7, 64, 999}) {
    Running parts(kSieve);
    parts.run(100'000, budget);
    EXPECT_EQ(parts.machine().state(), ProgramState::kEnded);
    EXPECT_EQ(parts.variables(), whole.variables()) << budget;
    EXPECT_EQ(parts.lines, whole.lines);
    EXPECT_EQ(parts.machine().counters().commands, whole.machine().counters().commands);
  }
}

TEST(AposMachine, CountsStepsWhoseBudgetIsUsedUp) {
  Running program("a = 1\nagain: a = a + 1\nGOTO again\n");
  program.run(10, 50);
  EXPECT_EQ(program.machine().counters().starved, 10u);
  EXPECT_EQ(program.machine().counters().commands, 500u);
}

// A turn that only reads what cannot change within a step ends the budget of the step.
TEST(AposMachine, RestsWhereALoopOnlyReads) {
  for (const char* text :
       {"endless: GOTO endless\n", "old = IPOS\nWHILE (old == IPOS) DO\nENDWHILE\n",
        "REPEAT\nUNTIL IN 3 == 1\n", "here:\nIF NOT (IN 1) AND (TIME < 100000) THEN GOTO here ENDIF\n"}) {
    Running program(text);
    program.device.values[Command::kIpos] = 5;
    program.run(50, 1000);
    EXPECT_FALSE(program.machine().over()) << text;
    EXPECT_EQ(program.machine().counters().starved, 0u) << text;
    EXPECT_LT(program.machine().counters().commands, 50u * 12) << text;
  }
  Running goes_on("old = IPOS\nWHILE (old == IPOS) DO\nENDWHILE\n");
  goes_on.device.values[Command::kIpos] = 5;
  goes_on.run(10);
  goes_on.device.values[Command::kIpos] = 6;
  goes_on.run(2);
  EXPECT_EQ(goes_on.machine().state(), ProgramState::kEnded);
}

TEST(AposErrors, WithoutAHandlerEndTheProgram) {
  Running program("DIM a[3]\ni = 4\nx = 1\nx = a[i]\nx = 2\n");
  program.run(10);
  EXPECT_EQ(program.machine().state(), ProgramState::kError);
  EXPECT_EQ(program.machine().error(), 171);
  EXPECT_EQ(program.machine().error_place().line, 4u);
  EXPECT_EQ(program["x"], 0);
  EXPECT_EQ(program.device.raised, std::vector<int>{171});
}

TEST(AposErrors, GoToTheHandlerInTheNextStep) {
  Running program(
      "DIM a[3]\nON ERROR GOSUB fault\ni = 4\na[i] = 1\ngone_on = TIME\nSUBMAINPROG\nSUBPROG fault\n at = "
      "TIME\n number = "
      "ERRNO\n ERRCLR\nRETURN\nENDPROG\n");
  program.run(10);
  EXPECT_EQ(program.machine().state(), ProgramState::kEnded);
  EXPECT_EQ(program["number"], 171);
  EXPECT_EQ(program["at"], 1);
  EXPECT_EQ(program["gone_on"], 1);
  EXPECT_EQ(program.device.cleared, 1);
}

TEST(AposErrors, ThatAreNotClearedCallTheHandlerAgain) {
  Running program(
      "ON ERROR GOSUB fault\nn = 0\nGOSUB a\nend: GOTO end\nSUBMAINPROG\nSUBPROG a\n GOSUB "
      "a\nRETURN\nSUBPROG fault\n n = n + 1\n"
      " IF n == 3 THEN ERRCLR ENDIF\nRETURN\nENDPROG\n");
  program.run(20);
  EXPECT_EQ(program["n"], 3);
  EXPECT_EQ(program.device.raised, std::vector<int>{151}) << "the eleventh GOSUB";
}

TEST(AposErrors, WaitBehindTheFirst) {
  Running program(
      "ON ERROR GOSUB fault\nhere: GOTO here\nSUBMAINPROG\nSUBPROG fault\n PRINT ERRNO\n DELAY 5\n "
      "ERRCLR\nRETURN\nENDPROG\n");
  program.run(2);
  program.device.asynchronous_error = 108;
  program.run(2);
  program.device.asynchronous_error = 113;
  program.run(20);
  EXPECT_EQ(program.lines, (Lines{"108", "113"}));
  EXPECT_EQ(program.machine().error(), 0);
}

TEST(AposErrors, HaveThePublishedNumbers) {
  EXPECT_EQ(Running("GOTO inside\nSUBMAINPROG\nSUBPROG a\ninside: x = 1\nRETURN\nENDPROG\n")
                .run(5)
                .machine()
                .error(),
            152);
  std::string loops;
  for (int i = 0; i < 11; ++i) loops += "a" + std::to_string(i) + ": n = 1\n";
  for (int i = 10; i >= 0; --i) loops += "LOOP 1 a" + std::to_string(i) + "\n";
  EXPECT_EQ(Running(loops).run(500, 1000).machine().error(), 114);
  EXPECT_EQ(Running("LINKGPAR 1899 \"x\" 0 1 0\n").run(5).machine().error(), 155);
  EXPECT_EQ(Running("x = GET 132\n").run(5).machine().error(), 112);
  std::string times;
  for (int i = 0; i < 13; ++i) times += "ON TIME 1000 GOSUB s" + std::to_string(i) + "\n";
  times += "SUBMAINPROG\n";
  for (int i = 0; i < 13; ++i) times += "SUBPROG s" + std::to_string(i) + "\nRETURN\n";
  EXPECT_EQ(Running(times + "ENDPROG\n").run(5).machine().error(), 184);
  std::string positions = "SUBMAINPROG\nSUBPROG s\nRETURN\nENDPROG\n";
  for (int i = 0; i < 21; ++i) positions += "ON +APOS " + std::to_string(i) + " GOSUB s\n";
  EXPECT_EQ(Running(positions).run(5).machine().error(), 149);
}

TEST(AposErrors, OfACommandGoOnBehindIt) {
  Running program(
      "ON ERROR GOSUB fault\nPOSA 5\nx = 1\nSUBMAINPROG\nSUBPROG fault\n n = ERRNO\n "
      "ERRCLR\nRETURN\nENDPROG\n");
  program.device.failures[Command::kPosa] = 111;
  program.run(5);
  EXPECT_EQ(program["n"], 111);
  EXPECT_EQ(program["x"], 1);
}

TEST(AposErrors, OfDeletedArraysAreThoseOfTheirBounds) {
  Running program("DIM a[3]\na[1] = 1\nDELETE ARRAYS\na[1] = 2\n");
  program.run(5);
  EXPECT_EQ(program.machine().error(), 171);
}

TEST(AposMachine, SaysWhichCommandItsDeviceDoesNotHave) {
  const CompiledProgram compiled = compile_program("x.m", "a = 1\nCSTART\na = 2\n");
  PlainDevice device;
  Arrays arrays;
  Machine machine(device, arrays);
  ASSERT_EQ(machine.load(*compiled.image), 0);
  for (int i = 0; i < 5; ++i) machine.step(10);
  EXPECT_EQ(machine.state(), ProgramState::kRefused);
  EXPECT_EQ(machine.refused(), Command::kCstart);
  EXPECT_EQ(machine.place().line, 2u);
}

TEST(AposMachine, DoesNotAllocateInAStep) {
  const std::string text =
      "DIM a[3]\nON ERROR GOSUB f\nON PERIOD 2 GOSUB p\nON INT 1 GOSUB p\ni = 0\nagain:\ni = i + 1\na[i mod "
      "5] = i\nPRINT \"i\", i, i, i, i, i\n"
      "DELAY 1\nGOTO again\nSUBMAINPROG\nSUBPROG f\n ERRCLR\nRETURN\nSUBPROG p\n n = n + "
      "1\nRETURN\nENDPROG\n";
  const CompiledProgram compiled = compile_program("x.m", text);
  PlainDevice device;
  Arrays arrays;
  Machine machine(device, arrays);
  ASSERT_EQ(machine.load(*compiled.image), 0);
  const std::uint64_t before = test::allocations_counted();
  {
    const test::CountAllocations counting;
    for (int i = 0; i < 1000; ++i) {
      device.set_input(1, i % 3 == 0);
      machine.step(50);
      device.advance(1);
    }
  }
  EXPECT_EQ(test::allocations_counted(), before);
  EXPECT_GT(machine.prints().dropped_lines(), 0u);
  EXPECT_FALSE(machine.over());
}

TEST(AposMachine, KeepsArraysFromOneProgramToTheNext) {
  PlainDevice device;
  Arrays arrays;
  Machine machine(device, arrays);
  const CompiledProgram first = compile_program("a.m", "DIM a[3]\na[2] = 7\n");
  ASSERT_EQ(machine.load(*first.image), 0);
  machine.step(10);
  const CompiledProgram second = compile_program("b.m", "DIM other[3], more[1]\nx = other[2]\n");
  ASSERT_EQ(machine.load(*second.image), 0);
  machine.step(10);
  EXPECT_EQ(machine.variable(0), 7);
  const CompiledProgram third = compile_program("c.m", "DIM a[4]\n");
  EXPECT_EQ(machine.load(*third.image), 170);
  EXPECT_EQ(machine.state(), ProgramState::kNone);
}

/// Published: byte 0 has outputs 1 to 8 of the option, byte 1 27 and 29 of the drive, lowest bit first.
TEST(AposMachine, SwitchesTheOutputsOfABytePerBit) {
  Running running("OUTB 0 129\nOUTB 1 2\n");
  running.run(3);
  std::vector<std::size_t> on;
  for (std::size_t output = 1; output <= PlainDevice::kOutputs; ++output)
    if (running.device.output(output)) on.push_back(output);
  EXPECT_EQ(on, (std::vector<std::size_t>{1, 8, 29}));
}

}  // namespace
}  // namespace lockstep::aposs::running_test
