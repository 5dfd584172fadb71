#include "projects/json/problem.hpp"

#include <algorithm>
#include <numeric>

namespace lockstep {
namespace {

constexpr std::size_t kMaximumListed = 24;  // names of a list in a message

char lower(char c) noexcept {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Number of letters to insert, remove, replace or exchange to get from one name to the other, up to
/// `maximum`
/// + 1.
std::size_t distance(std::string_view a, std::string_view b, std::size_t maximum) {
  std::vector<std::size_t> two_up, up(b.size() + 1), row(b.size() + 1);
  std::iota(up.begin(), up.end(), std::size_t{0});
  two_up = up;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    std::size_t minimum = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({up[j] + 1, row[j - 1] + 1, up[j - 1] + (a[i - 1] == b[j - 1] ? 0u : 1u)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], two_up[j - 2] + 1);
      minimum = std::min(minimum, row[j]);
    }
    if (minimum > maximum) return maximum + 1;
    std::swap(two_up, up);
    std::swap(up, row);
  }
  return up[b.size()];
}

}  // namespace

std::string to_string(std::string_view file, const Problem& problem) {
  std::string text = problem.file.empty() ? std::string(file) : problem.file;
  text += ":" + problem.place + ": " + problem.text;
  if (problem.line == 0) return text;
  text += " (line " + std::to_string(problem.line) + ", column " + std::to_string(problem.column);
  if (!problem.owner.empty()) text += ", " + problem.owner;
  return text + ")";
}

std::string quote(std::string_view text) {
  return "'" + shown(text) + "'";
}

std::string list_of(std::span<const std::string_view> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i == kMaximumListed) return text + ", …";
    if (i != 0) text += ", ";
    text += names[i];
  }
  return text;
}

std::string did_you_mean(std::string_view wrong, std::span<const std::string_view> names) {
  constexpr std::size_t kLongest = 100;  // no name that anybody has mistyped is longer
  if (wrong.size() > kLongest) return "";
  const std::string folded = fold(wrong);
  const std::size_t maximum = std::max<std::size_t>(1, wrong.size() / 3);
  std::string_view best;
  std::size_t best_distance = maximum + 1;
  for (const std::string_view name : names) {
    if (name.size() > wrong.size() + maximum || wrong.size() > name.size() + maximum) continue;
    const std::size_t d = distance(folded, fold(name), maximum);
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
