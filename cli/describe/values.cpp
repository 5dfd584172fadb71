#include "cli/describe/values.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "hmi_bridge/traces/csv_number.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::cli {
namespace {

constexpr double kMaximum = std::numeric_limits<double>::max();

template <class Real>
std::string shortest(Real value, std::chars_format format) {
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, format).ptr;
  return {text, end};
}

/// The shortest literal that reads back as the same value of its type.
template <class Real>
std::string shortest_literal(Real value) {
  if (!std::isfinite(value)) return shortest(value, std::chars_format::general);
  const double size = std::abs(static_cast<double>(value));
  if (size == 0.0 || (size >= 1e-4 && size < 1e7)) {
    std::string text = shortest(value, std::chars_format::fixed);
    return text.find('.') == text.npos ? text + ".0" : text;
  }
  const std::string text = shortest(value, std::chars_format::scientific);
  const auto e = text.find('e');
  const std::string mantissa = text.substr(0, e);
  return mantissa + (mantissa.find('.') == mantissa.npos ? ".0" : "") + "E" +
         std::to_string(std::stoi(text.substr(e + 1)));
}

/// A bound of a range as a literal of the type.
std::string bound(Type type, double value) {
  return is_real(type) || type == Type::TIME ? real_literal(value)
                                             : shortest(value, std::chars_format::fixed);
}

/// Whether the type has no values beyond the bound.
bool open_below(Type type, double lowest_allowed) {
  if (lowest_allowed <= -kMaximum) return true;
  return !is_real(type) && type != Type::TIME && lowest_allowed <= static_cast<double>(lowest(type));
}
bool open_above(Type type, double highest_allowed) {
  if (highest_allowed >= kMaximum) return true;
  return !is_real(type) && type != Type::TIME && highest_allowed >= static_cast<double>(highest(type));
}

}  // namespace

std::string real_literal(double value) {
  return shortest_literal(value);
}

std::string literal(Value value, Type type) {
  if (type >= Type::AXIS) return "";
  if (type == Type::BOOL) return value.u != 0 ? "TRUE" : "FALSE";
  if (type == Type::REAL) return shortest_literal(static_cast<float>(value.r));
  if (is_real(type)) return shortest_literal(value.r);
  if (is_bit_string(type)) return fmt::format("16#{:X}", value.u);
  if (type == Type::TIME) {
    char text[kNumberLength];
    return "T#" + std::string(text, print_seconds(text, value.i)) + "s";
  }
  return is_signed_integer(type) ? std::to_string(value.i) : std::to_string(value.u);
}

std::string error_literal(unsigned id) {
  return fmt::format("16#{:04X}", id);
}

std::string range_text(Type type, const Range& range) {
  if (range.unbounded() || type == Type::BOOL) return "";
  const bool below = open_below(type, range.lowest);
  const bool above = open_above(type, range.highest);
  std::string text;
  if (!below && !above)
    text = bound(type, range.lowest) + " to " + bound(type, range.highest);
  else if (!below)
    text = range.lowest == kPositive.lowest ? "> 0.0" : "≥ " + bound(type, range.lowest);
  else if (!above)
    text = "≤ " + bound(type, range.highest);
  if (std::isnan(range.excluded)) return text.empty() && is_real(type) ? "any finite number" : text;
  return text + (text.empty() ? "not " : ", not ") + bound(type, range.excluded);
}

std::vector<std::string> choice_lines(Type type, std::span<const Choice> choices) {
  std::vector<std::string> lines;
  for (const Choice& choice : choices) {
    const std::string value =
        type == Type::BOOL ? choice.value != 0 ? "TRUE" : "FALSE" : std::to_string(choice.value);
    lines.push_back(value + ": " + std::string(choice.text));
  }
  return lines;
}

nlohmann::ordered_json json_value(Value value, Type type) {
  if (type >= Type::AXIS) return nullptr;
  if (type == Type::BOOL) return value.u != 0;
  if (is_real(type)) return value.r;
  if (type == Type::TIME) return literal(value, type);
  if (is_signed_integer(type)) return value.i;
  return value.u;
}

std::string json_text(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(2);  // UTF-8, with C0 escaped already
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t size = lead < 0x80 ? 1 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
    const std::string_view character = std::string_view(text).substr(i, size);
    i += size;
    if (character == "\n" || visible(character) == character) {
      result += character;
      continue;
    }
    unsigned code = size == 1 ? lead : lead & (0x7Fu >> size);
    for (const char c : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(c) & 0x3Fu);
    result += fmt::format("\\u{:04x}", code);  // none of them is beyond 16 bits
  }
  return result;
}

void add_declaration(nlohmann::ordered_json& json, Type type, Unit unit, const Range& range,
                     std::span<const Choice> choices) {
  if (unit != Unit::kNone) json["unit"] = unit_text(unit);
  nlohmann::ordered_json bounds = nlohmann::ordered_json::object();
  if (!open_below(type, range.lowest)) bounds["lowest"] = range.lowest;
  if (!open_above(type, range.highest)) bounds["highest"] = range.highest;
  if (!std::isnan(range.excluded)) bounds["excluded"] = range.excluded;
  if (!bounds.empty()) json["range"] = std::move(bounds);
  if (choices.empty()) return;
  auto& list = json["choices"] = nlohmann::ordered_json::array();
  for (const Choice& choice : choices) {
    nlohmann::ordered_json value = choice.value;
    if (type == Type::BOOL) value = choice.value != 0;
    list.push_back({{"value", std::move(value)}, {"text", choice.text}});
  }
}

}  // namespace lockstep::cli
