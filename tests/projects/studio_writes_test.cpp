// Values that pages write, and commands that they give, in virtual time and without a network.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/projects/studio_machine.hpp"

namespace lockstep::studio_writes_test {
namespace {

using Json = nlohmann::json;

constexpr char kProject[] = R"({
  "lockstep": 1, "name": "written", "clock": { "servo_cycle": "2ms" },
  "technology_objects": { "Slide": { "type": "TO_PositioningAxis", "config": { "VirtualAxis": { "Mode": 1 },
    "DynamicDefaults": { "Velocity": 40.0, "Acceleration": 1000.0, "Deceleration": 1000.0, "Jerk": 0.0 } } } },
  "tags": { "speed": { "type": "LREAL", "init": 1.5 }, "count": { "type": "INT" }, "long": { "type": "LINT" },
            "flags": { "type": "WORD", "init": "16#ff00" }, "on": { "type": "BOOL" }, "pause": { "type": "TIME" },
            "product": { "type": "STRING[5]", "init": "ale" }, "list": { "type": "ARRAY[1..3] OF REAL" } },
  "programs": [],
  "studio": { "commands": { "axes": { "Slide": {} } } }
})";

class Machine : public test::StudioMachine {
 public:
  Machine() : StudioMachine(Simulation::from_text(kProject)) {}

  /// The answer to a request to write, as it is after one tick.
  StudioAnswer write(const std::string& body) {
    StudioRequest request;
    request.method = "POST";
    request.path = "/api/write";
    request.body = body;
    request.peer = "192.0.2.7:4242";
    StudioAnswer answer;
    answer.status = 0;
    session.answer(request, [&answer](StudioAnswer given) { answer = std::move(given); });
    if (answer.status == 0) run(1);
    return answer;
  }
  Json written(const std::string& body) {
    const StudioAnswer answer = write(body);
    EXPECT_EQ(answer.status, 200u) << answer.body;
    return Json::parse(answer.body);
  }
  double read(const std::string& path) const { return simulation.read(path); }
};

TEST(StudioWrites, AreRefusedUnlessTheStudioMayWrite) {
  Machine machine;
  const StudioAnswer answer = machine.write(R"({"writes":[{"path":"speed","value":2}]})");
  EXPECT_EQ(answer.status, 403u);
  EXPECT_EQ(Json::parse(answer.body)["error"]["code"], "not_allowed");
  machine.run(2);
  EXPECT_EQ(machine.read("speed"), 1.5);
  EXPECT_EQ(machine.get("/api")["rights"]["write"], false);
  EXPECT_NE(machine.get("/api")["why_not"]["write"].dump().find("--studio-write"), std::string::npos);
}

TEST(StudioWrites, EnterAtOneTickWhichTheAnswerTells) {
  Machine machine;
  machine.empower();
  machine.run(10);
  const Json answer = machine.written(
      R"({"writes":[{"path":"speed","value":2.5},{"path":"count","value":-7},{"path":"on","value":true},
                    {"path":"long","value":"-9007199254740993"},{"path":"pause","value":"1500000000"},
                    {"path":"product","value":"b\u00e4r"},{"path":"list[2]","value":3},
                    {"path":"Slide.Override.Velocity","value":50}]})");
  EXPECT_EQ(answer["tick"], "10");
  EXPECT_EQ(answer["t"], "20000000");
  EXPECT_EQ(answer["writes"][0]["before"], 1.5);
  EXPECT_EQ(answer["writes"][0]["value"], 2.5);
  EXPECT_EQ(answer["writes"][3]["value"], "-9007199254740993");
  EXPECT_EQ(answer["writes"][5]["before"], "ale");
  EXPECT_EQ(answer["writes"][5]["value"], "b\u00e4r");
  EXPECT_EQ(machine.read("speed"), 2.5);
  EXPECT_EQ(machine.read("count"), -7.0);
  EXPECT_EQ(machine.read("on"), 1.0);
  EXPECT_EQ(machine.read("pause"), 1.5);
  EXPECT_EQ(machine.read("list[2]"), 3.0);
  EXPECT_EQ(machine.read("Slide.Override.Velocity"), 50.0);
  EXPECT_EQ(machine.simulation.project().names.find_string("product")->text.view(), "b\xe4r");
}

