// The rotary knife in real time, operated over Modbus as its README says.
#include <gtest/gtest.h>

#include <string>

#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::rotary_knife_test {
namespace {

// Addresses of the README.
constexpr int kStart = 0;
constexpr int kSpeed = 10;
constexpr int kSynced = 0;
constexpr int kWaiting = 1;
constexpr int kAlarm = 2;
constexpr int kKnife = 0;
constexpr int kConveyor = 2;
constexpr int kCuts = 4;

TEST(RotaryKnife, AnHmiStartsItSetsItsSpeedWatchesItCutAndStopsIt) {
  const Directory directory;
  const std::string trace = directory.file("knife.csv");
  RunningLockstep run(example("02_rotary_knife"), {"--trace", trace});
  ModbusClient hmi(run.port());
  EXPECT_EQ(hmi.holding_float(kSpeed), 200.0F);
  hmi.write_float(kSpeed, 300.0F);
  EXPECT_EQ(hmi.holding_float(kSpeed), 300.0F) << "a read after a write shows it";
  hmi.write_coil(kStart, true);
  EXPECT_TRUE(wait_until([&] { return hmi.input(kWaiting) || hmi.input(kSynced); }));
  ASSERT_TRUE(wait_until([&] { return hmi.input(kSynced); })) << run.err();
  EXPECT_EQ(hmi.input_float(kConveyor), 300.0F);
  const float before = hmi.input_float(kKnife);
  EXPECT_TRUE(wait_until([&] { return hmi.input_float(kKnife) != before; }));
  EXPECT_TRUE(wait_until([&] { return hmi.input_double_word(kCuts) >= 2; }));

  hmi.write_coil(kStart, false);
  EXPECT_TRUE(wait_until([&] {
    const float place = hmi.input_float(kKnife);
    return !hmi.input(kSynced) && hmi.input_float(kConveyor) == 0.0F && (place < 0.05F || place > 359.95F);
  })) << "the knife is not parked: "
      << hmi.input_float(kKnife);
  EXPECT_FALSE(hmi.input(kAlarm));
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0);

  const CsvTable table = read_csv(trace);
  const std::size_t waiting = table.first("waiting", 1.0);
  const std::size_t synchronizing = table.first("gear.StartSync", 1.0, waiting);
  const std::size_t synchronous = table.first("gear.InSync", 1.0, synchronizing);
  EXPECT_LT(synchronous, table.rows) << "waiting, synchronizing, synchronous in this order";
}

TEST(RotaryKnife, MbpollSpeaksWithItByTheCommandsOfTheReadme) {
  RunningLockstep run(example("02_rotary_knife"));
  const std::string mbpoll = "mbpoll -m tcp -p " + std::to_string(run.port()) + " -0 -1 ";
  const auto shell = [](const std::string& command) {
    Process process({"sh", "-c", command});
    EXPECT_EQ(process.status(), 0) << command << "\n" << process.out() << process.err();
    return process.out();
  };
  shell(mbpoll + "-t 0 -r 0 127.0.0.1 -- 1");
  shell(mbpoll + "-t 4:float -B -r 10 127.0.0.1 -- 280");
  EXPECT_NE(shell(mbpoll + "-t 4:float -B -r 10 127.0.0.1").find("[10]: \t280"), std::string::npos);
  EXPECT_TRUE(wait_until([&] {
    return shell(mbpoll + "-t 3:float -B -r 2 127.0.0.1").find("[2]: \t280") != std::string::npos;
  })) << "the conveyor does not come to its speed";
}

}  // namespace
}  // namespace lockstep::test::rotary_knife_test
