#include "hmi_bridge/studio/url.hpp"

#include <algorithm>

namespace lockstep {
namespace {

int hexadecimal_digit(char c) noexcept {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

bool decode_url(std::string_view text, bool plus_is_blank, std::string& decoded) {
  decoded.clear();
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '+' && plus_is_blank) c = ' ';
    if (c == '%') {
      const int high = i + 2 < text.size() ? hexadecimal_digit(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? hexadecimal_digit(text[i + 2]) : -1;
      if (high < 0 || low < 0) return false;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20) return false;
    decoded += c;
  }
  return true;
}

bool decode_query(std::string_view text, std::vector<std::pair<std::string, std::string>>& query) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('&'), text.size());
    const std::string_view part = text.substr(0, end);
    const std::size_t equals = std::min(part.find('='), part.size());
    std::string name;
    std::string value;
    if (!decode_url(part.substr(0, equals), true, name)) return false;
    if (!decode_url(part.substr(std::min(equals + 1, part.size())), true, value)) return false;
    query.emplace_back(std::move(name), std::move(value));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return true;
}

}  // namespace

std::string_view query_of(std::string_view target) noexcept {
  const std::size_t mark = std::min(target.find('?'), target.size());
  return target.substr(std::min(mark + 1, target.size()));
}

bool parse_url(std::string_view target, StudioUrl& url) {
  if (!target.starts_with('/')) return false;
  const std::size_t mark = std::min(target.find('?'), target.size());
  return decode_url(target.substr(0, mark), false, url.path) && decode_query(query_of(target), url.query);
}

}  // namespace lockstep
