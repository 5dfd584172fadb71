// What the studio says of a run: without a network, and once through one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "projects/runtime/runtime.hpp"
#include "tests/hmi_bridge/studio_client.hpp"
#include "tests/projects/studio_machine.hpp"

namespace lockstep::studio_session_test {
namespace {

using Json = nlohmann::json;
using test::DecodedFrame;

const std::string kKnife = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";

using Client = test::StudioPage;

class Machine : public test::StudioMachine {
 public:
  Machine() : StudioMachine(kKnife) {}
};

TEST(StudioSession, TellsWhatItIsAndWhatTheProjectHas) {
  Machine machine;
  const Json about = machine.get("/api");
  EXPECT_EQ(about["api"], 1);
  EXPECT_EQ(about["project"], "rotary_knife");
  EXPECT_EQ(about["rights"]["write"], false);
  const Json project = machine.get("/api/project");
  EXPECT_EQ(project["objects"][1]["name"], "Knife");
  EXPECT_EQ(project["objects"][1]["type"], "TO_SynchronousAxis");
  EXPECT_EQ(project["tags"][0]["comment"], "from the HMI: the web runs and is cut");
  EXPECT_NE(project["instances"].dump().find("MC_GearInPos"), std::string::npos);
  EXPECT_FALSE(machine.ask("GET", "/api/project").etag.empty());
  EXPECT_EQ(machine.ask("GET", "/api/nothing").status, 404u);
  EXPECT_EQ(machine.ask("DELETE", "/api/project").status, 405u);
}

TEST(StudioSession, FindsSignalsByWordsWithUnitAndMeaning) {
  Machine machine;
  const Json found = machine.get("/api/signals", {{"q", "knife.position"}, {"limit", "5"}});
  ASSERT_FALSE(found["signals"].empty());
  EXPECT_EQ(found["signals"][0]["path"], "Knife.Position");
  EXPECT_EQ(found["signals"][0]["type"], "LREAL");
  EXPECT_FALSE(found["signals"][0]["writable"]);
  EXPECT_NE(found["signals"][0]["why_not_writable"].get<std::string>().find("computed"), std::string::npos);
  EXPECT_EQ(machine.get("/api/signals", {{"q", "speed"}})["signals"][0]["path"], "speed");
  EXPECT_TRUE(machine.get("/api/signals", {{"q", "no such thing"}})["signals"].empty());
  EXPECT_EQ(machine.ask("GET", "/api/signals", {{"limit", "0"}}).status, 422u);
  EXPECT_EQ(machine.ask("GET", "/api/signals", {{"limit", "x"}}).status, 422u);
}

TEST(StudioSession, ReadsEveryPathAsTheSimulationDoes) {
  Machine machine;
  machine.run(1500);
  const std::vector<StudioSignal> all =
      studio_signals(machine.simulation.project(), StudioUnits(machine.simulation.project()));
  ASSERT_GT(all.size(), 500u);
  std::size_t numbers = 0;
  for (std::size_t from = 0; from < all.size(); from += 400) {
    Json paths = Json::array();
    for (std::size_t i = from; i < std::min(from + 400, all.size()); ++i) paths.push_back(all[i].path);
    Json answer;
    StudioRequest request;
    request.method = "POST";
    request.path = "/api/read";
    const std::string body = Json{{"paths", paths}}.dump();
    request.body = body;
    machine.session.answer(request, [&answer](StudioAnswer given) { answer = Json::parse(given.body); });
    EXPECT_TRUE(answer.is_null()) << "the next row answers";
    for (int i = 0; i < 10 && answer.is_null(); ++i) machine.run(1);
    ASSERT_EQ(answer["values"].size(), paths.size()) << answer.dump();
    for (const Json& value : answer["values"]) {
      const double expected = machine.simulation.read(value["path"].get<std::string>());
      const Json& shown = value["value"];
      if (shown.is_boolean()) {
        EXPECT_EQ(shown.get<bool>() ? 1.0 : 0.0, expected) << value;
      } else if (shown.is_number()) {
        EXPECT_EQ(shown.get<double>(), expected) << value;
        ++numbers;
      } else if (shown == "inf" || shown == "-inf" || shown == "nan") {
        EXPECT_FALSE(std::isfinite(expected)) << value;
      } else {
        const double digits = std::stod(shown.get<std::string>());
        EXPECT_EQ(value["type"] == "TIME" ? digits * 1e-9 : digits, expected) << value;
      }
    }
  }
  EXPECT_GT(numbers, 300u);
}

TEST(StudioSession, TellsAllThatIsWrongWithAReading) {
  Machine machine;
  const StudioAnswer answer =
      machine.ask("POST", "/api/read", {}, R"({"paths":["Nife.Position","start","x"]})");
  EXPECT_EQ(answer.status, 422u);
  const Json json = Json::parse(answer.body);
  ASSERT_EQ(json["errors"].size(), 2u);
  EXPECT_EQ(json["errors"][0]["path"], "Nife.Position");
  EXPECT_EQ(json["error"]["code"], "not_found");
  for (const std::string bad :
       {"", "{", "[]", "{}", R"({"paths":[]})", R"({"paths":[1]})", R"({"paths":"x"})"})
    EXPECT_EQ(machine.ask("POST", "/api/read", {}, bad).status, 422u) << bad;
  EXPECT_EQ(machine.ask("POST", "/api/read", {}, std::string(100'000, '[')).status, 422u);
}

TEST(StudioSession, ReadsTheRestWhereThatIsWanted) {
  Machine machine;
  Json told;
  StudioRequest request;
  const std::string body = R"({"paths":["Knife","speed","x"],"partial":true})";
  request.method = "POST";
  request.path = "/api/read";
  request.body = body;
  machine.session.answer(request, [&told](const StudioAnswer& given) { told = Json::parse(given.body); });
  machine.run(10);
  ASSERT_TRUE(told.contains("values")) << told;
  ASSERT_EQ(told["values"].size(), 1u);
  EXPECT_EQ(told["values"][0]["path"], "speed");
  EXPECT_EQ(told["values"][0]["value"], 200.0);
  ASSERT_EQ(told["errors"].size(), 2u);
  EXPECT_EQ(told["errors"][0]["path"], "Knife") << "an axis has no value";
  EXPECT_EQ(machine.ask("POST", "/api/read", {}, R"({"paths":["x"],"partial":true})").status, 422u)
      << "there is no rest";
}

TEST(StudioSession, StreamsWhatAPageSubscribes) {
  Machine machine;
  Client client;
  machine.session.opened(client);
  machine.session.text(client, R"({"type":"subscribe","seq":1,"id":1,"paths":["Knife.Position"]})");
  EXPECT_EQ(client.last("error")["error"]["code"], "not_allowed") << "hello comes first";
  machine.session.text(client, R"({"type":"hello","seq":2})");
  EXPECT_EQ(client.last("hello")["seq"], 2);
  machine.session.text(
      client, R"({"type":"subscribe","seq":3,"id":1,"paths":["Conveyor.Position","nothing","start"]})");
  const Json subscribed = client.last("subscribed");
  EXPECT_EQ(subscribed["seq"], 3);
  EXPECT_EQ(subscribed["signals"][0]["column"], 0);
  EXPECT_EQ(subscribed["signals"][1]["error"]["code"], "not_found");
  EXPECT_EQ(subscribed["signals"][2]["column"], 1);
  EXPECT_EQ(subscribed["signals"][2]["type"], "BOOL");
  std::vector<double> positions;
  for (int tick = 0; tick < 3000; ++tick) {
    machine.run(1);
    for (const DecodedFrame& frame : client.frames) {
      ASSERT_TRUE(frame.is_whole);
      for (std::size_t row = 0; row < frame.t.size(); ++row)
        positions.push_back(frame.columns[0].real(0, row));
      machine.session.text(client, Json{{"type", "ack"}, {"frame", frame.frame}}.dump());
    }
    client.frames.clear();
  }
  ASSERT_GT(positions.size(), 700u);
  EXPECT_EQ(positions.back(), machine.simulation.read("Conveyor.Position"));
  EXPECT_GT(*std::max_element(positions.begin(), positions.end()), 1.0) << "the web has run";
  machine.session.text(client, R"({"type":"unsubscribe","seq":4,"id":1})");
  machine.run(5);
  EXPECT_TRUE(client.frames.empty());
  machine.session.closed(client);
  machine.run(5);
}

TEST(StudioSession, SendsSoManyRowsAsAreWanted) {
  Machine machine;
  Client client;
  machine.session.opened(client);
  machine.session.text(client, R"({"type":"hello"})");
  const auto subscribe = [&](const std::string& how) {
    client.texts.clear();
    machine.session.text(client,
                         R"({"type":"subscribe","seq":1,"id":1,"paths":["Conveyor.Position"],)" + how + "}");
    const Json subscribed = client.last("subscribed");
    return subscribed.is_null() ? Json() : subscribed.at("every");
  };
  EXPECT_EQ(subscribe(R"("every":5)"), 5);
  for (int tick = 0; tick < 500; ++tick) {
    machine.run(1);
    for (const DecodedFrame& frame : client.frames) {
      machine.session.text(client, Json{{"type", "ack"}, {"frame", frame.frame}}.dump());
    }
  }
  std::size_t rows = 0;
  for (const DecodedFrame& frame : client.frames) rows += frame.t.size();
  const std::size_t all = machine.get("/api/traces")["traces"][0]["rows"];
  EXPECT_NEAR(static_cast<double>(rows), static_cast<double>(all) / 5.0, 1.0);
  const std::int64_t cycle = machine.simulation.project().controller->clock.interpolator_cycle();
  EXPECT_EQ(subscribe("\"rate\":" + std::to_string(1e9 / static_cast<double>(8 * cycle))), 8);
  EXPECT_EQ(subscribe(R"("rate":1e9)"), 1) << "faster than there are rows";
  EXPECT_EQ(subscribe(R"("rate":0.000001)"), 10'000);
  for (const std::string wrong :
       {R"("every":0)", R"("every":10001)", R"("every":-1)", R"("every":1.5)", R"("every":"2")",
        R"("rate":0)", R"("rate":-3)", R"("rate":"x")", R"("every":2,"rate":2)"}) {
    subscribe(wrong);
    EXPECT_FALSE(client.last("error").is_null()) << wrong;
  }
}

TEST(StudioSession, AnswersWindowsAndStatisticsOfWhatHasBeen) {
  Machine machine;
  EXPECT_EQ(machine.ask("GET", "/api/traces/live/window").status, 416u) << "nobody has asked for a signal";
  Client client;
  machine.session.opened(client);
  machine.session.text(client, R"({"type":"hello"})");
  machine.session.text(client, R"({"type":"subscribe","id":1,"paths":["Conveyor.Velocity"]})");
  machine.run(3000);
  const Json traces = machine.get("/api/traces");
  EXPECT_GT(traces["traces"][0]["rows"], 1000);
  EXPECT_EQ(traces["traces"][0]["signals"][0]["path"], "Conveyor.Velocity");
  const StudioAnswer window =
      machine.ask("GET", "/api/traces/live/window", {{"signals", "Conveyor.Velocity"}, {"pixels", "100"}});
  ASSERT_EQ(window.status, 200u);
  const DecodedFrame frame(window.body);
  ASSERT_TRUE(frame.is_whole);
  EXPECT_EQ(frame.kind, 3);
  EXPECT_LE(frame.t.size(), 100u);
  const Json statistics = machine.get("/api/traces/live/statistics", {{"signals", "Conveyor.Velocity"}});
  double highest = 0.0;
  for (std::size_t i = 0; i < frame.t.size(); ++i) highest = std::max(highest, frame.columns[0].real(2, i));
  EXPECT_EQ(statistics[0]["maximum"], highest);
  EXPECT_GT(highest, 100.0) << "the web runs";
  EXPECT_EQ(machine.ask("GET", "/api/traces/live/window", {{"signals", "x"}}).status, 422u);
  EXPECT_EQ(machine.ask("GET", "/api/traces/live/window", {}).status, 422u);
  EXPECT_EQ(machine.ask("GET", "/api/traces/live/window", {{"from", "9"}, {"to", "8"}}).status, 416u);
  EXPECT_EQ(machine.ask("GET", "/api/traces/live/window", {{"signals", "Conveyor.Velocity"}, {"pixels", "0"}})
                .status,
            422u);
}

TEST(StudioSession, HasJobsAsBarsAndTellsThem) {
  Machine machine;
  Client client;
  machine.session.opened(client);
  machine.session.text(client, R"({"type":"hello"})");
  machine.run(3000);
  EXPECT_EQ(client.last("event")["event"]["kind"].get<std::string>().substr(0, 3), "job");
  const Json jobs = machine.get("/api/jobs")["jobs"];
  const auto gear =
      std::find_if(jobs.begin(), jobs.end(), [](const Json& job) { return job["instance"] == "gear"; });
  ASSERT_NE(gear, jobs.end());
  EXPECT_EQ((*gear)["object"], "Knife");
  EXPECT_EQ((*gear)["type"], "MC_GearInPos");
  const auto home =
      std::find_if(jobs.begin(), jobs.end(), [](const Json& job) { return job["instance"] == "home_k"; });
  ASSERT_NE(home, jobs.end());
  EXPECT_EQ((*home)["ended"], "job done");
}

TEST(StudioSession, KeepsAlarmsWithCauseAndRemedyUntilTheyAreAcknowledged) {
  StudioHistory history;
  TraceEvent alarm;
  alarm.kind = EventKind::alarm;
  alarm.source = "Knife";
  alarm.number = 521;
  history.add(alarm);
  ASSERT_EQ(history.pending().size(), 1u);
  TraceEvent other = alarm;
  other.source = "Conveyor";
  history.add(other);
  alarm.kind = EventKind::acknowledged;
  history.add(alarm);
  ASSERT_EQ(history.pending().size(), 1u);
  EXPECT_EQ(history.pending()[0].source, "Conveyor");
  EXPECT_EQ(history.events().size(), 3u);
}

TEST(StudioSession, AnAlarmReachesAPageWithItsCause) {
  Machine machine;
  Client client;
  machine.session.opened(client);
  machine.session.text(client, R"({"type":"hello"})");
  TraceEvent alarm;
  alarm.kind = EventKind::alarm;
  alarm.source = "Knife";
  alarm.number = 521;
  alarm.cause = "the axis is blocked";
  alarm.remedy = "free it";
  alarm.value_name = "following error";
  alarm.value = 2.5;
  machine.sink->event(alarm);
  machine.session.look();
  const Json told = client.last("event")["event"];
  EXPECT_EQ(told["cause"], "the axis is blocked");
  EXPECT_EQ(told["remedy"], "free it");
  EXPECT_EQ(told["value"]["value"], 2.5);
  EXPECT_EQ(machine.get("/api/events")["pending"][0]["number"], 521);
}

TEST(StudioSession, RefusesMessagesThatAreNone) {
  Machine machine;
  Client client;
  machine.session.opened(client);
  machine.session.text(client, R"({"type":"hello","token":"wrong"})");
  EXPECT_EQ(client.texts.back()["error"]["code"], "not_allowed");
  machine.session.text(client, R"({"type":"hello"})");
  for (const std::string bad :
       {"", "{", "[]", "7", "{}", R"({"type":1})", R"({"type":"jog"})", R"({"type":"subscribe"})",
        R"({"type":"subscribe","id":-1,"paths":["start"]})", R"({"type":"subscribe","id":1,"paths":7})",
        R"({"type":"ack"})", R"({"type":"ack","frame":"x"})", R"({"type":"ack","frame":99999999999})",
        "{\"type\":\"\xff\"}"}) {
    client.texts.clear();
    machine.session.text(client, bad);
    ASSERT_EQ(client.texts.size(), 1u) << bad;
    EXPECT_EQ(client.texts.back()["type"], "error") << bad;
  }
}

TEST(StudioSession, OfARunInRealTimeAnswersOverTheNetwork) {
  Runtime machine({.file = kKnife,
                   .stimuli = true,
                   .no_modbus = true,
                   .no_lcm = true,
                   .no_retain = true,
                   .studio = "127.0.0.1:0"});
  machine.start();
  ASSERT_TRUE(machine.studio_endpoint());
  test::StudioConnection client(machine.studio_endpoint()->port);
  ASSERT_TRUE(client.is_connected());
  const Json read = Json::parse(client.post("/api/read", R"({"paths":["Knife.Position","start"]})").body);
  EXPECT_EQ(read["values"][1]["path"], "start") << read.dump();
  EXPECT_EQ(client.get("/api/project").status, 200);
  test::StudioConnection page(machine.studio_endpoint()->port);
  ASSERT_EQ(page.upgrade(), 101);
  page.say(R"({"type":"hello","seq":1})");
  EXPECT_NE(page.hear_text("\"hello\""), "");
  page.say(R"({"type":"subscribe","seq":2,"id":4,"paths":["Knife.Position","Conveyor.Position"]})");
  EXPECT_NE(page.hear_text("\"subscribed\""), "");
  std::vector<std::uint64_t> ticks;
  while (ticks.size() < 200) {
    const test::StudioConnection::Message message = page.hear();
    ASSERT_TRUE(message.is_there);
    if (!message.is_binary) continue;
    const DecodedFrame frame(message.bytes);
    ASSERT_TRUE(frame.is_whole);
    EXPECT_EQ(frame.subscription, 4u);
    ticks.insert(ticks.end(), frame.tick.begin(), frame.tick.end());
    page.say(Json{{"type", "ack"}, {"frame", frame.frame}}.dump());
  }
  EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
  machine.stop();
  EXPECT_TRUE(machine.wait());
  EXPECT_TRUE(page.is_closed());
}

TEST(StudioSession, OfARunListensBeyondTheMachineOnlyWithAToken) {
  for (const std::string studio : {"0.0.0.0:0", "[::]:0"}) {
    Runtime machine({.file = kKnife, .no_modbus = true, .no_lcm = true, .no_retain = true, .studio = studio});
    EXPECT_THROW(machine.prepare(), CouldNotStart) << studio;
  }
  Runtime nowhere(
      {.file = kKnife, .no_modbus = true, .no_lcm = true, .no_retain = true, .studio = "127.0.0.1"});
  EXPECT_THROW(nowhere.prepare(), CouldNotStart);
  Runtime no_token({.file = kKnife,
                    .no_modbus = true,
                    .no_lcm = true,
                    .no_retain = true,
                    .studio = "127.0.0.1:0",
                    .studio_token = "/nonexistent/token"});
  EXPECT_THROW(no_token.prepare(), CouldNotStart);
}

}  // namespace
}  // namespace lockstep::studio_session_test
