#include "hmi_bridge/traces/text_literal.hpp"

namespace lockstep {
namespace {

constexpr std::string_view kHex = "0123456789ABCDEF";

bool is_printable(unsigned char c) noexcept {
  return (c >= 0x20 && c <= 0x7E) || c >= 0xA0;
}

std::string utf8_of(unsigned char c) {
  if (c < 0x80) return std::string(1, static_cast<char>(c));
  return {static_cast<char>(0xC0 | c >> 6), static_cast<char>(0x80 | (c & 0x3F))};
}

/// Takes the first character off a text in UTF-8; none if it is not one of ISO 8859-1.
std::optional<unsigned char> take_character(std::string_view& utf8) {
  const auto lead = static_cast<unsigned char>(utf8.front());
  utf8.remove_prefix(1);
  if (lead < 0x80) return lead;
  if ((lead != 0xC2 && lead != 0xC3) || utf8.empty()) return std::nullopt;
  const auto second = static_cast<unsigned char>(utf8.front());
  if ((second & 0xC0) != 0x80) return std::nullopt;
  utf8.remove_prefix(1);
  return static_cast<unsigned char>(lead << 6 | (second & 0x3F));
}

/// Takes what follows a $ off a literal: $$, $' or $hh.
std::optional<char> take_escaped(std::string_view& rest) {
  if (rest.starts_with('$') || rest.starts_with('\'')) {
    const char c = rest.front();
    rest.remove_prefix(1);
    return c;
  }
  std::size_t code = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::size_t digit = i < rest.size() ? kHex.find(rest[i]) : kHex.npos;
    if (digit == kHex.npos) return std::nullopt;
    code = 16 * code + digit;
  }
  rest.remove_prefix(2);
  return code == 0 ? std::nullopt : std::optional(static_cast<char>(code));
}

}  // namespace

std::optional<std::string> text_from_utf8(std::string_view utf8) {
  std::string text;
  while (!utf8.empty()) {
    const auto c = take_character(utf8);
    if (!c || !is_printable(*c)) return std::nullopt;
    text += static_cast<char>(*c);
  }
  return text;
}

std::string text_to_utf8(std::string_view text) {
  std::string utf8;
  for (const char c : text) utf8 += utf8_of(static_cast<unsigned char>(c));
  return utf8;
}

std::string text_literal(std::string_view text) {
  std::string literal = "'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (!is_printable(byte)) {
      literal += {'$', kHex[byte >> 4], kHex[byte & 15]};
      continue;
    }
    if (c == '$' || c == '\'') literal += '$';
    literal += utf8_of(byte);
  }
  return literal + "'";
}

std::optional<std::string> read_text_literal(std::string_view literal, std::string& problem) {
  problem.clear();
  const bool is_quoted = literal.size() >= 2 && literal.front() == '\'' && literal.back() == '\'';
  if (!is_quoted) {
    problem = "a text stands in single quotes";
    return std::nullopt;
  }
  std::string_view rest = literal.substr(1, literal.size() - 2);
  std::string text;
  while (!rest.empty()) {
    const char first = rest.front();
    if (first == '$') {
      rest.remove_prefix(1);
      const auto escaped = take_escaped(rest);
      if (!escaped) problem = "after a $ in a text are allowed: $, ', two digits such as 0A (not 00)";
      text += escaped.value_or('?');
    } else {
      const auto c = take_character(rest);
      if (first == '\'') problem = "a quote within a text is written $'";
      if (!c || !is_printable(*c)) problem = "a text has printable characters of ISO 8859-1 only";
      text += static_cast<char>(c.value_or('?'));
    }
    if (!problem.empty()) return std::nullopt;
  }
  return text;
}

}  // namespace lockstep
