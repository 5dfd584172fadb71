#include "projects/expressions/string_type.hpp"

#include <charconv>

#include "hmi_bridge/traces/text_literal.hpp"
#include "projects/json/fields.hpp"
#include "scheduler/text.hpp"

namespace lockstep {

bool is_string_type(std::string_view text) noexcept {
  return text.starts_with("STRING");
}

std::optional<std::size_t> read_string_type(const JsonValue& json, Problems& problems) {
  constexpr std::string_view kBegin = "STRING[";
  const std::string_view text = json.text;
  std::size_t capacity = 0;
  if (text.starts_with(kBegin)) {
    const char* const end = text.data() + text.size();
    const auto [behind, error] = std::from_chars(text.data() + kBegin.size(), end, capacity);
    const bool is_good = error == std::errc{} && std::string_view(behind, end) == "]";
    if (is_good && capacity >= 1 && capacity <= kLongestText) return capacity;
  }
  problems.report(json, json.shown() + " is no type of a text; allowed: STRING[n], n from 1 to " +
                            std::to_string(kLongestText) + ", such as STRING[20]");
  return std::nullopt;
}

std::string string_type_pattern() {
  static_assert(kLongestText == 254);
  return "^STRING\\[0*([1-9][0-9]?|1[0-9]{2}|2[0-4][0-9]|25[0-4])\\]$";
}

std::optional<std::string> read_text_constant(const JsonValue& json, std::size_t capacity,
                                              Problems& problems) {
  const std::string allowed = "a text of up to " + std::to_string(capacity) + " printable characters";
  if (json.kind != JsonKind::string) {
    report_kind(json, allowed, problems);
    return std::nullopt;
  }
  auto text = text_from_utf8(json.text);
  if (!text)
    problems.report(json, json.shown() + " holds a character that no STRING has; allowed: " + allowed +
                              " of ISO 8859-1 (Latin-1)");
  else if (text->size() > capacity)
    problems.report(
        json, json.shown() + " has " + std::to_string(text->size()) + " characters; allowed: " + allowed);
  else
    return text;
  return std::nullopt;
}

}  // namespace lockstep
