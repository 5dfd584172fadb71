// Leading axis proxies and transfer areas of a project: what is wrong with them, and a project that has both
// ends in one controller.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "projects/loader/simulation.hpp"
#include "tests/support/directory.hpp"

namespace lockstep::transfer_areas_test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

/// A virtual axis that provides its value, a local one behind the delay, and one that follows the proxy.
std::string project(const std::string& area, const std::string& delay = "0.004",
                    const std::string& coupling = "setpoint") {
  return R"({ "lockstep": 1, "name": "two ends", "clock": { "servo_cycle": "1ms" },
    "technology_objects": {
      "Main": { "type": "TO_PositioningAxis",
        "config": { "VirtualAxis": { "Mode": 1 }, "Modulo": { "Enable": true, "Length": 360.0 },
          "CrossPlcSynchronousOperation": { "Interface[1]": { "EnableLeadingValueOutput": true },
                                            "LocalLeadingValueDelayTime": )" +
         delay + R"( } } },
      "Line": { "type": "TO_LeadingAxisProxy",
        "config": { "Parameter": { "ToleranceTimeExternalLeadingValueInvalid": 0.1 } } },
      "Other": { "type": "TO_LeadingAxisProxy" },
      "Near": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 },
          "Modulo": { "Enable": true, "Length": 360.0 } },
        "leading_values": [ { "to": "Main", "coupling": "delayed" } ] },
      "Far": { "type": "TO_SynchronousAxis", "config": { "VirtualAxis": { "Mode": 1 },
          "Modulo": { "Enable": true, "Length": 360.0 } },
        "leading_values": [ { "to": "Line", "coupling": ")" +
         coupling + R"(" } ] }
    },
    "transfer_areas": { )" +
         area + R"( },
    "tags": { "on": { "type": "BOOL" }, "go": { "type": "BOOL" } },
    "programs": [ { "name": "all", "ob": "Main", "cycle": "1ms", "calls": [
      { "fb": "MC_Power", "name": "p1", "in": { "Axis": "Main", "Enable": "TRUE" } },
      { "fb": "MC_Power", "name": "p2", "in": { "Axis": "Near", "Enable": "TRUE" } },
      { "fb": "MC_Power", "name": "p3", "in": { "Axis": "Far", "Enable": "TRUE" } },
      { "fb": "MC_GearIn", "name": "g1", "in": { "Master": "Main", "Slave": "Near", "Execute": "on" } },
      { "fb": "MC_GearIn", "name": "g2", "in": { "Master": "Line", "Slave": "Far", "Execute": "on" } },
      { "fb": "MC_MoveVelocity", "name": "v",
        "in": { "Axis": "Main", "Velocity": "500.0", "Jerk": "3000.0", "Execute": "go" } } ] } ] })";
}

constexpr char kArea[] = R"("line": { "from": "Main", "to": "Line" })";

struct Told {
  std::vector<Problem> problems, warnings;
};

Told told(const std::string& text) {
  LoadedProject loaded = load_project(text);
  return {std::move(loaded.problems), std::move(loaded.warnings)};
}

TEST(TransferAreas, LeadTheAxesOnBothSidesToTheSamePlaces) {
  Simulation machine = Simulation::from_text(project(kArea));
  machine.run_for(100ms);
  machine.write("on", 1.0);
  machine.run_for(500ms);
  ASSERT_EQ(machine.read("g1.InGear"), 1.0);
  ASSERT_EQ(machine.read("g2.InGear"), 1.0);
  machine.write("go", 1.0);
  for (int i = 0; i < 5000; ++i) {
    machine.step();
    ASSERT_EQ(machine.read("Far.Position"), machine.read("Near.Position")) << i;
  }
  EXPECT_NEAR(machine.read("Far.Velocity"), 500.0, 1e-6);
  EXPECT_NEAR(std::remainder(machine.read("Main.Position") - machine.read("Far.Position"), 360.0), 2.0, 1e-9)
      << "500 u/s times 4 ms";
  EXPECT_EQ(machine.read("Main.StatusProvidedLeadingValue.DelayedLeadingValue.Position"),
            machine.read("Line.Position"));
  EXPECT_NEAR(machine.read("Line.StatusExternalLeadingValue.AdjustmentTime"), -0.003, 1e-12);
  EXPECT_EQ(machine.read("Line.StatusWord.X4"), 1.0);
}

