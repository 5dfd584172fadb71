#include "projects/json/fields.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "projects/literals/duration.hpp"

namespace lockstep {
namespace {

std::string range_text(std::string_view lowest, std::string_view highest) {
  return "from " + std::string(lowest) + " to " + std::string(highest);
}

/// Names of the variants that have a key.
std::vector<std::string_view> variants_with(std::string_view key, std::span<const KeyVariant> variants) {
  std::vector<std::string_view> names;
  for (const KeyVariant& variant : variants)
    if (std::ranges::find(variant.keys, key, &Key::name) != variant.keys.end()) names.push_back(variant.name);
  return names;
}

void check_keys(const JsonValue& value, Keys keys, std::span<const KeyVariant> variants,
                std::string_view variant, Problems& problems) {
  std::vector<std::string_view> names;
  for (const Key& key : keys) names.push_back(key.name);
  for (const auto& [name, member] : value.members) {
    if (std::ranges::find(names, name) != names.end()) continue;
    if (name == keys::kComment.name) {
      read_string(member, problems);
      continue;
    }
    const auto others = variants_with(name, variants);
    const std::string hint = others.empty()
                                 ? did_you_mean(name, names)
                                 : " in a " + std::string(variant) + "; allowed with: " + list_of(others);
    problems.report_key(*member, "unknown key " + quote(name) + hint + "; allowed: " + list_of(names) + ", " +
                                     std::string(keys::kComment.name));
  }
  for (const Key& key : keys)
    if (key.required && value.find(key.name) == nullptr)
      problems.report(value, "the key '" + std::string(key.name) + "' is missing");
}

}  // namespace

std::string decimal_text(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(std::begin(buffer), std::end(buffer), value);
  return {buffer, end};
}

std::string duration_text(std::int64_t nanoseconds) {
  constexpr std::pair<std::int64_t, std::string_view> kUnits[] = {{3'600'000'000'000, "h"},
                                                                  {60'000'000'000, "min"},
                                                                  {1'000'000'000, "s"},
                                                                  {1'000'000, "ms"},
                                                                  {1000, "us"}};
  for (const auto& [unit, name] : kUnits)
    if (nanoseconds != 0 && nanoseconds % unit == 0)
      return std::to_string(nanoseconds / unit) + std::string(name);
  return std::to_string(nanoseconds) + "ns";
}

void report_kind(const JsonValue& value, std::string_view allowed, Problems& problems) {
  if (value.kind == JsonKind::unusable) return;
  problems.report(value, value.shown() + " is not allowed here; allowed: " + std::string(allowed));
}

std::optional<std::string_view> read_string(const JsonValue* value, Problems& problems) {
  if (value == nullptr) return std::nullopt;
  if (value->kind == JsonKind::string) return value->text;
  report_kind(*value, "a string", problems);
  return std::nullopt;
}

std::optional<bool> read_bool(const JsonValue* value, Problems& problems) {
  if (value == nullptr) return std::nullopt;
  if (value->kind == JsonKind::boolean) return value->boolean;
  report_kind(*value, "true, false", problems);
  return std::nullopt;
}

std::optional<std::int64_t> read_integer(const JsonValue* value, std::int64_t lowest, std::int64_t highest,
                                         Problems& problems) {
  if (value == nullptr) return std::nullopt;
  const std::string allowed = "an integer " + range_text(std::to_string(lowest), std::to_string(highest));
  if (value->kind == JsonKind::number && value->whole && value->magnitude <= std::uint64_t{INT64_MAX}) {
    const auto amount = static_cast<std::int64_t>(value->magnitude);
    const std::int64_t number = value->negative ? -amount : amount;
    if (number >= lowest && number <= highest) return number;
  }
  report_kind(*value, allowed, problems);
  return std::nullopt;
}

std::optional<double> read_number(const JsonValue* value, double lowest, double highest, Problems& problems) {
  if (value == nullptr) return std::nullopt;
  if (value->kind == JsonKind::number && value->number >= lowest && value->number <= highest)
    return value->number;
  report_kind(*value, "a number " + range_text(decimal_text(lowest), decimal_text(highest)), problems);
  return std::nullopt;
}

std::optional<std::int64_t> read_duration(const JsonValue* value, std::int64_t lowest, std::int64_t highest,
                                          Problems& problems) {
  if (value == nullptr) return std::nullopt;
  if (value->kind != JsonKind::string) {
    report_kind(*value, "a duration such as \"10ms\"", problems);
    return std::nullopt;
  }
  std::string message;
  const auto duration = parse_duration(value->text, message);
  if (!duration) {
    problems.report(*value, message);
    return std::nullopt;
  }
  if (*duration >= lowest && *duration <= highest) return duration;
  report_kind(*value, "a duration " + range_text(duration_text(lowest), duration_text(highest)), problems);
  return std::nullopt;
}

std::optional<std::size_t> read_word(const JsonValue* value, std::span<const std::string_view> words,
                                     Problems& problems) {
  if (value == nullptr) return std::nullopt;
  if (value->kind != JsonKind::string) {
    report_kind(*value, list_of(words), problems);
    return std::nullopt;
  }
  const auto found = std::find(words.begin(), words.end(), value->text);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  problems.report(*value, value->shown() + " is not allowed here" + did_you_mean(value->text, words) +
                              "; allowed: " + list_of(words));
  return std::nullopt;
}

std::optional<std::string_view> read_title(const JsonValue* value, Problems& problems, std::size_t longest) {
  const auto text = read_string(value, problems);
  if (!text) return std::nullopt;
  const bool readable = visible(*text) == *text;
  if (!text->empty() && text->size() <= longest && readable) return text;
  problems.report(*value, value->shown() + " is not allowed here; allowed: a text of 1 to " +
                              std::to_string(longest) + " bytes without control characters");
  return std::nullopt;
}

std::optional<std::string_view> read_form(const JsonValue* value, const TextForm& form, Problems& problems) {
  const auto text = read_string(value, problems);
  if (!text) return std::nullopt;
  const std::string problem = form.problem(*text);
  if (problem.empty()) return text;
  problems.report(*value, problem);
  return std::nullopt;
}

const JsonValue* read_object(const JsonValue* value, Problems& problems) {
  if (value == nullptr || value->kind == JsonKind::object) return value;
  report_kind(*value, "an object", problems);
  return nullptr;
}

const JsonValue* read_array(const JsonValue* value, Problems& problems) {
  if (value == nullptr || value->kind == JsonKind::array) return value;
  report_kind(*value, "an array", problems);
  return nullptr;
}

std::string_view Fields::comment() const noexcept {
  const JsonValue* const text = value_.find(keys::kComment.name);
  return text != nullptr && text->kind == JsonKind::string ? std::string_view(text->text)
                                                           : std::string_view();
}

Fields::Fields(const JsonValue& value, Keys keys, Problems& problems) : value_(value) {
  if (read_object(&value, problems) != nullptr) check_keys(value, keys, {}, {}, problems);
}

Fields::Fields(const JsonValue& value, std::span<const KeyVariant> variants, std::size_t variant,
               Problems& problems)
    : value_(value) {
  if (read_object(&value, problems) != nullptr)
    check_keys(value, variants[variant].keys, variants, variants[variant].name, problems);
}

}  // namespace lockstep
