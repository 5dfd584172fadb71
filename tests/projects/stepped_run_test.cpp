// A run in virtual time whose trace and events stay in memory.
#include "projects/runtime/stepped_run.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <new>
#include <utility>
#include <vector>

#include "projects/loader/simulation.hpp"

namespace lockstep {
namespace {

constexpr std::string_view kProject = R"({
  "lockstep": 1, "name": "stepped", "clock": { "servo_cycle": "1ms", "interpolator_ratio": 2 },
  "technology_objects": { "Axis": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 } } } },
  "tags": { "ticks": { "type": "ULINT" }, "pause": { "type": "TIME", "init": "300ms" } },
  "programs": [ { "name": "Main", "ob": "Main", "cycle": "1ms", "calls": [
    { "set": "ticks", "to": "ticks + 1" },
    { "fb": "MC_Power", "name": "power", "in": { "Axis": "Axis", "Enable": true } },
    { "fb": "MC_MoveVelocity", "name": "run",
      "in": { "Axis": "Axis", "Execute": "power.Status", "Velocity": 10.0 } } ] } ],
  "stimuli": [ { "at": "1s", "set": { "ticks": 0 } } ],
  "trace": { "signals": [ "ticks", "pause", "Axis.Position" ] }
})";

Project load() {
  return std::move(*load_project(kProject).project);
}

SteppedRun::Options with_trace(const Project& project) {
  return {project.trace.signals};
}

TEST(SteppedRun, KeepsARowOfEachInterpolatorTick) {
  Project project = load();
  const auto options = with_trace(project);
  SteppedRun run(std::move(project), options);
  run.step(1);
  EXPECT_EQ(run.trace().rows(), 1u);
  run.step(998);
  run.step(2);
  const StoredTrace& trace = run.trace();
  ASSERT_EQ(trace.rows(), 501u);
  EXPECT_EQ(trace.block()->times()[1], 0.002);
  EXPECT_EQ(trace.block()->column(0)[499].u, 999u);
  EXPECT_EQ(trace.block()->column(0)[500].u, 1u);  // by the stimulus
  EXPECT_EQ(trace.block()->column(1)[0].r, 0.3);
  EXPECT_EQ(trace.signals()[2].unit, "mm");
}

TEST(SteppedRun, HasTheBitsOfASimulationHoweverItIsStepped) {
  Simulation simulation = Simulation::from_text(kProject);
  simulation.run_for(std::chrono::seconds(3));
  Project project = load();
  const auto options = with_trace(project);
  SteppedRun run(std::move(project), options);
  for (const std::uint64_t ticks : {1, 0, 499, 2000, 500}) run.step(ticks);
  EXPECT_EQ(run.project().controller->now(), 3'000'000'000);
  const Signal position = run.project().names.find("Axis.Position").place->signal;
  EXPECT_EQ(position.load().r, simulation.read("Axis.Position"));
  EXPECT_GT(position.load().r, 0.0);
}

TEST(SteppedRun, TellsJobsOnlyIfTheyAreWanted) {
  for (const bool jobs : {false, true}) {
    SteppedRun run(load(), {.signals = {}, .jobs = jobs});
    run.step(2000);
    EXPECT_EQ(run.trace().rows(), 0u);
    EXPECT_EQ(run.events().empty(), !jobs);
    for (const TraceEvent& event : run.events())
      EXPECT_TRUE(event.source == "power" || event.source == "run");
  }
}

TEST(StoredTrace, LeavesABlockAsItIsToWhoeverHoldsIt) {
  StoredTrace trace({{"a", Type::ULINT, ""}, {"b", Type::LREAL, ""}});
  std::vector<std::shared_ptr<const TraceBlock>> held;
  std::vector<Value> values(2);
  for (std::uint64_t row = 0; row < 5000; ++row) {
    values[0].u = row;
    values[1].r = -static_cast<double>(row);
    trace.add({static_cast<std::int64_t>(row) * 1'000'000, row, 0, values});
    if (held.empty() || held.back() != trace.block()) held.push_back(trace.block());
  }
  ASSERT_EQ(held.size(), 4u);  // 1024, 2048, 4096, 8192 rows
  for (const auto& block : held)
    for (std::uint64_t row = 0; row < std::min<std::uint64_t>(block->capacity(), 5000); ++row) {
      ASSERT_EQ(block->column(0)[row].u, row);
      ASSERT_EQ(block->column(1)[row].r, -static_cast<double>(row));
      ASSERT_EQ(block->times()[row], static_cast<double>(row) / 1000.0);
    }
}

TEST(StoredTrace, RefusesABlockBeyondWhatCanBeAddressed) {
  EXPECT_THROW(TraceBlock(3, std::numeric_limits<std::size_t>::max() / 8), std::bad_alloc);
}

}  // namespace
}  // namespace lockstep
