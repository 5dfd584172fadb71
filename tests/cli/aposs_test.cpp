// lockstep aposs: through the built program.
#include <gtest/gtest.h>

#include <fstream>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::aposs_test {
namespace {

const std::string kProgram =
    "DIM list[3]\n"
    "ON INT 1 GOSUB pressed\n"
    "ON ERROR GOSUB fault\n"
    "list[1] = GET 1900\n"
    "PRINT \"parameter\", list[1]\n"
    "WAITI 2 ON\n"
    "PRINT \"input 2 at\", TIME\n"
    "OUT 3 1\n"
    "SUBMAINPROG\n"
    "SUBPROG pressed\n"
    " PRINT \"pressed at\", TIME\n"
    "RETURN\n"
    "SUBPROG fault\n"
    " WHILE ERRNO DO\n"
    "  ERRCLR\n"
    " ENDWHILE\n"
    "RETURN\n"
    "ENDPROG\n";

TEST(Aposs, CheckTellsWhatProgramsNeed) {
  const Directory folder;
  const std::string file = folder.write("p.m", kProgram);
  const Ended ended = lockstep({"aposs", "check", file});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  EXPECT_NE(ended.out.find("  arrays list[3]\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("  inputs 1, 2\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("  outputs 3\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("  parameters 1900\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("pressed (at most 3 internal commands), fault (any number of internal commands)"),
            std::string::npos)
      << ended.out;
}

TEST(Aposs, CheckTellsEveryProblemOfEveryFile) {
  const Directory folder;
  const std::string good = folder.write("good.m", "x = 1\n");
  const std::string bad = folder.write("bad.m", "OUT 11\nSET SYNCMPULS 5\n");
  const Ended ended = lockstep({"aposs", "check", bad, good});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find(bad + ":1:1: OUT 11"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find(bad + ":2:5: 'SYNCMPULS' is no parameter"), std::string::npos) << ended.err;
  EXPECT_NE(ended.out.find(good + ": 2 internal commands"), std::string::npos) << ended.out;
  EXPECT_EQ(lockstep({"aposs", "check", folder.file("none.m")}).status, 2);
}

TEST(Aposs, CheckKnowsTheParametersOfAnEdition) {
  const Directory folder;
  const std::string later = folder.write("q.m", "SET SYNCFFVEL 5\na = GET 33-32\nSET KPROP 1\n");
  EXPECT_EQ(lockstep({"aposs", "check", later}).status, 0);
  EXPECT_EQ(lockstep({"aposs", "check", later, "--firmware", "5.00"}).status, 0);
  const Ended before = lockstep({"aposs", "check", later, "--firmware", "<5.00"});
  EXPECT_EQ(before.status, 1);
  EXPECT_NE(before.err.find(":1:5: 33-32 is of the later edition; allowed with firmware 5.00"),
            std::string::npos)
      << before.err;
  EXPECT_NE(before.err.find(":2:9: 33-32 is of the later edition"), std::string::npos) << before.err;
  EXPECT_EQ(before.err.find(":3:"), std::string::npos) << before.err;
  EXPECT_EQ(lockstep({"aposs", "check", later, "--firmware", "4"}).status, 2);
}

TEST(Aposs, RunPrintsInVirtualTime) {
  const Directory folder;
  const std::string file = folder.write("p.m", kProgram);
  const Ended ended =
      lockstep({"aposs", "run", file, "--set", "1900=7", "--in", "2=1.5s:1", "--in", "1=20ms:1"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out, "parameter 7\npressed at 20\ninput 2 at 1500\n");
  EXPECT_NE(ended.err.find("outputs that are on: 3"), std::string::npos) << ended.err;
}

TEST(Aposs, RunMovesTheAxisOfADevice) {
  const Directory folder;
  // 3000 RPM, 500 PPR: 100 qc/ms; in 500 ms up and 500 ms down, 150,000 counts between.
  const std::string file =
      folder.write("p.m",
                   "VEL 100\nACC 100\nDEC 100\nt0 = TIME\nPOSA 200000\nt1 = (TIME - t0) % 10\n"
                   "PRINT APOS, t1\n");
  const Ended ended =
      lockstep({"aposs", "run", file, "--set", "ENCODER=500", "--set", "32-80=3000", "--set", "RAMPMIN=0.5"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out, "200000 250\n");
}

TEST(Aposs, RunTracesTheAxisAndItsDrive) {
  const Directory folder;
  const std::string file = folder.write("p.m", "VEL 50\nACC 100\nDEC 100\nPOSA 20000\nDELAY 100\n");
  const std::string trace = folder.file("t.csv");
  const Ended ended =
      lockstep({"aposs", "run", file, "--plant", "--trace", trace, "--set", "ENCODER=500", "--set",
                "32-80=3000", "--set", "RAMPMIN=0.5", "--set", "FFVEL=10486", "--set", "POSERR=100000"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  std::ifstream rows(trace);
  std::string first, row, last;
  std::getline(rows, first);
  EXPECT_EQ(first, "t,CPOS,APOS,AVEL,TRACKERR,Reference,AXEND,ERRNO,Line");
  int behind = 0;
  while (std::getline(rows, row)) {
    const std::size_t comma = row.find(',');
    behind += row.substr(comma + 1, row.find(',', comma + 1) - comma - 1) !=
                      row.substr(row.find(',', comma + 1) + 1,
                                 row.find(',', row.find(',', comma + 1) + 1) - row.find(',', comma + 1) - 1)
                  ? 1
                  : 0;
    last = row;
  }
  EXPECT_GT(behind, 300) << "a drive is behind";
  EXPECT_NE(last.find(",20000,"), std::string::npos) << last;
  EXPECT_EQ(lockstep({"aposs", "run", file, "--trace", folder.file("none/t.csv")}).status, 2);
  EXPECT_EQ(lockstep({"aposs", "run", file, "--set", "VELRES=nan"}).status, 2);
  EXPECT_EQ(lockstep({"aposs", "run", file, "--set", "SYNCFACTM=0"}).status, 2);
}

TEST(Aposs, RunSaysPlainlyWhatIsNotBuilt) {
  const Directory folder;
  const std::string file = folder.write("p.m", "PRINT \"before\"\nSYNCC 1\nPRINT \"behind\"\n");
  const Ended ended = lockstep({"aposs", "run", file});
  EXPECT_EQ(ended.status, 1);
  EXPECT_EQ(ended.out, "before\n");
  EXPECT_NE(ended.err.find(file + ":2:1: SYNCC is not built yet"), std::string::npos) << ended.err;
}

TEST(Aposs, RunTellsAnErrorWithoutAHandler) {
  const Directory folder;
  const std::string file = folder.write("p.m", "DIM a[3]\ni = 9\nx = a[i]\n");
  const Ended ended = lockstep({"aposs", "run", file});
  EXPECT_EQ(ended.status, 1);
  EXPECT_NE(ended.err.find(file + ":3:5: error 171: "), std::string::npos) << ended.err;
}

TEST(Aposs, RunEndsAfterItsDuration) {
  const Directory folder;
  const std::string file =
      folder.write("p.m",
                   "ON PERIOD 100 GOSUB s\nhere: GOTO here\nSUBMAINPROG\nSUBPROG s\nPRINT TIME\n"
                   "RETURN\nENDPROG\n");
  const Ended ended = lockstep({"aposs", "run", file, "--duration", "350ms"});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_EQ(ended.out, "100\n200\n300\n");
}

TEST(Aposs, RunRefusesOptionsThatCannotBeRead) {
  const Directory folder;
  const std::string file = folder.write("p.m", "x = 1\n");
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--in", "40=1"},
                                                  {"--in", "1=x:1"},
                                                  {"--in", "1=1s:2"},
                                                  {"--set", "1899=1"},
                                                  {"--set", "1900"},
                                                  {"--set", "VELRES=0"},
                                                  {"--set", "34-50=1"},
                                                  {"--duration", "5"},
                                                  {"--steps-per-ms", "0"}}) {
    std::vector<std::string> arguments = {"aposs", "run", file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    EXPECT_EQ(lockstep(arguments).status, 2) << options[1 % options.size()];
  }
}

TEST(Aposs, ListShowsSourceAndInternalCommands) {
  const Directory folder;
  folder.write("part.m", "y = x * 2\n");
  const std::string file = folder.write("p.m", "x = 1\n#INCLUDE part.m\n");
  const Ended ended = lockstep({"aposs", "list", file});
  EXPECT_EQ(ended.status, 0) << ended.err;
  EXPECT_NE(ended.out.find("1: x = 1\n     0  MOVE x, 1\npart.m:1: y = x * 2\n     1  MUL y, x, 2\n"),
            std::string::npos)
      << ended.out;
}

}  // namespace
}  // namespace lockstep::cli::aposs_test
