/// What the catalogues of instructions say about the value of a pin.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/conformance/subject.hpp"

namespace lockstep::test {

enum class Verdict : std::uint8_t { accepted, rejected, not_said };

class PublishedValues {
 public:
  /// The pins of a published block; an unknown one says nothing about any of its values.
  explicit PublishedValues(std::string_view block) {
    for (const char* name : {"instructions_axis.json", "instructions.json"}) {
      const auto file = nlohmann::json::parse(std::ifstream(std::string(LOCKSTEP_TEST_DATA) + "/" + name));
      for (const auto& entry : file)
        if (entry.at("name") == std::string(block))
          for (const auto& pin : entry.at("parameters")) pins_[pin.at("name")] = pin;
    }
  }

  /// Whether the value of the pin counts, given the others and the following axis.
  bool relevant(Subject& subject, const Pin& pin, bool modulo) const {
    const auto found = pins_.find(std::string(pin.name));
    if (found == pins_.end() || !found->second.contains("relevantWhen")) return true;
    for (const auto& [name, values] : found->second.at("relevantWhen").items()) {
      if (const Pin* other = subject.type().find_pin(name)) {
        const double number = subject.number(*other);
        bool listed = false;
        for (const auto& value : values) listed |= value.get<double>() == number;
        if (!listed) return false;
      } else if (!modulo) {  // the conditions that are no pin ask for a ring
        return false;
      }
    }
    return true;
  }

  /// A setting of other pins with which the value of this one counts: name and number.
  std::map<std::string, double> relevant_setting(const Pin& pin) const {
    std::map<std::string, double> setting;
    const auto found = pins_.find(std::string(pin.name));
    if (found == pins_.end() || !found->second.contains("relevantWhen")) return setting;
    for (const auto& [name, values] : found->second.at("relevantWhen").items())
      if (pins_.contains(name)) setting[name] = values.at(0).get<double>();
    return setting;
  }

  Verdict verdict(Subject& subject, const Pin& pin, double number, bool modulo) const {
    if (!std::isfinite(number)) return Verdict::rejected;
    if (!relevant(subject, pin, modulo)) return Verdict::accepted;
    const auto found = pins_.find(std::string(pin.name));
    if (found == pins_.end() || !found->second.contains("allowed")) return Verdict::not_said;
    bool all_said = true;
    Verdict verdict = Verdict::not_said;
    for (const auto& rule : found->second.at("allowed")) {
      all_said &= rule.contains("value") || of_arrays(rule);
      if (!rule.contains("valid") || !matches(rule, subject, number)) continue;
      // "0 is not permitted" stands beside the range that holds it.
      if (verdict != Verdict::rejected)
        verdict = rule.at("valid").get<bool>() ? Verdict::accepted : Verdict::rejected;
    }
    if (verdict == Verdict::not_said && all_said) return Verdict::rejected;
    return verdict;
  }

 private:
  /// Rules of MC_CopyCamData, which name the kind of cam or bounds of arrays.
  static bool of_arrays(const nlohmann::json& rule) {
    if (rule.contains("rule")) return true;
    const std::string when = rule.value("when", "");
    return when.starts_with("TO_Cam") || when.starts_with("lower bound of ");
  }

  static const Array& array_of(Subject& subject, const std::string& pin) {
    const Pin& found = *subject.type().find_pin(pin);
    return *std::bit_cast<const Array*>(found.signal(subject.block()).load().u);
  }

  /// The cam of the bench is a TO_Cam.
  static bool matches_array(const nlohmann::json& rule, Subject& subject, double number) {
    const std::string when = rule.value("when", "");
    if (when == "TO_Cam_10k") return false;
    if (rule.contains("range"))
      return number >= rule.at("range").at(0).get<double>() && number <= rule.at("range").at(1).get<double>();
    char words[3][32] = {};
    if (std::sscanf(when.c_str(), "lower bound of %31s <= value", words[0]) == 1) {
      const Array& array = array_of(subject, words[0]);
      return number >= array.lower && number <= array.upper;
    }
    const std::string text = rule.value("rule", "");
    int above = 0;
    if (std::sscanf(text.c_str(), "value <= number of %31s in %31s and 0 <= value <= %d - %31s", words[0],
                    words[1], &above, words[2]) != 4) {
      ADD_FAILURE() << "a rule that this test cannot read: " << rule;
      return false;
    }
    const double start = subject.number(*subject.type().find_pin(words[2]));
    return number >= 0.0 && number <= above - start &&
           number <= static_cast<double>(array_of(subject, words[1]).count());
  }

  static bool matches(const nlohmann::json& rule, Subject& subject, double number) {
    if (of_arrays(rule)) return matches_array(rule, subject, number);
    if (rule.contains("range"))
      return number >= rule.at("range").at(0).get<double>() && number <= rule.at("range").at(1).get<double>();
    if (rule.contains("value")) {
      const auto& value = rule.at("value");
      if (value.is_boolean()) return number == (value.get<bool>() ? 1.0 : 0.0);
      if (value.is_number()) return number == value.get<double>();
      const std::string text = value;  // "1..4"
      const auto dots = text.find("..");
      if (dots == std::string::npos) return false;
      return number >= std::stod(text.substr(0, dots)) && number <= std::stod(text.substr(dots + 2));
    }
    return compares(rule.at("when"), number);
  }

  static bool compares(const std::string& condition, double number) {
    const auto space = condition.find(' ');
    const std::string sign = condition.substr(0, space);
    if (sign == ">") return number > std::stod(condition.substr(space));
    if (sign == ">=") return number >= std::stod(condition.substr(space));
    if (sign == "=") return number == std::stod(condition.substr(space));
    if (sign == "<") return number < std::stod(condition.substr(space));
    if (sign == "<=") return number <= std::stod(condition.substr(space));
    ADD_FAILURE() << "a condition that this test cannot read: " << condition;
    return false;
  }

  std::map<std::string, nlohmann::json> pins_;
};

}  // namespace lockstep::test
