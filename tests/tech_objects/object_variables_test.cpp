// Compares the declared variables of objects other than axes with the catalogue of their data blocks, both
// ways: paths, order, types, arrays, effects, ranges, values and bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep::object_variables_test {
namespace {

using Json = nlohmann::json;

// A printed lowest value that the start value of an axis, 0.0, would not have; axes begin at 0.0.
const std::set<std::string> kFromZero = {"Extrapolation.FollowingAxisDependentTime"};

class ObjectVariables : public testing::TestWithParam<ObjectKind> {
 protected:
  static const Json& published() {
    static const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/to_other.json"));
    for (const Json& object : file.at("technologyObjects"))
      if (object.at("name") == std::string(kind_name(GetParam()))) return object.at("variables");
    ADD_FAILURE() << "not in the catalogue";
    return file;
  }
  static std::vector<const Variable*> declared() {
    std::vector<const Variable*> list;
    for (const auto variables : data_block_of(GetParam()).lists())
      for (const Variable& variable : variables) list.push_back(&variable);
    return list;
  }
  static const Variable* find(const std::string& path) {
    for (const Variable* variable : declared())
      if (variable->path == path) return variable;
    return nullptr;
  }
};

struct Path {
  std::string path;  // with [] for the index
  std::size_t count = 0;
};

Path path_of(const Json& variable) {
  std::string path = variable.at("path");
  const auto open = path.find("[1..");
  if (open == std::string::npos) return {path, 0};
  const auto close = path.find(']');
  return {path.substr(0, open) + "[]" + path.substr(close + 1), std::stoul(path.substr(open + 4))};
}

double number_of(std::string text) {
  std::erase_if(text, [](char c) { return c == '_' || c == ' '; });
  return text.starts_with("16#") ? static_cast<double>(std::stoull(text.substr(3), nullptr, 16))
                                 : std::stod(text);
}

// "0 ... 2", "0, 1" or "16#0 ... 16#FFFF_FFFF".
Range range_of(const Json& text) {
  if (text.is_null()) return kAny;
  const std::string range = text;
  const auto dots = range.find(" ... ");
  if (dots != std::string::npos) return {number_of(range.substr(0, dots)), number_of(range.substr(dots + 5))};
  const auto comma = range.find(", ");
  return {number_of(range.substr(0, comma)), number_of(range.substr(comma + 2))};
}

TEST_P(ObjectVariables, AreThePublishedOnesInTheirOrder) {
  std::vector<std::string> expected, found;
  for (const Json& variable : published()) expected.push_back(path_of(variable).path);
  for (const Variable* variable : declared()) found.emplace_back(variable->path);
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()),
            std::set<std::string>(expected.begin(), expected.end()));
  EXPECT_EQ(found.size(), expected.size());
  for (const auto list : data_block_of(GetParam()).lists()) {
    std::size_t at = 0;
    for (const Variable& variable : list) {
      while (at < expected.size() && expected[at] != variable.path) ++at;
      EXPECT_LT(at, expected.size()) << variable.path << " stands too late";
    }
  }
}

TEST_P(ObjectVariables, HaveThePublishedTypesEffectsAndRanges) {
  const std::map<std::string, Effect> effects = {
      {"DIR", Effect::DIR}, {"CAL", Effect::CAL}, {"RES", Effect::RES}, {"RON", Effect::RON}};
  for (const Json& expected : published()) {
    const auto [path, count] = path_of(expected);
    const Variable* variable = find(path);
    ASSERT_NE(variable, nullptr) << path;
    const std::string type = expected.at("dataType");
    EXPECT_EQ(variable->type == Type::TAG ? "VREF" : type_name(variable->type), type) << path;
    EXPECT_EQ(variable->count, count) << path;
    EXPECT_EQ(variable->effect, effects.at(expected.at("W"))) << path;
    const Range range = range_of(expected.at("valueRange"));
    if (path == "ErrorDetail.Reaction") continue;  // the values of its own list
    if (!kFromZero.contains(path)) {
      EXPECT_EQ(variable->range.lowest, range.lowest) << path;
    }
    EXPECT_EQ(variable->range.highest, range.highest) << path;
  }
}

