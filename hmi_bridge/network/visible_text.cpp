#include "hmi_bridge/network/visible_text.hpp"

#include <algorithm>
#include <cstddef>

namespace lockstep {
namespace {

constexpr std::size_t kMaximumShown = 60;  // characters of a value in a message

/// Whether a terminal obeys a character instead of showing it: the controls C0 and C1, ends of lines and
/// paragraphs, and what turns the direction of others, so that a text reads as something else.
bool is_control(char32_t code) noexcept {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

/// Bytes of the UTF-8 character at the front of the text; 0 if it is none that can be shown.
std::size_t character(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t size = lead < 0x80 ? 1 : lead < 0xC0 ? 0 : lead < 0xE0 ? 2 : lead < 0xF0 ? 3 : 4;
  if (size == 0 || text.size() < size) return 0;
  char32_t code = size == 1 ? lead : lead & (0x7F >> size);
  for (std::size_t i = 1; i < size; ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    if ((byte & 0xC0) != 0x80) return 0;
    code = code << 6 | (byte & 0x3F);
  }
  // A longer form than needed is none: a lenient terminal would read a control out of it.
  constexpr char32_t kFirst[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool is_character = code >= kFirst[size] && code <= 0x10FFFF && (code < 0xD800 || code > 0xDFFF);
  return is_character && !is_control(code) ? size : 0;
}

/// The text, with "?" for what cannot be shown. @param maximum characters
std::string shown_up_to(std::string_view text, std::size_t maximum) {
  std::string result;
  for (std::size_t characters = 0; !text.empty(); ++characters) {
    if (characters == maximum) return result + "…";
    const std::size_t size = character(text);
    if (size == 0)
      result += '?';
    else
      result += text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

}  // namespace

std::string shown(std::string_view text) {
  return shown_up_to(text, kMaximumShown);
}

std::string visible(std::string_view text) {
  return shown_up_to(text, std::string_view::npos);
}

std::string json_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : visible(text)) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

}  // namespace lockstep
