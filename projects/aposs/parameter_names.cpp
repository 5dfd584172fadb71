#include "projects/aposs/parameter_names.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "projects/json/problem.hpp"

namespace lockstep::aposs {
namespace {

struct OldName {
  std::string_view name;
  std::int32_t function;  ///< of the input, normally open
};
constexpr OldName kOldNames[] = {{"I_REFSWITCH", 1}, {"I_NEGLIMITSW", 3}, {"I_POSLIMITSW", 5},
                                 {"I_ERRCLR", 7},    {"I_BREAK", 9},      {"I_CONTINUE", 11},
                                 {"I_PRGSTART", 13}, {"I_PRGCHOICE", 15}};

std::optional<std::int32_t> number_of(std::string_view digits) {
  std::int32_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

/// I_FUNCTION_n_m.
std::optional<std::int32_t> input_function(std::string_view name) {
  constexpr std::string_view kBegin = "I_FUNCTION_";
  if (!name.starts_with(kBegin)) return std::nullopt;
  name.remove_prefix(kBegin.size());
  const std::size_t bar = name.find('_');
  if (bar == name.npos) return std::nullopt;
  const auto function = number_of(name.substr(0, bar)), input = number_of(name.substr(bar + 1));
  if (!function || !input || *function < 1 || *function > 15 || *input < 1 || *input > 12)
    return std::nullopt;
  return kInputFunction + 100 * *function + *input;
}

}  // namespace

std::optional<std::int32_t> parameter_number(std::string_view name) {
  if (name.empty()) return std::nullopt;
  for (const mco305::Parameter& parameter : mco305::parameters())
    if (parameter.mnemonic == name) return parameter.number;
  for (const OldName& old : kOldNames)
    if (old.name == name) return kInputFunction + 100 * old.function;
  return input_function(name);
}

std::optional<std::int32_t> parameter_of(std::string_view name) {
  std::string upper(name);
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  if (const auto number = parameter_number(upper); number && is_parameter(*number)) return number;
  const bool grouped = upper.size() == 5 && upper[2] == '-';
  if (grouped) upper.erase(2, 1);
  const auto number = number_of(upper);
  if (!number || !is_parameter(*number) || (*number >= 2000 && !grouped)) return std::nullopt;
  return number;
}

bool is_parameter(std::int32_t number) noexcept {
  return mco305::parameter_index(number) != mco305::kNoParameter;
}

bool is_later_parameter(std::int32_t number) noexcept {
  const std::size_t index = mco305::parameter_index(number);
  return index < mco305::parameters().size() && mco305::parameters()[index].later_edition;
}

std::string parameter_text(std::int32_t number) {
  if (number < 2000) return std::to_string(number);
  const std::string rest = std::to_string(number % 100);
  return std::to_string(number / 100) + (rest.size() < 2 ? "-0" : "-") + rest;
}

std::string nearest_parameter(std::string_view name) {
  std::vector<std::string_view> names;
  for (const mco305::Parameter& parameter : mco305::parameters())
    if (!parameter.mnemonic.empty()) names.push_back(parameter.mnemonic);
  const std::string hint = did_you_mean(name, names);
  const std::size_t begin = hint.find('\''), end = hint.rfind('\'');
  if (begin == hint.npos || end <= begin) return "";
  const std::string found = hint.substr(begin + 1, end - begin - 1);
  return found + " " + parameter_text(*parameter_number(found));
}

}  // namespace lockstep::aposs
