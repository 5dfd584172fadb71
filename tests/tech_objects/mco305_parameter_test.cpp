// The parameters and errors of the MCO 305 against the published lists.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tech_objects/mco305_catalogue/errors.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"

namespace lockstep::mco305 {
namespace {

nlohmann::json catalogue(const std::string& name) {
  std::ifstream file(std::string(LOCKSTEP_TEST_DATA) + "/mco305/" + name);
  return nlohmann::json::parse(file);
}

std::string symbol_value(const nlohmann::json& bound, int decimals) {
  if (bound.is_number()) {
    double value = bound.get<double>();
    for (int i = 0; i < decimals; ++i) value *= 10.0;
    return std::to_string(static_cast<std::int64_t>(value + (value < 0 ? -0.5 : 0.5)));
  }
  const auto text = bound.get<std::string>();
  const std::string sign = text.starts_with("-") ? "-" : "";
  return sign + (text.find("VELRES") != std::string::npos ? "10000" : std::to_string(kLargestPosition));
}

TEST(Mco305Parameters, AreThePublishedOnes) {
  std::size_t found = 0;
  const nlohmann::json document = catalogue("parameters.json");
  for (const auto& published : document.at("parameters")) {
    std::string text = published["number"];
    if (text.starts_with("19")) continue;
    text.erase(2, 1);
    const std::size_t index = parameter_index(std::stoi(text));
    ASSERT_NE(index, kNoParameter) << text;
    const Parameter& ours = parameters()[index];
    ++found;
    EXPECT_EQ(ours.title, published["title"].get<std::string>()) << text;
    EXPECT_EQ(ours.later_edition, published["edition"] == "de-only") << text;
    EXPECT_EQ(ours.unit, published["unit"].is_null() ? "" : published["unit"].get<std::string>()) << text;
    const nlohmann::json start = published["default"].is_null() ? nlohmann::json(0) : published["default"];
    EXPECT_EQ(std::to_string(ours.start), symbol_value(start, ours.decimals)) << text;
    if (published["range"].is_null()) continue;
    EXPECT_EQ(std::to_string(ours.lowest), symbol_value(published["range"][0], ours.decimals)) << text;
    EXPECT_EQ(std::to_string(ours.highest), symbol_value(published["range"][1], ours.decimals)) << text;
  }
  EXPECT_EQ(found, parameters().size());
}

TEST(Mco305Parameters, RefuseWhatNothingCanBeComputedWith) {
  ParameterValues values;
  EXPECT_EQ(values.set(kVelRes, 0), kUnknownParameter);
  EXPECT_EQ(values[kVelRes], 100);
  EXPECT_EQ(values.set(4711, 1), kUnknownParameter);
  EXPECT_EQ(values.set(3450, 1), kUnknownParameter);
  EXPECT_EQ(values.set(1942, 5), 0);
  EXPECT_EQ(values[1942], 5);
  EXPECT_EQ(values.changes(1942), 0U);
  EXPECT_EQ(values.change(1942, 6), 0);
  EXPECT_EQ(values.changes(1942), 1U);
}

TEST(Mco305Errors, HaveThePublishedBits) {
  const nlohmann::json document = catalogue("errors.json"), all = document.at("errors");
  EXPECT_EQ(all.size(), errors().size());
  for (const auto& published : all) {
    const Error* const ours = find_error(published["number"]);
    ASSERT_NE(ours, nullptr) << published["number"];
    const std::string word =
        ours->word == 0 ? "" : "word " + std::to_string(ours->word) + " bit " + std::to_string(ours->bit);
    EXPECT_EQ(word, published["alarmWord"].is_null() ? "" : published["alarmWord"].get<std::string>());
  }
}

}  // namespace
}  // namespace lockstep::mco305
