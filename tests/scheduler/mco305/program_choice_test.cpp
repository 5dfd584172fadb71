// Which program runs: that which starts by itself, PRGPAR, inputs; breaking and continuing one, and its end.
#include <cmath>

#include "tests/scheduler/mco305/device_run.hpp"

namespace lockstep::program_choice_test {
namespace {

// "In all other instances the Autostart program is started repeatedly."
TEST(Mco305Programs, ThatStartByThemselvesBeginAgainWhenTheyHaveEnded) {
  DeviceRun run;
  run.set("1900", 0);
  run.add_program("n = GET 1900\nSET 1900 (n + 1)\nDELAY 10\n");
  run.begin(true);
  run.run(100);
  EXPECT_GE(run.object.parameters()[1900], 7);
  EXPECT_LE(run.object.parameters()[1900], 11);
}

// "If it is planned to start the programs via PRGPAR, the Autostart program is only executed once."
TEST(Mco305Programs, AreChosenByPrgparAndMayChooseTheNextOne) {
  DeviceRun run;
  run.add_program("SET PRGPAR 2\nSET 1900 (GET 1900 + 1)\n", 1, true);
  run.add_program("SET 1901 (GET 1901 + 1)\nSET PRGPAR 3\n", 2, false);
  run.add_program("SET 1902 (GET 1902 + 1)\nagain:\nGOTO again\n", 3, false);
  run.begin(true);
  run.run(50);
  EXPECT_EQ(run.object.parameters()[1900], 1);
  EXPECT_EQ(run.object.parameters()[1901], 1);
  EXPECT_EQ(run.object.parameters()[1902], 1);
  EXPECT_EQ(run.object.program()->number, 3);
}

// "The start input is defined: wait for it, number from the select inputs."
TEST(Mco305Programs, AreChosenByInputs) {
  DeviceRun run;
  run.set("33-50", 15);
  run.set("33-52", 13);
  run.add_program("SET 1900 (GET 1900 + 1)\n", 0, true);
  run.add_program("SET 1901 (GET 1901 + 1)\n", 3, false);
  run.begin(true);
  run.run(20);
  EXPECT_EQ(run.object.parameters()[1900], 1);
  auto& io = run.object.device().io();
  io.set_input(1, true);
  io.set_input(2, true);
  run.run(5);
  EXPECT_EQ(run.object.parameters()[1901], 0);
  io.set_input(3, true);
  run.run(20);
  EXPECT_EQ(run.object.parameters()[1901], 1) << "once for each edge";
}

// "An error has not occurred (except position error, end switch and software limit), since otherwise the
// Autostart program will not be started again."
TEST(Mco305Programs, AreNotStartedWithAnErrorButForThree) {
  for (const int error : {108, 111, 125, 113}) {
    DeviceRun run;
    run.add_program("SET 1900 (GET 1900 + 1)\nagain:\nGOTO again\n");
    run.begin(true);
    run.run(10);
    run.object.device().raise(error);
    run.run(10);
    EXPECT_EQ(run.object.parameters()[1900], error == 113 ? 1 : 2) << error;
    if (error == 113) {
      run.object.device().clear_all_errors();
      run.run(10);
      EXPECT_EQ(run.object.parameters()[1900], 2) << "when it has been cleared";
    }
  }
}

// 33-50 = [9] breaks, 33-51 = [11] continues: "any motion which was interrupted will be completed".
TEST(Mco305Programs, ThatAreBrokenByAnInputGoOnByAnotherWithTheirMotion) {
  DeviceRun run;
  run.set("33-50", 9);
  run.set("33-51", 11);
  run.set("32-01", 500);
  run.set("32-80", 3000);
  run.set("33-83", 2);
  run.add_program("VEL 50\nACC 50\nDEC 50\nSET 1900 1\nPOSA 20000\nSET 1901 7\nDELAY 100000\n");
  run.begin(true);
  run.run(150);
  auto& device = run.object.device();
  EXPECT_TRUE(device.moving());
  device.io().set_input(1, true);
  run.run(3000);
  EXPECT_EQ(run.object.machine().state(), aposs::ProgramState::kError);
  EXPECT_EQ(device.pending().first(), 119);
  EXPECT_FALSE(device.moving());
  EXPECT_LT(device.actual_units(), 20000);
  EXPECT_EQ(run.object.parameters()[1901], 0);
  device.io().set_input(1, false);
  device.io().set_input(2, true);
  run.run(3000);
  EXPECT_EQ(device.actual_units(), 20000);
  EXPECT_EQ(run.object.parameters()[1901], 7);
  EXPECT_FALSE(device.pending().any());
}

// "Once you have removed the error": another one has to be cleared first.
TEST(Mco305Programs, ThatAnErrorHasEndedGoOnWhenItHasBeenCleared) {
  DeviceRun run;
  run.set("33-51", 11);
  run.set("33-52", 7);
  run.add_program("n = 1\nSET 32-99 1\nSET 1900 5\nwait:\nGOTO wait\n");
  run.begin(false);
  run.run(10);
  auto& io = run.object.device().io();
  EXPECT_EQ(run.object.parameters()[1900], 0);
  io.set_input(2, true);
  run.run(10);
  EXPECT_EQ(run.object.machine().state(), aposs::ProgramState::kError);
  io.set_input(3, true);
  run.run(10);
  io.set_input(2, false);
  run.run(2);
  io.set_input(2, true);
  run.run(10);
  EXPECT_EQ(run.object.parameters()[1900], 5);
  EXPECT_EQ(run.variable("n"), 1) << "it did not begin anew";
}

// ESCCOND: controlled stop, brake, outputs kept, 0 or 1; nothing is started any more.
TEST(Mco305Programs, EndedByTheUserStopAndSwitchTheOutputsAsEsccondSays) {
  for (const int condition : {0, 1, 2}) {
    DeviceRun run;
    run.set("33-84", condition);
    run.set("33-66", 5);  // output 4: brake
    run.set("32-01", 500);
    run.set("32-80", 3000);
    run.add_program("OUT 1 1\nOUT 2 0\nVEL 50\nACC 50\nDEC 50\nSET 1900 (GET 1900 + 1)\nPOSA 1000000\n");
    run.begin(true);
    run.run(400);
    run.object.shut_down();
    auto& device = run.object.device();
    double before = device.set_velocity_now();
    EXPECT_GT(before, 0.0);
    for (int i = 0; i < 2000; ++i) {
      run.step();
      EXPECT_LE(device.set_velocity_now(), before + 1e-9);
      before = device.set_velocity_now();
    }
    EXPECT_TRUE(run.object.at_rest());
    EXPECT_EQ(device.io().output(1), condition != 1) << condition;
    EXPECT_EQ(device.io().output(2), condition == 2) << condition;
    EXPECT_TRUE(device.io().output(4)) << condition;
    EXPECT_EQ(run.object.parameters()[1900], 1);
  }
}

// "After program end or abort, the original parameter values are valid again."
TEST(Mco305Programs, LeaveParametersAsTheyWereUnlessTheySaveThem) {
  for (const bool save : {false, true}) {
    DeviceRun run;
    run.set("KPROP", 30);
    run.add_program(std::string("SET KPROP 99\nSET 1900 7\nn = GET KPROP\n") + (save ? "SAVE AXPARS\n" : ""));
    run.begin(false);
    ASSERT_TRUE(run.run_to_end(100));
    EXPECT_EQ(run.variable("n"), 99);
    EXPECT_EQ(run.object.parameters()[mco305::kKProp], save ? 99 : 30);
    EXPECT_EQ(run.object.parameters()[1900], 7) << "those of the application stay";
  }
}

// OUTAN: "operate the FC 300 without feedback"; -0x4000 to 0x4000 are ±100 %.
TEST(Mco305Programs, TurnTheDriveWithoutItsControllerByOutan) {
  DeviceRun run;
  run.object.settings.has_drive = true;
  run.set("32-01", 500);
  run.set("32-80", 3000);
  run.add_program(
      "OUTAN 0x4000\nMOTOR OFF\nv = SYSVAR[4122]\nOUTAN 0x2000\nDELAY 500\na = SYSVAR[4107]\nw = "
      "SYSVAR[4122]\nOUTAN (-0x8000)\nx = SYSVAR[4122]\nOUTAN 0\nDELAY 500\nb = SYSVAR[4107]\n"
      "OUTAN 0x1000\nDELAY 300\nMOTOR ON\nDELAY 300\nc = SYSVAR[4107]\n");
  run.begin(false);
  ASSERT_TRUE(run.run_to_end(3000));
  EXPECT_EQ(run.variable("v"), 0) << "while the controller is on it has no effect";
  EXPECT_NEAR(run.variable("a"), 50, 1) << "half of VELMAX, 100 qc/ms";
  EXPECT_EQ(run.variable("w"), 0x2000);
  EXPECT_EQ(run.variable("x"), -0x4000);
  EXPECT_NEAR(run.variable("b"), 0, 1);
  EXPECT_NEAR(run.variable("c"), 0, 1);
  EXPECT_TRUE(run.object.at_rest());
}

TEST(Mco305Programs, AnErrorStopsADriveWithoutController) {
  DeviceRun run;
  run.object.settings.has_drive = true;
  run.add_program("MOTOR OFF\nOUTAN 0x2000\nDELAY 300\nSET 32-99 1\n");
  run.begin(false);
  ASSERT_TRUE(run.run_to_end(1000));
  run.run(5);
  EXPECT_FALSE(run.object.device().open_loop());
  EXPECT_FALSE(run.object.at_rest()) << "the machine still turns";
  run.run(300);
  EXPECT_TRUE(run.object.at_rest());
}

TEST(Mco305Programs, ReadThatNoKeyIsPressed) {
  DeviceRun run;
  run.add_program("a = INKEY (-1)\nb = INKEY 20\n");
  run.begin(false);
  ASSERT_TRUE(run.run_to_end(100));
  EXPECT_EQ(run.variable("a"), -1);
  EXPECT_EQ(run.variable("b"), -1);
}

// GOTO out of subprograms into the main program, again and again: no call is left behind.
TEST(Mco305Programs, MayLeaveSubprogramsByGoto) {
  DeviceRun run;
  run.add_program(
      "n = 0\nagain:\nn = n + 1\nIF n < 50 THEN\nGOSUB a\nENDIF\nGOSUB c\nn = n + 100\n"
      "SUBMAINPROG\nSUBPROG a\nGOSUB b\nRETURN\nSUBPROG b\nGOTO again\nRETURN\nSUBPROG c\n"
      "RETURN\nENDPROG\n");
  run.begin(false);
  ASSERT_TRUE(run.run_to_end(100));
  EXPECT_EQ(run.object.machine().state(), aposs::ProgramState::kEnded);
  EXPECT_EQ(run.variable("n"), 150);
}

// What others have deleted is made anew when a program begins.
TEST(Mco305Programs, MakeArraysAnewThatHaveBeenDeleted) {
  DeviceRun run;
  run.set("33-80", 2);
  run.add_program("DIM a[12]\na[1] = 5\nDELETE ARRAYS\n", 1, true);
  run.add_program("DIM b[10]\nb[10] = b[1] + 3\nx = b[10]\nwait:\nGOTO wait\n", 2, false);
  run.begin(true);
  run.run(50);
  EXPECT_EQ(run.object.program()->number, 2);
  EXPECT_EQ(run.variable("x"), 3);
}

}  // namespace
}  // namespace lockstep::program_choice_test
