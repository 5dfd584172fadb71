// What the compiler says, with line and column.
#include "tests/projects/aposs/program_run.hpp"

namespace lockstep::aposs::message_test {
namespace {

TEST(AposMessages, TellTheNearestParameter) {
  EXPECT_EQ(said_of("SET SYNCMPULS 5\n"), Lines{"x.m:1:5: 'SYNCMPULS' is no parameter; allowed here: a "
                                                "parameter (nearest: SYNCMPULSM 33-17) or 1900 to "
                                                "1999"});
  EXPECT_EQ(said_of("x = GET 132\n"), Lines{"warning: x.m:1:9: GET: parameter 132: error 112 when it runs; "
                                            "allowed: 32-00 to 34-71 as published, 1900 to 1999"});
}

TEST(AposMessages, TellTheWordsThatBelongToTheFirst) {
  EXPECT_EQ(said_of("MOTOR\n"), Lines{"x.m:1:1: there is no command 'MOTOR' alone; allowed: MOTOR OFF, MOTOR "
                                      "ON, MOTOR STOP, MOTOR: as a label, MOTOR = as a variable"});
  EXPECT_EQ(said_of("DEF zero\n").at(0).substr(0, 76),
            "x.m:1:1: there is no command 'DEF' alone; allowed: DEF ORIGIN, DEF SYNCORIGI");
}

TEST(AposMessages, WarnOfAnInputForWhichNobodyWaits) {
  EXPECT_EQ(
      said_of("WAITI 99 ON\n"),
      Lines{"warning: x.m:1:7: WAITI: input 99: it is always off; allowed: 1 to 12, 18, 19, 27, 29, 32, 33"});
}

TEST(AposMessages, TellWhichBlockHasNoEnd) {
  EXPECT_EQ(said_of("IF 1 THEN\nx = 1\nENDIF\nENDIF\n"),
            Lines{"x.m:4:1: ENDIF without IF; the IF of line 1 ended in line 3"});
  EXPECT_EQ(said_of("a:\nIF 1 THEN\nGOTO a\n"),
            Lines{"x.m:4:1: IF of line 2 has no ENDIF before end of the file"});
  EXPECT_EQ(said_of("WHILE 1 DO\nIF 1 THEN\nENDWHILE\n"),
            Lines{"x.m:3:1: IF of line 2 has no ENDIF before 'ENDWHILE'"});
  EXPECT_EQ(said_of("REPEAT\nx = 1\n"),
            Lines{"x.m:3:1: REPEAT of line 1 has no UNTIL before end of the file"});
  EXPECT_EQ(said_of("ENDWHILE\n"), Lines{"x.m:1:1: ENDWHILE without WHILE"});
  EXPECT_EQ(said_of("SUBMAINPROG\nSUBPROG a\nSUBPROG b\nRETURN\nENDPROG\n"),
            Lines{"x.m:3:1: SUBPROG of line 2 has no RETURN before 'SUBPROG'"});
  EXPECT_EQ(
      said_of("SUBMAINPROG\nSUBPROG a\nIF 1 THEN\nRETURN\nENDIF\nRETURN\nENDPROG\n").at(0).substr(0, 31),
      "x.m:4:1: RETURN within a block;");
}

TEST(AposMessages, TellWhatAnOutputNeeds) {
  EXPECT_EQ(said_of("OUT 11\n"), Lines{"x.m:1:1: OUT 11 is read as output 11 without a state; allowed: OUT 1 "
                                       "1, OUT 11 0, OUT 11 1 (outputs: 1 to "
                                       "8, 21, 22, 27, 29, X34/1, X34/5, X34/10)"});
  EXPECT_EQ(said_of("OUT X34/2 1\n"),
            Lines{"x.m:1:5: 'X34/2' is no output; allowed: X59/1 to X59/8, X34/1, X34/5, X34/10"});
}

TEST(AposMessages, TellInWhichDirectionAPositionIsPassed) {
  EXPECT_EQ(said_of("ON APOS 5 GOSUB s\nSUBMAINPROG\nSUBPROG s\nRETURN\nENDPROG\n"),
            Lines{"x.m:1:4: ON APOS: the sign says in which direction; allowed: ON +APOS, ON -APOS"});
}

TEST(AposMessages, TellWhatStandsInPlaceOfACommand) {
  EXPECT_EQ(said_of("POSAA 100\n").at(0).substr(0, 65),
            "x.m:1:1: there is no command 'POSAA' (did you mean 'POSA'?); allo");
  EXPECT_EQ(said_of("POSA target + 1000\ntarget = 1\n"),
            Lines{"x.m:1:13: POSA: an expression as an argument stands in parentheses, as in POSA (a + b)"});
  EXPECT_EQ(said_of("APOS = 3\n"), Lines{"x.m:1:1: 'APOS' is a command and cannot be assigned to"});
  EXPECT_EQ(said_of("APOS\n"), Lines{"x.m:1:1: 'APOS' gives a value; allowed: name = APOS"});
  EXPECT_EQ(said_of("x = HOME\n"), Lines{"x.m:1:5: 'HOME' is a command and gives no value"});
  EXPECT_EQ(said_of("VEL\nACC 5\n"),
            Lines{"x.m:2:1: VEL: an argument is missing before 'ACC'; allowed: a number, a variable, "
                  "an element, a function or an expression in parentheses"});
}

TEST(AposMessages, TellOfNamesThatAreNotThere) {
  EXPECT_EQ(said_of("GOTO man\nmain:\n"), Lines{"x.m:1:6: there is no label 'man:' (did you mean 'MAIN'?)"});
  EXPECT_EQ(said_of("GOSUB a\n"), Lines{"x.m:1:7: there is no SUBPROG 'a'"});
  EXPECT_EQ(said_of("x = speed\nspeeed = 1\n"),
            Lines{"warning: x.m:1:5: 'speed' is read and never assigned: it is 0 (did you mean 'SPEEED'?)"});
  EXPECT_EQ(said_of("DIM a[3]\nSETCURVE b\n"),
            Lines{"x.m:2:10: SETCURVE: 'b' is no array (did you mean 'a'?); allowed: a"});
}

TEST(AposMessages, TellOfNamesThatAreThereTwice) {
  EXPECT_EQ(said_of("a:\na:\n"), Lines{"x.m:2:1: a second label 'a'; the first stands in line 1"});
  EXPECT_EQ(said_of("DIM a[1], a[2]\n"), Lines{"x.m:1:11: 'a' is declared twice"});
  // Its elements can be read all the same, and those of the arrays behind it.
  EXPECT_EQ(said_of("DIM a[9], b[2]\na = 1\na[2] = a[3] + b[1] + b[3]\n").at(0),
            "x.m:1:5: 'a' is a variable too");
  EXPECT_EQ(said_of("a = 1\na:\n"), Lines{"x.m:2:1: 'a' is a variable and a label; allowed: one of the two"});
  EXPECT_EQ(said_of("x = 1\nDIM a[3]\n"),
            Lines{"x.m:2:1: DIM behind another statement; allowed: DIM at the beginning of the "
                  "program"});
}

TEST(AposMessages, TellOfNumbersThatDoNotFit) {
  EXPECT_EQ(
      said_of("x = 2147483649\n"),
      Lines{"x.m:1:5: '2147483649' is too large; allowed: -2147483648 to 2147483647, 0x0 to 0xFFFFFFFF"});
  EXPECT_EQ(said_of("x = 089\n"),
            Lines{"x.m:1:5: a number that begins with 0 is octal and has the digits 0 to 7"});
  EXPECT_EQ(said_of("x = 5.33\n"),
            Lines{"x.m:1:7: there is no part 33; allowed: .1 to .32, .b1 to .b4, .w1, .w2, .l"});
  EXPECT_EQ(said_of("DIM a[3]\na[4] = 1\n"), Lines{"x.m:2:3: 'a' has no element 4; allowed: 1 to 3"});
}

TEST(AposMessages, TellOfCommentsThatAreNested) {
  EXPECT_EQ(said_of("/* one\n /* two */\nx = 1\n"),
            Lines{"x.m:2:2: '/*' within the comment that begins in line 1; comments are not nested, allowed "
                  "here: '*/'"});
  EXPECT_EQ(said_of("x = 1\n/* one\n"),
            Lines{"x.m:2:1: the comment that begins here does not end; allowed: '*/' behind it"});
  EXPECT_EQ(said_of("/*****/ x = 1 /** y **/ // z\n"), Lines{});
}

TEST(AposMessages, AreOneLineWhateverStandsInTheText) {
  for (const char one : {'\n', '\r', '\x1b', '\t', '\x7f', '\0', '\x80'})
    for (const char* const before : {"ON ", "ON +", "a = ", "GOSUB ", ""})
      for (const std::string& line : said_of(std::string(before) + "'" + one + "\nb = 1\n"))
        EXPECT_EQ(line.find_first_of("\n\r\x1b"), line.npos) << line;
}

TEST(AposMessages, TellWhatComesLaterAndWhatNever) {
  EXPECT_EQ(said_of("x = CPOSDIFF 3\n"),
            Lines{"x.m:1:5: CPOSDIFF is of the later edition (firmware from 5.00) and not built yet"});
  EXPECT_EQ(said_of("CANDEL -1\n"), Lines{"x.m:1:1: CANDEL needs a CAN bus, which Lockstep does not have"});
  EXPECT_EQ(said_of("x = 0\nx++\n"),
            Lines{"x.m:2:2: '++' is of the later edition and not built yet; allowed: x = x + 1"});
  EXPECT_EQ(said_of("#define a 1\n"),
            Lines{"x.m:1:1: '#define' is not built yet (it is of the later edition); allowed: #INCLUDE "
                  "file"});
}

TEST(AposMessages, NameTheUsualForm) {
  const std::string end = "\nSUBMAINPROG\nSUBPROG s\nRETURN\nENDPROG\n";
  EXPECT_EQ(said_of("LINKGP 1900 \"a\" 0 1 0\n"),
            Lines{"warning: x.m:1:1: 'LINKGP': the usual form is LINKGPAR"});
  EXPECT_EQ(said_of("LINKPAR 1900 \"a\" 0 1 0\n"),
            Lines{"warning: x.m:1:1: 'LINKPAR': the usual form is LINKGPAR"});
  EXPECT_EQ(said_of("DEFMCPPOS 1000\n"), Lines{"warning: x.m:1:1: 'DEFMCPPOS': the usual form is DEFMCPOS"});
  EXPECT_EQ(said_of("WAIT 1000\n"), Lines{"warning: x.m:1:1: 'WAIT': the usual form is WAITT"});
  EXPECT_EQ(said_of("WAIT T 1000\nWAIT AX\nWAIT I 4 ON\n"), Lines{});
  EXPECT_EQ(said_of("WAITI 1\n"), Lines{"warning: x.m:1:1: the usual form is WAITI n ON or WAITI n OFF"});
  EXPECT_EQ(said_of("WAIT IN1 OFF\n"),
            Lines{"warning: x.m:1:1: the usual form is WAITI n ON or WAITI n OFF"});
  EXPECT_EQ(said_of("IF IN1 THEN\nENDIF\n"), Lines{"warning: x.m:1:4: 'IN1': the usual form is IN 1"});
  EXPECT_EQ(said_of("in4 = IN 4\nx = in4\n"), Lines{});
  EXPECT_EQ(said_of("SYNCC\n"), Lines{"warning: x.m:2:1: SYNCC without a number is taken for SYNCC 0"});
  EXPECT_EQ(said_of("ON MCPOS 5 GOSUB s" + end),
            Lines{"warning: x.m:1:4: ON MCPOS without a sign is taken for ON +MCPOS"});
  EXPECT_EQ(
      said_of("SUBMAINPROG\nSUBPROG a\nRETURN\n"),
      Lines{"warning: x.m:4:1: ENDPROG is missing at the end of the file; SUBMAINPROG stands in line 1"});
  EXPECT_EQ(said_of("WHILE 1 DO\n{\nx = 1\n}\nENDWHILE\n"),
            Lines{"warning: x.m:2:1: braces around the body of WHILE do nothing; the usual form is WHILE … "
                  "DO … ENDWHILE"});
  EXPECT_EQ(said_of("SET I_REFSWITCH 3\nSET I_FUNCTION_9_4 1\nx = GET I_FUNCTION_9_4\n"), Lines{});
}

TEST(AposMessages, WarnWhereAnExpressionIsReadOtherwiseThanItLooks) {
  EXPECT_EQ(
      said_of("a = 1\nx = NOT a == 0\n"),
      Lines{"warning: x.m:2:5: NOT takes what stands directly behind it; NOT (a == b) takes the comparison"});
  EXPECT_EQ(said_of("a = 1\nx = 2 * a.3\n"), Lines{"warning: x.m:2:10: the part is taken of all that stands "
                                                   "before it, (a * b).n; parentheses say what is meant"});
  EXPECT_EQ(said_of("x = 5 % 0\n"), Lines{"warning: x.m:1:7: a division by 0 gives 0"});
  EXPECT_EQ(said_of("main:\nGOSUB a\nSUBMAINPROG\nSUBPROG a\nGOTO main\nRETURN\nENDPROG\n"),
            Lines{"warning: x.m:5:6: the jump to 'main' leads out of a subprogram or into one; a RETURN "
                  "behind it has no GOSUB: error 152"});
}

TEST(AposMessages, AreKeptUpToTwentyAndCounted) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += "CANDEL 1\n";
  const CompiledProgram compiled = compile_program("x.m", text);
  EXPECT_EQ(compiled.errors.size(), 20u);
  EXPECT_EQ(compiled.errors_found, 50u);
}

TEST(AposIncludes, AreReadFromBesideTheProgram) {
  const ReadIncluded read = [](const std::string& name) -> std::optional<std::string> {
    if (name == "sub.m") return "SUBPROG a\n n = n + 1\nRETURN\n";
    if (name == "bad.m") return "x = 1\nCANDEL 1\n";
    if (name == "self.m") return "#include \"self.m\"\n";
    return std::nullopt;
  };
  EXPECT_EQ(said_of("n = 0\nGOSUB a\nSUBMAINPROG\n#INCLUDE sub.m // file\nENDPROG\n", read), Lines{});
  EXPECT_EQ(said_of("#include \"bad.m\"\n", read),
            Lines{"bad.m:2:1: CANDEL needs a CAN bus, which Lockstep does not have"});
  EXPECT_EQ(said_of("#include \"self.m\"\n", read),
            Lines{"self.m:1:1: #INCLUDE of 'self.m': the file includes itself"});
  EXPECT_EQ(
      said_of("#INCLUDE ../secret.m\n", read),
      Lines{"x.m:1:1: #INCLUDE of '../secret.m'; allowed: a file beside the program whose name ends in .m"});
  const ReadIncluded any = [](const std::string&) { return std::optional<std::string>("CANDEL 1\n"); };
  for (const std::string name : {"\x1b[2J.m", "\x7f.m", "\xc2\x9b.m"}) {
    const Lines said = said_of("#INCLUDE " + name + "\n", any);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_TRUE(said[0].starts_with("x.m:1:1: #INCLUDE of '")) << said[0];
    EXPECT_EQ(said[0].find(name[0]), said[0].npos)
        << "its name would stand in front of each message about it";
  }
  EXPECT_EQ(said_of("#INCLUDE none.m\n", read),
            Lines{"x.m:1:1: #INCLUDE of 'none.m': the file cannot be read; allowed: a file beside the "
                  "program whose name ends in "
                  ".m"});
}

TEST(AposLimits, HoldForVariablesAndNesting) {
  std::string many = "DIM a[1]\n";
  for (int i = 0; i < 92; ++i) many += "v" + std::to_string(i) + " = 1\n";
  EXPECT_EQ(said_of(many), Lines{"x.m:93:7: the program has 93 variables and arrays; allowed: 92"});
  std::string long_one;
  for (int i = 0; i <= 60'000; ++i) long_one += "ERRCLR\n";
  EXPECT_EQ(said_of(long_one).at(0).substr(0, 48), "x.m:60001:1: the program has 60002 internal comm");
  std::string deep = "x = " + std::string(1000, '(') + "1" + std::string(1000, ')') + "\n";
  EXPECT_EQ(said_of(deep).at(0).substr(0, 45), "x.m:1:69: the expression is nested too deep; ");
  std::string sum = "x = 1";
  for (int i = 0; i < 5000; ++i) sum += " + x";
  EXPECT_EQ(said_of(sum).size(), 1u);
  std::string ifs;
  for (int i = 0; i < 200; ++i) ifs += "IF x THEN\n";
  EXPECT_FALSE(said_of(ifs).empty());
}

TEST(AposLimits, HoldForFilesWithThePlaceOfTheFirstByteThatIsTooMuch) {
  const std::string line(1023, ' ');
  std::string text;
  while (text.size() < kLargestFile) text += line + "\n";
  EXPECT_EQ(text.size(), kLargestFile);
  EXPECT_EQ(said_of(text), Lines{});
  EXPECT_EQ(said_of(text + "x"),
            Lines{"x.m:1025:1: the file goes on behind 1 MiB; allowed: files of at most 1048576 bytes"});
  EXPECT_EQ(said_of(std::string(kLargestFile + 1, ' ')),
            Lines{"x.m:1:1048577: the file goes on behind 1 MiB; allowed: files of at most 1048576 bytes"});
  EXPECT_EQ(said_of("\xef\xbb\xbf" + text),
            Lines{"x.m:1024:1022: the file goes on behind 1 MiB; allowed: files of at most 1048576 bytes"});
  const ReadIncluded read = [&text](const std::string&) -> std::optional<std::string> { return text + "x"; };
  EXPECT_EQ(said_of("#INCLUDE big.m\n", read),
            Lines{"big.m:1025:1: the file goes on behind 1 MiB; allowed: files of at most 1048576 bytes"});
}

TEST(AposListing, ShowsEachLineAboveWhatItBecame) {
  const std::string source =
      "DIM a[2]\nx = 2\na[x] = x * 3\nPOSA (x + 1)\nGOSUB s\nSUBMAINPROG\nSUBPROG s\n PRINT \"x\", "
      "x\nRETURN\nENDPROG\n";
  const CompiledProgram compiled = compile_program("x.m", source);
  ASSERT_TRUE(compiled.image);
  EXPECT_EQ(listing(*compiled.image, {source}),
            "2: x = 2\n     0  MOVE x, 2\n3: a[x] = x * 3\n     1  MUL t0, x, 3\n     2  STORE a[], x, t0\n"
            "4: POSA (x + 1)\n     3  ADD t0, x, 1\n     4  CALL POSA t0\n5: GOSUB s\n     5  GOSUB s\n6: "
            "SUBMAINPROG\n"
            "     6  JUMP 9\n\ns:\n8:  PRINT \"x\", x\n     7  PRINT \"x\", \" \", x\n9: RETURN\n     8  "
            "RETURN\n     9  END\n");
}

TEST(AposListing, TellsTheLongestRunOfAHandler) {
  const CompiledProgram compiled = compile_program(
      "x.m",
      "ON INT 1 GOSUB a\nON INT 2 GOSUB b\nSUBMAINPROG\nSUBPROG a\n IF x THEN\n  y = 1\n  z = 1\n ELSE\n  y "
      "= 2\n ENDIF\n GOSUB "
      "c\nRETURN\nSUBPROG b\n WHILE 1 DO\n x = 1\n ENDWHILE\nRETURN\nSUBPROG c\n x = 1\nRETURN\nENDPROG\n");
  ASSERT_TRUE(compiled.image);
  const std::vector<Routine> handlers = handlers_of(*compiled.image);
  ASSERT_EQ(handlers.size(), 2u);
  EXPECT_EQ(longest_run(*compiled.image, handlers[0].entry),
            8u);  // JUMPZ, y, z, JUMP, GOSUB, x, RETURN, RETURN
  EXPECT_EQ(longest_run(*compiled.image, handlers[1].entry), std::nullopt);
}

}  // namespace
}  // namespace lockstep::aposs::message_test