TEST(TransferAreas, OfAProxyThatHasNoneAreMissed) {
  const Told one = told(project(kArea));
  EXPECT_TRUE(one.problems.empty());
  ASSERT_EQ(one.warnings.size(), 2u) << "the other one is that nothing uses it";
  EXPECT_EQ(one.warnings[0].place, "/technology_objects/Other");
  EXPECT_NE(one.warnings[0].text.find("no transfer area"), std::string::npos);
}

struct Wrong {
  const char* area;
  const char* place;
  const char* text;
};

class WrongTransferAreas : public testing::TestWithParam<Wrong> {};

TEST_P(WrongTransferAreas, AreToldWithTheirPlace) {
  const Told all = told(project(GetParam().area));
  ASSERT_EQ(all.problems.size(), 1u) << (all.problems.empty() ? "" : all.problems.back().text);
  EXPECT_EQ(all.problems[0].place, GetParam().place);
  EXPECT_NE(all.problems[0].text.find(GetParam().text), std::string::npos) << all.problems[0].text;
}

INSTANTIATE_TEST_SUITE_P(
    Each, WrongTransferAreas,
    testing::Values(
        Wrong{R"("a": { "from": "Main", "interface": 2, "to": "Line" })", "/transfer_areas/a/from",
              "Interface[2].EnableLeadingValueOutput TRUE"},
        Wrong{R"("a": { "from": "Main", "interface": 9, "to": "Line" })", "/transfer_areas/a/interface",
              "1 to 8"},
        Wrong{R"("a": { "from": "Line", "to": "Line" })", "/transfer_areas/a/from", "Line"},
        Wrong{R"("a": { "from": "Main", "to": "Near" })", "/transfer_areas/a/to", "TO_LeadingAxisProxy"},
        Wrong{R"("a": { "from": "Main" })", "/transfer_areas/a", "'to' is missing"},
        Wrong{R"("a": { "from": "Main", "to": "Line" }, "b": { "from": "Main", "to": "Other" })",
              "/transfer_areas/b/from", "one area for each interface"},
        Wrong{R"("a": { "from": "Main", "to": [ "Line", "Line" ] })", "/transfer_areas/a/to/1",
              "one source for each proxy"},
        Wrong{R"("a": { "from": "Main", "to": [ "Line", "Far" ] })", "/transfer_areas/a/to/1",
              "TO_LeadingAxisProxy"},
        Wrong{R"("a": { "from": "Main", "to": [] })", "/transfer_areas/a/to", "one proxy or more"},
        Wrong{R"("a": { "to": "Line" })", "/transfer_areas/a", "'from' is missing"},
        Wrong{R"("a": { "direction": "send", "from": "Main", "to": "Line" })", "/transfer_areas/a/to",
              "with 'within' and 'receive'"},
        Wrong{R"("a": { "direction": "send" })", "/transfer_areas/a", "'from' is missing"},
        Wrong{R"("a": { "direction": "receive", "to": "Line", "source": "X" })", "/transfer_areas/a",
              "'controller' is missing"},
        Wrong{R"("a": { "direction": "receive", "to": "Line", "controller": "X" })", "/transfer_areas/a",
              "'source' is missing"},
        Wrong{
            R"("a": { "direction": "receive", "from": "Main", "to": "Line", "controller": "X", "source": "Y" })",
            "/transfer_areas/a/from", "with 'within' and 'send'"},
        Wrong{R"("a": { "from": "Main", "to": "Line", "channel": "x" })", "/transfer_areas/a/channel",
              "with 'send' and 'receive'"},
        Wrong{R"("a": { "direction": "send", "from": "Main", "address": "10.0.0.1" })",
              "/transfer_areas/a/address", "with 'receive'"},
        Wrong{
            R"("a": { "direction": "receive", "to": "Line", "controller": "X", "source": "Y", "address": "::1" })",
            "/transfer_areas/a/address", "IPv4"},
        Wrong{R"("a": { "direction": "send", "from": "Main" },
                 "b": { "direction": "receive", "channel": "a", "to": "Line", "controller": "X", "source": "Y" })",
              "/transfer_areas/b/channel", "one area for each channel"},
        Wrong{R"("a": { "direction": "send", "from": "Main" }, "b": { "from": "Main", "to": "Line" })",
              "/transfer_areas/b/from", "one area for each interface"},
        Wrong{R"("a": { "from": "Main", "to": "Line" },
                 "b": { "direction": "receive", "to": "Line", "controller": "X", "source": "Y" })",
              "/transfer_areas/b/to", "one source for each proxy"}));

