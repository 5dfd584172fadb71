#include "projects/expressions/parser.hpp"

#include <algorithm>
#include <utility>

#include "projects/expressions/habits.hpp"
#include "projects/expressions/lexer.hpp"
#include "projects/expressions/operators.hpp"

namespace lockstep {
namespace {

/// Whether a name is an operator, and so no value.
bool is_reserved(std::string_view word) {
  return std::ranges::any_of(expression_operators(),
                             [&](const ExpressionOperator& one) { return one.text == word; });
}

class Parser {
 public:
  explicit Parser(std::string_view text) : lexer_(text), token_(lexer_.next()) {}

  Syntax whole() {
    if (token_.kind == Token::Kind::kEnd) throw SyntaxError{token_.column, "the expression is empty"};
    Syntax result = binary(1);
    if (token_.kind != Token::Kind::kEnd) throw behind(result);
    return result;
  }

 private:
  /// Counts how deep the text nests while it lives.
  class Level {
   public:
    explicit Level(Parser& parser) : depth_(parser.depth_) {
      if (++depth_ > kDeepestExpression)
        throw SyntaxError{parser.token_.column,
                          "the expression nests deeper than " + std::to_string(kDeepestExpression)};
    }
    ~Level() { --depth_; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;

   private:
    int& depth_;
  };

  SyntaxError unexpected(const std::string& allowed) const {
    std::string found = "the end of the expression";
    switch (token_.kind) {
      case Token::Kind::kName:
      case Token::Kind::kSymbol:
        found = quoted(token_.text);
        break;
      case Token::Kind::kInteger:
      case Token::Kind::kReal:
      case Token::Kind::kTyped:
      case Token::Kind::kText:
        found = "a literal";
        break;
      case Token::Kind::kEnd:
        break;
    }
    return {token_.column, found + " found where " + allowed + " is expected"};
  }

  /// What stands behind a whole expression: something that other languages write there?
  SyntaxError behind(const Syntax& expression) const {
    SyntaxError error = unexpected("an operator or the end");
    const bool condition = expression.kind == Syntax::Kind::kReference && upper_case(expression.text) == "IF";
    if (const Habit* const habit = habit_of(condition ? "IF" : at(":=") ? ":=" : ""))
      error.message += "; " + std::string(condition ? "IF is " : "") + std::string(habit->here);
    return error;
  }

  void advance() { token_ = lexer_.next(); }
  bool at(std::string_view symbol) const {
    return token_.kind == Token::Kind::kSymbol && token_.text == symbol;
  }
  bool at_keyword(std::string_view word) const {
    return token_.kind == Token::Kind::kName && upper_case(token_.text) == word;
  }
  void expect(std::string_view symbol) {
    if (!at(symbol)) throw unexpected(quoted(symbol));
    advance();
  }

  /// The operator with so many operands that the token is.
  const ExpressionOperator* operator_here(int operands) const {
    for (const ExpressionOperator& candidate : expression_operators())
      if (candidate.operands == operands && (at(candidate.text) || at_keyword(candidate.text)))
        return &candidate;
    return nullptr;
  }

  Syntax binary(int weakest) {
    Syntax left = unary();
    for (const ExpressionOperator* found = operator_here(2); found != nullptr && found->strength >= weakest;
         found = operator_here(2)) {
      Syntax node;
      node.kind = Syntax::Kind::kOperator;
      node.column = token_.column;
      node.text = found->text;
      node.operation = found->operation;
      advance();
      node.operands.push_back(std::move(left));
      node.operands.push_back(binary(found->strength + 1));
      measure(node);
      left = std::move(node);
    }
    return left;
  }

  static void measure(Syntax& node) {
    for (const Syntax& operand : node.operands) node.height = std::max(node.height, operand.height + 1);
    if (node.height > kHighestExpression)
      throw SyntaxError{node.column, "the expression chains more than " + std::to_string(kHighestExpression) +
                                         " operators"};
  }

