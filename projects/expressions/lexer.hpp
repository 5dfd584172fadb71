/// Structured Text cut into words: names, literals and symbols.
/// @source IEC 61131-3:2013, 6.1 (names, comments), 6.3 (literals)
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "projects/literals/types.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Thrown where the text cannot be read on; caught by the compiler.
struct SyntaxError {
  int column;  ///< from 1, in bytes
  std::string message;
};

struct Token {
  enum class Kind {
    kEnd,
    kName,     ///< also keywords and functions; `text` as written
    kInteger,  ///< `integer`, whose type its place decides
    kReal,     ///< `value.r`
    kTyped,    ///< `value` of `type`: TRUE, INT#5, T#10ms
    kText,     ///< `text`: the characters of 'ale'
    kSymbol    ///< `text`
  };
  Kind kind = Kind::kEnd;
  int column = 1;
  std::string text;
  WideInteger integer = 0;
  Type type = Type::BOOL;
  Value value{};
};

/// Cuts a text into tokens, one at a time. The text has to outlive it.
class Lexer {
 public:
  explicit Lexer(std::string_view text) noexcept : text_(text) {}

  /// The next token; kEnd at the end of the text, again and again. Throws SyntaxError.
  Token next();

 private:
  void skip_blanks();
  void skip_comment();
  Token name(Token token);
  Token number(Token token);
  Token typed(Token token, Type type);
  Token duration(Token token);
  Token quoted_text(Token token);
  std::string take_digits(int base, std::string_view what);
  WideInteger take_integer();
  void end_of_literal(int column) const;

  char peek(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  int column() const { return static_cast<int>(at_) + 1; }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace lockstep
