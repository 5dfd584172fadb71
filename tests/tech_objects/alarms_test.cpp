// Compares alarms and error identifiers with the catalogue, both ways.
#include "tech_objects/alarms/alarms.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "tech_objects/alarms/detail.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"

namespace lockstep::alarms_test {
namespace {

using Json = nlohmann::json;

const Json& catalogue() {
  static const Json file = Json::parse(std::ifstream(LOCKSTEP_TEST_DATA "/alarms.json"));
  return file;
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A bit as it is printed, "X11"; -1 for none.
int printed_bit(const Json& bit) {
  return bit.is_null() ? -1 : std::stoi(bit.get<std::string>().substr(1));
}

AlarmClass printed_class(const Json& text) {
  static const std::map<std::string, AlarmClass> classes = {{"warning", AlarmClass::warning},
                                                            {"acknowledgeable", AlarmClass::acknowledgeable},
                                                            {"fatal", AlarmClass::fatal}};
  return classes.at(text.get<std::string>());
}

// Reactions that depend on a variable are printed as "4 or 3"; the first is the one of its start value.
int printed_reaction(const Json& reaction) {
  return reaction.is_number() ? reaction.get<int>() : std::stoi(reaction.get<std::string>());
}

TEST(Alarms, AreThoseOfTheCatalogue) {
  const Json& printed = catalogue().at("alarms");
  ASSERT_EQ(alarms().size(), printed.size());
  for (const Json& row : printed) {
    const Alarm* alarm = find_alarm(row.at("number"));
    ASSERT_NE(alarm, nullptr) << row;
    EXPECT_EQ(alarm->number, row.at("number").get<int>());
    EXPECT_EQ(alarm->text, row.at("meaning").get<std::string>());
    EXPECT_EQ(alarm->reaction, printed_reaction(row.at("reaction"))) << row;
    EXPECT_EQ(alarm->error_bit, printed_bit(row.at("errorWordBit"))) << row;
    EXPECT_EQ(alarm->warning_bit, printed_bit(row.at("warningWordBit"))) << row;
    EXPECT_EQ(alarm->alarm_class, printed_class(row.at("class"))) << row;
  }
}

TEST(Alarms, AreNumberedOnceInAscendingOrder) {
  int last = 0;
  for (const Alarm& alarm : alarms()) {
    EXPECT_GT(alarm.number, last);
    last = alarm.number;
  }
  EXPECT_EQ(find_alarm(0), nullptr);
  EXPECT_EQ(find_alarm(-1), nullptr);
  EXPECT_EQ(find_alarm(1000), nullptr);
}

TEST(Alarms, ShowInABitThatHasAName) {
  for (const Alarm& alarm : alarms()) {
    const bool in_error_word = alarm.error_bit >= 0;
    const int bit = in_error_word ? alarm.error_bit : alarm.warning_bit;
    ASSERT_TRUE(bit >= 0 && bit < 32) << alarm.number;
    EXPECT_NE(alarm.error_bit >= 0, alarm.warning_bit >= 0) << alarm.number;
    const BitNames& names = in_error_word ? kErrorBitNames : kWarningBitNames;
    EXPECT_FALSE(names[static_cast<std::size_t>(bit)].empty()) << alarm.number;
    if (alarm.alarm_class == AlarmClass::warning) {
      EXPECT_EQ(alarm.reaction, 0) << alarm.number;
      EXPECT_FALSE(in_error_word) << alarm.number;
    }
  }
}

TEST(Alarms, HaveTheReactionsThatAnAxisKnowsAndThoseOfOtherObjects) {
  std::set<int> known;
  for (const Json& row : catalogue().at("reactions")) known.insert(row.at("value").get<int>());
  for (const Alarm& alarm : alarms()) EXPECT_TRUE(known.contains(alarm.reaction)) << alarm.number;
  for (const AlarmReaction reaction :
       {AlarmReaction::none, AlarmReaction::stop_current, AlarmReaction::stop_maximum,
        AlarmReaction::stop_emergency, AlarmReaction::remove_enable, AlarmReaction::track_setpoints})
    EXPECT_TRUE(known.contains(static_cast<int>(reaction)));
}

/// Numbers of namespace `alarm`, by their constants.
std::map<int, std::string> constants() {
  std::map<int, std::string> names;
  const std::string header = contents(LOCKSTEP_SOURCE_DIR "/tech_objects/alarms/alarms.hpp");
  const std::regex constant(R"(inline constexpr int (k\w+) = (\d+);)");
  for (std::sregex_iterator found(header.begin(), header.end(), constant), end; found != end; ++found)
    names[std::stoi((*found)[2])] = (*found)[1];
  return names;
}

/// Sources below a folder, one behind the other.
std::string sources(const std::string& folder, const std::string& but = "") {
  std::string all;
  for (const auto& file : std::filesystem::recursive_directory_iterator(LOCKSTEP_SOURCE_DIR "/" + folder))
    if (file.path().extension() == ".cpp" && file.path().filename() != but) all += contents(file.path());
  return all;
}

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> all;
  for (std::sregex_iterator found(text.begin(), text.end(), pattern), end; found != end; ++found)
    all.insert(found->str());
  return all;
}

/// What tests look for: constants of alarms, and numbers beside a word that tells of alarms.
std::set<std::string> looked_for(const std::string& tests) {
  std::set<std::string> all = matches(tests, std::regex(R"(alarm::k\w+)"));
  for (const std::string& line : matches(tests, std::regex(R"((larm|Number)[^\n]*)")))
    all.merge(matches(line, std::regex(R"(\b\d{3}(?=u?\b))")));
  return all;
}

TEST(Alarms, AreRaisedAndTestedOrSayWhyTheyAreNot) {
  const std::map<int, std::string> names = constants();
  const std::string runtime = sources("tech_objects") + sources("fb") + sources("scheduler");
  const std::set<std::string> tested = looked_for(sources("tests", "alarms_test.cpp"));
  for (const Alarm& alarm : alarms()) {
    const auto name = names.find(alarm.number);
    const bool raised = name != names.end() && runtime.find("alarm::" + name->second) != std::string::npos;
    EXPECT_EQ(alarm.not_raised.empty(), raised) << alarm.number << " tells: " << alarm.not_raised;
    EXPECT_TRUE(!raised || tested.contains("alarm::" + name->second) ||
                tested.contains(std::to_string(alarm.number)))
        << alarm.number << " has no test";
  }
  for (const auto& [number, name] : names) EXPECT_NE(find_alarm(number), nullptr) << name;
}

TEST(Alarms, ThatAreRaisedTellCauseAndRemedy) {
  for (const Alarm& alarm : alarms()) {
    EXPECT_EQ(alarm.cause.empty(), !alarm.not_raised.empty()) << alarm.number;
    EXPECT_EQ(alarm.remedy.empty(), !alarm.not_raised.empty()) << alarm.number;
    EXPECT_TRUE(!alarm.values.value.empty() || alarm.values.limit.empty()) << alarm.number;
    EXPECT_EQ(alarm.values.value.empty(), alarm.values.unit == Unit::kNone) << alarm.number;
  }
}

TEST(Alarms, HaveCausesWithNumbersOfTheirOwn) {
  std::set<AlarmCause> seen;
  for (const CauseText& row : alarm_causes()) {
    EXPECT_TRUE(seen.insert(row.cause).second) << row.text;
    EXPECT_EQ(row.text.empty(), row.cause == AlarmCause::none);
    EXPECT_EQ(&cause_text(row.cause), &row);
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(AlarmCause::used_by) + 1) << "each has a text";
}

TEST(ErrorIds, AreThoseOfTheCatalogue) {
  const Json& printed = catalogue().at("errorIds");
  ASSERT_EQ(error_texts().size(), printed.size());
  std::size_t i = 0;
  for (const Json& row : printed) {
    const std::string text = row.at("errorId");
    ASSERT_TRUE(text.starts_with("16#")) << text;
    const auto id = static_cast<ErrorId>(std::stoul(text.substr(3), nullptr, 16));
    EXPECT_EQ(error_text(id), row.at("meaning").get<std::string>()) << text;
    EXPECT_EQ(error_texts()[i++].id, id) << text;
  }
}

TEST(ErrorIds, ThatTheRuntimeReportsHaveATextAndUnknownOnesHaveNone) {
  for (const ErrorId id : {ErrorId::none,
                           ErrorId::technology_alarm,
                           ErrorId::no_technology_object,
                           ErrorId::velocity,
                           ErrorId::acceleration,
                           ErrorId::deceleration,
                           ErrorId::jerk,
                           ErrorId::direction,
                           ErrorId::distance,
                           ErrorId::position,
                           ErrorId::mode,
                           ErrorId::stop_mode,
                           ErrorId::one_instance_only,
                           ErrorId::restarting,
                           ErrorId::restart_refused,
                           ErrorId::locked,
                           ErrorId::homing_mode_incremental,
                           ErrorId::no_job_memory,
                           ErrorId::actual_values_invalid,
                           ErrorId::ratio_numerator,
                           ErrorId::ratio_denominator,
                           ErrorId::recursive_coupling,
                           ErrorId::leading_distance,
                           ErrorId::master_sync_position,
                           ErrorId::slave_sync_position,
                           ErrorId::sync_profile_reference,
                           ErrorId::sensor,
                           ErrorId::not_position_controlled,
                           ErrorId::velocity_gear_active,
                           ErrorId::homing_while_coupled,
                           ErrorId::unspecified})
    EXPECT_FALSE(error_text(id).empty()) << static_cast<int>(id);
  EXPECT_TRUE(error_text(ErrorId{0x1234}).empty());
}

}  // namespace
}  // namespace lockstep::alarms_test
