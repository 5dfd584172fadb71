// A day of virtual time with everything on: memory stays as it is. CI runs five minutes of it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test {
namespace {

constexpr int kTicks = 900;  // address of the count of ticks

/// Memory of a process in the machine [KiB].
long resident(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::atol(line.c_str() + 6);
  return -1;
}

class Soak : public testing::TestWithParam<const char*> {};

TEST_P(Soak, ADayOfVirtualTimeTakesNoMoreMemoryThanItsFirstHours) {
  const bool soak = std::getenv("LOCKSTEP_SOAK") != nullptr;
  const int seconds = soak ? 86400 : 300;
  const Directory directory;
  Json json = example_json(GetParam());
  json["modbus"]["map"].push_back(
      {{"diagnostic", "ticks"}, {"table", "input_register"}, {"address", kTicks}, {"type", "UDINT"}});
  const double period = json["clock"]["servo_cycle"] == "500us" ? 0.0005 : 0.001;
  const auto all_ticks = static_cast<std::uint32_t>(seconds / period);
  // The trace is written, but no disk has room for a day of it.
  std::filesystem::create_symlink("/dev/null", directory.file("trace.csv"));
  Process run(lockstep_command({"run", directory.write("project.json", json.dump()), "--simulate", "--modbus",
                                "127.0.0.1:0", "--lcm", "memq://", "--trace", directory.file("trace.csv"),
                                "--duration", std::to_string(seconds) + "s"}));
  const std::string mark = "Modbus server on 127.0.0.1:";
  ASSERT_TRUE(wait_until([&] { return run.err().find('\n') != std::string::npos; }));
  ModbusClient client(std::atoi(run.err().c_str() + run.err().find(mark) + mark.size()));
  const auto wait_for = [&](double part) {
    return wait_until([&] { return client.input_double_word(kTicks) >= part * all_ticks; },
                      std::chrono::hours(12));
  };
  ASSERT_TRUE(wait_for(0.2));
  const long early = resident(run.pid());
  ASSERT_TRUE(wait_for(0.9));
  const long late = resident(run.pid());
  std::cout << early << " KiB after a fifth, " << late << " KiB near the end of " << seconds << " s\n";
  EXPECT_GT(early, 1000);
  EXPECT_LE(late, early + 256);
  ASSERT_TRUE(wait_until([&] { return !run.running(); }, std::chrono::hours(12)));
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_EQ(run.err().find("alarm"), std::string::npos) << run.err();
}

INSTANTIATE_TEST_SUITE_P(Machines, Soak, testing::Values("03_line_shaft", "05_press_feeder"),
                         [](const auto& name) { return std::string(name.param).substr(3); });

}  // namespace
}  // namespace lockstep::test