TEST(TransferAreas, LeadSeveralProxiesAlike) {
  Simulation machine =
      Simulation::from_text(project(R"("line": { "from": "Main", "to": [ "Line", "Other" ] })"));
  machine.run_for(100ms);
  machine.write("go", 1.0);
  for (int i = 0; i < 1000; ++i) {
    machine.step();
    ASSERT_EQ(machine.read("Line.Position"), machine.read("Other.Position")) << i;
  }
  EXPECT_GT(machine.read("Line.Velocity"), 100.0);
  EXPECT_EQ(machine.read("Other.StatusWord.X4"), 1.0);
}

// ---- Counts

std::string with_counts(const std::string& counts) {
  Json json = Json::parse(project(kArea));
  json["technology_objects"]["Line"]["telegrams"] = Json::parse(counts);
  json["tags"].update(Json::parse(R"({ "taken": { "type": "ULINT" }, "refused": { "type": "ULINT" },
                                            "off": { "type": "BOOL" } })"));
  json["programs"][0]["calls"].push_back(Json::parse(
      R"({ "fb": "MC_Reset", "name": "r", "in": { "Axis": "Main", "Restart": "TRUE", "Execute": "on" } })"));
  json["programs"][0]["calls"][0]["in"]["Enable"] = "NOT off";
  return json.dump();
}

TEST(TransferAreas, HaveTheirCountsInTags) {
  Simulation machine = Simulation::from_text(with_counts(R"({ "received": "taken", "refused": "refused" })"));
  machine.run_for(100ms);
  EXPECT_EQ(machine.read("taken"), 99.0) << "that of the last tick is under way";
  EXPECT_EQ(machine.read("refused"), 0.0);
  machine.write("off", 1.0);
  machine.run_for(20ms);
  machine.write("on", 1.0);  // the source is restarted: its values do not count any more
  machine.run_for(50ms);
  ASSERT_EQ(machine.read("r.Done"), 1.0);
  EXPECT_GT(machine.read("refused"), 40.0);
  EXPECT_EQ(machine.read("taken") + machine.read("refused"), 169.0);
}

TEST(TransferAreas, HaveTheirCountsInTagsOfTheRightTypeOnly) {
  const Told all = told(with_counts(R"({ "missing": "on" })"));
  ASSERT_EQ(all.problems.size(), 1u);
  EXPECT_EQ(all.problems[0].place, "/technology_objects/Line/telegrams/missing");
  EXPECT_NE(all.problems[0].text.find("ULINT tag"), std::string::npos) << all.problems[0].text;
}

/// Those of what goes out stand at the root: they are of the controller, whatever provides.
TEST(TransferAreas, HaveTheCountsOfWhatGoesOutInTagsOfTheRightTypeOnly) {
  Json json = Json::parse(project(kArea));
  json["tags"]["sent"] = {{"type", "ULINT"}};
  json["telegrams"]["sent"] = "sent";
  const LoadedProject loaded = load_project(json.dump());
  ASSERT_TRUE(loaded.project);
  EXPECT_NE(loaded.project->sent_tags.sent, nullptr);
  EXPECT_EQ(loaded.project->sent_tags.clock_losses, nullptr);
  for (const Problem& warning : loaded.warnings) EXPECT_NE(warning.place, "/tags/sent") << "it is used";
  json["tags"]["sent"]["type"] = "UDINT";
  const Told all = told(json.dump());
  ASSERT_EQ(all.problems.size(), 1u);
  EXPECT_EQ(all.problems[0].place, "/telegrams/sent");
  EXPECT_NE(all.problems[0].text.find("ULINT tag"), std::string::npos) << all.problems[0].text;
}

// ---- Files and templates

/// What a project comes to of which the areas, and proxies with them, stand elsewhere.
std::string areas_of(const LoadedProject& loaded) {
  if (!loaded.project) return loaded.problems.empty() ? "none" : loaded.problems[0].text;
  std::string text;
  for (const TransferArea& area : loaded.project->transfer_areas) {
    text += area.name + ":";
    for (const auto& receiver : area.to) text += " " + receiver.proxy->name;
    text += ";";
  }
  return text;
}

