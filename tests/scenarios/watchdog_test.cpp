// A panel that falls silent, over real Modbus. Nothing here depends on how fast anything is: what the panel
// wants is written again and again until it is seen, since it may be late itself.
#include <gtest/gtest.h>

#include "tests/scenarios/lockstep_process.hpp"
#include "tests/scenarios/modbus_client.hpp"
#include "tests/scenarios/small_project.hpp"

namespace lockstep::test::watchdog_test {
namespace {

constexpr int kBeat = 0, kSpeed = 1;      // holding registers
constexpr int kStart = 0;                 // coil
constexpr int kSilent = 0, kRunning = 1;  // discrete inputs
constexpr int kDoubled = 0;               // input register

Json machine() {
  Json json = empty_project();
  json["tags"] = Json::parse(R"({
    "beat": {"type": "UINT"}, "start": {"type": "BOOL"}, "speed": {"type": "LREAL"}, "silent": {"type": "BOOL"},
    "running": {"type": "BOOL"}, "doubled": {"type": "LREAL"}})");
  json["programs"] = {{{"name", "P"},
                       {"ob", "Main"},
                       {"cycle", "1ms"},
                       {"calls", {assignment("running", "start"), assignment("doubled", "speed * 2.0")}}}};
  json["modbus"]["map"] = Json::parse(R"([
    {"tag": "beat", "table": "holding_register", "address": 0},
    {"tag": "speed", "table": "holding_register", "address": 1, "type": "REAL"},
    {"tag": "start", "table": "coil", "address": 0},
    {"tag": "silent", "table": "discrete_input", "address": 0},
    {"tag": "running", "table": "discrete_input", "address": 1},
    {"tag": "doubled", "table": "input_register", "address": 0, "type": "REAL"}])");
  json["modbus"]["watchdog"] = {{"tag", "beat"},
                                {"timeout", "500ms"},
                                {"status", "silent"},
                                {"set", {{"start", false}, {"speed", 3.0}}}};
  return json;
}

TEST(WatchdogScenario, BringsTheFailSafeValuesWhenAPanelFallsSilentAndEndsWithItsNextBeat) {
  const Directory directory;
  RunningLockstep run(directory.write("project.json", machine().dump()));
  ModbusClient panel(run.port());
  ModbusClient other(run.port());  // which gives no sign of life
  std::uint16_t count = 0;
  const auto beat = [&] { panel.write_register(kBeat, ++count); };

  // Whoever has never given a sign of life is silent too.
  ASSERT_TRUE(wait_until([&] { return other.input(kSilent); })) << run.err();
  EXPECT_TRUE(wait_until([&] { return other.input_float(kDoubled) == 6.0F; }));

  // It speaks, and what it writes counts.
  ASSERT_TRUE(wait_until([&] {
    beat();
    return !panel.input(kSilent);
  }));
  ASSERT_TRUE(wait_until([&] {
    beat();
    panel.write_coil(kStart, true);
    panel.write_float(kSpeed, 50.0F);
    return panel.input(kRunning) && panel.input_float(kDoubled) == 100.0F;
  }));

  // It falls silent, though still connected and reading.
  ASSERT_TRUE(wait_until([&] { return panel.input(kSilent); }));
  EXPECT_TRUE(wait_until([&] { return !panel.input(kRunning) && panel.input_float(kDoubled) == 6.0F; }));
  EXPECT_FALSE(panel.coil(kStart));
  EXPECT_EQ(panel.holding_float(kSpeed), 3.0F);

  // Writes without a sign of life have no effect, not those of others either.
  other.write_coil(kStart, true);
  EXPECT_TRUE(wait_until([&] { return !other.coil(kStart); }));
  EXPECT_FALSE(other.input(kRunning));

  // With the next beat it is over. The values stay until somebody writes others.
  ASSERT_TRUE(wait_until([&] {
    beat();
    return !panel.input(kSilent);
  }));
  EXPECT_EQ(panel.input_float(kDoubled), 6.0F);
  run.send(SIGINT);
  EXPECT_EQ(run.status(), 0) << run.err();
  EXPECT_NE(run.err().find("warning: Modbus: a watchdog has found its client silent"), std::string::npos)
      << run.err();
}

}  // namespace
}  // namespace lockstep::test::watchdog_test