TEST_P(ObjectVariables, HaveThePublishedValuesAndBits) {
  for (const Json& expected : published()) {
    const std::string path = path_of(expected).path;
    const Variable* variable = find(path);
    ASSERT_NE(variable, nullptr) << path;
    if (expected.contains("values") && path != "ErrorDetail.Reaction") {
      std::vector<std::int64_t> values, choices;
      for (const Json& value : expected.at("values"))
        values.push_back(value.is_boolean() ? value.get<bool>() : value.get<std::int64_t>());
      for (const Choice& choice : variable->choices) choices.push_back(choice.value);
      EXPECT_EQ(choices, values) << path;
    }
    EXPECT_EQ(variable->bits != nullptr, expected.contains("bits")) << path;
    if (variable->bits == nullptr) continue;
    for (std::size_t bit = 0; bit < variable->bits->size(); ++bit)
      EXPECT_EQ((*variable->bits)[bit], expected.at("bits").value(std::to_string(bit), ""))
          << path << ".X" << bit;
  }
}

TEST_P(ObjectVariables, HoldPermittedStartValuesInPlacesOfTheirOwn) {
  std::set<std::size_t> taken;
  for (const Variable* variable : declared())
    for (std::size_t i = 0; i < std::max<std::size_t>(variable->count, 1); ++i) {
      const std::size_t offset = variable->offset + i * variable->stride;
      for (int byte = 0; byte < size_of(variable->type); ++byte)
        EXPECT_TRUE(taken.insert(offset + static_cast<std::size_t>(byte)).second) << variable->path;
      if (variable->type == Type::TAG) continue;
      const double value = as_double(variable->start_value(i), variable->type);
      EXPECT_TRUE(variable->range.allows(value)) << variable->path << " = " << value;
      if (variable->choices.empty()) continue;
      EXPECT_TRUE(std::any_of(variable->choices.begin(), variable->choices.end(), [&](const Choice& choice) {
        return static_cast<double>(choice.value) == value;
      })) << variable->path;
    }
}

TEST_P(ObjectVariables, AreSetByTheProjectUnlessTheRuntimeComputesThem) {
  for (const Variable& variable : data_block_of(GetParam()).status)
    EXPECT_TRUE(variable.computed) << variable.path;
  for (const Variable& variable : data_block_of(GetParam()).configuration)
    EXPECT_EQ(variable.computed, variable.path == "Extrapolation.LeadingAxisDependentTime") << variable.path;
}

// A positioning axis has what a synchronous axis has, but for what only a follower needs.
TEST(PositioningAxis, HasTheVariablesOfASynchronousAxisWithoutWhatOnlyAFollowerNeeds) {
  const Json less =
      Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/to_other.json")).at("notOfPositioningAxis");
  const auto removed = [&](std::string_view path) {
    for (const Json& structure : less.at("structures"))
      if (path.starts_with(structure.get<std::string>() + ".")) return true;
    return false;
  };
  std::size_t left_out = 0;
  for (const auto variables : data_block_of(ObjectKind::TO_SynchronousAxis).lists())
    for (const Variable& variable : variables) {
      if (variable.count != 0) continue;
      const Variable* own = find_variable(ObjectKind::TO_PositioningAxis, variable.path).variable;
      EXPECT_EQ(own == nullptr, removed(variable.path)) << variable.path;
      left_out += own == nullptr;
      if (own == nullptr || variable.bits == nullptr) continue;
      EXPECT_EQ(own->offset, variable.offset);
      for (std::size_t bit = 0; bit < variable.bits->size(); ++bit) {
        const Json gone = less.at("bits").value(std::string(variable.path), Json::array());
        const bool reserved = std::find(gone.begin(), gone.end(), bit) != gone.end();
        EXPECT_EQ((*own->bits)[bit], reserved ? "" : (*variable.bits)[bit]) << variable.path << ".X" << bit;
      }
    }
  EXPECT_GT(left_out, 0u);
}

std::vector<ObjectKind> kinds_of_the_catalogue() {
  std::vector<ObjectKind> kinds;
  const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/to_other.json"));
  for (const Json& object : file.at("technologyObjects"))
    for (const ObjectKindText& known : kObjectKinds)
      if (object.at("name") == std::string(known.name)) kinds.push_back(known.kind);
  return kinds;
}

INSTANTIATE_TEST_SUITE_P(Every, ObjectVariables, testing::ValuesIn(kinds_of_the_catalogue()),
                         [](const auto& kind) { return std::string(kind_name(kind.param)); });

}  // namespace
}  // namespace lockstep::object_variables_test