TEST(StudioWrites, OfATextAreReadAsAText) {
  Machine machine;
  machine.empower();
  machine.run(10);
  const auto read = [&machine] {
    StudioRequest request;
    request.method = "POST";
    request.path = "/api/read";
    request.body = std::string_view(R"({"paths":["count","PRODUCT","speed"]})");
    Json answer;
    machine.session.answer(request, [&answer](StudioAnswer given) { answer = Json::parse(given.body); });
    for (int i = 0; i < 10 && answer.is_null(); ++i) machine.run(1);
    return answer["values"];
  };
  Json values = read();
  ASSERT_EQ(values.size(), 3u) << values;
  EXPECT_EQ(values[1], (Json{{"path", "product"}, {"type", "STRING[5]"}, {"unit", ""}, {"value", "ale"}}));
  EXPECT_EQ(values[2]["value"], 1.5) << "what stands behind it is its own";
  machine.written(R"({"writes":[{"path":"product","value":"b\u00e4r"},{"path":"count","value":3}]})");
  values = read();
  EXPECT_EQ(values[0]["value"], 3);
  EXPECT_EQ(values[1]["value"], "b\u00e4r");
}

TEST(StudioWrites, ChangeTheBitsOfAMask) {
  Machine machine;
  machine.empower();
  const Json answer = machine.written(
      R"({"writes":[{"path":"flags","value":15,"bits":255},{"path":"flags.X15","value":false}]})");
  EXPECT_EQ(machine.read("flags"), 0x7f0f);
  EXPECT_EQ(answer["writes"][1]["before"], true);
  EXPECT_EQ(machine.write(R"({"writes":[{"path":"speed","value":1,"bits":1}]})").status, 422u);
}

TEST(StudioWrites, AreAllRefusedForOneAndToldAllThatIsWrong) {
  Machine machine;
  machine.empower();
  const StudioAnswer answer = machine.write(
      R"({"writes":[{"path":"speed","value":9},{"path":"sped","value":1},{"path":"count","value":40000},
                    {"path":"count","value":1.5},{"path":"Slide.Position","value":1},{"path":"on","value":"yes"},
                    {"path":"Slide.Override.Velocity","value":300},{"path":"product","value":"too long"},{}]})");
  EXPECT_EQ(answer.status, 422u);
  const Json errors = Json::parse(answer.body)["errors"];
  ASSERT_EQ(errors.size(), 8u) << errors;
  const char* const codes[] = {"not_found",  "wrong_type",   "wrong_type",   "not_writable",
                               "wrong_type", "out_of_range", "out_of_range", "bad_request"};
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(errors[i]["code"], codes[i]) << errors[i];
  EXPECT_NE(errors[5]["message"].dump().find("from 0 to 200"), std::string::npos) << errors[5];
  machine.run(2);
  EXPECT_EQ(machine.read("speed"), 1.5);
  for (const char* bad : {"", "[]", "{}", R"({"writes":[]})", R"({"writes":7})"})
    EXPECT_EQ(machine.write(bad).status, 422u) << bad;
  std::string many = R"({"writes":[)";
  for (int i = 0; i < 1001; ++i) many += std::string(i == 0 ? "" : ",") + R"({"path":"speed","value":1})";
  EXPECT_EQ(Json::parse(machine.write(many + "]}").body)["error"]["code"], "too_many");
}

TEST(StudioWrites, HaveNoKeyTwiceAndNoneThatIsUnknown) {
  Machine machine;
  machine.empower();
  const auto refusal_of = [&](const char* body) {
    const StudioAnswer answer = machine.write(body);
    EXPECT_EQ(answer.status, 422u) << body;
    return Json::parse(answer.body)["error"].value("message", "");
  };
  EXPECT_EQ(refusal_of(R"({"writes":[{"path":"speed","value":1,"value":2}]})"),
            "the key 'value' is there twice");
  EXPECT_EQ(refusal_of(R"({"writes":[{"path":"speed","value":2}],"writes":[{"path":"count","value":2}]})"),
            "the key 'writes' is there twice");
  EXPECT_EQ(refusal_of(R"({"writes":[{"path":"speed","value":2,"bit":1}]})"),
            "unknown key 'bit'; allowed: path, value, bits");
  EXPECT_EQ(refusal_of(R"({"writes":[{"path":"speed","value":2}],"write":[]})"),
            "unknown key 'write'; allowed: writes");
  machine.run(2);
  EXPECT_EQ(machine.read("speed"), 1.5);
}

