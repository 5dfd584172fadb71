// A simulation that a studio drives: forwards, and backwards by running it once more.
#include "projects/runtime/desk_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "projects/loader/simulation.hpp"
#include "tests/projects/studio_files.hpp"
#include "tests/projects/studio_machine.hpp"

namespace lockstep::desk_run_test {
namespace {

using Json = nlohmann::json;

const std::string kKnife = LOCKSTEP_SOURCE_DIR "/projects/02_rotary_knife/project.json";
constexpr std::int64_t kSecond = 1'000'000'000;
const std::vector<std::string> kPaths = {"Knife.Position",    "Knife.Velocity", "Conveyor.Position",
                                         "Conveyor.Velocity", "speed",          "cuts"};

class Desk {
 public:
  explicit Desk(const std::string& file = kKnife) : handler({.file = file}) {
    handler.opened(page);
    handler.text(page, R"({"type":"hello"})");
  }
  ~Desk() { handler.closed(page); }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  StudioAnswer ask(const std::string& method, const std::string& path, const std::string& body = "") {
    StudioRequest request;
    request.method = method;
    request.path = path;
    request.body = body;
    request.peer = "192.0.2.7:4242";
    StudioAnswer answer;
    bool is_answered = false;
    handler.answer(request, [&](StudioAnswer given) {
      answer = std::move(given);
      is_answered = true;
    });
    while (!is_answered) look();
    return answer;
  }
  StudioAnswer simulate(const Json& request) { return ask("POST", "/api/simulation", request.dump()); }
  Json state() { return Json::parse(ask("GET", "/api/simulation").body); }
  /// Goes to a time, either way, and waits until it is there.
  void seek(std::int64_t t) {
    const StudioAnswer answer = simulate({{"action", "seek"}, {"t", std::to_string(t)}});
    ASSERT_EQ(answer.status, 200u) << answer.body;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    Json now;
    do {
      look();
      now = state();
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << now;
    } while (now["state"] != "paused" || now["t"] != std::to_string(t));
  }
  std::vector<double> values() {
    const Json read = Json::parse(ask("POST", "/api/read", Json{{"paths", kPaths}}.dump()).body);
    std::vector<double> values;
    for (const Json& one : read.at("values")) values.push_back(one.at("value").get<double>());
    return values;
  }
  void write(const std::string& path, double value) {
    const StudioAnswer answer =
        ask("POST", "/api/write", Json{{"writes", {{{"path", path}, {"value", value}}}}}.dump());
    EXPECT_EQ(answer.status, 200u) << answer.body;
  }
  void look() {
    handler.look();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  DeskHandler handler;
  test::StudioPage page;
};

/// The same by itself: written at 3 s, values at a time.
std::vector<double> straight(std::int64_t t) {
  Simulation simulation(kKnife);
  simulation.run_for(std::chrono::nanoseconds(std::min(t, 3 * kSecond)));
  if (t > 3 * kSecond) {
    simulation.write("speed", 250.0);
    simulation.run_for(std::chrono::nanoseconds(t - 3 * kSecond));
  }
  std::vector<double> values;
  for (const std::string& path : kPaths) values.push_back(simulation.read(path));
  return values;
}

TEST(DeskRun, SeeksForwardsAndBackwardsToTheBitWithWhatWasWritten) {
  Desk desk;
  desk.seek(3 * kSecond);
  desk.write("speed", 250.0);
  desk.seek(5 * kSecond);
  EXPECT_EQ(desk.values(), straight(5 * kSecond));
  desk.seek(8 * kSecond);
  EXPECT_EQ(desk.values(), straight(8 * kSecond));
  desk.seek(5 * kSecond);
  EXPECT_EQ(desk.values(), straight(5 * kSecond)) << "backwards";
  EXPECT_FALSE(desk.page.last("restarted").is_null()) << "pages say hello again";
  desk.seek(8 * kSecond);
  EXPECT_EQ(desk.values(), straight(8 * kSecond)) << "and on from there";
  desk.seek(2 * kSecond);
  EXPECT_EQ(desk.values(), straight(2 * kSecond)) << "before it was written";
  desk.seek(4 * kSecond);
  EXPECT_EQ(desk.values()[4], 200.0) << "what lies behind the time that one went back to has not happened";
}

TEST(DeskRun, RecordsOnItsWayBackWhatWasRecordedBefore) {
  Desk desk;
  desk.handler.text(desk.page, R"({"type":"subscribe","id":1,"paths":["Knife.Position"]})");
  desk.look();
  desk.seek(4 * kSecond);
  // Rows that have been recorded are read within a while.
  const auto last_row = [&desk](const std::string& expected) {
    std::string to;
    for (int i = 0; i < 2000 && to != expected; ++i) {
      desk.look();
      const Json traces = Json::parse(desk.ask("GET", "/api/traces").body);
      to = traces.at("traces").at(0).value("to", "");
    }
    return to;
  };
  EXPECT_EQ(last_row("3998000000"), "3998000000");
  desk.seek(1 * kSecond);
  EXPECT_EQ(last_row("998000000"), "998000000");
}

TEST(DeskRun, DoesNotRepeatWhatWasCommandedByHand) {
  Desk desk;
  desk.seek(1 * kSecond);
  const Json hello = desk.page.last("hello");
  const Json& panel = hello.at("panels").at(0);
  Json command = {{"type", "command"}, {"axis", panel.at("axis")}, {"action", "override"},
                  {"value", 50.0},     {"run", panel.at("run")},   {"beat", panel.at("beat")},
                  {"sequence", 1}};
  desk.handler.text(desk.page, command.dump());
  ASSERT_EQ(desk.page.last("command").value("accepted", false), true) << desk.page.texts.back();
  desk.seek(2 * kSecond);
  const StudioAnswer back = desk.simulate({{"action", "seek"}, {"t", "1000000000"}});
  EXPECT_EQ(back.status, 409u);
  EXPECT_NE(back.body.find("by hand"), std::string::npos) << back.body;
  EXPECT_EQ(desk.state()["t"], "2000000000") << "it stays where it is";
  EXPECT_EQ(desk.simulate({{"action", "restart"}}).status, 200u);
  desk.look();
  EXPECT_EQ(desk.state()["t"], "0");
  desk.seek(1 * kSecond);
  desk.seek(kSecond / 2);
}

TEST(DeskRun, TellsWhyAProjectThatHasBecomeInvalidIsNotBegunAnew) {
  const test::StudioFolder folder;
  std::ifstream knife(kKnife);
  const std::string whole((std::istreambuf_iterator<char>(knife)), std::istreambuf_iterator<char>());
  const std::string file = folder.write("project.json", whole);
  Desk desk(file);
  desk.seek(kSecond / 10);
  std::string wrong = whole;
  for (const std::string_view type : {"LREAL", "BOOL"}) {
    const std::size_t at = wrong.find("\"type\": \"" + std::string(type) + '"');
    ASSERT_NE(at, wrong.npos);
    wrong.replace(at + 9, type.size(), "FLOAT");
  }
  for (const std::string& content : {wrong, std::string("{"), std::string()}) {
    folder.write("project.json", content);
    for (const Json& ask : {Json{{"action", "restart"}}, Json{{"action", "seek"}, {"t", "1000000"}}}) {
      const StudioAnswer answer = desk.simulate(ask);
      EXPECT_EQ(answer.status, 422u) << answer.body;
      const Json errors = Json::parse(answer.body).at("errors");
      EXPECT_EQ(errors.at(0).at("code"), "invalid_project");
      EXPECT_GE(errors.size(), content == wrong ? 2u : 1u) << errors;
      desk.look();
      EXPECT_EQ(desk.state().at("t"), "100000000") << "it stays where it is";
    }
  }
  std::filesystem::remove(file);
  EXPECT_EQ(desk.simulate({{"action", "restart"}}).status, 422u);
  folder.write("project.json", whole);
  EXPECT_EQ(desk.simulate({{"action", "restart"}}).status, 200u);
  desk.look();
  EXPECT_EQ(desk.state().at("t"), "0");
}

}  // namespace
}  // namespace lockstep::desk_run_test
