#include "projects/json/problem.hpp"

#include <algorithm>
#include <numeric>

#include "projects/json/document.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kMostShown = 60;   // characters of a value in a message
constexpr std::size_t kMostListed = 24;  // names of a list in a message

char lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

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

/// The text, with "?" for what cannot be shown. @param most characters
std::string shown_up_to(std::string_view text, std::size_t most) {
  std::string result;
  for (std::size_t characters = 0; !text.empty(); ++characters) {
    if (characters == most) return result + "…";
    const std::size_t size = character(text);
    if (size == 0)
      result += '?';
    else
      result += text.substr(0, size);
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return result;
}

/// Number of letters to insert, remove, replace or exchange to get from one name to the other, up to `most`
/// + 1.
std::size_t distance(std::string_view a, std::string_view b, std::size_t most) {
  std::vector<std::size_t> two_up, up(b.size() + 1), row(b.size() + 1);
  std::iota(up.begin(), up.end(), std::size_t{0});
  two_up = up;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    std::size_t least = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({up[j] + 1, row[j - 1] + 1, up[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], two_up[j - 2] + 1);
      least = std::min(least, row[j]);
    }
    if (least > most) return most + 1;
    std::swap(two_up, up);
    std::swap(up, row);
  }
  return up[b.size()];
}

}  // namespace

std::string to_string(std::string_view file, const Problem& problem) {
  return std::string(file) + ":" + problem.place + ": " + problem.text;
}

void Problems::report(const JsonValue& at, std::string text) {
  errors_.push_back({at.pointer(), std::move(text)});
}

void Problems::warn(const JsonValue& at, std::string text) {
  warnings_.push_back({at.pointer(), std::move(text)});
}

std::string shown(std::string_view text) {
  return shown_up_to(text, kMostShown);
}

std::string visible(std::string_view text) {
  return shown_up_to(text, std::string_view::npos);
}

std::string quote(std::string_view text) {
  return "'" + shown(text) + "'";
}

std::string list_of(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == kMostListed) return text + ", …";
    if (i != 0) text += ", ";
    text += names[i];
  }
  return text;
}

std::string did_you_mean(std::string_view wrong, std::span<const std::string_view> names) {
  constexpr std::size_t kLongest = 100;  // no name that anybody has mistyped is longer
  if (wrong.size() > kLongest) return "";
  const std::string folded = fold(wrong);
  const std::size_t most = std::max<std::size_t>(1, wrong.size() / 3);
  std::string_view best;
  std::size_t best_distance = most + 1;
  for (const std::string_view name : names) {
    if (name.size() > wrong.size() + most || wrong.size() > name.size() + most) continue;
    const std::size_t d = distance(folded, fold(name), most);
    if (d >= best_distance) continue;
    best = name;
    best_distance = d;
  }
  if (best.empty()) return "";
  return " (did you mean '" + std::string(best) + "'?)";
}

bool same_name(std::string_view a, std::string_view b) noexcept {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

std::string fold(std::string_view name) {
  std::string result(name);
  std::transform(result.begin(), result.end(), result.begin(), lower);
  return result;
}

}  // namespace lockstep
