// Compares the declared variables with the catalogue of the published data block, both ways, and finds each.
#include "tech_objects/data_blocks/variable.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace lockstep::variable_test {
namespace {

using Json = nlohmann::json;

// Ours alone; everything else is published.
constexpr const char* kOwnVariable = "Synchronization.MasterReversionTolerance";
// Not one variable of these is documented, so there is nothing to declare.
const std::set<std::string> kInternal = {"ControlPanel", "InternalToTrace"};

Json read(const char* name) {
  return Json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/" + name));
}

void collect(const Json& variable, std::vector<Json>& leaves) {
  if (variable.contains("children"))
    for (const Json& child : variable.at("children")) collect(child, leaves);
  else if (variable.at("kind") != "struct-internal")
    leaves.push_back(variable);
  else
    EXPECT_TRUE(kInternal.contains(variable.at("path"))) << variable;
}

// The published variables in published order.
const std::vector<Json>& published() {
  static const std::vector<Json> list = [] {
    std::vector<Json> leaves;
    const Json file = read("to_synchronous_axis.json");
    for (const Json& section : file.at("sections"))
      for (const Json& variable : section.at("variables")) collect(variable, leaves);
    return leaves;
  }();
  return list;
}

struct PublishedPath {
  std::string path;  // with [] for the index
  std::size_t count = 0;
};

// "Sensor[1..4].Type" is declared once for its four elements, as "Sensor[].Type".
PublishedPath published_path(const Json& variable) {
  std::string path = variable.at("path");
  const auto open = path.find("[1..");
  if (open == std::string::npos) return {path, 0};
  const auto close = path.find(']');
  const std::size_t count = std::stoul(path.substr(open + 4, close - open - 4));
  return {path.substr(0, open) + "[]" + path.substr(close + 1), count};
}

std::vector<const Variable*> declared() {
  std::vector<const Variable*> list;
  for (const auto variables : data_block_of(ObjectKind::TO_SynchronousAxis).lists())
    for (const Variable& variable : variables) list.push_back(&variable);
  return list;
}

const Variable* find_declared(const std::string& path) {
  for (const Variable* variable : declared())
    if (variable->path == path) return variable;
  return nullptr;
}

std::string concrete(std::string_view path, std::size_t index) {
  std::string text(path);
  if (const auto open = text.find("[]"); open != std::string::npos)
    text.replace(open, 2, "[" + std::to_string(index) + "]");
  return text;
}

Type published_type(const std::string& name) {
  if (name == "VREF") return Type::TAG;
  if (name == "DB_ANY") return Type::DB_ANY;
  const auto type = tag_type(name);
  EXPECT_TRUE(type) << name;
  return type.value_or(Type::BOOL);
}

// "DL" stands at one variable and in no legend: loaded with the configuration, as RES is.
Effect published_effect(const std::string& code) {
  static const std::map<std::string, Effect> effects = {{"DIR", Effect::DIR},
                                                        {"CAL", Effect::CAL},
                                                        {"RES", Effect::RES},
                                                        {"RON", Effect::RON},
                                                        {"DL", Effect::RES}};
  return effects.at(code);
}

struct Bounds {
  double lowest, highest;
};

// Lowest and highest printed value; a range printed for linear and for rotary axes holds both.
Bounds published_bounds(const Json& range) {
  if (range.is_array()) {
    Bounds hull{INFINITY, -INFINITY};
    for (const Json& part : range) {
      hull.lowest = std::min(hull.lowest, part.at("min").get<double>());
      hull.highest = std::max(hull.highest, part.at("max").get<double>());
    }
    return hull;
  }
  if (range.contains("set")) {
    const auto set = range.at("set").get<std::vector<double>>();
    return {*std::min_element(set.begin(), set.end()), *std::max_element(set.begin(), set.end())};
  }
  return {range.at("min"), range.at("max")};
}

std::vector<std::int64_t> published_choices(const Json& variable) {
  std::vector<std::int64_t> values;
  if (!variable.contains("values")) return values;
  for (const Json& row : variable.at("values")) {
    const Json& value = row.at("value");
    values.push_back(value.is_boolean() ? (value.get<bool>() ? 1 : 0) : value.get<std::int64_t>());
  }
  return values;
}

TEST(Variables, AreThePublishedOnesAndOneOfOurs) {
  std::set<std::string> expected = {kOwnVariable};
  for (const Json& variable : published())
    EXPECT_TRUE(expected.insert(published_path(variable).path).second) << variable.at("path");
  std::set<std::string> actual;
  for (const Variable* variable : declared())
    EXPECT_TRUE(actual.insert(std::string(variable->path)).second) << variable->path << " is declared twice";
  EXPECT_EQ(actual, expected);
  EXPECT_EQ(published().size(), 213u);
}

TEST(Variables, StandInPublishedOrder) {
  for (const auto variables : data_block_of(ObjectKind::TO_SynchronousAxis).lists()) {
    std::size_t at = 0;
    for (const Variable& variable : variables) {
      if (variable.path == kOwnVariable) continue;
      while (at < published().size() && published_path(published()[at]).path != variable.path) ++at;
      EXPECT_LT(at, published().size()) << variable.path << " stands too late";
    }
  }
}

TEST(Variables, HaveThePublishedTypesArraysAndEffects) {
  for (const Json& expected : published()) {
    const PublishedPath path = published_path(expected);
    const Variable* variable = find_declared(path.path);
    ASSERT_NE(variable, nullptr) << path.path;
    EXPECT_EQ(type_name(variable->type), type_name(published_type(expected.at("dataType")))) << path.path;
    EXPECT_EQ(variable->count, path.count) << path.path;
    EXPECT_EQ(variable->effect, published_effect(expected.at("W"))) << path.path;
  }
}

TEST(Variables, PermitThePublishedRanges) {
  for (const Json& expected : published()) {
    const Variable& variable = *find_declared(published_path(expected).path);
    const Json& range = expected.at("range");
    if (range.is_null()) {
      EXPECT_TRUE(variable.range.unbounded()) << variable.path;
      continue;
    }
    const Bounds bounds = published_bounds(range);
    EXPECT_EQ(variable.range.lowest, bounds.lowest) << variable.path;
    EXPECT_EQ(variable.range.highest, bounds.highest) << variable.path;
    EXPECT_TRUE(std::isnan(variable.range.excluded)) << variable.path;
  }
}

TEST(Variables, HaveThePublishedValuesOfEnumerations) {
  for (const Json& expected : published()) {
    const Variable& variable = *find_declared(published_path(expected).path);
    std::vector<std::int64_t> values;
    for (const Choice& choice : variable.choices) {
      values.push_back(choice.value);
      EXPECT_FALSE(choice.text.empty()) << variable.path;
      EXPECT_TRUE(variable.range.allows(static_cast<double>(choice.value))) << variable.path;
    }
    EXPECT_EQ(values, published_choices(expected)) << variable.path;
    if (!expected.contains("values")) continue;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (expected.at("values")[i].contains("name")) {
        const std::string name = expected.at("values")[i].at("name");
        EXPECT_TRUE(variable.choices[i].text.starts_with(name)) << variable.path << ": " << name;
      }
  }
}

TEST(Variables, NameTheBitsOfTheirWords) {
  const Json words = read("status_bits.json").at("TO_SynchronousAxis").at("words");
  std::set<std::string> with_bits;
  for (const Json& word : words) {
    const std::string path = word.at("path");
    with_bits.insert(path);
    const Variable* variable = find_declared(path);
    ASSERT_NE(variable, nullptr) << path;
    ASSERT_NE(variable->bits, nullptr) << path;
    const Json& names = word.at("bitNames");
    ASSERT_EQ(names.size(), variable->bits->size());
    for (std::size_t bit = 0; bit < names.size(); ++bit)
      EXPECT_EQ((*variable->bits)[bit], names[bit].is_null() ? "" : names[bit].get<std::string>())
          << path << ".X" << bit;
  }
  for (const Variable* variable : declared())
    EXPECT_EQ(variable->bits != nullptr, with_bits.contains(std::string(variable->path))) << variable->path;
}

TEST(Variables, HoldDefaultsThatTheirRangesPermit) {
  AxisData data;
  for (const Variable* variable : declared()) {
    for (std::size_t i = 1; i <= std::max<std::size_t>(variable->count, 1); ++i) {
      const std::string path = concrete(variable->path, i);
      const double value =
          as_double(find_variable(ObjectKind::TO_SynchronousAxis, path).signal(&data).load(), variable->type);
      if (variable->type == Type::TAG) {
        EXPECT_EQ(value, 0.0) << path << " names no tag until it is given one";
        continue;
      }
      EXPECT_TRUE(std::isfinite(value)) << path;
      EXPECT_TRUE(variable->range.allows(value)) << path << " = " << value;
      const bool chosen =
          std::any_of(variable->choices.begin(), variable->choices.end(),
                      [&](const Choice& choice) { return static_cast<double>(choice.value) == value; });
      // The list of this one holds its special value only; the others are numbers of objects.
      EXPECT_TRUE(variable->type == Type::DB_ANY || variable->choices.empty() || chosen) << path;
    }
  }
}

// No two variables share a byte, and none lies outside the data block.
TEST(Variables, LieInPlacesOfTheirOwn) {
  std::vector<bool> taken(sizeof(AxisData), false);
  for (const Variable* variable : declared())
    for (std::size_t i = 1; i <= std::max<std::size_t>(variable->count, 1); ++i) {
      const std::string path = concrete(variable->path, i);
      const std::size_t offset = find_variable(ObjectKind::TO_SynchronousAxis, path).offset;
      const auto size = static_cast<std::size_t>(size_of(variable->type));
      ASSERT_LE(offset + size, sizeof(AxisData)) << path;
      for (std::size_t byte = offset; byte < offset + size; ++byte) {
        EXPECT_FALSE(taken[byte]) << path << " lies on another variable";
        taken[byte] = true;
      }
    }
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

bool has_bits(const Variable& variable) {
  return is_bit_string(variable.type) || is_integer(variable.type);
}

TEST(FindVariable, FindsEachPathEachElementAndEachBit) {
  AxisData data;
  for (const Variable* variable : declared()) {
    for (std::size_t i = 1; i <= std::max<std::size_t>(variable->count, 1); ++i) {
      const std::string path = concrete(variable->path, i);
      for (const std::string& spelled : {path, upper(path)}) {
        const VariableAddress place = find_variable(ObjectKind::TO_SynchronousAxis, spelled);
        ASSERT_EQ(place.variable, variable) << spelled;
        EXPECT_EQ(place.bit, -1) << spelled;
        EXPECT_EQ(place.offset, variable->offset + (i - 1) * variable->stride) << spelled;
      }
      if (!has_bits(*variable)) {
        EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, path + ".X0").variable, nullptr) << path;
        continue;
      }
      const int width = 8 * size_of(variable->type);
      for (int bit = 0; bit < width; ++bit) {
        const VariableAddress place =
            find_variable(ObjectKind::TO_SynchronousAxis, path + ".X" + std::to_string(bit));
        ASSERT_EQ(place.variable, variable) << path << ".X" << bit;
        EXPECT_EQ(place.bit, bit);
        EXPECT_EQ(place.signal(&data).value_type(), Type::BOOL);
      }
      EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, path + ".X" + std::to_string(width)).variable,
                nullptr)
          << path;
    }
  }
}

