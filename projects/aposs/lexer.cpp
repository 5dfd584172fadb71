#include "projects/aposs/lexer.hpp"

#include <algorithm>
#include <limits>

#include "hmi_bridge/network/visible_text.hpp"
#include "projects/json/problem.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::size_t kMaximumTokens = 400'000;
constexpr std::size_t kMaximumFiles = 64;
constexpr std::size_t kDeepestInclude = 8;

bool is_letter(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}
int digit_of(char c) noexcept {
  if (is_digit(c)) return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return 99;
}

/// Length of the UTF-8 character at the beginning, 0 if there is none.
std::size_t utf8_length(std::string_view text) noexcept {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : lead >= 0xc2 ? 2 : 0;
  if (length == 0 || lead > 0xf4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xc0) != 0x80) return 0;
  return length;
}

/// Length of a blank that is none of ASCII, as programs copied from documents have them; 0 if there is none.
std::size_t foreign_blank(std::string_view text) noexcept {
  if (text.starts_with("\xc2\xa0")) return 2;
  const bool wide =
      text.size() >= 3 && text.starts_with("\xe2\x80") && static_cast<unsigned char>(text[2]) <= 0x8a;
  return wide ? 3 : 0;
}

/// A text of the program as UTF-8: what is not, is taken for ISO 8859-1.
std::string as_utf8(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const auto byte = static_cast<unsigned char>(text[at]);
    const std::size_t length = byte < 0x80 ? 1 : utf8_length(text.substr(at));
    if (length != 0) {
      result += text.substr(at, length);
      at += length;
    } else {
      result += static_cast<char>(0xc0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3f));
      ++at;
    }
  }
  return result;
}

class Cutter {
 public:
  Cutter(const ReadIncluded& read, Messages& messages) : read_(read), messages_(messages) {}

  void file(std::string name, std::string_view text, std::size_t depth) {
    files_open_.push_back(folded(name));
    const auto index = static_cast<std::uint16_t>(result_.files.size());
    result_.files.push_back(std::move(name));
    const std::string_view outer_text = text_;
    const std::size_t outer_at = at_;
    const Place outer_place = place_;
    const std::size_t outer_depth = depth_;
    text_ = text;
    at_ = text.starts_with("\xef\xbb\xbf") ? 3 : 0;
    place_ = {index, 1, 1};
    depth_ = depth;
    if (text.size() > kLargestFile)
      too_large();
    else
      while (next_token()) {
      }
    text_ = outer_text;
    at_ = outer_at;
    end_ = place_;
    place_ = outer_place;
    depth_ = outer_depth;
    files_open_.pop_back();
  }

