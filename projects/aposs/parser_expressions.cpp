// Expressions and arguments.
#include <algorithm>

#include "projects/aposs/argument_check.hpp"
#include "projects/aposs/parameter_names.hpp"
#include "projects/aposs/parser.hpp"
#include "projects/json/problem.hpp"
#include "scheduler/aposs/arithmetic.hpp"

namespace lockstep::aposs {
namespace {

constexpr std::size_t kDeepest = 64;
constexpr std::size_t kMaximumOperators = 1000;

struct BinaryOperator {
  std::string_view sign;
  Operation operation;
  int level;
};

// From the weakest to the strongest; MG.33.L5.03, priority of operators. Those of one level go from left to
// right.
constexpr BinaryOperator kOperators[] = {
    {"OR", Operation::kEitherTrue, 0},
    {"AND", Operation::kBothTrue, 1},
    {"|", Operation::kOr, 2},
    {"^", Operation::kExclusiveOr, 3},
    {"&", Operation::kAnd, 4},
    {"==", Operation::kEqual, 5},
    {"!=", Operation::kUnequal, 5},
    {"<", Operation::kLess, 6},
    {">", Operation::kGreater, 6},
    {"<=", Operation::kLessOrEqual, 6},
    {">=", Operation::kGreaterOrEqual, 6},
    {"<<", Operation::kShiftLeft, 7},
    {">>", Operation::kShiftRight, 7},
    {"+", Operation::kAdd, 8},
    {"-", Operation::kSubtract, 8},
    {"*", Operation::kMultiply, 9},
    {"%", Operation::kDivide, 9},
    {"MOD", Operation::kRemainder, 9},
    {"RND", Operation::kDivideRounded, 9},
};
constexpr int kStrongest = 9;

const BinaryOperator* operator_of(const Token& token, int level) {
  for (const BinaryOperator& one : kOperators) {
    if (one.level != level) continue;
    if (token.kind == Token::Kind::kSymbol && token.text == one.sign) return &one;
    if (token.kind == Token::Kind::kName && token.folded == one.sign) return &one;
  }
  return nullptr;
}

bool is_relation(const Token& token) {
  return operator_of(token, 5) != nullptr || operator_of(token, 6) != nullptr;
}

}  // namespace

ExpressionPointer Parser::expression() {
  if (nested_ == 0) operators_ = 0;
  if (++nested_ > kDeepest) {
    nested_ = 0;
    fail(peek().place, "the expression is nested too deep; allowed: " + std::to_string(kDeepest) + " levels");
  }
  ExpressionPointer result = binary(0);
  --nested_;
  return result;
}

void Parser::count_operator(const Place& place) {
  if (++operators_ > kMaximumOperators)
    fail(place, "the expression is too long; allowed: " + std::to_string(kMaximumOperators) + " operators");
}

ExpressionPointer Parser::binary(int level) {
  if (level > kStrongest) return unary();
  ExpressionPointer left = binary(level + 1);
  for (;;) {
    const Place place = peek().place;
    if (level == kStrongest && at_symbol(".")) {
      const bool of_result = left->kind == Expression::Kind::kOperation && !left->in_parentheses &&
                             left->operation != Operation::kBit && left->operands.size() == 2;
      if (of_result)
        messages_.warn(
            place,
            "the part is taken of all that stands before it, (a * b).n; parentheses say what is meant");
      count_operator(place);
      left = selected(std::move(left), place);
      continue;
    }
    const BinaryOperator* const found = operator_of(peek(), level);
    if (found == nullptr) return left;
    count_operator(place);
    take();
    ExpressionPointer right = binary(level + 1);
    if ((found->operation == Operation::kDivide || found->operation == Operation::kRemainder ||
         found->operation == Operation::kDivideRounded) &&
        right->kind == Expression::Kind::kConstant && right->value == 0)
      messages_.warn(place, "a division by 0 gives 0");
    left = apply(place, found->operation, std::move(left), std::move(right));
  }
}

// What stands behind the point: a number of a bit, or b, w, l and the number of a byte, a word, the whole.
std::pair<Operation, ExpressionPointer> Parser::selector() {
  const Place place = peek().place;
  const std::string allowed = "; allowed: .1 to .32, .b1 to .b4, .w1, .w2, .l";
  Operation operation = Operation::kBit;
  ExpressionPointer number;
  const auto begins_part = [this] {  // 'b' before a number is the byte, also where a variable has that name
    const std::string& name = peek().folded;
    return (name == "B" || name == "W") && (peek(1).kind == Token::Kind::kNumber || at_symbol("(", 1));
  };
  if (peek().kind == Token::Kind::kName && (begins_part() || !assigned_.contains(peek().folded))) {
    const Token& token = take();
    const char letter = token.folded[0];
    const std::string_view digits = std::string_view(token.folded).substr(1);
    const bool numeric =
        !digits.empty() && digits.size() < 3 && digits.find_first_not_of("0123456789") == digits.npos;
    operation = letter == 'B' ? Operation::kByte : letter == 'W' ? Operation::kWord : Operation::kMove;
    if ((operation == Operation::kMove && letter != 'L') || (!digits.empty() && !numeric))
      fail(place, quote("." + token.text) + " is no part of a number" + allowed);
    if (numeric)
      number = constant(place, std::stoi(std::string(digits)));
    else if (letter != 'L' || peek().kind == Token::Kind::kNumber)
      number = primary();
  } else {
    number = primary();
  }
  if (number == nullptr) number = constant(place, 1);
  const int parts = operation == Operation::kBit    ? BitOf::kParts
                    : operation == Operation::kByte ? ByteOf::kParts
                    : operation == Operation::kWord ? WordOf::kParts
                                                    : 1;
  if (number->kind == Expression::Kind::kConstant && (number->value < 1 || number->value > parts))
    messages_.error(place, "there is no part " + std::to_string(number->value) + allowed);
  return {operation, std::move(number)};
}

ExpressionPointer Parser::selected(ExpressionPointer of, const Place& place) {
  take();
  auto [operation, number] = selector();
  if (operation == Operation::kMove) return of;
  return apply(place, operation, std::move(of), std::move(number));
}

ExpressionPointer Parser::unary() {
  const Token& token = peek();
  ExpressionPointer result;
  if (token.kind != Token::Kind::kNumber) count_operator(token.place);  // it may call itself
  if (accept_symbol("-")) {
    result = apply(token.place, Operation::kNegate, unary());
  } else if (accept_symbol("+")) {
    result = unary();
  } else if (accept_symbol("~")) {
    result = apply(token.place, Operation::kInvert, unary());
  } else if (accept_word("NOT")) {
    result = apply(token.place, Operation::kNot, unary());
    if (is_relation(peek()))
      messages_.warn(token.place,
                     "NOT takes what stands directly behind it; NOT (a == b) takes the comparison");
  } else if (accept_word("ABS")) {
    result = apply(token.place, Operation::kAbsolute, unary());
  } else {
    result = primary();
  }
  return result;
}

ExpressionPointer Parser::primary() {
  const Token& token = peek();
  if (token.kind == Token::Kind::kNumber) {
    take();
    return constant(token.place, token.number);
  }
  if (accept_symbol("(")) {
    ExpressionPointer inside = expression();
    expect_symbol(")", "behind the expression in parentheses");
    inside->in_parentheses = true;
    return inside;
  }
  if (token.kind == Token::Kind::kName) return named_primary();
  fail_here("a number, a variable, an element of an array, a function or an expression in parentheses");
}

std::optional<std::int32_t> Parser::glued_input(const Token& token) const {
  const std::string& name = token.folded;
  if (name.size() < 3 || name.size() > 4 || !name.starts_with("IN") || assigned_.contains(name))
    return std::nullopt;
  if (name.find_first_not_of("0123456789", 2) != name.npos) return std::nullopt;
  return std::stoi(name.substr(2));
}

ExpressionPointer Parser::named_primary() {
  const Token& token = peek();
  if (const auto input = glued_input(token)) {
    take();
    messages_.warn(token.place, quote(token.text) + ": the usual form is IN " + std::to_string(*input));
    uses_.inputs.insert(*input);
    auto read = std::make_unique<Expression>();
    read->kind = Expression::Kind::kCommand;
    read->place = token.place;
    read->command = Command::kIn;
    read->operands.push_back(constant(token.place, *input));
    return read;
  }
  if (const auto named = command_at(tokens_.subspan(at_))) return function(*named, token);
  if (is_reserved(token.folded))
    fail_here("a number, a variable, an element of an array, a function or an expression in parentheses");
  take();
  auto result = std::make_unique<Expression>();
  result->place = token.place;
  result->name = token.folded;
  result->written = token.text;
  if (const auto array = array_numbers_.find(token.folded); array != array_numbers_.end()) {
    result->kind = Expression::Kind::kElement;
    result->number = array->second;
    result->operands.push_back(bracketed_index(token.text));
    return result;
  }
  if (at_symbol("["))
    fail(token.place, "there is no array " + quote(token.text) + "; arrays stand in DIM at the beginning");
  if (at_symbol("(") && peek().glued)
    fail(token.place, "there is no function " + quote(token.text) + nearest_name(token.folded, assigned_) +
                          "; functions of one's own are of the later edition and not built yet");
  if (at_symbol("++") || at_symbol("--"))
    fail(peek().place, quote(peek().text) + " is of the later edition and not built yet; allowed: " +
                           token.text + " = " + token.text + " + 1");
  result->kind = Expression::Kind::kVariable;
  reads_.push_back({token.folded, token.text, token.place});
  return result;
}

ExpressionPointer Parser::bracketed_index(std::string_view of) {
  expect_symbol("[", "behind " + quote(of));
  const Place place = peek().place;
  ExpressionPointer index = expression();
  expect_symbol("]", "behind the index");
  const auto array = array_numbers_.find(folded(of));
  if (array != array_numbers_.end() && index->kind == Expression::Kind::kConstant) {
    const std::uint32_t size = arrays_[array->second].size;
    if (index->value < 1 || static_cast<std::uint32_t>(index->value) > size)
      messages_.error(place, quote(of) + " has no element " + std::to_string(index->value) +
                                 "; allowed: 1 to " + std::to_string(size));
  }
  return index;
}

ExpressionPointer Parser::function(const NamedCommand& named, const Token& at) {
  const CommandRow& row = row_of(named.command);
  const bool simple = named.command == Command::kTime || named.command == Command::kErrno;
  refuse(row, at.place);
  if (row.kind != CommandKind::kFunction && !simple)
    fail(at.place, quote(at.text) + " is a command and gives no value");
  for (std::size_t i = 0; i < named.words; ++i) take();
  auto result = std::make_unique<Expression>();
  result->place = at.place;
  if (simple) {
    result->kind = Expression::Kind::kOperation;
    result->operation = named.command == Command::kTime ? Operation::kTime : Operation::kErrorNumber;
    return result;
  }
  result->kind = Expression::Kind::kCommand;
  result->command = named.command;
  result->operands = arguments(row);
  return result;
}

// Arguments stand behind each other, parted by blanks: primaries, or expressions in parentheses.
ExpressionPointer Parser::argument(std::string_view of) {
  const Token& token = peek();
  if (!argument_follows())
    fail(token.place,
         std::string(of) + ": an argument is missing before " + shown() +
             "; allowed: a number, a variable, an element, a function or an expression in parentheses");
  count_operator(token.place);  // as an argument may have one of its own
  if (accept_symbol("-")) return apply(token.place, Operation::kNegate, argument(of));
  if (accept_symbol("+")) return argument(of);
  if (accept_symbol("~")) return apply(token.place, Operation::kInvert, argument(of));
  if (accept_word("ABS")) return apply(token.place, Operation::kAbsolute, argument(of));
  return primary();
}

bool Parser::argument_follows() const {
  const Token& token = peek();
  if (token.kind == Token::Kind::kNumber) return true;
  if (token.kind == Token::Kind::kSymbol)
    return token.text == "(" || token.text == "-" || token.text == "+" || token.text == "~";
  if (token.kind != Token::Kind::kName) return false;
  if (token.folded == "ABS" || glued_input(token)) return true;
  if (const auto named = command_at(tokens_.subspan(at_))) {
    const CommandRow& row = row_of(named->command);
    return row.kind == CommandKind::kFunction || named->command == Command::kTime ||
           named->command == Command::kErrno;
  }
  return !is_reserved(token.folded);
}

ExpressionPointer Parser::state(std::string_view of, bool optional) {
  const Place place = peek().place;
  if (optional && !on_same_line()) return constant(place, 1);
  if (accept_word("ON")) return constant(place, 1);
  if (accept_word("OFF")) return constant(place, 0);
  if (optional && !argument_follows()) return constant(place, 1);
  return argument(of);
}

void Parser::use_parameter(const Place& place, std::int32_t number) {
  uses_.parameters.insert(number);
  if (!later_edition_ && is_later_parameter(number))
    messages_.error(place, parameter_text(number) + " is of the later edition; allowed with firmware 5.00");
}

ExpressionPointer Parser::parameter(std::string_view of) {
  const Token& token = peek();
  if (token.kind == Token::Kind::kName && !assigned_.contains(token.folded)) {
    if (const auto number = parameter_number(token.folded)) {
      take();
      if (*number < kInputFunction) use_parameter(token.place, *number);
      return constant(token.place, *number);
    }
    const std::string nearest = nearest_parameter(token.folded);
    fail(token.place, quote(token.text) + " is no parameter; allowed here: a parameter" +
                          (nearest.empty() ? "" : " (nearest: " + nearest + ")") + " or 1900 to 1999");
  }
  ExpressionPointer number = drive_parameter(of);
  if (number->kind != Expression::Kind::kConstant) return number;
  use_parameter(token.place, number->value);
  return number;
}

// 32-67, 4-13: the '-' is no subtraction where it touches both numbers.
ExpressionPointer Parser::drive_parameter(std::string_view of) {
  const Token& group = peek();
  const bool dashed = group.kind == Token::Kind::kNumber && at_symbol("-", 1) && peek(1).glued &&
                      peek(2).kind == Token::Kind::kNumber && peek(2).glued;
  if (!dashed) return argument(of);
  take();
  take();
  const Token& number = take();
  // A leading 0 makes no octal number here: 32-09 is published so.
  if (group.number < 0 || group.number > 99 || number.text.size() != 2)
    fail(group.place, "a parameter has a group and two digits, as in 32-67");
  return constant(group.place, group.number * 100 + std::stoi(number.text));
}

ExpressionPointer Parser::output() {
  const Token& token = peek();
  const bool terminal = token.kind == Token::Kind::kName && token.folded.starts_with("X") &&
                        at_symbol("/", 1) && peek(2).kind == Token::Kind::kNumber;
  if (!terminal) {
    ExpressionPointer number = argument("OUT");
    if (number->kind != Expression::Kind::kConstant) return number;
    uses_.outputs.insert(number->value);
    return number;
  }
  const std::string block = take().folded;
  take();
  const Token& pin = take();
  const bool option = block == "X59" && pin.number >= 1 && pin.number <= 8;
  const bool relay = block == "X34" && (pin.number == 1 || pin.number == 5 || pin.number == 10);
  if (!option && !relay)
    fail(token.place,
         quote(token.text + "/" + pin.text) + " is no output; allowed: X59/1 to X59/8, X34/1, X34/5, X34/10");
  const std::int32_t number = option ? pin.number : 3400 + pin.number;
  uses_.outputs.insert(number);
  return constant(token.place, number);
}

ExpressionPointer Parser::array_argument(std::string_view of) {
  const Token& token = peek();
  const auto array =
      token.kind == Token::Kind::kName ? array_numbers_.find(token.folded) : array_numbers_.end();
  if (array == array_numbers_.end()) {
    std::vector<std::string_view> names;
    for (const ArrayDeclaration& declared : arrays_) names.push_back(declared.name);
    fail(token.place, std::string(of) + ": " + shown() + " is no array" +
                          (token.kind == Token::Kind::kName ? did_you_mean(token.text, names) : "") +
                          "; allowed: " + (names.empty() ? "one that stands in DIM" : list_of(names)));
  }
  take();
  return constant(token.place, array->second);
}

ExpressionPointer Parser::text_argument(std::string_view of) {
  const Token& token = peek();
  if (token.kind != Token::Kind::kText)
    fail(token.place, std::string(of) + ": a text in quotation marks has to stand here");
  take();
  return constant(token.place, emitter_.text(token.text));
}

ExpressionPointer Parser::word_argument(std::span<const std::string_view> words, std::string_view of) {
  const Token& token = peek();
  for (std::size_t i = 0; i < words.size(); ++i)
    if (accept_word(words[i])) return constant(token.place, static_cast<std::int32_t>(i));
  fail(token.place, std::string(of) + ": " + shown() + " cannot stand here" +
                        did_you_mean(token.folded, words) + "; allowed: " + list_of(words));
}

ExpressionPointer Parser::argument_of(Argument kind, const CommandRow& row) {
  switch (kind) {
    case Argument::kValue:
      return argument(row.name);
    case Argument::kOptionalValue:
      if (!on_same_line() || !argument_follows()) {
        messages_.warn(peek().place, std::string(row.name) + " without a number is taken for " +
                                         std::string(row.name) + " 0");
        return constant(peek().place, 0);
      }
      return argument(row.name);
    case Argument::kState:
    case Argument::kOptionalState:
      return state(row.name, kind == Argument::kOptionalState);
    case Argument::kIndex:
      return bracketed_index(row.name);
    case Argument::kArray:
      return array_argument(row.name);
    case Argument::kParameter:
      return parameter(row.name);
    case Argument::kDrive:
      return drive_parameter(row.name);
    case Argument::kText:
      return text_argument(row.name);
    case Argument::kOutput:
      return output();
    case Argument::kPart:
      return word_argument(kSavedParts, row.name);
    case Argument::kCoefficient:
      return word_argument(kPidCoefficients, row.name);
    case Argument::kNone:
      break;
  }
  return constant(peek().place, 0);
}

void Parser::use_input(const Expression& input) {
  if (input.kind == Expression::Kind::kConstant) uses_.inputs.insert(input.value);
}

void Parser::check(Command command, const std::vector<ExpressionPointer>& arguments) {
  std::vector<const Expression*> all;
  for (const ExpressionPointer& argument : arguments) all.push_back(argument.get());
  check_arguments(command, all, {later_edition_, arrays_}, messages_);
}

void Parser::check(Command command, std::initializer_list<const Expression*> arguments) {
  check_arguments(command, std::span(arguments.begin(), arguments.size()), {later_edition_, arrays_},
                  messages_);
}

std::vector<ExpressionPointer> Parser::arguments(const CommandRow& row) {
  std::vector<ExpressionPointer> result;
  for (std::size_t i = 0; i < row.arity(); ++i) {
    result.push_back(argument_of(row.arguments[i], row));
    if (i == 0 && row.command == Command::kIn) use_input(*result[0]);
  }
  return result;
}

}  // namespace lockstep::aposs