TEST(FindVariable, RefusesWhatIsNotThere) {
  for (const char* path : {"",
                           ".",
                           "Positio",
                           "Positions",
                           "Position.",
                           ".Position",
                           " Position",
                           "Position ",
                           "Position[1]",
                           "Sensor",
                           "Sensor.Type",
                           "Sensor[].Type",
                           "Sensor[0].Type",
                           "Sensor[5].Type",
                           "Sensor[-1].Type",
                           "Sensor[+1].Type",
                           "Sensor[ 1].Type",
                           "Sensor[1 ].Type",
                           "Sensor[1.0].Type",
                           "Sensor[1]Type",
                           "Sensor[1].",
                           "Sensor[1]",
                           "Sensor[1].Nothing",
                           "Sensor[1][1].Type",
                           "Sensor]1[.Type",
                           "Sensor[99999999999999999999].Type",
                           "Sensor[18446744073709551617].Type",
                           "StatusWord.X",
                           "StatusWord.22",
                           "StatusWord.X32",
                           "StatusWord.X-1",
                           "StatusWord.X+1",
                           "StatusWord.X1.5",
                           "StatusWord.X1.X1",
                           "StatusWord.X100",
                           "StatusWord.Y1",
                           "StatusWord.Enable",
                           "Position.X0",
                           "Modulo.Enable.X0",
                           "Modulo",
                           "Modulo.",
                           "DynamicLimits..MaxVelocity",
                           "ControlPanel",
                           "InternalToTrace"})
    EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, path).variable, nullptr) << "'" << path << "'";
}

