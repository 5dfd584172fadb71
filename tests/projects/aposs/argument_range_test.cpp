// What is said of constant arguments that are not what they may be, and that a run does what is said.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "projects/aposs/argument_check.hpp"
#include "tests/projects/aposs/program_run.hpp"
#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::aposs::argument_range_test {
namespace {

/// A statement and what is said of it, behind "x.m:1:"; `error` is that of a run.
struct Case {
  std::string statement, said;
  int error = 0;
};

const std::string kSubprogram = "\nSUBMAINPROG\nSUBPROG s\nRETURN\nENDPROG\n";

// Values beside what the Design Guide gives each argument.
const std::vector<Case>& cases() {
  static const std::string outputs = "1 to 8, 21, 22, 27, 29, X34/1, X34/5, X34/10";
  static const std::string inputs = "1 to 12, 18, 19, 27, 29, 32, 33";
  static const std::string times =
      ": below 0 it is over at once; an option counts no further than this; allowed: 0 to 1073741823";
  static const std::string drive =
      "3-03, 4-13, 16-02, 16-03, 16-05, 16-12, 16-13, 16-14, 16-16, 16-17, 16-60, 16-62, 16-64, 16-65";
  static const std::vector<Case> all{
      {"ACC 0", "5: ACC: acceleration 0: the default (32-85) is taken; allowed: 1 and more"},
      {"DEC -1", "5: DEC: deceleration -1: the default (32-85) is taken; allowed: 1 and more"},
      {"VEL -1", "5: VEL: velocity -1: the default (32-84) is taken; allowed: 0 and more"},
      {"VEL 0", "5: VEL: velocity 0: nothing moves; allowed: 1 and more"},
      {"VEL 10001",
       "5: VEL: velocity 10001: it is more than VELMAX, whatever VELRES is; allowed: 1 to 10000"},
      {"CVEL -10001",
       "6: CVEL: velocity -10001: it is more than VELMAX, whatever VELRES is; allowed: -10000 to 10000"},
      {"DIM a[4] COMOPTGET 5 a", "20: COMOPTGET: number 5: error 171 when it runs; allowed: 0 to 4", 171},
      {"DIM a[20] COMOPTSEND 11 a", "22: COMOPTSEND: number 11: error 171 when it runs; allowed: 0 to 10",
       171},
      {"DIM a[20] COMOPTGET -1 a", "21: COMOPTGET: number -1: error 171 when it runs; allowed: 0 to 10", 171},
      {"DELAY -1", "7: DELAY: time -1" + times},
      {"WAITT -1", "7: WAITT: time -1" + times},
      {"DELAY (1073741823 + 1)", "19: DELAY: time 1073741824" + times},
      {"ON TIME -5 GOSUB s" + kSubprogram, "9: ON TIME: time -5" + times},
      {"x = GET 132",
       "9: GET: parameter 132: error 112 when it runs; allowed: 32-00 to 34-71 as published, 1900 to 1999",
       112},
      {"x = GETVLT 15-00", "12: GETVLT: parameter 15-00: error 112 when it runs; allowed: " + drive, 112},
      {"x = GETVLT 32-67", "12: GETVLT: parameter 32-67: error 112 when it runs; allowed: " + drive, 112},
      {"x = GETVLTSUB 303 0",
       "15: GETVLTSUB: parameter 3-03: error 112 when it runs; allowed: none, the simulated drive has no "
       "parameter with indices",
       112},
      {"SETVLTSUB 303 0 1",
       "11: SETVLTSUB: parameter 3-03: error 112 when it runs; allowed: none, the simulated drive has no "
       "parameter with indices",
       112},
      {"SETVLT 1617 5", "8: SETVLT: parameter 16-17: error 112 when it runs; allowed: 3-03, 4-13", 112},
      {"SETVLT 4-13 -1", "13: SETVLT: value -1: error 112 when it runs; allowed: 0 to 60000", 112},
      {"x = IN 13", "8: IN: input 13: it is always off; allowed: " + inputs},
      {"WAITI 99 OFF", "7: WAITI: input 99: it is always off; allowed: " + inputs},
      {"WAITI 1 2", "9: WAITI: state 2: it is taken for ON; allowed: 0, 1"},
      {"x = INAD 55", "10: INAD: terminal 55: error 171 when it runs; allowed: 53, 54", 171},
      {"x = INB 3", "9: INB: byte 3: it is always 0; allowed: 0 to 2"},
      {"LINKGPAR 1899 \"a\" 0 1 0",
       "10: LINKGPAR: parameter 1899: error 155 when it runs; allowed: 1900 to 1999", 155},
      {"LINKGPAR 1900 \"a\" 9 0 0",
       "19: LINKGPAR: minimum 9: error 155 when it runs; allowed: up to 0, the value behind it", 155},
      {"LINKGPAR 1900 \"a\" 0 9 2", "23: LINKGPAR: type 2: nothing depends on it here; allowed: 0, 1"},
      {"LINKSYSVAR 5 1900 \"a\"",
       "12: LINKSYSVAR: index 5: error 155 when it runs; allowed: the index of a system variable", 155},
      {"LINKSYSVAR 4107 2000 \"a\"",
       "17: LINKSYSVAR: parameter 2000: error 155 when it runs; allowed: 1900 to 1999", 155},
      {"a: LOOP -1 a", "9: LOOP: number -1: nothing is repeated; allowed: 0 and more"},
      {"MOVESYNCORIGIN (1073741823 + 1)",
       "28: MOVESYNCORIGIN: distance 1073741824: an option shifts no further than this; allowed: -1073741823 "
       "to 1073741823"},
      {"NOWAIT 2", "8: NOWAIT: state 2: it is taken for ON; allowed: 0, 1"},
      {"ON PARAM 99-99 GOSUB s" + kSubprogram,
       "10: ON PARAM: parameter 99-99: it never comes; allowed: 32-00 to 34-71 as published, 1900 to 1999"},
      {"ON PERIOD -5 GOSUB s" + kSubprogram,
       "11: ON PERIOD: period -5: it is switched off, as by 0; allowed: 0 and more"},
      {"ON PERIOD 19 GOSUB s" + kSubprogram,
       "11: ON PERIOD: period 19: an option looks at its time every 20 ms; allowed: 0, 20 and more"},
      {"ON STATBIT 2 GOSUB s" + kSubprogram,
       "12: ON STATBIT: bit 2: it never comes; allowed: 1, 3, 4, 6, 8 to 12, 25 to 31, below 0 for the "
       "falling edge"},
      {"OUT 33 1", "5: OUT: output 33: error 171 when it runs; allowed: 1 to 32, X34/1, X34/5, X34/10", 171},
      {"OUT 9 1", "5: OUT: output 9: no terminal shows it; allowed: " + outputs},
      {"OUT 1 -1", "7: OUT: state -1: it is taken for ON; allowed: 0, 1"},
      {"OUTAN 0x4001", "7: OUTAN: reference 16385: the nearest of these is taken; allowed: -16384 to 16384"},
      {"OUTB 2 0", "6: OUTB: byte 2: error 171 when it runs; allowed: 0, 1", 171},
      {"OUTB 0 256", "8: OUTB: value 256: its lowest eight bits are taken; allowed: 0 to 255"},
      {"OUTDA 43 0", "7: OUTDA: output 43: error 171 when it runs; allowed: 42", 171},
      {"OUTDA 42 100001", "10: OUTDA: value 100001: the nearest of these is taken; allowed: 0 to 100000"},
      {"x = PCD[11]", "9: PCD: word 11: error 171 when it runs; allowed: 1 to 10", 171},
      {"PCD[0] = 1", "5: PCD: word 0: error 171 when it runs; allowed: 1 to 10", 171},
      {"PCD[11].3 = 1", "5: PCD: word 11: error 171 when it runs; allowed: 1 to 10", 171},
      {"PRINT DEV -2 \"a\"",
       "11: PRINT DEV: device -2: below 0 nothing is printed, else everything; allowed: -1, 0"},
      {"SET 34-70 1",
       "5: SET: parameter 34-70: error 112 when it runs; allowed: 32-00 to 33-91 as published, 1900 to 1999",
       112},
      {"SET 32-99 1",
       "5: SET: parameter 32-99: error 112 when it runs; allowed: 32-00 to 33-91 as published, 1900 to 1999",
       112},
      {"SET VELRES 0", "12: SET: value 0: error 112 when it runs; allowed: 1 to 10000", 112},
      {"SET SYNCFACTM 0",
       "15: SET: value 0: error 112 when it runs; allowed: -1073741823 to 1073741823, not 0", 112},
      {"SET SYNCFACTM 1073741824",
       "15: SET: value 1073741824: SET takes it without a look at its range; allowed: -1073741823 to "
       "1073741823, not 0"},
      {"SET SYNCFACTS 1073741824",
       "15: SET: value 1073741824: SET takes it without a look at its range; allowed: -1073741823 to "
       "1073741823"},
      {"SET I_BREAK 13", "13: SET: value 13: error 112 when it runs; allowed: -12 to 12", 112},
      {"SET RAMPMIN 3600001",
       "13: SET: value 3600001: SET takes it without a look at its range; allowed: 1 to 3600000, in "
       "thousandths"},
      {"SET ERRCOND 4", "13: SET: value 4: SET takes it without a look at its range; allowed: 0, 1, 2, 3, 5"},
      {"SET PID TIMER 0", "15: SET PID: value 0: nothing changes; allowed: for TIMER all but 0"},
      {"SWAPMENC 2", "10: SWAPMENC: state 2: it is taken for ON; allowed: 0, 1"},
      {"SYNCC -1", "7: SYNCC: number -1: there is no such number of cycles; allowed: 0 and more"},
      {"SYNCCMM -1", "9: SYNCCMM: number -1: there is no such number of cycles; allowed: 0 and more"},
      {"SYNCCMS -1", "9: SYNCCMS: number -1: there is no such number of cycles; allowed: 0 and more"},
      {"SYNCMARKERSTART 2", "17: SYNCMARKERSTART: type 2: error 112 when it runs; allowed: 0, 1", 112},
      {"SYNCSTATCLR 12",
       "13: SYNCSTATCLR: value 12: no other flag is cleared; allowed: 8, 16, 32, 64 and their sums"},
      {"x = SYSVAR[5]",
       "12: SYSVAR: index 5: error 112 when it runs; allowed: the index of a system variable", 112},
      {"SYSVAR[4107] = 1", "8: SYSVAR: written index 4107: error 112 when it runs; allowed: 4105", 112},
      {"DIM a[20] TESTSETP 0 1 1 1 a", "20: TESTSETP: time 0: nothing is recorded; allowed: 1 and more"},
      {"DIM a[20] TESTSETP 1 5 1 1 a",
       "22: TESTSETP: index 5: there is none; allowed: the index of a system variable"},
      {"DIM a[20] TESTSETP 1 1 5 1 a",
       "24: TESTSETP: index 5: there is none; allowed: the index of a system variable"},
      {"DIM a[20] TESTSETP 1 1 1 5 a",
       "26: TESTSETP: index 5: there is none; allowed: the index of a system variable"},
      {"TESTSTART -1", "11: TESTSTART: number -1: nothing is recorded; allowed: 0 and more"},
      {"WAITNDX 0", "9: WAITNDX: time 0: error 179 when it runs; allowed: 1 and more", 179},
  };
  return all;
}

// Of which no run could tell.
const std::vector<Case>& refused() {
  static const std::vector<Case> all{
      {"ON COMBIT 33 GOSUB s",
       "11: ON COMBIT: bit 33: there is none; allowed: 1 to 32, below 0 for the falling edge"},
      {"ON COMBIT 0 GOSUB s",
       "11: ON COMBIT: bit 0: there is none; allowed: 1 to 32, below 0 for the falling edge"},
      {"ON INT 13 GOSUB s",
       "8: ON INT: input 13: there is none; allowed: 1 to 12, 18 to 33, below 0 for the falling edge"},
      {"ON INT -34 GOSUB s",
       "8: ON INT: input -34: there is none; allowed: 1 to 12, 18 to 33, below 0 for the falling edge"},
      {"ON STATBIT -33 GOSUB s",
       "12: ON STATBIT: bit -33: there is none; allowed: 1 to 32, below 0 for the falling edge"},
  };
  return all;
}

TEST(AposRanges, AreToldOfConstantsBesideThem) {
  for (const Case& one : cases())
    EXPECT_EQ(said_of(one.statement + "\n"), Lines{"warning: x.m:1:" + one.said}) << one.statement;
  for (const Case& one : refused())
    EXPECT_EQ(said_of(one.statement + kSubprogram), Lines{"x.m:1:" + one.said}) << one.statement;
}

TEST(AposRanges, AreToldEachOfSomeCase) {
  for (const ArgumentRange& range : argument_ranges()) {
    std::string begin(row_of(range.command).name);
    begin = begin.substr(0, begin.find(" =")) + ": " + std::string(range.name) + " ";
    const std::string happens =
        range.error != 0 ? "error " + std::to_string(range.error) : std::string(range.outside);
    const auto tells = [&](const Case& one) {
      return one.said.find(": " + begin) != one.said.npos && one.said.find(": " + happens) != one.said.npos;
    };
    EXPECT_TRUE(std::ranges::any_of(range.problem ? refused() : cases(), tells)) << begin << happens;
  }
}

// ON ERROR handles it: so the program is not refused.
TEST(AposRanges, NameTheErrorsThatARunHas) {
  int runs = 0;
  for (const Case& one : cases()) {
    if (one.statement.find("GOSUB") != std::string::npos || one.statement.find("TEST") != std::string::npos ||
        one.statement.starts_with("SYNCC"))
      continue;
    const std::size_t declared = one.statement.starts_with("DIM") ? one.statement.find(']') + 1 : 0;
    DeviceRun run;
    run.add_program(one.statement.substr(0, declared) + "\nON ERROR GOSUB fault\n" +
                    one.statement.substr(declared) +
                    "\nSUBMAINPROG\nSUBPROG fault\n error = ERRNO\n ERRCLR\nRETURN\nENDPROG\n");
    run.begin();
    run.run(50);
    EXPECT_EQ(run.variable("error"), one.error) << one.statement;
    ++runs;
  }
  EXPECT_GT(runs, 50);
}

TEST(AposRanges, SayNothingOfWhatIsAllowed) {
  for (const char* const statement : {"ACC 1000",
                                      "VEL 1",
                                      "VEL 10000",
                                      "CVEL -10000",
                                      "DIM a[4] COMOPTGET 4 a",
                                      "DELAY 0",
                                      "WAITT 1073741823",
                                      "x = GET 3471",
                                      "x = GET 1999",
                                      "x = GET I_FUNCTION_1_1",
                                      "x = GETVLT 16-17",
                                      "SETVLT 303 5",
                                      "x = IN 33",
                                      "x = INAD 53 + INAD 54",
                                      "x = INB 2",
                                      "LINKGPAR 1999 \"a\" 5 5 1",
                                      "LINKSYSVAR 4107 1900 \"a\"",
                                      "a: LOOP 0 a",
                                      "NOWAIT OFF",
                                      "OUT X34/10 0",
                                      "OUT X59/8 ON",
                                      "OUT 29 1",
                                      "OUTAN -0x4000",
                                      "OUTB 1 3",
                                      "OUTB 0 255",
                                      "OUTDA 42 100000",
                                      "x = PCD[10]",
                                      "PCD[1].16 = 0",
                                      "PRINT DEV -1 \"a\"",
                                      "SET I_BREAK -12",
                                      "SET I_FUNCTION_9_4 1",
                                      "SET SYNCMSTART 1007",
                                      "SET SYNCMTYPM 52",
                                      "SET ENCODERTYPE 21",
                                      "SET 1900 -2147483648",
                                      "SET PID KPROP 0",
                                      "SYNCC 0",
                                      "SYNCCSTART -1",
                                      "SYNCSTATCLR 120",
                                      "SYSVAR[4105] = 0",
                                      "x = INKEY -1",
                                      "x = 60 x = INAD x",
                                      "WAITNDX 1"})
    EXPECT_EQ(said_of(std::string(statement) + "\n"), Lines{}) << statement;
  for (const char* const statement :
       {"ON COMBIT -32", "ON INT 33", "ON STATBIT -31", "ON PARAM 1999", "ON PARAM 32-67", "ON PARAM POSERR",
        "ON PERIOD 0", "ON PERIOD 20", "ON TIME 0"})
    EXPECT_EQ(said_of(statement + (" GOSUB s" + kSubprogram)), Lines{}) << statement;
}

// Of 5.00 alone there is a start behaviour 7.
TEST(AposRanges, DependOnTheEdition) {
  const CompiledProgram before = compile_program("x.m", "SET SYNCMSTART 7\n", {}, {.later_edition = false});
  ASSERT_EQ(before.warnings.size(), 1u);
  EXPECT_TRUE(before.warnings[0].text.starts_with("SET: value 7: SET takes it")) << before.warnings[0].text;
  EXPECT_EQ(said_of("SET SYNCMSTART 7\n"), Lines{});
}

// Each argument of the catalogue with a range of numbers is declared, but for those for which every number is
// one.
TEST(AposRanges, AreThereForEachArgumentWithARangeOfNumbers) {
  const std::set<std::pair<std::string, std::size_t>> any{
      {"INKEY", 0}, {"SYNCCSTART", 0}, {"SYNCCSTOP", 0}, {"GETVLTSUB", 1}, {"SETCURVE", 0}};
  const nlohmann::json document =
      nlohmann::json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/mco305/commands.json"));
  int compared = 0;
  for (const auto& command : document.at("commands")) {
    const std::string name = command.at("name");
    const auto row = std::ranges::find(commands(), std::string_view(name), &CommandRow::name);
    ASSERT_NE(row, commands().end()) << name;
    if (row->kind == CommandKind::kLater || row->kind == CommandKind::kNever) continue;
    for (std::size_t i = 0; i < command.at("parameters").size(); ++i) {
      const auto& range = command["parameters"][i].at("range");
      if (!range.is_string() || any.contains({name, i})) continue;
      const std::string text = range;
      if (text.find_first_of("0123456789") == text.npos) continue;
      const bool declared = std::ranges::any_of(argument_ranges(), [&](const ArgumentRange& one) {
        return one.command == row->command && one.argument == i;
      });
      EXPECT_TRUE(declared) << name << " " << i << ": " << text;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 35);
}

TEST(AposRanges, AreWhatARunDoesWithoutAnError) {
  DeviceRun run;
  run.add_program(
      "VEL 0\nNOWAIT ON\nPOSA 100000\nDELAY 500\nstood = APOS\nACC 0\nDEC -1\nVEL -1\nPOSA 100000\nDELAY "
      "500\nmoved = APOS\n"
      "byte = INB 3\ninput = IN 13\nOUT 1 2\nOUTB 1 2\na: n = n + 1\nLOOP -1 a\n");
  run.begin();
  run.run(1200);
  EXPECT_EQ(run.variable("stood"), 0);
  EXPECT_GT(run.variable("moved"), 0);
  EXPECT_EQ(run.variable("byte"), 0);
  EXPECT_EQ(run.variable("input"), 0);
  EXPECT_EQ(run.variable("n"), 1);
  EXPECT_TRUE(run.object.device().io().output(1));
  EXPECT_FALSE(run.object.device().io().output(27));
  EXPECT_TRUE(run.object.device().io().output(29)) << "the second bit of byte 1";
}

}  // namespace
}  // namespace lockstep::aposs::argument_range_test
