// lockstep describe by everyday words: what somebody looks for who does not know how it is called here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/command_run.hpp"

namespace lockstep::cli::describe_search_test {
namespace {

using nlohmann::json;

json described(std::vector<std::string> words) {
  words.insert(words.begin(), "describe");
  words.emplace_back("--json");
  const Ended ended = lockstep(words);
  EXPECT_EQ(ended.status, 0) << words[1] << ": " << ended.err;
  return json::parse(ended.out, nullptr, false);
}

std::vector<std::string> names_in(const json& list) {
  std::vector<std::string> names;
  for (const json& one : list) names.push_back(one["name"]);
  return names;
}

std::size_t place_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

TEST(DescribeSearch, FindsWhatIsMeantByWordsOfEveryday) {
  constexpr std::size_t kScreen = 24;
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"following", "error"}, "521"},
      {{"counter"}, "CTU"},
      {{"counter"}, "CTUD"},
      {{"reset", "counter"}, "CTU.R"},
      {{"division", "by", "zero"}, "/"},
      {{"division", "by", "zero"}, "DIV"},
      {{"select", "text"}, "SEL"},
      {{"halt", "gear"}, "MC_GearOut"},
      {{"metre"}, "Units.LengthUnit"},
      {{"inch"}, "Units.LengthUnit"},
      {{"modified", "sine"}, "modified sine"},
      {{"sweep"}, "sweep"},
      {{"latch"}, "SR"}};
  for (const auto& [words, name] : cases)
    EXPECT_LT(place_of(names_in(described(words)["found"]), name), kScreen)
        << words[0] << ": " << name << " in\n"
        << described(words).dump(1).substr(0, 4000);
}

TEST(DescribeSearch, TellsAlarmsFirstAndDialectsLastAndMotorsOnce) {
  const std::vector<std::string> names = names_in(described({"following", "error"})["found"]);
  EXPECT_EQ(place_of(names, "521"), 0U);
  EXPECT_LT(place_of(names, "FollowingError.MaxValue"), place_of(names, "A.FollowingError"));
  EXPECT_LT(place_of(names, "A.FollowingError"), names.size());
  EXPECT_EQ(place_of(names, "B.FollowingError"), names.size());
  const std::string shown = lockstep({"describe", "following", "error"}).out;
  EXPECT_NE(shown.find("Following error too large"), std::string::npos) << shown;
}

TEST(DescribeSearch, LooksIntoCausesAndRemedies) {
  const std::vector<std::string> names = names_in(described({"blocked", "overloaded"})["found"]);
  EXPECT_LT(place_of(names, "521"), names.size());
}

TEST(DescribeSearch, ANameOfADialectLeadsToWhatElseIsCalledSo) {
  for (const auto& [word, name] : {std::pair("timer", "TON"), std::pair("home", "MC_Home")}) {
    const json found = described({word});
    EXPECT_LT(place_of(names_in(found["also"]), name), 8U) << found.dump(1);
    const std::string shown = lockstep({"describe", word}).out;
    EXPECT_NE(shown.find(name), std::string::npos) << shown;
  }
  EXPECT_FALSE(described({"KPROP"}).contains("also"));
}

TEST(DescribeSearch, TakesWhatARunTells) {
  EXPECT_EQ(described({"alarm", "521"})["number"], 521);
  EXPECT_EQ(described({"ErrorID", "16#8001"})["id"], "16#8001");
  EXPECT_EQ(described({"ErrorID", "8001"})["id"], "16#8001");
  EXPECT_EQ(described({"error", "16#8001"})["id"], "16#8001");
  EXPECT_EQ(described({"error", "8001"})["id"], "16#8001");
  EXPECT_EQ(described({"error", "32769"})["id"], "16#8001");
  EXPECT_EQ(lockstep({"describe", "alarm", "99999"}).status, 1);
  EXPECT_EQ(lockstep({"describe", "ErrorID", "1"}).status, 1);
}

}  // namespace
}  // namespace lockstep::cli::describe_search_test
