// What the studio keeps and hands out of a run: values to the bit, and what triggers catch.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "projects/studio/shots.hpp"
#include "projects/studio/trigger.hpp"
#include "tests/projects/studio_machine.hpp"

namespace lockstep::studio_trace_test {
namespace {

using Json = nlohmann::json;
using test::DecodedFrame;
using test::StudioMachine;
using test::StudioPage;

const std::string kKnife = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";
const std::string kSignals = "Knife.Position,Conveyor.Velocity,gear.InSync,Knife.StatusWord,cuts";

/// A page that has said hello and subscribes these paths.
void subscribe(StudioMachine& machine, StudioPage& page, const std::string& paths) {
  machine.session.opened(page);
  machine.session.text(page, R"({"type":"hello"})");
  Json list = Json::array();
  for (std::size_t at = 0; at < paths.size();) {
    const std::size_t end = std::min(paths.find(',', at), paths.size());
    list.push_back(paths.substr(at, end - at));
    at = end + 1;
  }
  machine.session.text(page, Json{{"type", "subscribe"}, {"id", 1}, {"paths", list}}.dump());
}

TEST(StudioTrace, IsExportedInPartsAndNotBeyondALimit) {
  StudioMachine machine(kKnife);
  StudioPage page;
  subscribe(machine, page, kSignals);
  machine.run(600);
  const StudioAnswer part = machine.ask("GET", "/api/traces/live/export",
                                        {{"signals", "cuts"}, {"from", "400000000"}, {"to", "407999999"}});
  EXPECT_EQ(part.body, "t,cuts\n0.4,0\n0.402,0\n0.404,0\n0.406,0\n");
  EXPECT_EQ(machine.ask("GET", "/api/traces/live/export", {{"signals", "cuts"}, {"format", "xls"}}).status,
            422u);
  EXPECT_EQ(machine.ask("GET", "/api/traces/live/other", {{"signals", "cuts"}}).status, 404u);
  EXPECT_EQ(machine.ask("GET", "/api/traces/shot-9/window", {{"signals", "cuts"}}).status, 404u);
  EXPECT_EQ(machine.ask("GET", "/api/traces/live", {{"signals", "cuts"}}).status, 404u);
}

TEST(StudioTrigger, JudgesEachKindByItsRule) {
  using Kind = StudioTriggerKind;
  const auto occasions = [](const StudioTrigger::Condition& condition, const std::vector<double>& values) {
    StudioTrigger trigger(condition);
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (trigger.judge(values[i])) found.push_back(i);
    return found;
  };
  using Rows = std::vector<std::size_t>;
  EXPECT_EQ(occasions({Kind::above, 1.0}, {0, 1, 2, 2, 0}), (Rows{2, 3}));
  EXPECT_EQ(occasions({Kind::below, 1.0}, {0, 1, 2, -1}), (Rows{0, 3}));
  EXPECT_EQ(occasions({Kind::rising, 1.0}, {2, 0, 2, 3, 1, 2}), (Rows{2, 5}))
      << "what is above has not risen";
  EXPECT_EQ(occasions({Kind::falling, 1.0}, {0, 2, 0, 1, 0}), (Rows{2, 4}));
  EXPECT_EQ(occasions({Kind::rising, 1.0, 0.0, 0.5}, {0, 2, 0.8, 2, 0.5, 2}), (Rows{1, 5})) << "hysteresis";
  EXPECT_EQ(occasions({Kind::falling, 1.0, 0.0, 0.5}, {2, 0, 1.2, 0, 1.5, 0}), (Rows{1, 5}));
  EXPECT_EQ(occasions({Kind::change}, {3, 3, 4, 4, 3}), (Rows{2, 4}));
  EXPECT_EQ(occasions({Kind::outside, -1.0, 1.0}, {0, 1, 1.1, -1, -2}), (Rows{2, 4}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(occasions({Kind::rising, 1.0}, {0, nan, 2}), (Rows{2})) << "what is no number changes nothing";
  EXPECT_EQ(occasions({Kind::alarm}, {0, 1, 2}), Rows{});
  // Whole numbers to their last digit.
  const auto whole = [](const StudioTrigger::Condition& condition, const std::vector<std::uint64_t>& values) {
    StudioTrigger trigger(condition);
    Rows found;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (trigger.judge(Value{.u = values[i]}, Type::LWORD)) found.push_back(i);
    return found;
  };
  const std::uint64_t far = std::uint64_t{1} << 60;
  EXPECT_EQ(whole({.kind = Kind::change}, {far, far + 1, far + 1}), Rows{1});
  EXPECT_EQ(whole({.kind = Kind::bits, .mask = 6, .wanted = 2}, {0, 2, 3, 6, 4, far + 2}), (Rows{1, 2, 5}));
  EXPECT_EQ(whole({.kind = Kind::bits, .mask = far + 1, .wanted = far}, {far, far + 1, 0}), Rows{0});
}

TEST(StudioTrigger, CatchesWhatHappenedBeforeAndAfterItsOccasion) {
  StudioMachine machine(kKnife);
  StudioPage page;
  subscribe(machine, page, "Knife.Position,Conveyor.Velocity");
  machine.session.text(page, R"({"type":"trigger","seq":7,"action":"arm","kind":"rising","path":"gear.InSync",
    "level":0.5,"before":100000000,"after":50000000})");
  EXPECT_EQ(page.last("trigger")["state"], "armed") << page.texts.back();
  EXPECT_EQ(page.last("trigger")["seq"], 7);
  machine.run(4000);
  const Json shot = page.last("shot");
  ASSERT_EQ(shot["id"], "shot-1");
  EXPECT_EQ(shot["reason"], "gear.InSync rising");
  const std::int64_t t = std::stoll(shot["t"].get<std::string>());
  const Json traces = machine.get("/api/traces")["traces"];
  ASSERT_EQ(traces.size(), 2u) << "once, as it is a single one";
  EXPECT_EQ(traces[1]["from"], std::to_string(t - 100'000'000));
  EXPECT_EQ(traces[1]["to"], std::to_string(t + 50'000'000));
  // It has all that was looked at, and the signal of the trigger, which nobody looks at.
  const DecodedFrame frame(
      machine.ask("GET", "/api/traces/shot-1/window", {{"signals", "gear.InSync,Knife.Position"}}).body);
  ASSERT_EQ(frame.t.size(), 76u);
  for (std::size_t i = 0; i < frame.t.size(); ++i)
    EXPECT_EQ(frame.columns[0].arrays[0][i] != 0, frame.t[i] >= t) << i;
  EXPECT_EQ(machine.get("/api/traces/shot-1/statistics", {{"signals", "Knife.Position"}})[0]["n"], 76);
}

TEST(StudioTrigger, WaitsAgainAndIsDisarmed) {
  StudioMachine machine(kKnife);
  StudioPage page;
  subscribe(machine, page, "cuts");
  machine.session.text(
      page,
      R"({"type":"trigger","action":"arm","kind":"change","path":"cuts","after":2000000,"mode":"normal"})");
  machine.run(6000);
  const std::size_t shots = machine.get("/api/traces")["traces"].size() - 1;
  EXPECT_EQ(static_cast<double>(shots), machine.simulation.read("cuts")) << "one for each cut";
  EXPECT_GT(shots, 2u);
  machine.session.text(page, R"({"type":"trigger","action":"disarm"})");
  EXPECT_EQ(page.last("trigger")["state"], "disarmed");
  machine.run(3000);
  EXPECT_EQ(machine.get("/api/traces")["traces"].size() - 1, shots);
  machine.session.closed(page);
  machine.run(5);
}

TEST(StudioTrigger, TakesASecondConditionAndBits) {
  StudioMachine machine(kKnife);
  StudioPage page;
  subscribe(machine, page, "cuts");
  // A cut while the web runs faster than it does before 6 s.
  machine.session.text(page,
                       R"({"type":"trigger","action":"arm","kind":"change","path":"cuts","mode":"normal",
    "and":{"kind":"above","path":"Conveyor.Velocity","level":250}})");
  EXPECT_EQ(page.last("trigger")["state"], "armed") << page.texts.back();
  machine.run(5900);
  EXPECT_TRUE(page.last("shot").is_null());
  machine.run(2000);
  ASSERT_FALSE(page.last("shot").is_null());
  EXPECT_GT(std::stoll(page.last("shot")["t"].get<std::string>()), 6'000'000'000);
  const std::string id = page.last("shot")["id"];
  const Json seen = machine.get("/api/traces/" + id + "/statistics", {{"signals", "Conveyor.Velocity"}});
  EXPECT_GT(seen[0]["first"].get<double>(), 250.0) << "it is caught, too, though nobody has subscribed to it";
  // Homed, and in standstill no more.
  machine.session.text(
      page,
      R"({"type":"trigger","action":"arm","kind":"bits","path":"Knife.StatusWord","mask":"160","value":32})");
  EXPECT_EQ(page.last("trigger")["state"], "armed") << page.texts.back();
  machine.run(50);
  EXPECT_EQ(page.last("shot")["reason"], "Knife.StatusWord bits");
}

TEST(StudioTrigger, ComesByItselfWhereNothingHappens) {
  StudioMachine machine(kKnife);
  StudioPage page;
  subscribe(machine, page, "cuts");
  machine.run(10);
  machine.session.text(
      page, R"({"type":"trigger","action":"arm","kind":"above","path":"Knife.Position","level":1000,
    "mode":"auto","auto":100000000,"after":10000000})");
  machine.run(90);
  EXPECT_TRUE(page.last("shot").is_null());
  machine.run(40);
  EXPECT_EQ(page.last("shot")["reason"], "Knife.Position above, by itself");
  EXPECT_EQ(page.last("shot")["id"], "shot-1");
  machine.run(240);
  EXPECT_EQ(page.last("shot")["id"], "shot-3") << "again and again";
  // What does happen comes first.
  machine.session.text(page,
                       R"({"type":"trigger","action":"arm","kind":"job","mode":"auto","auto":10000000000})");
  machine.run(1500);
  EXPECT_EQ(page.last("shot")["reason"], "job");
}

TEST(StudioTrigger, IsForcedAndWaitsForAlarmsAndJobs) {
  StudioMachine machine(kKnife);
  StudioPage page;
  subscribe(machine, page, "Knife.Position");
  machine.run(10);
  machine.session.text(page, R"({"type":"trigger","action":"arm","kind":"alarm","before":10000000})");
  machine.run(10);
  EXPECT_TRUE(page.last("shot").is_null());
  machine.session.text(page, R"({"type":"trigger","action":"force"})");
  machine.run(10);
  EXPECT_EQ(page.last("shot")["reason"], "alarm");
  machine.session.text(page, R"({"type":"trigger","action":"arm","kind":"job"})");
  machine.run(1500);
  EXPECT_EQ(page.last("shot")["reason"], "job") << "the web starts after half a second";
  EXPECT_EQ(page.last("shot")["id"], "shot-2");
}

TEST(StudioTrigger, IsRefusedWithWhatIsAllowed) {
  StudioMachine machine(kKnife);
  StudioPage page;
  subscribe(machine, page, "cuts");
  for (const std::string bad :
       {R"({"type":"trigger"})",
        R"({"type":"trigger","action":"shoot"})",
        R"({"type":"trigger","action":"force"})",
        R"({"type":"trigger","action":"arm","kind":"sideways","path":"cuts"})",
        R"({"type":"trigger","action":"arm","kind":"rising","path":"no.such"})",
        R"({"type":"trigger","action":"arm","kind":"rising"})",
        R"({"type":"trigger","action":"arm","path":7})",
        R"({"type":"trigger","action":"arm","path":"cuts","level":"high"})",
        R"({"type":"trigger","action":"arm","path":"cuts","before":-1})",
        R"({"type":"trigger","action":"arm","path":"cuts","before":30000000000,"after":30000000000})",
        R"({"type":"trigger","action":"arm","path":"cuts","hysteresis":-1})",
        R"({"type":"trigger","action":"arm","path":"cuts","kind":"outside","level":2,"upper":1})",
        R"({"type":"trigger","action":"arm","path":"cuts","kind":"bits","mask":0,"value":0})",
        R"({"type":"trigger","action":"arm","path":"cuts","kind":"bits","mask":1,"value":2})",
        R"({"type":"trigger","action":"arm","path":"cuts","kind":"bits","mask":-1,"value":0})",
        R"({"type":"trigger","action":"arm","path":"cuts","kind":"bits","mask":"x","value":0})",
        R"({"type":"trigger","action":"arm","path":"cuts","kind":"bits"})",
        R"({"type":"trigger","action":"arm","path":"speed","kind":"bits","mask":1,"value":1})",
        R"({"type":"trigger","action":"arm","path":"cuts","and":7})",
        R"({"type":"trigger","action":"arm","path":"cuts","and":{"kind":"above"}})",
        R"({"type":"trigger","action":"arm","path":"cuts","and":{"kind":"rising","path":"speed"}})",
        R"({"type":"trigger","action":"arm","path":"cuts","and":{"kind":"above","path":"no.such"}})",
        R"({"type":"trigger","action":"arm","path":"cuts","mode":"auto","auto":0})",
        R"({"type":"trigger","action":"arm","path":"cuts","mode":"auto","auto":-1})",
        R"({"type":"trigger","action":"arm","path":"cuts","mode":"sometimes"})"}) {
    page.texts.clear();
    machine.session.text(page, bad);
    ASSERT_EQ(page.texts.size(), 1u) << bad;
    EXPECT_EQ(page.texts.back()["type"], "error") << bad;
  }
}

TEST(StudioShots, KeepTheNewest) {
  StudioShots shots;
  for (int i = 0; i < 60; ++i) shots.add("x", i, TraceStore());
  EXPECT_EQ(shots.all().size(), StudioShots::kShots);
  EXPECT_EQ(shots.find("shot-10"), nullptr);
  ASSERT_NE(shots.find("shot-60"), nullptr);
  EXPECT_EQ(shots.find("shot-60")->t, 59);
}

}  // namespace
}  // namespace lockstep::studio_trace_test
