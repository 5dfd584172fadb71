// Compares the declared variables of both kinds of cam with the catalogue of the published data block, both
// ways.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tech_objects/cam_object/cam.hpp"
#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep::cam_variables_test {
namespace {

using Json = nlohmann::json;

struct Published {
  Json variable;
  std::size_t count = 0;
};

void collect(const Json& variable, std::map<std::string, Published>& found) {
  if (variable.contains("children")) {
    for (const Json& child : variable.at("children")) collect(child, found);
    return;
  }
  std::string path = variable.at("path");
  std::size_t count = 0;
  if (const auto open = path.find("[1.."); open != std::string::npos) {
    const auto close = path.find(']');
    count = std::stoul(path.substr(open + 4, close - open - 4));
    path = path.substr(0, open) + "[]" + path.substr(close + 1);
  }
  EXPECT_TRUE(found.insert({path, {variable, count}}).second) << path;
}

std::map<std::string, Published> published(const std::string& kind) {
  const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/to_cam.json"));
  std::map<std::string, Published> found;
  for (const Json& section : file.at("sections")) {
    const auto kinds = section.at("appliesTo").get<std::set<std::string>>();
    if (!kinds.contains(kind)) continue;
    for (const Json& variable : section.at("variables")) collect(variable, found);
  }
  return found;
}

std::map<std::string, const Variable*> declared(ObjectKind kind) {
  std::map<std::string, const Variable*> found;
  for (const auto list : data_block_of(kind).lists())
    for (const Variable& variable : list)
      EXPECT_TRUE(found.insert({std::string(variable.path), &variable}).second) << variable.path;
  return found;
}

std::string published_type(const Published& one) {
  const Json& array = one.variable.contains("array") ? one.variable.at("array") : Json::object();
  return array.contains("elementType") ? array.at("elementType") : one.variable.at("dataType");
}

class CamVariables : public testing::TestWithParam<ObjectKind> {
 protected:
  std::map<std::string, Published> published_ = published(std::string(kind_name(GetParam())));
  std::map<std::string, const Variable*> declared_ = declared(GetParam());
};

TEST_P(CamVariables, AreThePublishedOnes) {
  ASSERT_EQ(published_.size(), 27u);
  for (const auto& [path, one] : published_) EXPECT_TRUE(declared_.contains(path)) << path;
  for (const auto& [path, variable] : declared_)
    EXPECT_TRUE(published_.contains(path) || path == "Segment[].Origin") << path << ": our own is the origin";
}

TEST_P(CamVariables, HaveThePublishedTypesArraysEffectsAndRanges) {
  const std::map<std::string, Effect> effects = {{"CAL", Effect::CAL}, {"RON", Effect::RON}};
  for (const auto& [path, one] : published_) {
    const Variable& variable = *declared_.at(path);
    EXPECT_EQ(type_name(variable.type), published_type(one)) << path;
    EXPECT_EQ(variable.count, one.count) << path;
    EXPECT_EQ(variable.effect, effects.at(one.variable.at("W"))) << path;
    EXPECT_EQ(variable.computed, variable.effect == Effect::RON) << path;
    if (!one.variable.contains("range") || one.variable.at("range").is_null()) {
      EXPECT_TRUE(variable.range.unbounded()) << path;
      continue;
    }
    const Json& range = one.variable.at("range");
    const bool set = range.contains("set");
    EXPECT_EQ(variable.range.lowest, (set ? range.at("set").front() : range.at("min")).get<double>()) << path;
    EXPECT_EQ(variable.range.highest, (set ? range.at("set").back() : range.at("max")).get<double>()) << path;
  }
}

TEST_P(CamVariables, NameTheirValuesAndBits) {
  for (const auto& [path, one] : published_) {
    const Variable& variable = *declared_.at(path);
    if (variable.type == Type::DINT && one.variable.contains("values")) {
      const Json& values = one.variable.at("values");
      ASSERT_EQ(variable.choices.size(), values.size()) << path;
      for (std::size_t i = 0; i < values.size(); ++i)
        EXPECT_EQ(variable.choices[i].value, values[i].at("value").get<std::int64_t>()) << path;
    }
    if (!one.variable.contains("bits")) continue;
    ASSERT_NE(variable.bits, nullptr) << path;
    BitNames names{};
    for (const Json& bit : one.variable.at("bits"))
      if (!bit.at("reserved").get<bool>()) {
        static std::set<std::string> kept;
        names[bit.at("bit").get<std::size_t>()] = *kept.insert(bit.at("name")).first;
      }
    EXPECT_EQ(*variable.bits, names) << path;
  }
}

TEST_P(CamVariables, AreFoundByTheirPathsInTheDataBlock) {
  Cam cam(GetParam(), "Cam", DB_ANY{1});
  cam.define_point(6, {70.0, 7.0});
  const auto read = [&](const char* path) {
    const VariableAddress place = find_variable(GetParam(), path);
    EXPECT_NE(place.variable, nullptr) << path;
    const Signal signal = place.signal(cam.data_block());
    return as_double(signal.load(), signal.value_type());
  };
  EXPECT_EQ(read("point[7].X"), 70.0);
  EXPECT_EQ(read("Point[7].y"), 7.0);
  EXPECT_EQ(read("ValidPoint[7]"), 1.0);
  EXPECT_EQ(read("ValidPoint[8]"), 0.0);
  const std::string last = "Point[" + std::to_string(cam.point_count()) + "].x";
  const std::string beyond = "Point[" + std::to_string(cam.point_count() + 1) + "].x";
  EXPECT_EQ(read(last.c_str()), 0.0);
  EXPECT_EQ(find_variable(GetParam(), beyond).variable, nullptr);
  cam.configure(0.001, 1);
  EXPECT_EQ(read("StatusWord.X5"), 0.0);
}

INSTANTIATE_TEST_SUITE_P(BothKinds, CamVariables, testing::Values(ObjectKind::TO_Cam, ObjectKind::TO_Cam_10k),
                         [](const auto& one) { return std::string(kind_name(one.param)); });

}  // namespace
}  // namespace lockstep::cam_variables_test
