// lockstep run: what the console tells of an alarm whose cause is a value of the project.
#include <gtest/gtest.h>

#include <string>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::told_alarms_test {
namespace {

struct ZeroCase {
  const char* name;
  const char* config;
  const char* told;    // the values
  const char* remedy;  // what to write
};

class LimitOfZeroIsTold : public testing::TestWithParam<ZeroCase> {};

TEST_P(LimitOfZeroIsTold, WithWhichLimitItIsTheValuesAndWhatToWrite) {
  const Directory folder;
  const std::string file = folder.write(
      "zero.json", std::string(R"({ "lockstep": 1, "name": "zero", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
      "DynamicDefaults": { "Velocity": 10.0, "Acceleration": 100.0, "Deceleration": 100.0, "Jerk": 400.0 }, )") +
                       GetParam().config + R"( } } },
    "programs": [ { "name": "Main", "ob": "Main", "cycle": "10ms", "calls": [
      { "fb": "MC_Power", "name": "power", "in": { "Axis": "Slide", "Enable": true } },
      { "fb": "MC_MoveRelative", "name": "move", "in": { "Axis": "Slide", "Execute": "power.Status", "Distance": 5.0 } } ] } ] })");
  const Ended ended = lockstep({"run", file, "--simulate", "--duration", "100ms"});
  EXPECT_EQ(ended.status, 0);
  for (const char* const part :
       {GetParam().told, GetParam().remedy, "move (MC_MoveRelative of Slide): failed"})
    EXPECT_NE(ended.err.find(part), std::string::npos) << part << "\n" << ended.err;
}

INSTANTIATE_TEST_SUITE_P(
    Alarms, LimitOfZeroIsTold,
    testing::Values(ZeroCase{"Velocity", R"("DynamicLimits": { "MaxVelocity": 500.0, "Velocity": 0.0 })",
                             "MaxVelocity 500 mm/s, Velocity 0 mm/s\n",
                             "remedy: write a value above 0 to the one that is 0"},
                    ZeroCase{"Deceleration", R"("DynamicLimits": { "MaxDeceleration": 0.0 })",
                             "value of the motion 0 mm/s², limit 0 mm/s²; the deceleration\n",
                             "remedy: write a value above 0 to the limit"},
                    ZeroCase{"Jerk", R"("DynamicLimits": { "MaxJerk": 0.0 })",
                             "jerk of the job 400 mm/s³, limit 0 mm/s³\n",
                             "remedy: write a value above 0 to DynamicLimits.MaxJerk"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace lockstep::cli::told_alarms_test