TEST(StudioWrites, ThatAreNoJsonAreToldInPlainWords) {
  Machine machine;
  machine.empower();
  for (const char* const body :
       {"", "{", "{\"writes\":[}", "\xff", "{\"writes\":[{\"path\":\"speed\",\"value\":1e999}]}"}) {
    const std::string message = Json::parse(machine.write(body).body)["error"].value("message", "");
    EXPECT_EQ(message.find("json.exception"), std::string::npos) << message;
    EXPECT_TRUE(message.starts_with("this is no JSON: ")) << message;
  }
}

/// What the simulation takes of its own writes is what pages may write, and the other way round.
TEST(StudioWrites, AreCheckedAsThoseOfAProgramThatEmbedsTheRun) {
  Machine machine;
  machine.empower();
  const double numbers[] = {0.0, 1.0, -1.0, 0.5, 200.0, 201.0, 32767.0, 32768.0, 65535.0, 1e300, -1e300};
  for (const std::string path :
       {"speed", "count", "flags", "on", "list[1]", "list[4]", "Slide.Override.Velocity", "Slide.Position",
        "Slide.DynamicLimits.MaxVelocity", "flags.X3"})
    for (const double number : numbers) {
      bool taken = true;
      try {
        machine.simulation.write(path, number);
      } catch (const std::logic_error&) {
        taken = false;
      }
      const Json body = {{"writes", {{{"path", path}, {"value", number}}}}};
      EXPECT_EQ(machine.write(body.dump()).status == 200u, taken) << path << " = " << number;
    }
}

TEST(StudioWrites, AndRefusalsAreEventsWithTheAddressOfTheClient) {
  Machine machine;
  machine.empower();
  machine.written(R"({"writes":[{"path":"speed","value":2.5}]})");
  machine.write(R"({"writes":[{"path":"Slide.Position","value":2.5}]})");
  machine.run(1);
  const Json events = machine.get("/api/events")["events"];
  ASSERT_EQ(events.size(), 2u) << events;
  EXPECT_EQ(events[0]["kind"], "written");
  EXPECT_EQ(events[0]["source"], "speed");
  EXPECT_EQ(events[0]["text"], "1.5 → 2.5");
  EXPECT_EQ(events[0]["address"], "192.0.2.7:4242");
  EXPECT_EQ(events[1]["kind"], "write refused");
  EXPECT_EQ(events[1]["source"], "Slide.Position");
  EXPECT_EQ(events[1]["address"], "192.0.2.7:4242");
}

class Panel {
 public:
  explicit Panel(Machine& machine) : machine_(machine) {
    machine.session.opened(page);
    machine.session.text(page, R"({"type":"hello"})");
  }
  ~Panel() { close(); }
  void close() {
    if (open_) machine_.session.closed(page);
    open_ = false;
  }
  Json command(const std::string& action, double value = 0.0) {
    const Json told = page.last("panel").is_null() ? page.last("hello") : page.last("panel");
    const Json& panel = told["panels"][0];
    Json message = {{"type", "command"},    {"axis", "Slide"},         {"action", action},
                    {"value", value},       {"sequence", ++sequence_}, {"run", panel["run"]},
                    {"beat", panel["beat"]}};
    machine_.session.text(page, message.dump());
    return page.last("command");
  }

  test::StudioPage page;

 private:
  Machine& machine_;
  int sequence_ = 0;
  bool open_ = true;
};

TEST(StudioCommands, AreRefusedUnlessTheStudioMayCommand) {
  Machine machine;
  Panel panel(machine);
  machine.session.text(
      panel.page, R"({"type":"command","axis":"Slide","action":"enable","run":1,"beat":1,"sequence":1})");
  EXPECT_EQ(panel.page.last("command")["accepted"], false);
  EXPECT_EQ(panel.page.last("hello")["rights"]["command"], false);
  machine.run(50);
  EXPECT_EQ(machine.read("Slide.StatusWord.X0"), 0.0);
}

TEST(StudioCommands, EnableAndJogAsLongAsTheyAreRepeated) {
  Machine machine;
  machine.empower();
  Panel panel(machine);
  EXPECT_EQ(panel.page.last("hello")["rights"]["command"], true);
  EXPECT_EQ(panel.command("enable")["accepted"], true);
  machine.run(50);
  EXPECT_EQ(machine.read("Slide.StatusWord.X0"), 1.0);
  for (int i = 0; i < 5; ++i) {
    ASSERT_EQ(panel.command("jog forward", 20.0)["accepted"], true);
    machine.run(50);
    EXPECT_EQ(machine.read("Slide.VelocitySetpoint"), 20.0);
  }
  machine.run(110);
  EXPECT_LT(machine.read("Slide.VelocitySetpoint"), 20.0) << "300 ms without one brake it";
  machine.run(100);
  EXPECT_EQ(machine.read("Slide.VelocitySetpoint"), 0.0);
}

