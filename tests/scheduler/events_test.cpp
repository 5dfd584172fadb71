// Events of the cycle: alarms, acknowledgements, jobs, and the queue that carries them.
#include "scheduler/events.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "fb/home.hpp"
#include "fb/move.hpp"
#include "fb/power.hpp"
#include "tests/support/rig.hpp"

namespace lockstep::events_test {
namespace {

using test::Rig;

std::vector<Event> taken(EventQueue& queue) {
  std::vector<Event> all;
  for (std::size_t i = 0; i < queue.readable(); ++i) all.push_back(queue.event(i));
  queue.pop(all.size());
  return all;
}

TEST(EventQueue, KeepsTheirOrderAndCountsWhatFindsItFull) {
  EventQueue queue(4);
  for (int i = 0; i < 6; ++i) queue.push({.number = i});
  EXPECT_EQ(queue.lost(), 2u);
  const std::vector<Event> first = taken(queue);
  ASSERT_EQ(first.size(), 4u);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(first[static_cast<std::size_t>(i)].number, i);
  queue.push({.number = 7});
  EXPECT_EQ(taken(queue).at(0).number, 7);
  EXPECT_EQ(queue.lost(), 2u);
}

TEST(EventQueue, LetsVirtualTimeGoOnWhenNobodyReads) {
  EventQueue queue(4);
  EXPECT_TRUE(queue.wait_for_space());
  for (int i = 0; i < 4; ++i) queue.push({});
  queue.close();
  EXPECT_FALSE(queue.wait_for_space());
}

TEST(Events, TellAlarmsAndTheirAcknowledgementInTheirTicks) {
  Rig rig;
  Axis& axis = rig.axis("Axis");
  auto& power = rig.block<MC_Power>();
  auto& reset = rig.block<MC_Reset>();
  power.Axis = &axis;
  reset.Axis = &axis;
  EventQueue queue;
  rig.controller.events = &queue;
  power.Enable = true;
  rig.run(5);
  EXPECT_TRUE(taken(queue).empty());
  axis.raise(alarm::kVelocityLimitZero);
  axis.raise(alarm::kVelocityLimitZero);
  rig.tick();
  const std::vector<Event> raised = taken(queue);
  ASSERT_EQ(raised.size(), 1u);
  EXPECT_EQ(raised[0].kind, EventKind::alarm);
  EXPECT_EQ(raised[0].number, 304);
  EXPECT_EQ(raised[0].reaction, 3);
  EXPECT_EQ(raised[0].source, 0u);
  EXPECT_EQ(raised[0].t, rig.controller.now() - 1'000'000);
  reset.Execute = true;
  rig.run(3);
  const std::vector<Event> acknowledged = taken(queue);
  ASSERT_EQ(acknowledged.size(), 1u);
  EXPECT_EQ(acknowledged[0].kind, EventKind::acknowledged);
}

TEST(Events, TellWhetherTicksWereMissedWithinASecondBefore) {
  Rig rig;
  Axis& axis = rig.axis("Axis");
  EventQueue queue;
  rig.controller.events = &queue;
  const auto alarm_is_late = [&] {
    axis.raise(alarm::kVelocityLimitZero);
    rig.tick();
    const std::vector<Event> told = taken(queue);
    EXPECT_EQ(told.size(), 1u);
    auto& reset = rig.block<MC_Reset>();
    reset.Axis = &axis;
    reset.Execute = true;
    rig.run(3);
    taken(queue);
    return !told.empty() && told[0].late;
  };
  rig.run(10);
  EXPECT_FALSE(alarm_is_late()) << "none was missed";
  rig.controller.skip(20);
  EXPECT_TRUE(alarm_is_late()) << "in the next tick";
  rig.run(900);
  EXPECT_TRUE(alarm_is_late());
  rig.run(200);
  EXPECT_FALSE(alarm_is_late()) << "more than a second later";
}

TEST(Events, TellHowJobsStartAndEnd) {
  Controller controller;
  controller.clock = {1'000'000, 1};
  Axis& axis = controller.add_axis(ObjectKind::TO_SynchronousAxis, "Axis");
  axis.data.VirtualAxis.Mode = 1;
  auto& power = static_cast<MC_Power&>(*controller.add_instance(*find_block_type("MC_Power"), "power").block);
  auto& move = static_cast<MC_MoveRelative&>(
      *controller.add_instance(*find_block_type("MC_MoveRelative"), "move").block);
  power.Axis = &axis;
  move.Axis = &axis;
  controller.finish();
  EventQueue queue;
  controller.events = &queue;
  controller.tell_jobs();
  // The blocks are called between the ticks; the next tick tells what they show.
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      controller.tick();
      power.call(0);
      move.call(0);
    }
  };
  power.Enable = true;
  run(5);
  taken(queue);
  move.Distance = 5.0;
  move.Execute = true;
  run(2000);
  const std::vector<Event> done = taken(queue);
  ASSERT_EQ(done.size(), 2u);
  EXPECT_EQ(done[0].kind, EventKind::job_started);
  EXPECT_EQ(done[1].kind, EventKind::job_done);
  EXPECT_EQ(done[1].source, 1u);
  EXPECT_GT(done[1].t, done[0].t);
  move.Execute = false;
  run(2);
  move.Velocity = 0.0;
  move.Execute = true;
  run(3);
  const std::vector<Event> failed = taken(queue);
  ASSERT_EQ(failed.size(), 1u);
  EXPECT_EQ(failed[0].kind, EventKind::job_failed);
  EXPECT_EQ(failed[0].number, 0x8003);
}

TEST(Events, CostNothingWithoutAQueue) {
  Rig rig;
  Axis& axis = rig.axis("Axis");
  for (int i = 0; i < 100; ++i) {
    axis.raise(alarm::kVelocityLimitZero);
    rig.tick();
  }
  EXPECT_TRUE(axis.alarm_notes.any()) << "they wait, bounded";
}

}  // namespace
}  // namespace lockstep::events_test
