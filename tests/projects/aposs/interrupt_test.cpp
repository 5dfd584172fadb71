// Interrupts of all classes: order, memory, blocking, what they do to waits.
#include "tests/projects/aposs/program_run.hpp"

namespace lockstep::aposs::interrupt_test {
namespace {

/// Subprograms that print their name.
std::string printing(const std::vector<std::string>& names) {
  std::string text = "SUBMAINPROG\n";
  for (const std::string& name : names) text += "SUBPROG " + name + "\n PRINT \"" + name + "\"\nRETURN\n";
  return text + "ENDPROG\n";
}

TEST(AposInterrupts, OfOneStepRunByClassThenByNumber) {
  Running program(
      "ON PERIOD 3 GOSUB period\nON TIME 3 GOSUB time\nON PARAM 1900 GOSUB param\nON STATBIT 9 GOSUB "
      "stat9\nON STATBIT 3 "
      "GOSUB stat3\nON COMBIT 5 GOSUB com\nON +APOS 100 GOSUB apos\nON -MAPOS -5 GOSUB mapos\nON INT 5 GOSUB "
      "int5\nON INT -2 "
      "GOSUB int2\nhere: GOTO here\n" +
      printing({"period", "time", "param", "stat9", "stat3", "com", "apos", "mapos", "int5", "int2"}));
  program.device.set_input(2, true);
  program.run(3);
  program.device.set_input(2, false);
  program.device.set_input(5, true);
  program.device.bits = {0, 1u << 4, (1u << 8) | (1u << 2)};
  program.device.positions[0].value = 150;
  program.device.positions[1].value = -10;
  program.device.set_parameter(1900, 7);
  program.run(1);
  EXPECT_EQ(program.lines,
            (Lines{"int2", "int5", "apos", "mapos", "com", "stat3", "stat9", "param", "period", "time"}));
}

TEST(AposInterrupts, OfTheirOwnHandlerAreRememberedOnce) {
  Running program(
      "ON INT 1 GOSUB slow\nn = 0\nhere: GOTO here\nSUBMAINPROG\nSUBPROG slow\n n = n + 1\n DELAY "
      "20\nRETURN\nENDPROG\n");
  program.run(2);
  const auto pulse = [&] {
    program.device.set_input(1, true);
    program.run(2);
    program.device.set_input(1, false);
    program.run(2);
  };
  pulse();
  pulse();  // remembered
  pulse();  // lost
  program.run(100);
  EXPECT_EQ(program["n"], 2);
}

TEST(AposInterrupts, AreNotNestedButForErrors) {
  Running program(
      "ON ERROR GOSUB fault\nON INT 1 GOSUB slow\nON INT 2 GOSUB two\nhere: GOTO here\n"
      "SUBMAINPROG\nSUBPROG slow\n PRINT \"slow\"\n DELAY 10\n PRINT \"slow ends\"\nRETURN\nSUBPROG two\n "
      "PRINT \"two\"\nRETURN\n"
      "SUBPROG fault\n PRINT \"fault\"\n DELAY 3\n ERRCLR\n PRINT \"fault ends\"\nRETURN\nENDPROG\n");
  program.run(2);
  program.device.set_input(1, true);
  program.run(2);
  program.device.set_input(2, true);
  program.run(2);
  program.device.asynchronous_error = 108;
  program.run(30);
  EXPECT_EQ(program.lines, (Lines{"slow", "fault", "fault ends", "slow ends", "two"}));
}

TEST(AposInterrupts, KeepWhatTheLineBelowHasComputedSoFar) {
  // Whatever the budget is, the handler finds its temporaries and the main program its own.
  for (const std::int32_t budget : {12, 13, 17, 23, 50}) {
    Running program(
        "ON PERIOD 1 GOSUB tick\nn = 0\nk = 0\nagain:\nr = (n + 1) * (n + 2) - (n + 3) * (n - 4)\nIF r != 4 "
        "* n + 14 THEN\n bad = 1\n"
        "ENDIF\nn = n + 1\nIF n < 400 THEN GOTO again ENDIF\n"
        "SUBMAINPROG\nSUBPROG tick\n k = (k + 1) * (1 + 0 * n) * (2 - 1) + (n - n) * 5\nRETURN\nENDPROG\n");
    program.run(100'000, budget);
    EXPECT_EQ(program.machine().state(), ProgramState::kEnded);
    EXPECT_EQ(program["bad"], 0) << budget;
    EXPECT_GT(program["k"], 100);
  }
}

// EN 3337-3355: an assignment of the handler is lost where the main program is in the middle of its own.
TEST(AposInterrupts, RaceWithAssignmentsAsPublished) {
  Running program(
      "ON INT 1 GOSUB clear\nvalue = 5\ntarget = 10\ntarget = target + value - 3\nSUBMAINPROG\nSUBPROG "
      "clear\n target = 0\nRETURN\nENDPROG\n");
  program.run(4, 1);  // ON INT, value, target, target + value
  program.device.set_input(1, true);
  program.run(10, 1);
  EXPECT_EQ(program["target"], 12);
}

TEST(AposInterrupts, OfADisabledClassAreForgottenIfTheyAreEdgesAndKeptIfTheyAreMessages) {
  const std::string handlers = printing({"int", "time", "param", "apos", "period"});
  const std::string definitions =
      "ON INT 1 GOSUB int\nON TIME 5 GOSUB time\nON PARAM 1900 GOSUB param\nON +APOS 100 GOSUB apos\n";
  const auto lines_with = [&](const std::string& disable, const std::string& enable) {
    Running program(definitions + disable + "DELAY 20\nPRINT \"enable\"\n" + enable + "DELAY 5\n" + handlers);
    program.run(3);
    program.device.set_input(1, true);
    program.device.set_parameter(1900, 1);
    program.device.positions[0].value = 200;
    program.run(60);
    return program.lines;
  };
  EXPECT_EQ(lines_with("", ""), (Lines{"int", "apos", "param", "time", "enable"}));
  EXPECT_EQ(lines_with("DISABLE INT\nDISABLE TIME\nDISABLE PARAM\nDISABLE POSINT\n",
                       "ENABLE INT\nENABLE TIME\nENABLE PARAM\nENABLE POSINT\n"),
            (Lines{"enable", "time", "param", "apos"}));
  EXPECT_EQ(lines_with("DISABLE ALL\n", "ENABLE ALL\n"), (Lines{"enable", "int", "apos", "param", "time"}));
  EXPECT_EQ(lines_with("DISABLE ALL\nDISABLE TIME\n", "ENABLE ALL\n"),
            (Lines{"enable", "int", "apos", "param"}));
}

TEST(AposInterrupts, InAHandlerAreHeldBackByTheHandlerAlone) {
  Running program(
      "ON INT 1 GOSUB one\nON INT 2 GOSUB two\nhere: GOTO here\nSUBMAINPROG\nSUBPROG one\n PRINT \"one\"\n "
      "ENABLE ALL\n DELAY 5\n DISABLE "
      "ALL\n PRINT \"one ends\"\nRETURN\nSUBPROG two\n PRINT \"two\"\nRETURN\nENDPROG\n");
  program.run(2);
  program.device.set_input(1, true);
  program.run(2);
  program.device.set_input(2, true);
  program.run(20);
  EXPECT_EQ(program.lines, (Lines{"one", "one ends", "two"}));
}

TEST(AposInterrupts, LetDelayGoOnAndStartWaittAnew) {
  const auto end_of = [](const std::string& wait) {
    Running program("ON INT 1 GOSUB s\n" + wait +
                    "\nt = TIME\nSUBMAINPROG\nSUBPROG s\n DELAY 3\nRETURN\nENDPROG\n");
    program.run(6);
    program.device.set_input(1, true);
    program.run(100);
    return program["t"];
  };
  EXPECT_EQ(end_of("DELAY 20"), 20);
  EXPECT_EQ(end_of("WAITT 20"), 29);  // 6 and 3 ms of the handler, then 20
  EXPECT_EQ(end_of("DELAY 7"), 9);    // the handler is finished first
}

TEST(AposInterrupts, EndHomeAndLetOtherCommandsGoOn) {
  const std::string handler = "OUT 1 1\nSUBMAINPROG\nSUBPROG s\n OUT 2 1\nRETURN\nENDPROG\n";
  Running home("ON INT 1 GOSUB s\nHOME\n" + handler);
  home.device.busy[Command::kHome] = 50;
  home.run(5);
  home.device.set_input(1, true);
  home.run(100);
  EXPECT_EQ(home.device.commands, (Lines{"0 HOME", "5 OUT 2 1", "5 OUT 1 1"}));
  EXPECT_EQ(home.device.given_up, std::vector<Command>{Command::kHome});
  Running motion("ON INT 1 GOSUB s\nPOSA 5\n" + handler);
  motion.device.busy[Command::kPosa] = 50;
  motion.run(5);
  motion.device.set_input(1, true);
  motion.run(100);
  EXPECT_EQ(motion.device.commands, (Lines{"0 POSA 5", "5 OUT 2 1", "50 OUT 1 1"}));
}

TEST(AposInterrupts, OfErrorsDoNotEndHome) {
  Running program(
      "ON ERROR GOSUB fault\nHOME\nOUT 1 1\nSUBMAINPROG\nSUBPROG fault\n ERRCLR\nRETURN\nENDPROG\n");
  program.device.busy[Command::kHome] = 20;
  program.run(5);
  program.device.asynchronous_error = 113;
  program.run(50);
  EXPECT_EQ(program.device.commands, (Lines{"0 HOME", "20 OUT 1 1"}));
  EXPECT_TRUE(program.device.given_up.empty());
}

TEST(AposInterrupts, RunWithNowaitOn) {
  Running program(
      "ON INT 1 GOSUB s\nDELAY 10\nPOSA 3\nOUT 2 1\nSUBMAINPROG\nSUBPROG s\n POSA 1\n POSA 2\n OUT 1 "
      "1\nRETURN\nENDPROG\n");
  program.device.busy[Command::kPosa] = 5;
  program.run(2);
  program.device.set_input(1, true);
  program.run(50);
  EXPECT_EQ(program.device.commands, (Lines{"2 POSA 1", "2 POSA 2", "2 OUT 1 1", "10 POSA 3", "15 OUT 2 1"}));
}

TEST(AposInterrupts, OfPeriodsDoNotDrift) {
  Running program(
      "n = 0\nsum = 0\nON PERIOD 50 GOSUB tick\nbegin = TIME\nagain:\nx = (x * 7 + 3) mod 13\nWAITT x\nGOTO "
      "again\nSUBMAINPROG\nSUBPROG "
      "tick\n n = n + 1\n late = late + TIME - begin - n * 50\n DELAY (n mod 30)\nRETURN\nENDPROG\n");
  program.run(50'001);
  EXPECT_EQ(program["n"], 1000);
  EXPECT_EQ(program["late"], 0);
}

TEST(AposInterrupts, OfPeriodsThatAreTooShortLeaveTheMainProgramNothing) {
  Running program(
      "n = 0\nON PERIOD 10 GOSUB slow\nagain: n = n + 1\nDELAY 1\nGOTO again\nSUBMAINPROG\nSUBPROG slow\n "
      "DELAY 12\nRETURN\nENDPROG\n");
  program.run(500);
  EXPECT_LT(program["n"], 15);
}

TEST(AposInterrupts, OfTimesComeOnceAndAreStartedAnew) {
  Running program(
      "ON TIME 10 GOSUB s\nDELAY 5\nON TIME 10 GOSUB s\nDELAY 50\nON PERIOD 5 GOSUB p\nDELAY 12\nON PERIOD 0 "
      "GOSUB p\nDELAY "
      "30\nSUBMAINPROG\nSUBPROG s\n PRINT \"s\", TIME\nRETURN\nSUBPROG p\n PRINT \"p\", "
      "TIME\nRETURN\nENDPROG\n");
  program.run(200);
  EXPECT_EQ(program.lines, (Lines{"s 15", "p 60", "p 65"}));
}

TEST(AposInterrupts, OfTimesAreSeenEveryTwentyMillisecondsIfOneWants) {
  Running program("ON TIME 25 GOSUB s\nhere: GOTO here\nSUBMAINPROG\nSUBPROG s\n t = TIME\nRETURN\nENDPROG\n",
                  20);
  program.run(100);
  EXPECT_EQ(program["t"], 40);
}

TEST(AposInterrupts, OfPositionsAreReroutedAndDeleted) {
  const std::string handlers = printing({"info", "zero", "other"});
  Running program(
      "ON - APOS 200 GOSUB info\nON - APOS 100 GOSUB info\nON + APOS 100 GOSUB info\nON + APOS 0 GOSUB "
      "zero\nON INT 3 GOSUB "
      "info\nWAITI 1 ON\nON + APOS 100 GOSUB other\nWAITI 2 ON\nON DELETE 0 GOSUB info\nhere: GOTO here\n" +
      handlers);
  const auto move = [&](std::int32_t to) {
    program.device.positions[0].value = to;
    program.run(2);
  };
  move(-50);
  move(150);
  EXPECT_EQ(program.lines, (Lines{"info", "zero"})) << "in the order in which they were defined";
  program.device.set_input(1, true);
  program.run(2);
  move(90);
  move(110);
  EXPECT_EQ(program.lines, (Lines{"info", "zero", "info", "other"}));
  program.device.set_input(2, true);
  program.run(2);
  move(300);
  move(50);
  EXPECT_EQ(program.lines.size(), 4u);
  program.device.set_input(3, true);
  program.run(2);
  EXPECT_EQ(program.lines.back(), "info") << "ON INT of the same subprogram stays";
}

TEST(AposInterrupts, OfAnInputWatchOneEdge) {
  Running program("ON INT 1 GOSUB up\nON INT -1 GOSUB down\nhere: GOTO here\n" + printing({"up", "down"}));
  program.run(2);
  program.device.set_input(1, true);
  program.run(3);
  program.device.set_input(1, false);
  program.run(3);
  EXPECT_EQ(program.lines, Lines{"down"});
}

TEST(AposInterrupts, OfFallingBitsOfTheBusAreTheirOwn) {
  Running program("ON COMBIT 5 GOSUB up\nON COMBIT -5 GOSUB down\nhere: GOTO here\n" +
                  printing({"up", "down"}));
  program.run(2);
  program.device.bits[1] = 16;
  program.run(3);
  program.device.bits[1] = 0;
  program.run(3);
  EXPECT_EQ(program.lines, (Lines{"up", "down"}));
}

}  // namespace
}  // namespace lockstep::aposs::interrupt_test
