// System files: what they come to, and what is wrong with them is told with file and place.
#include "projects/system/system.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "projects/loader/project_schema.hpp"
#include "schema_check.hpp"
#include "system_files.hpp"

namespace lockstep::system_test {
namespace {

using test::ControllerFile;
using test::SystemFiles;
using test::SystemJson;
using json = nlohmann::json;

ControllerFile source() {
  ControllerFile file("infeed");
  file.axis("Conveyor");
  file.axis("Near");
  file.provide("Conveyor", 0.002);
  file.gear("Near", "Conveyor", 1, 1, "delayed");
  return file;
}

ControllerFile receiver(const std::string& cycle = "1ms") {
  ControllerFile file("press", cycle);
  file.axis("Press");
  file.proxy("Line");
  file.gear("Press", "Line");
  return file;
}

/// Two controllers and what is between them.
SystemFiles two() {
  SystemFiles files;
  files.add("PLC_1", source());
  files.add("PLC_2", receiver());
  files.area("line", "PLC_1.Conveyor", {"PLC_2.Line"});
  return files;
}

TEST(System, IsWhatItsFileSays) {
  SystemFiles files = two();
  files.json["simulated_network"] = {{"latency", "300us"}, {"jitter", "100us"}, {"loss", 0.001}, {"seed", 7}};
  files.json["controllers"]["PLC_2"]["phase"] = "300us";
  files.json["delays"] = {{"fixed", {"PLC_1.Conveyor"}}, {"left_out", {"PLC_2.Press"}}};
  const LoadedSystem loaded = load_system_file(files.path());
  ASSERT_TRUE(loaded.system) << to_string("system.json", loaded.problems[0]);
  EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings[0].text;
  const System& system = *loaded.system;
  EXPECT_EQ(system.name, "test");
  ASSERT_EQ(system.controllers.size(), 2u);
  EXPECT_EQ(system.controllers[1].name, "PLC_2");
  EXPECT_EQ(system.controllers[1].phase, 300'000);
  EXPECT_EQ(system.controllers[1].project.controller->shared_time_at_start, 300'000);
  EXPECT_EQ(system.find("plc_1"), 0u);
  EXPECT_FALSE(system.find("PLC_3"));
  ASSERT_EQ(system.areas.size(), 1u);
  EXPECT_EQ(system.areas[0].from->name, "Conveyor");
  EXPECT_EQ(system.areas[0].to[0].controller, 1u);
  EXPECT_EQ(system.areas[0].to[0].proxy->name, "Line");
  EXPECT_EQ(system.simulated_network.latency, 300'000);
  EXPECT_EQ(system.simulated_network.loss, 0.001);
  EXPECT_EQ(system.simulated_network.seed, 7u);
  EXPECT_EQ(system.delays.fixed[0].object->name, "Conveyor");
  EXPECT_EQ(system.delays.left_out[0].object->name, "Press");
  EXPECT_EQ(full_name(system.controllers[0], *system.areas[0].from), "PLC_1.Conveyor");
}

TEST(System, NamesTheChannelOfAnAreaWithItself) {
  SystemFiles files = two();
  const std::string longest(58, 'x');
  files.json["name"] = longest;  // and ".line": 63 bytes, as LCM permits
  EXPECT_TRUE(load_system_file(files.path()).system);
  files.json["name"] = longest + "x";
  const LoadedSystem loaded = load_system_file(files.path());
  ASSERT_EQ(loaded.problems.size(), 1u);
  EXPECT_EQ(loaded.problems[0].place, "/transfer_areas/line");
  EXPECT_NE(loaded.problems[0].text.find("up to 63 bytes"), std::string::npos) << loaded.problems[0].text;
}

TEST(System, WarnsOfANetworkBeyondTheMachineWithoutAKey) {
  SystemFiles files = two();
  files.json["network"]["lcm"] = "udpm://239.255.76.67:7667?ttl=1";
  const LoadedSystem open = load_system_file(files.path());
  ASSERT_TRUE(open.system);
  ASSERT_EQ(open.warnings.size(), 1u);
  EXPECT_EQ(open.warnings[0].place, "/network/lcm");
  files.json["network"]["key_file"] = "keys/line";
  const LoadedSystem closed = load_system_file(files.path());
  ASSERT_TRUE(closed.system);
  EXPECT_TRUE(closed.warnings.empty());
  EXPECT_EQ(closed.system->network.key_file, files.directory().file("keys/line"));
  files.json["network"] = {{"lcm", "udpm://239.255.76.67:7667?ttl=0"}};
  EXPECT_TRUE(load_system_file(files.path()).warnings.empty());
}

TEST(System, CouplesEachControllerToThoseThatItLeadsAndFollows) {
  SystemFiles files = two();
  files.json["controllers"]["PLC_1"]["address"] = {"10.7.0.1", "10.8.0.0/16"};
  files.json["network"] = {{"clock", "tai"}, {"clock_error", "500us"}};
  int prepared = 0;
  const auto prepare = [&](Project&, const SystemController& one) {
    ++prepared;
    EXPECT_EQ(one.name, "PLC_2");
  };
  const LoadedSystem receiving = load_controller_of(files.path(), "plc_2", prepare);
  ASSERT_TRUE(receiving.system);
  EXPECT_EQ(prepared, 1);
  EXPECT_TRUE(receiving.system->controllers[0].project.couplings.empty()) << "it runs elsewhere";
  ASSERT_EQ(receiving.system->controllers[1].project.couplings.size(), 1u);
  const NetworkCoupling& in = receiving.system->controllers[1].project.couplings[0];
  EXPECT_TRUE(in.sent.empty());
  ASSERT_EQ(in.received.size(), 1u);
  EXPECT_EQ(in.received[0].link.area, "test.line");
  EXPECT_EQ(in.received[0].senders.size(), 2u);
  ASSERT_EQ(in.received[0].to.size(), 1u);
  EXPECT_EQ(in.received[0].to[0]->name, "Line");
  EXPECT_EQ(in.network.clock, SharedClockKind::tai);
  EXPECT_EQ(in.network.clock_error, 500'000);

  const LoadedSystem sending = load_controller_of(files.path(), "PLC_1");
  ASSERT_TRUE(sending.system);
  const NetworkCoupling& out = sending.system->controllers[0].project.couplings.at(0);
  ASSERT_EQ(out.sent.size(), 1u);
  EXPECT_TRUE(out.received.empty());
  EXPECT_EQ(out.sent[0].from->name, "Conveyor");
  EXPECT_EQ(out.sent[0].link.layout(), in.received[0].link.layout()) << "both sides say the same";
  EXPECT_TRUE(sending.system->controllers[0].project.transfer_areas.empty());
}

TEST(System, OfWhichAnAreaIsWithinOneControllerStaysWithinIt) {
  SystemFiles files;
  ControllerFile both = source();
  both.proxy("Line");
  both.axis("Press");
  both.gear("Press", "Line");
  files.add("PLC_1", both);
  files.area("line", "PLC_1.Conveyor", {"PLC_1.Line"});
  LoadedSystem loaded = load_controller_of(files.path(), "PLC_1");
  ASSERT_TRUE(loaded.system);
  Project& project = loaded.system->controllers[0].project;
  EXPECT_TRUE(project.couplings.empty());
  ASSERT_EQ(project.controller->telegram_outputs.size(), 1u);
  ASSERT_EQ(project.controller->telegram_inputs.size(), 1u);
  EXPECT_EQ(project.controller->telegram_inputs[0].ring, project.controller->telegram_outputs[0].ring);
}

TEST(System, IsToldFromAProject) {
  const SystemFiles files = two();
  EXPECT_TRUE(is_system_file(files.path()));
  EXPECT_FALSE(is_system_file(files.directory().file("PLC_1.json")));
  EXPECT_FALSE(is_system_file(files.directory().file("none.json")));
  EXPECT_FALSE(is_system("{ \"lockstep_system\": 1,"));
}

/// What is wrong if something is changed, as it is shown, without the folder; every problem a line.
std::string told(const std::function<void(SystemFiles&)>& change) {
  SystemFiles files = two();
  change(files);
  const std::string path = files.path();
  std::string text;
  for (const LoadedFor use : {LoadedFor::running, LoadedFor::looking}) {
    const LoadedSystem loaded = load_system_file(path, use);
    std::string found;
    for (const Problem& problem : loaded.problems) found += to_string(path, problem) + "\n";
    EXPECT_EQ(loaded.problems.empty(), loaded.system.has_value());
    if (use == LoadedFor::looking) {
      EXPECT_EQ(found, text) << "check and run say the same";
    }
    text = found;
  }
  const std::string folder = files.directory().file("");
  for (std::size_t at = 0; (at = text.find(folder)) != text.npos;) text.erase(at, folder.size());
  return text;
}

struct Wrong {
  const char* pointer;  // of what is changed
  const char* value;
  const char* place;  // where it is told
  const char* what;
};

class WrongSystem : public testing::TestWithParam<Wrong> {};

TEST_P(WrongSystem, IsToldWithItsPlace) {
  const Wrong& wrong = GetParam();
  const std::string text = told([&](SystemFiles& files) {
    files.json[SystemJson::json_pointer(wrong.pointer)] = SystemJson::parse(wrong.value);
  });
  EXPECT_EQ(text.substr(0, text.find(": ")), std::string("system.json:") + wrong.place) << text;
  EXPECT_NE(text.find(wrong.what), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), text.size() - 1) << "one problem";
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongSystem,
    testing::Values(
        Wrong{"/lockstep_system", "2", "/lockstep_system", "1"},
        Wrong{"/transfer_areas/line/from", "\"PLC_9.Conveyor\"", "/transfer_areas/line/from",
              "there is no controller 'PLC_9' (did you mean 'PLC_1'?); allowed: PLC_1, PLC_2"},
        Wrong{"/transfer_areas/line/from", "\"Conveyor\"", "/transfer_areas/line/from",
              "allowed: CONTROLLER.OBJECT"},
        Wrong{"/transfer_areas/line/from", "\"PLC_1.Conveyer\"", "/transfer_areas/line/from",
              "of the controller 'PLC_1':"},
        Wrong{"/transfer_areas/line/from", "\"PLC_2.Line\"", "/transfer_areas/line/from",
              "TO_PositioningAxis"},
        Wrong{"/transfer_areas/line/interface", "2", "/transfer_areas/line/from",
              "Interface[2].EnableLeadingValueOutput TRUE"},
        Wrong{"/transfer_areas/line/interface", "9", "/transfer_areas/line/interface", "1 to 8"},
        Wrong{"/transfer_areas/line/to", "[\"PLC_2.Press\"]", "/transfer_areas/line/to/0",
              "TO_LeadingAxisProxy"},
        Wrong{"/transfer_areas/line/to", "[]", "/transfer_areas/line/to", "one name or more"},
        Wrong{"/transfer_areas/line/to", "[\"PLC_2.Line\", \"PLC_2.Line\"]", "/transfer_areas/line/to/1",
              "one source for each proxy"},
        Wrong{"/transfer_areas/other", R"({ "from": "PLC_1.Conveyor", "interface": 1, "to": "PLC_2.Line" })",
              "/transfer_areas/other/from", "one area for each interface"},
        Wrong{"/controllers/PLC_2/project", "\"none.json\"", "/controllers/PLC_2/project", "cannot be read"},
        Wrong{"/controllers/PLC_2/phase", "\"1ms\"", "/controllers/PLC_2/phase", "less than 1ms"},
        Wrong{"/controllers/PLC 3", R"({ "project": "PLC_2.json" })", "/controllers/PLC 3", "PLC 3"},
        Wrong{"/controllers/plc_1", R"({ "project": "PLC_2.json" })", "/controllers/plc_1",
              "case does not count"},
        Wrong{"/simulated_network/loss", "1.5", "/simulated_network/loss", "1"},
        Wrong{"/simulated_network/latency", "\"-1ms\"", "/simulated_network/latency", "-1ms"},
        Wrong{"/network/lcm", "\"http://x\"", "/network/lcm", "udpm://"},
        Wrong{"/network/clock", "\"ntp\"", "/network/clock", "tai"},
        Wrong{"/network/clock_error", "\"1ns\"", "/network/clock_error", "1us"},
        Wrong{"/controllers/PLC_2/address", "\"plc2.local\"", "/controllers/PLC_2/address", "192.168.1.0/24"},
        Wrong{"/controllers/PLC_2/address", R"([ "10.0.0.1", "10.0.0.1/8" ])", "/controllers/PLC_2/address/1",
              "IPv4"},
        Wrong{"/controllers/PLC_2/address", "[]", "/controllers/PLC_2/address", "lets nobody in"},
        Wrong{"/transfer_areas/x23456789x123456789x123456789x123456789x123456789x123456789",
              R"({ "from": "PLC_1.Near", "interface": 1, "to": "PLC_2.Line" })",
              "/transfer_areas/x23456789x123456789x123456789x123456789x123456789x123456789/from",
              "Interface[1].EnableLeadingValueOutput TRUE"},
        Wrong{"/delays/fixed", R"(["PLC_2.Nobody"])", "/delays/fixed/0", "Nobody"},
        Wrong{"/unknown", "1", "/unknown", "unknown key"}));

TEST(System, TellsWhatIsWrongInAProjectWithItsFile) {
  const std::string text = told([](SystemFiles& files) {
    ControllerFile press = receiver();
    press.json["tags"]["go"]["type"] = "BOOLEAN";
    files.add("PLC_2", press);
    files.add("PLC_3", press);
    files.json["controllers"]["PLC_3"]["project"] = "PLC_2.json";
  });
  EXPECT_TRUE(text.starts_with("PLC_2.json:/tags/go/type: unknown type 'BOOLEAN'")) << text;
  EXPECT_EQ(text.find('\n'), text.size() - 1) << "once, though two controllers run it";
}

TEST(System, TellsProxiesWithTwoSourcesUnlessTheyAreToBeShown) {
  SystemFiles files = two();
  ControllerFile file = source();
  file.provide("Conveyor", 0.002, 2);
  files.add("PLC_1", file);
  files.area("other", "PLC_1.Conveyor", {"PLC_2.Line"}, 2);
  const LoadedSystem refused = load_system_file(files.path());
  ASSERT_EQ(refused.problems.size(), 1u);
  EXPECT_EQ(refused.problems[0].place, "/transfer_areas/other/to/0");
  const LoadedSystem shown = load_system_file(files.path(), LoadedFor::looking, SeveralSources::kept);
  ASSERT_TRUE(shown.system);
  EXPECT_EQ(shown.system->areas.size(), 2u);
}

TEST(System, TellsCyclesThatDoNotFit) {
  const std::string text = told([](SystemFiles& files) { files.add("PLC_2", receiver("200ms")); });
  EXPECT_TRUE(
      text.starts_with("system.json:/transfer_areas/line/to/0: the servo cycle of the controller "
                       "'PLC_2', 200ms, does not fit"))
      << text;
  EXPECT_NE(text.find("at most 128ms"), std::string::npos) << text;
}

TEST(System, WarnsOfAProxyThatNobodyLeads) {
  SystemFiles files = two();
  ControllerFile press = receiver();
  press.proxy("Idle");
  files.add("PLC_2", press);
  const LoadedSystem loaded = load_system_file(files.path());
  ASSERT_TRUE(loaded.system);
  ASSERT_EQ(loaded.warnings.size(), 2u) << "the other one is that nothing uses it";
  EXPECT_EQ(loaded.warnings[0].file, files.directory().file("PLC_2.json"));
  EXPECT_EQ(loaded.warnings[0].place, "/technology_objects/Idle");
}

// ---- Its schema

class SystemSchema : public SchemaCheck {
 protected:
  SystemSchema() : SchemaCheck(system_schema()) {}

  static json whole() {
    SystemFiles files = two();
    files.json["$schema"] = "system.schema.json";
    files.json["comment"] = "all keys";
    files.json["description"] = "two controllers";
    files.json["controllers"]["PLC_2"]["phase"] = "300us";
    files.json["controllers"]["PLC_2"]["address"] = "10.0.0.0/8";
    files.json["network"] = {{"lcm", "udpm://239.255.76.67:7667?ttl=0"},
                             {"clock", "monotonic"},
                             {"clock_error", "1ms"},
                             {"key_file", "key"}};
    files.json["simulated_network"] = {{"latency", "300us"},  {"jitter", "100us"},   {"loss", 0.001},
                                       {"duplicates", 0.001}, {"reordering", 0.001}, {"seed", 7}};
    files.json["delays"] = {{"fixed", {"PLC_1.Conveyor"}}, {"left_out", {"PLC_2.Press"}}};
    return json::parse(files.json.dump());
  }
};

TEST_F(SystemSchema, ShipsAsItIsMade) {
  expect_shipped("system.schema.json", system_schema());
}

TEST_F(SystemSchema, KnowsEveryKeyAndRefusesNothingThatTheLoaderAccepts) {
  SystemFiles files = two();
  const json all = whole();
  EXPECT_TRUE(accepts(all));
  const auto loads = [&](const json& system) {
    files.json = SystemJson::parse(system.dump());
    return load_system_file(files.path(), LoadedFor::looking).system.has_value();
  };
  EXPECT_TRUE(loads(all));
  const json values = {nullptr, true, -1, 0, 1, 2.5, "", "start", "10ms", json::array(), json::object()};
  const json flat = all.flatten();
  int refused = 0;
  for (const auto& [pointer, old] : flat.items()) {
    for (const json& value : values) {
      json system = all;
      system[json::json_pointer(pointer)] = value;
      if (accepts(system)) continue;
      ++refused;
      EXPECT_FALSE(loads(system)) << pointer << " = " << value;
    }
    json::json_pointer place(pointer);
    place.pop_back();
    if (!all.at(place).is_object()) continue;
    json system = all;
    system[place / "no_such_key"] = 1;
    EXPECT_FALSE(accepts(system)) << pointer;
    EXPECT_FALSE(loads(system)) << pointer;
  }
  EXPECT_GT(refused, 80) << "an editor is served";
}

}  // namespace
}  // namespace lockstep::system_test