TEST(StudioCommands, APageThatGoesStopsWhatItJogs) {
  Machine machine;
  machine.empower();
  Panel first(machine), second(machine);
  first.command("enable");
  machine.run(50);
  first.command("jog forward", 20.0);
  machine.run(20);
  const Json refused = second.command("jog backward", 20.0);
  EXPECT_EQ(refused["accepted"], false);
  EXPECT_NE(refused["reason"].dump().find("another panel"), std::string::npos);
  second.close();
  machine.run(20);
  EXPECT_EQ(machine.read("Slide.VelocitySetpoint"), 20.0) << "the jog was not its own";
  first.close();
  machine.run(25);
  EXPECT_EQ(machine.read("Slide.VelocitySetpoint"), 0.0) << "long before the deadman";
}

TEST(StudioCommands, StopIsHeardWhateverElseIsWrongWithIt) {
  Machine machine;
  machine.empower();
  Panel first(machine), second(machine);
  first.command("enable");
  machine.run(50);
  first.command("jog forward", 20.0);
  machine.run(20);
  machine.session.text(second.page, R"({"type":"command","axis":"Slide","action":"stop"})");
  EXPECT_EQ(second.page.last("command")["accepted"], true);
  machine.run(25);
  EXPECT_EQ(machine.read("Slide.VelocitySetpoint"), 0.0);
}

TEST(StudioCommands, OfAnotherRunOrRepeatedOnesMoveNothing) {
  Machine machine;
  machine.empower();
  Panel panel(machine);
  panel.command("enable");
  machine.run(50);
  const Json stand = panel.page.last("hello")["panels"][0];
  Json message = {{"type", "command"}, {"axis", "Slide"}, {"action", "jog forward"}, {"value", 20.0},
                  {"sequence", 9},     {"run", "17"},     {"beat", stand["beat"]}};
  machine.session.text(panel.page, message.dump());
  EXPECT_EQ(panel.page.last("command")["accepted"], false);
  message["run"] = stand["run"];
  message["sequence"] = 1;
  machine.session.text(panel.page, message.dump());
  EXPECT_EQ(panel.page.last("command")["accepted"], false) << "repeated";
  message["sequence"] = 10;
  message["value"] = 41.0;
  machine.session.text(panel.page, message.dump());
  EXPECT_EQ(panel.page.last("command")["accepted"], false) << "faster than jogging goes";
  message["axis"] = "Sled";
  machine.session.text(panel.page, message.dump());
  EXPECT_EQ(panel.page.last("command")["accepted"], false);
  for (const char* bad : {R"({"type":"command"})", R"({"type":"command","action":"fly","axis":"Slide"})",
                          R"({"type":"command","action":"reset","axis":7})",
                          R"({"type":"command","action":"reset","axis":"Slide","run":"x"})"}) {
    panel.page.texts.clear();
    machine.session.text(panel.page, bad);
    EXPECT_FALSE(panel.page.last("error").is_null()) << bad;
  }
  machine.run(100);
  EXPECT_EQ(machine.read("Slide.VelocitySetpoint"), 0.0);
  const std::string events = machine.get("/api/events").dump();
  EXPECT_NE(events.find("command refused"), std::string::npos);
  EXPECT_NE(events.find("192.0.2.7:4242"), std::string::npos);
}

TEST(StudioCommands, HomeAndOverride) {
  Machine machine;
  machine.empower();
  Panel panel(machine);
  panel.command("enable");
  machine.run(50);
  EXPECT_EQ(panel.command("home", 12.5)["accepted"], true);
  EXPECT_EQ(panel.command("override", 60.0)["accepted"], true);
  machine.run(50);
  EXPECT_EQ(machine.read("Slide.Position"), 12.5);
  EXPECT_EQ(machine.read("Slide.Override.Velocity"), 60.0);
  EXPECT_EQ(panel.command("reset")["accepted"], true);
}

}  // namespace
}  // namespace lockstep::studio_writes_test
