// Pages come, go, write and ask for everything: the thread of the cycle does not notice.
#include <gtest/gtest.h>

#ifndef __SANITIZE_THREAD__  // which has locks of its own behind every access

#include <chrono>
#include <string>
#include <thread>

#include "tests/hmi_bridge/studio_client.hpp"
#include "tests/scenarios/cycle_thread.hpp"
#include "tests/scenarios/lockstep_process.hpp"

namespace lockstep::test::studio_cycle_test {
namespace {

std::uint16_t port_of_studio(RunningLockstep& run) {
  const std::string mark = "http://127.0.0.1:";
  std::size_t at = std::string::npos;
  const bool is_told = wait_until([&] {
    return (at = run.err().find(mark)) != std::string::npos &&
           run.err().find('/', at + mark.size()) != std::string::npos;
  });
  return is_told ? static_cast<std::uint16_t>(std::stoi(run.err().substr(at + mark.size())))
                 : std::uint16_t{0};
}

/// What a page does with a run, all of it.
void use(std::uint16_t port, int round) {
  StudioConnection page(port);
  ASSERT_EQ(page.upgrade(), 101);
  page.say(R"({"type":"hello"})");
  page.say(R"({"type":"subscribe","id":1,"paths":["Knife.Position","Conveyor.Velocity","gear.InSync"]})");
  page.say(R"({"type":"trigger","action":"arm","kind":"change","path":"cuts","mode":"normal"})");
  ASSERT_NE(page.hear_text("armed"), "");
  StudioConnection client(port);
  // 50 requests that change something are heard in a second.
  const auto is_heard = [](int status) { return status == 200 || status == 429; };
  EXPECT_TRUE(is_heard(client.post("/api/read", R"({"paths":["Knife.ActualPosition","speed"]})").status));
  const std::string write =
      R"({"writes":[{"path":"speed","value":)" + std::to_string(100 + round % 100) + "}]}";
  EXPECT_TRUE(is_heard(client.post("/api/write", write).status));
  EXPECT_EQ(client.get("/api/traces/live/window?signals=Knife.Position&pixels=100").status, 200);
  page.say(R"({"type":"unsubscribe","id":1})");
}

TEST(StudioCycle, AsksTheSystemForNothingWhilePagesComeAndGo) {
  RunningLockstep run(example("02_rotary_knife"), {"--stimuli", "--studio", "127.0.0.1:0"});
  const std::uint16_t port = port_of_studio(run);
  ASSERT_NE(port, 0) << run.err();
  CycleCalls calls(run.pid());
  int rounds = 0;
  // While it is looked at, and for as many pages as go into that time.
  for (const auto begin = Clock::now(); Clock::now() - begin < std::chrono::milliseconds(2500); ++rounds)
    use(port, rounds);
  EXPECT_GT(rounds, 3);
  calls.expect_only_waits();
  run.send(SIGTERM);
  EXPECT_EQ(run.status(), 0) << run.err();
}

}  // namespace
}  // namespace lockstep::test::studio_cycle_test

#endif