TEST(FindVariable, GivesTheSignalOfTheMember) {
  AxisData data;
  data.Sensor[2].Type = 2;
  EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, "Sensor[3].Type").signal(&data).load().i, 2);
  EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, "Sensor[2].Type").signal(&data).load().i,
            data.Sensor[1].Type);
  data.Modulo.Length = 123.25;
  EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, "modulo.length").signal(&data).load().r, 123.25);
  set_bit(data.StatusWord, StatusBit::Synchronous, true);
  EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, "StatusWord.X22").signal(&data).load().u, 1u);
  EXPECT_EQ(find_variable(ObjectKind::TO_SynchronousAxis, "statusword.x21").signal(&data).load().u, 0u);
}

// Refused in a project: what the runtime computes.
TEST(Variables, AreSetByTheProjectUnlessTheRuntimeComputesThem) {
  for (const Variable& variable : data_block_of(ObjectKind::TO_SynchronousAxis).status)
    EXPECT_TRUE(variable.computed) << variable.path;
  for (const Variable& variable : data_block_of(ObjectKind::TO_SynchronousAxis).configuration)
    EXPECT_EQ(variable.computed, variable.path == "Extrapolation.LeadingAxisDependentTime") << variable.path;
}

}  // namespace
}  // namespace lockstep::variable_test
