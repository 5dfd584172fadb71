// Values, operators, blocks: what a program computes.
#include "tests/projects/aposs/program_run.hpp"

namespace lockstep::aposs::language_test {
namespace {

TEST(AposExpression, HasTheValuesOfThePublishedTables) {
  EXPECT_EQ(value_of("3 + 3"), 6);
  EXPECT_EQ(value_of("9 - 3"), 6);
  EXPECT_EQ(value_of("2 * 3"), 6);
  EXPECT_EQ(value_of("19 % 3"), 6);
  EXPECT_EQ(value_of("127 ^ 255"), 128);
  EXPECT_EQ(value_of("250 mod 16"), 10);
  EXPECT_EQ(value_of("250 rnd 16"), 16);
  EXPECT_EQ(value_of("abs (-5)"), 5);
  EXPECT_EQ(value_of("7 & 6"), 6);
  EXPECT_EQ(value_of("2 | 4"), 6);
  EXPECT_EQ(value_of("~(-7)"), 6);
  EXPECT_EQ(value_of("3 << 1"), 6);
  EXPECT_EQ(value_of("12 >> 1"), 6);
  EXPECT_EQ(value_of("7.1"), 1);
  EXPECT_EQ(value_of("7.3"), 1);
  EXPECT_EQ(value_of("7.4"), 0);
  EXPECT_EQ(value_of("0x027F.b1"), 127);
  EXPECT_EQ(value_of("0x027F.b2"), 2);
  EXPECT_EQ(value_of("0x0010FFFF.w2"), 16);
  EXPECT_EQ(value_of("0x0010FFFF.l"), 0x0010FFFF);
}

TEST(AposExpression, HasTheValuesOfThePublishedConstants) {
  EXPECT_EQ(value_of("5000"), 5000);
  EXPECT_EQ(value_of("0x7F"), 127);
  EXPECT_EQ(value_of("0X7f"), 127);
  EXPECT_EQ(value_of("0100"), 64);
  EXPECT_EQ(value_of("'A'"), 65);
  EXPECT_EQ(value_of("0"), 0);
  EXPECT_EQ(value_of("0xFFFFFFFF"), -1);
  EXPECT_EQ(value_of("-2147483648"), -2147483647 - 1);
}

// With a variable in it, the machine computes; of constants the compiler does. Both say the same.
TEST(AposExpression, IsTheSameForTheCompilerAndTheMachine) {
  const char* const operators[] = {"+",  "-", "*", "%",  "mod", "rnd", "&",  "|",   "^", "<<",
                                   ">>", "<", ">", "<=", ">=",  "==",  "!=", "AND", "OR"};
  const char* const values[] = {"0",  "1",          "(-1)",          "7",    "(-7)", "31",
                                "32", "2147483647", "(-2147483648)", "65536"};
  for (const char* sign : operators) {
    std::string text;
    int count = 0;
    for (const char* a : values)
      for (const char* b : values) {
        const std::string n = std::to_string(count++);
        text += "a = " + std::string(a) + "\nb = " + b + "\nm = a " + sign + " b\nc = " + a + " " + sign +
                " " + b + "\nIF m != c THEN\n PRINT \"" + a + " " + sign + " " + b + "\", m, c\nENDIF\n";
      }
    Running program(text);
    program.run(100);
    EXPECT_EQ(program.machine().state(), ProgramState::kEnded);
    EXPECT_EQ(program.lines, Lines{}) << sign;
  }
}

TEST(AposExpression, FollowsThePublishedPriorities) {
  EXPECT_EQ(value_of("2 + 3 * 4"), 14);
  EXPECT_EQ(value_of("100 - 10 - 1"), 89);
  EXPECT_EQ(value_of("100 % 7 * 7"), 98);
  EXPECT_EQ(value_of("1 << 2 + 1"), 8);
  EXPECT_EQ(value_of("1 < 2 << 1"), 1);
  EXPECT_EQ(value_of("2 == 2 & 3"), 1);  // (2 == 2) & 3
  EXPECT_EQ(value_of("1 | 6 ^ 7 & 3"), 1 | (6 ^ (7 & 3)));
  EXPECT_EQ(value_of("1 OR 0 AND 0"), 1);
  EXPECT_EQ(value_of("0 == 1 < 2"), 0);  // 0 == (1 < 2)
  EXPECT_EQ(value_of("NOT 0 AND 0"), 0);
  EXPECT_EQ(value_of("NOT (0 AND 0)"), 1);
  EXPECT_EQ(value_of("- 2 * 3"), -6);
  EXPECT_EQ(value_of("a * b.1", "a = 3\nb = 6"), 0);  // (3 * 6).1
  EXPECT_EQ(value_of("a + b.2", "a = 3\nb = 6"), 4);
}

TEST(AposExpression, CountsDivisionsByZero) {
  Running program("a = 0\nx = 5 % a\ny = 5 mod a\nz = 5 rnd a\n");
  program.run(2);
  EXPECT_EQ(program["x"], 0);
  EXPECT_EQ(program.machine().counters().divisions_by_zero, 3u);
  EXPECT_EQ(program.machine().error(), 0);
}

TEST(AposAssignment, WritesPartsOfVariablesAndElements) {
  Running program(
      "DIM f[2]\nv = 0\nv.3 = 1\na = v\nf[1] = 0\nf[1].8 = 1\nb = f[1]\nv = 0\nv.b1 = 72\nc = v\nv.b2 = "
      "128\nd = v\n"
      "v.w2 = 15\ne = v\nn = 3\nw = 0\nw.n = 1\nw.b (n - 1) = 1\ng = w.n\n");
  program.run(2);
  EXPECT_EQ(program["a"], 4);
  EXPECT_EQ(program["b"], 128);
  EXPECT_EQ(program["c"], 72);
  EXPECT_EQ(program["d"], 0x8048);
  EXPECT_EQ(program["e"], 0x000F8048);
  EXPECT_EQ(program["w"], 4 + 256);
  EXPECT_EQ(program["g"], 1);
}

TEST(AposNames, AreTheSameInAnyCase) {
  Running program("Next_Step = 4\nNEXT_step = next_STEP + 1\nPrInT next_step\n");
  program.run(2);
  EXPECT_EQ(program.lines, Lines{"5"});
}

TEST(AposBlocks, BranchAtTheFirstConditionThatHolds) {
  const std::string text =
      "IF a == 1 THEN\n r = 10\nELSEIF a == 2 THEN\n r = 20\nELSEIF (a == 2) OR (a == 3) THEN\n r = "
      "30\nELSE\n r = 40\n"
      "ENDIF\n";
  EXPECT_EQ(Running("a = 1\n" + text).run(2)["r"], 10);
  EXPECT_EQ(Running("a = 2\n" + text).run(2)["r"], 20);
  EXPECT_EQ(Running("a = 3\n" + text).run(2)["r"], 30);
  EXPECT_EQ(Running("a = 4\n" + text).run(2)["r"], 40);
}

TEST(AposBlocks, RepeatAsPublished) {
  EXPECT_EQ(Running("n = 0\nWHILE (n < 5) DO\n n = n + 1\nENDWHILE\n").run(2)["n"], 5);
  EXPECT_EQ(Running("n = 9\nWHILE n < 5 DO\n n = n + 1\nENDWHILE\n").run(2)["n"], 9);
  EXPECT_EQ(Running("n = 9\nREPEAT\n n = n + 1\nUNTIL n > 5\n").run(2)["n"], 10);
  EXPECT_EQ(Running("n = 0\nagain: n = n + 1\nLOOP 9 again\n").run(2)["n"], 10);
  EXPECT_EQ(Running("n = 0\ntimes = -1\nagain: n = n + 1\nLOOP times again\n").run(2)["n"], 1);
  EXPECT_EQ(Running("n = 0\nouter: m = 0\ninner: n = n + 1\nLOOP 2 inner\nLOOP 3 outer\n").run(2)["n"], 12);
}

TEST(AposBlocks, CallSubprogramsFromAnywhere) {
  Running program(
      "SUBMAINPROG\nSUBPROG twice\n GOSUB once\n GOSUB once\nRETURN\nSUBPROG once\n n = n + "
      "1\nRETURN\nENDPROG\n"
      "n = 0\nGOSUB twice\nGOSUB once\nIF n == 3 THEN GOTO end ENDIF\nn = 99\nend:\n");
  EXPECT_EQ(program.run(2)["n"], 3);
  EXPECT_EQ(program.machine().state(), ProgramState::kEnded);
}

TEST(AposBlocks, EndWithExit) {
  Running program("n = 1\nGOSUB stop\nn = 2\nSUBMAINPROG\nSUBPROG stop\n EXIT\nRETURN\nENDPROG\n");
  EXPECT_EQ(program.run(2)["n"], 1);
  EXPECT_EQ(program.machine().state(), ProgramState::kEnded);
  EXPECT_EQ(program.machine().place().line, 6u);
}

TEST(AposPrint, PutsTextsNumbersAndCharactersTogether) {
  Running program(
      "position = 100\nPRINT \"Position\", position\nPRINT \"Number: \", -5\nPRINT 1, 2, 3\nPRINT \"a\", "
      "\"b\"\n"
      "PRINT CHR(65), CHR(66), 7\nPRINT \"no \";\nPRINT \"end\"\nPRINT\nPRINT (2 * 3), 1 == 1\n");
  program.run(2);
  EXPECT_EQ(program.lines, (Lines{"Position 100", "Number: -5", "1 2 3", "a b", "AB7", "no end", "", "6 1"}));
}

TEST(AposPrint, IsSilencedByPrintDev) {
  Running program("PRINT \"a\"\nPRINT DEV -1 \"b\"\nPRINT \"c\"\nPRINT DEV 0 \"d\"\nPRINT \"e\"\n");
  program.run(2);
  EXPECT_EQ(program.lines, (Lines{"a", "d", "e"}));
}

TEST(AposPrint, TakesTextsInEitherEncoding) {
  Running program("PRINT \"\xc3\xa4\"\nPRINT \"\xe4\"\nPRINT CHR(228)\n");
  program.run(2);
  EXPECT_EQ(program.lines, (Lines{"\xc3\xa4", "\xc3\xa4", "\xc3\xa4"}));
}

TEST(AposArguments, ArePrimariesPartedByBlanks) {
  Running program(
      "DIM xpos[3]\nxpos[2] = 40\nn = 2\nSET 1900 25\nPOSA -500\nPOSA (n + 1)\nPOSA xpos[n]\nCVEL GET 1900\n"
      "MOVESYNCORIGIN (- GET 1900)\nMOVESYNCORIGIN -n\nSYNCCSTOP 2 -100\nOUT n 1\nOUT X34/5 ON\nOUTAN "
      "-0x4000\n"
      "SET 32-09 1\nSETVLT 4-13 50\nSETVLTSUB 413 n 7\nSAVE AXPARS\nCOMOPTGET 3 xpos\nDEF SYNCORIGIN 2000 "
      "4000\n"
      "DEFSYNCORIGIN 1 2\nSYSVAR[4105] = n * 3\nPCD[1] = 6\n");
  program.device.values[Command::kPcd] = 5;
  program.run(3, 1000);
  EXPECT_EQ(
      program.device.commands,
      (Lines{"0 POSA -500", "0 POSA 3", "0 POSA 40", "0 CVEL 25", "0 MOVESYNCORIGIN -25",
             "0 MOVESYNCORIGIN -2", "0 SYNCCSTOP 2 -100", "0 OUT 2 1", "0 OUT 3405 1", "0 OUTAN -16384",
             "0 SET 3209 1", "0 SETVLT 413 50", "0 SETVLTSUB 413 2 7", "0 COMOPTGET 3 0",
             "0 DEF SYNCORIGIN 2000 4000", "0 DEF SYNCORIGIN 1 2", "0 SYSVAR = 4105 6", "0 PCD = 1 6"}));
}

TEST(AposArguments, OfPidFollowItsFilter) {
  Running program("SET PID KPROP 3\nSET PID KDER 0\nu = PID 7\nv = PID (u - 1)\n");
  program.run(2);
  EXPECT_EQ(program["u"], 21);
  EXPECT_EQ(program["v"], 60);
}

// PCD[1].3 = 1 changes a bit of the word that is sent; what comes is another word.
TEST(AposArguments, WriteBitsOfProcessData) {
  Running program("PCD[1].3 = 1\nx = PCD[1].1\n");
  program.device.values[Command::kSentPcd] = 1;
  program.device.values[Command::kPcd] = 3;
  program.run(2);
  EXPECT_EQ(program.device.commands, Lines{"0 PCD = 1 5"});
  EXPECT_EQ(program["x"], 1);
}

}  // namespace
}  // namespace lockstep::aposs::language_test