TEST(TransferAreas, MayStandInAnIncludedFile) {
  const test::Directory directory;
  Json json = Json::parse(project(kArea));
  directory.write("areas.json",
                  R"({ "transfer_areas": { "other": { "from": "Main", "interface": 2, "to": "Other" } } })");
  json["include"] = {"areas.json"};
  json["technology_objects"]["Main"]["config"]["CrossPlcSynchronousOperation"]["Interface[2]"] = {
      {"EnableLeadingValueOutput", true}};
  directory.write("project.json", json.dump());
  EXPECT_EQ(areas_of(load_project_file(directory.file("project.json"))), "other: Other;line: Line;");
  directory.write("areas.json", R"({ "transfer_areas": { "other": { "from": "Main", "to": "Nobody" } } })");
  const LoadedProject wrong = load_project_file(directory.file("project.json"));
  ASSERT_FALSE(wrong.problems.empty());
  EXPECT_EQ(wrong.problems[0].file, directory.file("areas.json"));
  EXPECT_EQ(wrong.problems[0].owner, "transfer area 'other'");
}

TEST(TransferAreas, AreMadeByTemplates) {
  Json json = Json::parse(project(kArea));
  json["templates"]["station"] = Json::parse(R"({ "parameters": { "n": {} },
    "technology_objects": { "Q${n}": { "type": "TO_LeadingAxisProxy" } },
    "transfer_areas": { "station${n}": { "from": "Main", "interface": "${n}", "to": "Q${n}" } } })");
  json["instances"] =
      Json::parse(R"([ { "template": "station", "name": "S${n}", "for": { "n": [2, 4] } } ])");
  for (const char* interface : {"Interface[2]", "Interface[3]", "Interface[4]"})
    json["technology_objects"]["Main"]["config"]["CrossPlcSynchronousOperation"][interface] = {
        {"EnableLeadingValueOutput", true}};
  EXPECT_EQ(areas_of(load_project(json.dump())), "line: Line;station2: Q2;station3: Q3;station4: Q4;");
  json.erase("transfer_areas");
  EXPECT_EQ(areas_of(load_project(json.dump())), "station2: Q2;station3: Q3;station4: Q4;");
}

TEST(TransferAreas, RefuseWhatNoCouplingAndNoDelayCanBe) {
  const Told actual = told(project(kArea, "0.004", "actual"));
  ASSERT_EQ(actual.problems.size(), 1u);
  EXPECT_EQ(actual.problems[0].place, "/technology_objects/Far/leading_values/0/coupling");
  EXPECT_NE(actual.problems[0].text.find("no actual value"), std::string::npos);
  const Told longer = told(project(kArea, "4.5"));
  ASSERT_EQ(longer.problems.size(), 1u);
  EXPECT_EQ(longer.problems[0].place,
            "/technology_objects/Main/config/CrossPlcSynchronousOperation/LocalLeadingValueDelayTime");
  EXPECT_NE(longer.problems[0].text.find("allowed: 0 to 4"), std::string::npos) << longer.problems[0].text;
}

TEST(TransferAreas, OfOtherProcessesAreWhatTheFileSays) {
  const LoadedProject loaded = load_project(project(
      R"("out": { "direction": "send", "from": "Main" },
         "in": { "direction": "receive", "channel": "line.crank", "controller": "PLC_1", "source": "Crank",
                 "interface": 3, "to": [ "Line", "Other" ], "address": [ "10.7.0.1", "10.8.0.0/16" ] })"));
  ASSERT_TRUE(loaded.project) << loaded.problems[0].text;
  for (const Problem& warning : loaded.warnings)
    EXPECT_EQ(warning.text.find("it leads nothing"), std::string::npos) << warning.text;
  EXPECT_TRUE(loaded.project->transfer_areas.empty());
  EXPECT_TRUE(loaded.project->controller->telegram_outputs.empty()) << "until a run joins the network";
  ASSERT_EQ(loaded.project->couplings.size(), 1u);
  const NetworkCoupling& coupling = loaded.project->couplings[0];
  EXPECT_EQ(coupling.network.lcm, "udpm://239.255.76.67:7667?ttl=0") << "nothing leaves the machine";
  ASSERT_EQ(coupling.sent.size(), 1u);
  EXPECT_EQ(coupling.sent[0].link.area, "out");
  EXPECT_EQ(coupling.sent[0].link.sender, "two ends");
  EXPECT_EQ(coupling.sent[0].link.source, "Main");
  ASSERT_EQ(coupling.received.size(), 1u);
  const ReceivedArea& in = coupling.received[0];
  EXPECT_EQ(in.link.area, "line.crank");
  EXPECT_EQ(in.link.sender, "PLC_1");
  EXPECT_EQ(in.link.source, "Crank");
  EXPECT_EQ(in.link.interface, 3);
  EXPECT_EQ(in.senders.size(), 2u);
  EXPECT_EQ(in.to.size(), 2u);
}

}  // namespace
}  // namespace lockstep::transfer_areas_test
