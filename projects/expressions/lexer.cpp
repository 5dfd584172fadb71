#include "projects/expressions/lexer.hpp"

#include <charconv>
#include <cmath>
#include <limits>

#include "hmi_bridge/traces/text_literal.hpp"
#include "projects/expressions/habits.hpp"
#include "projects/expressions/letters.hpp"
#include "projects/literals/duration.hpp"

namespace lockstep {
namespace {

bool begins_name(char c) {
  return is_letter(c) || c == '_';
}

int digit_value(char c) {
  if (is_digit(c)) return c - '0';
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return 99;
}

constexpr WideInteger kLargest = ((WideInteger{1} << 126) - 1) * 2 + 1;

}  // namespace

Token Lexer::next() {
  skip_blanks();
  Token token;
  token.column = column();
  if (at_ >= text_.size()) return token;
  if (begins_name(peek())) return name(std::move(token));
  if (is_digit(peek())) return number(std::move(token));
  if (peek() == '\'') return quoted_text(std::move(token));
  token.kind = Token::Kind::kSymbol;
  const std::string_view two = text_.substr(at_, 2);
  // None of them begins where a sign of this language may stand; := is one, within the brackets of a call.
  if (const Habit* const habit = habit_sign(text_.substr(at_)); habit != nullptr && habit->written != ":=")
    throw SyntaxError{column(), quoted(habit->written) + " has no meaning here; " + std::string(habit->here)};
  for (const std::string_view symbol : {"**", "<>", "<=", ">=", ":="})
    if (two == symbol) token.text = symbol;
  if (token.text.empty() && std::string_view("+-*/<>=&().,[]").find(peek()) != std::string_view::npos)
    token.text = peek();
  if (token.text.empty()) {
    constexpr std::string_view hex = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(peek());
    std::string what = quoted(text_.substr(at_, 1));
    if (byte < ' ' || byte > '~') what = std::string("the byte 16#") + hex[byte >> 4] + hex[byte & 15];
    throw SyntaxError{column(), what + " has no meaning in an expression"};
  }
  at_ += token.text.size();
  return token;
}

void Lexer::skip_blanks() {
  for (;;) {
    const char c = peek();
    if (at_ < text_.size() && (c == ' ' || c == '\t' || c == '\n' || c == '\r'))
      ++at_;
    else if (c == '(' && peek(1) == '*')
      skip_comment();
    else if (c == '/' && peek(1) == '/')
      while (at_ < text_.size() && peek() != '\n') ++at_;
    else
      return;
  }
}

void Lexer::skip_comment() {
  const int start = column();
  int depth = 0;  // comments may be nested
  do {
    if (at_ >= text_.size()) throw SyntaxError{start, "the comment that begins here has no end *)"};
    const std::string_view two = text_.substr(at_, 2);
    if (two == "(*") ++depth;
    if (two == "*)") --depth;
    at_ += two == "(*" || two == "*)" ? 2 : 1;
  } while (depth > 0);
}

Token Lexer::name(Token token) {
  const std::size_t start = at_;
  while (begins_name(peek()) || is_digit(peek())) ++at_;
  token.kind = Token::Kind::kName;
  token.text = text_.substr(start, at_ - start);
  const std::string upper = upper_case(token.text);
  if (peek() == '#') {
    ++at_;
    if (upper == "T" || upper == "TIME") return duration(std::move(token));
    const auto type = tag_type(upper);
    if (!type)
      throw SyntaxError{token.column, quoted(token.text) +
                                          " is no type; a typed literal is INT#5, WORD#16#FF, "
                                          "BOOL#1, LREAL#1.5, T#10ms"};
    return typed(std::move(token), *type);
  }
  if (upper == "TRUE" || upper == "FALSE") {
    token.kind = Token::Kind::kTyped;
    token.value.u = upper == "TRUE" ? 1 : 0;
  }
  return token;
}

std::string Lexer::take_digits(int base, std::string_view what) {
  std::string digits;
  const int start = column();
  for (bool after_digit = false;; ++at_) {
    const char c = peek();
    if (c == '_' && after_digit) {
      after_digit = false;
      continue;
    }
    if (digit_value(c) >= base) {
      if (!after_digit) throw SyntaxError{column(), "a digit of " + std::string(what) + " is missing"};
      break;
    }
    digits += c;
    after_digit = true;
  }
  if (digits.size() > 400) throw SyntaxError{start, "the number has more than 400 digits"};
  return digits;
}

/// An integer, in base 10 or with one of the bases 2, 8 and 16 before a '#'.
WideInteger Lexer::take_integer() {
  const int start = column();
  int base = 10;
  std::string digits = take_digits(10, "the number");
  if (peek() == '#') {
    if (digits != "2" && digits != "8" && digits != "16")
      throw SyntaxError{start, "the base " + quoted(digits) + " is unknown; allowed are 2#, 8# and 16#"};
    base = std::stoi(digits);
    ++at_;
    digits = take_digits(base, "the number in base " + digits);
  }
  WideInteger value = 0;
  for (const char c : digits) {
    if (value > (kLargest - 15) / base)
      throw SyntaxError{start, "the integer is larger than any type; LREAL holds it as 1.0E30"};
    value = value * base + digit_value(c);
  }
  return value;
}

void Lexer::end_of_literal(int start) const {
  if (begins_name(peek()) || is_digit(peek()) || peek() == '#' || (peek() == '.' && is_digit(peek(1))))
    throw SyntaxError{column(), quoted(text_.substr(at_, 1)) +
                                    " may not follow the literal that begins at column " +
                                    std::to_string(start)};
}

Token Lexer::number(Token token) {
  const std::size_t start = at_;
  // A real literal is told from an integer by its fraction or exponent.
  std::size_t i = start;
  while (i < text_.size() && (is_digit(text_[i]) || text_[i] == '_')) ++i;
  const bool fraction = i + 1 < text_.size() && text_[i] == '.' && is_digit(text_[i + 1]);
  const bool exponent = i < text_.size() && (text_[i] == 'E' || text_[i] == 'e');
  if (!fraction && !exponent) {
    token.integer = take_integer();
    token.kind = Token::Kind::kInteger;
    if (peek() == '.') throw SyntaxError{column(), "a digit has to follow the decimal point"};
    end_of_literal(token.column);
    return token;
  }
  std::string clean = take_digits(10, "the number");
  if (fraction) {
    ++at_;
    clean += "." + take_digits(10, "the fraction");
  }
  if (peek() == 'E' || peek() == 'e') {
    ++at_;
    clean += "E";
    if (peek() == '+' || peek() == '-') {
      if (peek() == '-') clean += "-";
      ++at_;
    }
    clean += take_digits(10, "the exponent");
  }
  end_of_literal(token.column);
  token.kind = Token::Kind::kReal;
  const auto [end, error] = std::from_chars(clean.data(), clean.data() + clean.size(), token.value.r);
  if (error != std::errc{} || end != clean.data() + clean.size())
    throw SyntaxError{token.column, quoted(text_.substr(start, at_ - start)) +
                                        " is out of the range of LREAL (2.3E-308 to 1.7E308)"};
  return token;
}

Token Lexer::typed(Token token, Type type) {
  const bool negative = peek() == '-';
  if (peek() == '-' || peek() == '+') ++at_;
  Token literal;
  literal.column = column();
  if (is_digit(peek())) literal = number(std::move(literal));
  if (type == Type::BOOL)
    for (const std::string_view word : {"TRUE", "FALSE"})
      if (upper_case(text_.substr(at_, word.size())) == word) {
        at_ += word.size();
        literal.kind = Token::Kind::kTyped;
        literal.value.u = word == "TRUE" ? 1 : 0;
        end_of_literal(token.column);
      }
  token.kind = Token::Kind::kTyped;
  token.type = type;
  const std::string what = token.text + "#";
  if (literal.kind == Token::Kind::kTyped) {
    token.value = literal.value;
  } else if (literal.kind == Token::Kind::kInteger && !is_real(type)) {
    const WideInteger value = negative ? -literal.integer : literal.integer;
    if (!in_range(value, type))
      throw SyntaxError{token.column, decimal(value) + " does not fit " + std::string(type_name(type)) +
                                          " (" + decimal(lowest(type)) + " to " + decimal(highest(type)) +
                                          ")"};
    token.value.u = static_cast<std::uint64_t>(value);
  } else if (is_real(type) && (literal.kind == Token::Kind::kInteger || literal.kind == Token::Kind::kReal)) {
    const double value =
        literal.kind == Token::Kind::kReal ? literal.value.r : static_cast<double>(literal.integer);
    token.value.r = negative ? -value : value;
    if (type == Type::REAL) {
      token.value.r = static_cast<double>(static_cast<float>(token.value.r));
      if (!std::isfinite(token.value.r) || (token.value.r == 0.0 && value != 0.0))
        throw SyntaxError{token.column, "the literal is out of the range of REAL (1.2E-38 to 3.4E38)"};
    }
  } else {
    throw SyntaxError{token.column,
                      "no literal of " + std::string(type_name(type)) + " follows " + quoted(what)};
  }
  return token;
}

Token Lexer::duration(Token token) {
  const std::size_t start = at_;
  if (peek() == '-' || peek() == '+') ++at_;
  while (begins_name(peek()) || is_digit(peek()) || (peek() == '.' && is_digit(peek(1)))) ++at_;
  std::string message;
  const auto value = parse_iec_duration(text_.substr(start, at_ - start), message);
  if (!value)
    throw SyntaxError{token.column, quoted(text_.substr(static_cast<std::size_t>(token.column) - 1,
                                                        at_ - static_cast<std::size_t>(token.column) + 1)) +
                                        " " + message};
  token.kind = Token::Kind::kTyped;
  token.type = Type::TIME;
  token.value.i = *value;
  return token;
}

/// A text 'ale', in which $' does not end it.
Token Lexer::quoted_text(Token token) {
  const std::size_t start = at_++;
  while (at_ < text_.size() && peek() != '\'') at_ += peek() == '$' ? 2 : 1;
  if (at_ >= text_.size()) throw SyntaxError{token.column, "the text that begins here has no end '"};
  ++at_;
  std::string problem;
  const auto characters = read_text_literal(text_.substr(start, at_ - start), problem);
  if (!characters) throw SyntaxError{token.column, problem};
  token.kind = Token::Kind::kText;
  token.text = *characters;
  return token;
}

}  // namespace lockstep
