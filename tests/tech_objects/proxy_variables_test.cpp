// Compares the declared variables of the leading axis proxy with the catalogue of its data block, both ways:
// paths, order, types, effects, ranges, values and bits.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep::proxy_variables_test {
namespace {

using Json = nlohmann::json;

void collect(const Json& variable, std::vector<Json>& leaves) {
  if (!variable.contains("children")) return leaves.push_back(variable);
  for (const Json& child : variable.at("children")) collect(child, leaves);
}

std::vector<Json> published() {
  std::vector<Json> leaves;
  const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/to_leading_axis_proxy.json"));
  for (const Json& section : file.at("sections"))
    for (const Json& variable : section.at("variables")) collect(variable, leaves);
  return leaves;
}

std::vector<const Variable*> declared() {
  std::vector<const Variable*> list;
  for (const auto variables : data_block_of(ObjectKind::TO_LeadingAxisProxy).lists())
    for (const Variable& variable : variables) list.push_back(&variable);
  return list;
}

const Variable* find(const std::string& path) {
  return find_variable(ObjectKind::TO_LeadingAxisProxy, path).variable;
}

TEST(ProxyVariables, AreThePublishedOnes) {
  const std::vector<Json> expected = published();
  EXPECT_EQ(expected.size(), 14u);
  EXPECT_EQ(declared().size(), expected.size());
  const std::map<std::string, Effect> effects = {
      {"DIR", Effect::DIR}, {"CAL", Effect::CAL}, {"RES", Effect::RES}, {"RON", Effect::RON}};
  for (const Json& row : expected) {
    const std::string path = row.at("path"), type = row.at("dataType");
    SCOPED_TRACE(path);
    const Variable* const variable = find(path);
    ASSERT_NE(variable, nullptr);
    EXPECT_EQ(variable->type == Type::TAG ? "VRef" : std::string(type_name(variable->type)), type);
    EXPECT_EQ(variable->effect, effects.at(row.at("W")));
    EXPECT_EQ(variable->computed, row.at("W") == "RON" && type != "VRef");
    const Json& range = row.at("range");
    EXPECT_EQ(variable->range.unbounded(), range.is_null());
    if (range.contains("min")) {
      EXPECT_EQ(variable->range.lowest, range.at("min").get<double>());
      EXPECT_EQ(variable->range.highest, range.at("max").get<double>());
    }
    std::vector<std::int64_t> values, choices;
    if (row.contains("values"))
      for (const Json& value : row.at("values")) values.push_back(value.at("value"));
    for (const Choice& choice : variable->choices) choices.push_back(choice.value);
    EXPECT_EQ(choices, values);
    EXPECT_EQ(variable->bits != nullptr, row.contains("bitNames"));
    if (variable->bits == nullptr) continue;
    const Json& names = row.at("bitNames");
    ASSERT_EQ(names.size(), variable->bits->size());
    for (std::size_t bit = 0; bit < names.size(); ++bit)
      EXPECT_EQ((*variable->bits)[bit], names[bit].is_null() ? "" : names[bit].get<std::string>())
          << path << ".X" << bit;
  }
}

TEST(ProxyVariables, StandInPublishedOrder) {
  const std::vector<Json> expected = published();
  std::size_t last = 0;
  for (const Json& row : expected) {
    const Variable* const variable = find(row.at("path"));
    ASSERT_NE(variable, nullptr);
    EXPECT_GE(variable->offset, last) << row.at("path");
    last = variable->offset;
  }
}

}  // namespace
}  // namespace lockstep::proxy_variables_test
