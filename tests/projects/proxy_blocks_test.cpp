// Which blocks a project may give a leading axis proxy: those of its column in the published table; every
// other one refuses it, with its place and what is allowed.
// @source S7-1500T synchronous operation V7, 4.4
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "fb/block.hpp"
#include "projects/loader/project.hpp"

namespace lockstep::proxy_blocks_test {
namespace {

using Json = nlohmann::ordered_json;

/// What is told of a call of a block with the proxy at one of its pins, at that pin.
std::string told(std::string_view block, std::string_view pin) {
  Json project = Json::parse(R"({ "lockstep": 1, "name": "one call", "clock": { "servo_cycle": "1ms" },
    "technology_objects": { "Line": { "type": "TO_LeadingAxisProxy" } },
    "programs": [ { "name": "all", "ob": "Main", "cycle": "1ms", "calls": [] } ] })");
  project["programs"][0]["calls"][0] = {{"fb", block}, {"name", "one"}, {"in", {{pin, "Line"}}}};
  const LoadedProject loaded = load_project(project.dump());
  const std::string place = "/programs/0/calls/0/in/" + std::string(pin);
  std::string text;
  for (const Problem& problem : loaded.problems)
    if (problem.place == place) text += problem.text;
  return text;
}

TEST(ProxyBlocks, AreThoseOfThePublishedColumnAndTheOthersRefuse) {
  const std::set<std::string> column = {
      "MC_Reset.Axis",   "MC_GearIn.Master",          "MC_GearInPos.Master",      "MC_GearInVelocity.Master",
      "MC_CamIn.Master", "MC_PhasingRelative.Master", "MC_PhasingAbsolute.Master"};
  std::set<std::string> taken;
  int refused = 0;
  for (const BlockType& type : block_types())
    for (const Pin& pin : type.pins) {
      if (pin.objects == 0) continue;
      const std::string name = std::string(type.name) + "." + std::string(pin.name);
      const std::string text = told(type.name, pin.name);
      if (text.empty()) {
        taken.insert(name);
        continue;
      }
      ++refused;
      EXPECT_NE(text.find("'Line'"), std::string::npos) << name << ": " << text;
      EXPECT_NE(text.find("TO_"), std::string::npos) << "what is allowed: " << name << ": " << text;
    }
  EXPECT_EQ(taken, column);
  EXPECT_GE(refused, 40);
}

}  // namespace
}  // namespace lockstep::proxy_blocks_test