  Syntax unary() {
    const ExpressionOperator* const found = operator_here(1);
    if (found == nullptr) return primary();
    const Level level(*this);
    Syntax node;
    node.kind = Syntax::Kind::kOperator;
    node.column = token_.column;
    node.text = found->text;
    node.operation = found->operation;
    advance();
    node.operands.push_back(unary());
    measure(node);
    return node;
  }

  Syntax primary() {
    Syntax node;
    node.column = token_.column;
    node.integer = token_.integer;
    node.value = token_.value;
    node.type = token_.type;
    switch (token_.kind) {
      case Token::Kind::kInteger:
        node.kind = Syntax::Kind::kInteger;
        break;
      case Token::Kind::kReal:
        node.kind = Syntax::Kind::kReal;
        break;
      case Token::Kind::kTyped:
        node.kind = Syntax::Kind::kTyped;
        break;
      case Token::Kind::kText:
        node.kind = Syntax::Kind::kText;
        node.text = token_.text;
        break;
      case Token::Kind::kName:
        return named(std::move(node));
      default:
        return bracketed();
    }
    advance();
    return node;
  }

  Syntax bracketed() {
    if (!at("(")) throw unexpected("a value");
    const Level level(*this);
    advance();
    Syntax inner = binary(1);
    expect(")");
    return inner;
  }

  Syntax named(Syntax node) {
    node.text = token_.text;
    if (is_reserved(upper_case(token_.text))) throw unexpected("a value");
    advance();
    if (at("(")) return call(std::move(node));
    node.kind = Syntax::Kind::kReference;
    for (;;) {
      if (at(".")) {
        advance();
        if (token_.kind != Token::Kind::kName) throw unexpected("the name of a variable or a bit .X0");
        node.text += "." + token_.text;
        advance();
      } else if (at("[")) {
        index(node);
      } else {
        return node;
      }
    }
  }

  /// An index that is a literal goes into the text; any other expression is evaluated at run time.
  void index(Syntax& node) {
    const Level level(*this);
    const int column = token_.column;
    advance();
    if (at("]")) throw unexpected("an index");
    Syntax inner = binary(1);
    expect("]");
    const bool negative = inner.kind == Syntax::Kind::kOperator && inner.text == "-" &&
                          inner.operands.size() == 1 && inner.operands[0].kind == Syntax::Kind::kInteger;
    if (negative || inner.kind == Syntax::Kind::kInteger) {
      node.text += "[" + decimal(negative ? -inner.operands[0].integer : inner.integer) + "]";
      return;
    }
    if (!node.operands.empty()) throw SyntaxError{column, "only one index may be an expression"};
    node.text += "[]";
    node.operands.push_back(std::move(inner));
    measure(node);
  }

  Syntax call(Syntax node) {
    const Level level(*this);
    node.kind = Syntax::Kind::kCall;
    node.text = upper_case(node.text);
    advance();
    if (at(")")) throw unexpected("an input of " + node.text);
    for (;;) {
      const Token before = token_;
      Syntax input = binary(1);
      std::string name;
      if (at(":=")) {
        if (input.kind != Syntax::Kind::kReference || upper_case(input.text) != upper_case(before.text))
          throw unexpected("',' or ')'");
        name = upper_case(before.text);
        advance();
        input = binary(1);
      }
      if (!node.operands.empty() && name.empty() != node.names.empty())
        throw SyntaxError{before.column, "either all inputs of " + node.text + " are named or none"};
      if (!name.empty()) node.names.push_back(name);
      node.operands.push_back(std::move(input));
      if (!at(",")) break;
      advance();
    }
    expect(")");
    measure(node);
    return node;
  }

  Lexer lexer_;
  Token token_;
  int depth_ = 0;
};

}  // namespace

Syntax parse_expression(std::string_view text) {
  if (text.size() > kLongestExpression)
    throw SyntaxError{1, "the expression has " + std::to_string(text.size()) + " bytes; allowed are " +
                             std::to_string(kLongestExpression)};
  return Parser(text).whole();
}

}  // namespace lockstep
