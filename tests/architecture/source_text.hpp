/// Reading C++ sources as text, just far enough to check rules about includes and keywords.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// An #include directive.
struct Include {
  int line;          ///< from 1
  std::string path;  ///< without quotes or angle brackets
  bool quoted;       ///< "path" rather than <path>
};

namespace source_text_detail {

inline bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

// Where the literal or comment that begins at `from` ends; `from` itself if none begins there.
inline std::size_t end_of_comment(std::string_view text, std::size_t from) {
  if (text.substr(from, 2) == "//") return std::min(text.find('\n', from), text.size());
  if (text.substr(from, 2) != "/*") return from;
  const std::size_t close = text.find("*/", from + 2);
  return close == std::string_view::npos ? text.size() : close + 2;
}

inline std::size_t end_of_raw_string(std::string_view text, std::size_t from) {
  const std::size_t open = text.find('(', from);
  if (open == std::string_view::npos) return text.size();
  const std::string close = ")" + std::string(text.substr(from + 2, open - from - 2)) + "\"";
  const std::size_t found = text.find(close, open);
  return found == std::string_view::npos ? text.size() : found + close.size();
}

inline std::size_t end_of_literal(std::string_view text, std::size_t from) {
  if (text.substr(from, 2) == "R\"") return end_of_raw_string(text, from);
  const char quote = text[from];
  const bool separates_digits = quote == '\'' && from > 0 && is_word(text[from - 1]);
  if ((quote != '"' && quote != '\'') || separates_digits) return from;
  std::size_t at = from + 1;
  while (at < text.size() && text[at] != quote && text[at] != '\n') at += text[at] == '\\' ? 2 : 1;
  return std::min(at + 1, text.size());
}

}  // namespace source_text_detail

/// The text with every comment as blanks; lines stay where they are. String literals stay if asked for,
/// otherwise they become blanks too.
inline std::string code_of(std::string_view text, bool keep_literals) {
  std::string code(text);
  const auto blank = [&](std::size_t from, std::size_t to) {
    std::replace_if(
        code.begin() + static_cast<std::ptrdiff_t>(from), code.begin() + static_cast<std::ptrdiff_t>(to),
        [](char c) { return c != '\n'; }, ' ');
  };
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t comment = source_text_detail::end_of_comment(text, at);
    const std::size_t literal = source_text_detail::end_of_literal(text, at);
    if (comment != at || (literal != at && !keep_literals)) blank(at, std::max(comment, literal));
    at = std::max({comment, literal, at + 1});
  }
  return code;
}

/// The include directives, those in comments left out.
inline std::vector<Include> includes_of(std::string_view text) {
  std::vector<Include> includes;
  const std::string code = code_of(text, true);
  int line = 1;
  for (std::size_t begin = 0; begin < code.size(); ++line) {
    const std::size_t end = std::min(code.find('\n', begin), code.size());
    const std::string_view row = std::string_view(code).substr(begin, end - begin);
    begin = end + 1;
    const std::size_t hash = row.find_first_not_of(" \t");
    if (hash == std::string_view::npos || row[hash] != '#') continue;
    const std::size_t open = row.find_first_of("\"<");
    const std::size_t word = row.find("include");
    if (word == std::string_view::npos || open == std::string_view::npos || open < word) continue;
    const std::size_t close = row.find(row[open] == '<' ? '>' : '"', open + 1);
    includes.push_back({line, std::string(row.substr(open + 1, close - open - 1)), row[open] == '"'});
  }
  return includes;
}

/// The lines, from 1, on which a word stands as a word of code: in no comment, literal or longer identifier.
inline std::vector<int> lines_with_word(std::string_view text, std::string_view word) {
  std::vector<int> lines;
  const std::string code = code_of(text, false);
  for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1)) {
    const bool starts = at == 0 || !source_text_detail::is_word(code[at - 1]);
    const bool ends = at + word.size() == code.size() || !source_text_detail::is_word(code[at + word.size()]);
    if (starts && ends)
      lines.push_back(1 + static_cast<int>(std::count(code.begin(),
                                                      code.begin() + static_cast<std::ptrdiff_t>(at), '\n')));
  }
  return lines;
}

}  // namespace lockstep