  Tokens take() {
    result_.list.push_back({Token::Kind::kEnd, "end of the file", "", 0, false, false, end_});
    return std::move(result_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  bool done() const { return at_ >= text_.size(); }
  void step() {
    if (text_[at_] == '\n') {
      ++place_.line;
      place_.column = 0;
    }
    ++at_;
    ++place_.column;
  }

  /// Tells where the first byte stands that is too much; nothing of the file is read.
  void too_large() {
    const std::string_view before = text_.substr(0, kLargestFile);
    const std::size_t end = before.rfind('\n'), begin = end == before.npos ? 0 : end + 1;
    place_.line = static_cast<std::uint32_t>(1 + std::count(before.begin(), before.end(), '\n'));
    place_.column = static_cast<std::uint32_t>(1 + before.size() - begin);
    messages_.error(place_, "the file goes on behind 1 MiB; allowed: files of at most " +
                                std::to_string(kLargestFile) + " bytes");
  }

  void skip_line() {
    while (!done() && peek() != '\n') step();
  }

  void skip_comment() {
    const Place begin = place_;
    step();
    step();
    while (!done()) {
      if (peek() == '*' && peek(1) == '/') {
        step();
        step();
        return;
      }
      if (peek() == '/' && peek(1) == '*' && peek(2) != '/')
        messages_.error(place_, "'/*' within the comment that begins in line " + std::to_string(begin.line) +
                                    "; comments are not nested, allowed here: '*/'");
      step();
    }
    messages_.error(begin, "the comment that begins here does not end; allowed: '*/' behind it");
  }

  /// Blanks and comments. Whether there were any.
  bool skip_blanks() {
    const std::size_t begin = at_;
    while (!done()) {
      if (static_cast<unsigned char>(peek()) <= ' ') {
        step();
      } else if (const std::size_t blank = foreign_blank(text_.substr(at_)); blank != 0) {
        for (std::size_t i = 0; i < blank; ++i) step();
      } else if (peek() == '/' && peek(1) == '/') {
        skip_line();
      } else if (peek() == '/' && peek(1) == '*') {
        skip_comment();
      } else {
        break;
      }
    }
    return at_ != begin;
  }

  bool next_token() {
    const bool glued = !skip_blanks() && !fresh_line_;
    fresh_line_ = false;
    if (done()) return false;
    if (result_.list.size() >= kMaximumTokens) {
      messages_.error(place_,
                      "the program is too long; allowed: " + std::to_string(kMaximumTokens) + " words");
      at_ = text_.size();
      return false;
    }
    Token token;
    token.place = place_;
    token.glued = glued;
    const char c = peek();
    if (is_letter(c)) {
      name(token);
    } else if (is_digit(c)) {
      number(token);
    } else if (c == '"') {
      text(token);
    } else if (c == '\'') {
      character(token);
    } else if (c == '#') {
      directive(token.place);
      fresh_line_ = true;
      return true;
    } else {
      symbol(token);
    }
    if (token.kind != Token::Kind::kEnd) result_.list.push_back(std::move(token));
    return true;
  }

  void name(Token& token) {
    while (is_letter(peek()) || is_digit(peek())) {
      token.text += peek();
      step();
    }
    token.kind = Token::Kind::kName;
    token.folded = folded(token.text);
  }

  void number(Token& token) {
    token.kind = Token::Kind::kNumber;
    int base = 10;
    if (peek() == '0' && (peek(1) == 'x' || peek(1) == 'X')) {
      base = 16;
      token.text = std::string(text_.substr(at_, 2));
      step();
      step();
    } else if (peek() == '0') {
      base = 8;
    }
    token.decimal = base == 10 || token.text == "0";
    std::uint64_t value = 0;
    bool fits = true, digits = false;
    while (is_digit(peek()) || (base == 16 && digit_of(peek()) < 16)) {
      const auto digit = static_cast<unsigned>(digit_of(peek()));
      if (digit >= static_cast<unsigned>(base)) {
        if (belongs_to_group()) return take_group_number(token);
        messages_.error(token.place, "a number that begins with 0 is octal and has the digits 0 to 7");
        while (is_digit(peek())) step();
        return;
      }
      value = value * static_cast<unsigned>(base) + digit;
      fits = fits && value <= (base == 10 ? 2147483648u : 0xffffffffu);
      if (!fits) value = 0;
      digits = true;
      token.text += peek();
      step();
    }
    if (base == 8) token.decimal = token.text == "0";
    if (!digits) messages_.error(token.place, "digits 0 to 9 and A to F have to follow 0x");
    if (!fits)
      messages_.error(
          token.place,
          quote(token.text) + " is too large; allowed: -2147483648 to 2147483647, 0x0 to 0xFFFFFFFF");
    token.number = static_cast<std::int32_t>(static_cast<std::uint32_t>(value));
    if (is_letter(peek()) && base != 16)
      messages_.error(place_, "a letter directly behind a number; allowed: a blank between them");
  }

  /// 32-09: two digits directly behind a '-' that stands directly behind a number.
  bool belongs_to_group() const {
    const std::size_t size = result_.list.size();
    return size >= 2 && result_.list[size - 1].text == "-" && result_.list[size - 1].glued &&
           result_.list[size - 2].kind == Token::Kind::kNumber && text_[at_ - 2] == '-' && !is_digit(peek(1));
  }
  void take_group_number(Token& token) {
    token.text += peek();
    token.number = digit_of(peek());
    step();
  }

  void text(Token& token) {
    step();
    const std::size_t begin = at_;
    while (!done() && peek() != '"' && peek() != '\n') step();
    std::string_view content = text_.substr(begin, at_ - begin);
    if (peek() == '"')
      step();
    else
      messages_.error(token.place,
                      "the text that begins here does not end in its line; allowed: '\"' behind it");
    if (content.ends_with('\r')) content.remove_suffix(1);
    token.kind = Token::Kind::kText;
    token.text = as_utf8(content);
  }

  void character(Token& token) {
    step();
    token.kind = Token::Kind::kNumber;
    token.number = static_cast<unsigned char>(peek());
    const char one = peek();
    const bool shows = static_cast<unsigned char>(one) >= 0x20 && one != 0x7F;
    token.text = "'" + (shows ? as_utf8({&one, 1}) : "?") + "'";
    if (done() || peek(1) != '\'') {
      messages_.error(token.place, "one character has to stand between two apostrophes, as in 'A'");
      skip_line();
      return;
    }
    step();
    step();
  }

  void symbol(Token& token) {
    static constexpr std::string_view kSymbols[] = {"<<", ">>", "<=", ">=", "==", "!=", "++", "--"};
    static constexpr std::string_view kSingle = "+-*%^&|~<>=()[]{},;:./";
    token.kind = Token::Kind::kSymbol;
    for (const std::string_view symbol : kSymbols)
      if (text_.substr(at_, 2) == symbol) {
        token.text = symbol;
        step();
        step();
        return;
      }
    if (kSingle.find(peek()) != std::string_view::npos) {
      token.text = peek();
      step();
      return;
    }
    const std::size_t length = static_cast<unsigned char>(peek()) < 0x80
                                   ? 1
                                   : std::max<std::size_t>(1, utf8_length(text_.substr(at_)));
    messages_.error(token.place, quote(as_utf8(text_.substr(at_, length))) +
                                     " means nothing here; names have letters, digits and underscores");
    for (std::size_t i = 0; i < length; ++i) step();
    token.kind = Token::Kind::kEnd;
  }

  void directive(const Place& place) {
    step();
    std::string word;
    while (is_letter(peek())) {
      word += peek();
      step();
    }
    const std::size_t begin = at_;
    skip_line();
    std::string_view rest = text_.substr(begin, at_ - begin);
    if (const std::size_t comment = std::min(rest.find("//"), rest.find("/*")); comment != rest.npos)
      rest = rest.substr(0, comment);
    const std::size_t first = rest.find_first_not_of(" \t\r");
    rest = first == rest.npos ? "" : rest.substr(first, rest.find_last_not_of(" \t\r") - first + 1);
    if (folded(word) == "INCLUDE") return include(place, rest);
    if (folded(word) == "DEBUG")
      return messages_.warn(place, "#DEBUG belongs to the tool of the vendor and does nothing here");
    messages_.error(
        place, quote("#" + word) + " is not built yet (it is of the later edition); allowed: #INCLUDE file");
  }

  void include(const Place& place, std::string_view name) {
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    const std::string file(name);
    const std::string allowed = "; allowed: a file beside the program whose name ends in .m";
    // Its name stands in front of each message about it.
    const bool shows = visible(as_utf8(file)) == as_utf8(file);
    if (!shows || !folded(file).ends_with(".M") || file.find_first_of("/\\:<>\"") != file.npos ||
        file.starts_with('.'))
      return messages_.error(place, "#INCLUDE of " + quote(file) + allowed);
    if (std::find(files_open_.begin(), files_open_.end(), folded(file)) != files_open_.end())
      return messages_.error(place, "#INCLUDE of " + quote(file) + ": the file includes itself");
    if (depth_ + 1 > kDeepestInclude || result_.files.size() >= kMaximumFiles)
      return messages_.error(place, "#INCLUDE of " + quote(file) +
                                        ": too many files; allowed: " + std::to_string(kMaximumFiles) + ", " +
                                        std::to_string(kDeepestInclude) + " within each other");
    const std::optional<std::string> text = read_ ? read_(file) : std::nullopt;
    if (!text)
      return messages_.error(place, "#INCLUDE of " + quote(file) + ": the file cannot be read" + allowed);
    this->file(file, *text, depth_ + 1);
  }

  const ReadIncluded& read_;
  Messages& messages_;
  Tokens result_;
  std::string_view text_;
  std::size_t at_ = 0;
  Place place_{0, 1, 1}, end_{0, 1, 1};
  std::size_t depth_ = 0;
  bool fresh_line_ = true;
  std::vector<std::string> files_open_;
};

}  // namespace

std::string folded(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return result;
}

Tokens cut(std::string name, std::string_view text, const ReadIncluded& read, Messages& messages) {
  Cutter cutter(read, messages);
  cutter.file(std::move(name), text, 0);
  return cutter.take();
}

}  // namespace lockstep::aposs
