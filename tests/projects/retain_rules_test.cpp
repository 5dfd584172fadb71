// What a project keeps across runs.
#include <gtest/gtest.h>

#include "changed_project.hpp"
#include "projects/loader/project.hpp"

namespace lockstep::retain_rules_test {
namespace {

TEST(ProjectRetain, ListsTagsAndTheAdjustmentsOfAbsoluteEncoders) {
  Json json = Json::parse(kExampleProject);
  json["tags"]["other"] = {{"type", "INT"}, {"retain", true}};
  json["technology_objects"]["Knife"]["config"]["Sensor[1]"] = {{"Type", 2}};
  json["technology_objects"]["Knife"]["config"]["LoadGear"] = {{"Numerator", 3}};
  json["retain"] = {{"file", "values"}, {"interval", "10s"}};
  const LoadedProject loaded = load_project(json.dump(), "/somewhere");
  ASSERT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  const RetainConfig& retain = loaded.project->retain;
  ASSERT_EQ(retain.values.size(), 3u);
  EXPECT_EQ(retain.values[0].name, "speed");
  EXPECT_EQ(retain.values[1].name, "other");
  EXPECT_EQ(retain.values[2].name, "Knife.StatusSensor[1].AbsEncoderOffset");
  EXPECT_NE(retain.values[2].basis.find("LoadGear.Numerator=3"), std::string::npos) << retain.values[2].basis;
  EXPECT_NE(retain.values[2].basis.find("Sensor[1].Type=2"), std::string::npos) << retain.values[2].basis;
  EXPECT_EQ(retain.file, "/somewhere/values");
  EXPECT_EQ(retain.interval, std::chrono::seconds(10));
}

TEST(ProjectRetain, KeepsBesideEachEncoderTheSettingsOfThatEncoder) {
  Json json = Json::parse(kExampleProject);
  Json& knife = json["technology_objects"]["Knife"];
  knife["config"]["Sensor[1]"] = {{"Type", 1}, {"InverseDirection", true}};
  knife["config"]["Sensor[2]"] = {{"Existent", true}, {"Type", 2}, {"Parameter", {{"Resolution", 0.25}}}};
  knife["drive"]["sensors"] = Json::parse(R"([{"sensor": 2}])");
  const LoadedProject loaded = load_project(json.dump());
  ASSERT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  const std::vector<KeptValue>& values = loaded.project->retain.values;
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[2].name, "Knife.StatusSensor[2].AbsEncoderOffset");
  EXPECT_NE(values[1].basis.find("Sensor[1].InverseDirection="), std::string::npos) << values[1].basis;
  EXPECT_EQ(values[1].basis.find("Resolution"), std::string::npos) << values[1].basis;
  EXPECT_NE(values[2].basis.find("Sensor[2].Type=2"), std::string::npos) << values[2].basis;
  EXPECT_NE(values[2].basis.find("Sensor[2].Parameter.Resolution=0.25"), std::string::npos)
      << values[2].basis;
  EXPECT_EQ(values[2].basis.find("InverseDirection"), std::string::npos) << values[2].basis;
}

TEST(ProjectRetain, ListsArraysWithAllTheirElementsAndMembers) {
  Json json = Json::parse(kExampleProject);
  json["tags"]["recipe"] = {{"type", "ARRAY[-1..1] OF INT"}, {"retain", true}, {"init", {7, 8}}};
  json["tags"]["curve"] = {{"type", "ARRAY[1..2] OF TO_Cam_Struct_PointData"},
                           {"retain", true},
                           {"init", {{1.0, 2.0}, {3.0, 4.0}}}};
  json["tags"]["passing"] = {{"type", "ARRAY[1..2] OF INT"}};
  const LoadedProject loaded = load_project(json.dump());
  ASSERT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  const std::vector<KeptValue>& values = loaded.project->retain.values;
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[1].name, "recipe");
  EXPECT_EQ(values[1].type(), "ARRAY[-1..1] OF INT");
  ASSERT_EQ(values[1].signals().size(), 3u);
  EXPECT_EQ(values[1].signals()[1].load().i, 8);
  EXPECT_EQ(values[2].type(), "ARRAY[1..2] OF TO_Cam_Struct_PointData");
  ASSERT_EQ(values[2].signals().size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(values[2].signals()[i].load().r, static_cast<double>(i + 1)) << "x, y, x, y";
}

TEST(ProjectRetain, HasADefaultInterval) {
  const LoadedProject loaded = load_project(kExampleProject);
  ASSERT_TRUE(loaded.project.has_value());
  EXPECT_EQ(loaded.project->retain.values.size(), 1u);
  EXPECT_EQ(loaded.project->retain.file, "");
  EXPECT_EQ(loaded.project->retain.interval, std::chrono::seconds(1));
}

TEST(ProjectRetain, ValuesGivenBackBeforeTheStartAreThoseTheAxisBeginsWith) {
  Json json = Json::parse(kExampleProject);
  json["technology_objects"]["Knife"]["config"]["Sensor[1]"] = {{"Type", 1}};
  const LoadedProject loaded = load_project(json.dump(), "", [](Project& project) {
    Value offset{};
    offset.r = 90.0;
    project.retain.values.back().signal.store(offset);
    Value present{};
    present.u = 1;
    project.retain.values.back().present->store(present);
  });
  ASSERT_TRUE(loaded.project.has_value()) << lines(loaded.problems);
  EXPECT_EQ(loaded.project->controller->axes[1]->data.ActualPosition, 90.0);
}

}  // namespace
}  // namespace lockstep::retain_rules_test
