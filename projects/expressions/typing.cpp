#include "projects/expressions/typing.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace lockstep {
namespace {

std::vector<Term> pair_of(Term left, Term right) {
  std::vector<Term> both;
  both.push_back(std::move(left));
  both.push_back(std::move(right));
  return both;
}

bool is_integer_literal(const Term& term) {
  return term.shape == Shape::kInteger && term.form == Term::Form::kLiteral;
}
/// Whether a term is the integer 0, as a literal.
bool is_zero(const Term& term) {
  if (term.form != Term::Form::kLiteral || term.faulty) return false;
  return is_integer_literal(term)
             ? term.integer == 0
             : term.shape == Shape::kTyped && lockstep::is_integer(term.type) && term.value.u == 0;
}
bool is_typed(const Term& term, Type type) {
  return term.shape == Shape::kTyped && term.type == type;
}
bool is_integer(const Common& common) {
  return common.shape == Shape::kInteger || (common.shape == Shape::kTyped && is_integer(common.type));
}
bool is_number(const Common& common) {
  return common.shape == Shape::kReal || is_integer(common) ||
         (common.shape == Shape::kTyped && is_real(common.type));
}

/// The number of a bit suffix "X12"; none if the member is not one.
std::optional<int> bit_number(std::string_view member) {
  if (member.size() < 2 || member.size() > 4 || (member[0] != 'X' && member[0] != 'x')) return std::nullopt;
  int number = 0;
  for (const char c : member.substr(1)) {
    if (c < '0' || c > '9') return std::nullopt;
    number = number * 10 + (c - '0');
  }
  return number;
}

}  // namespace

Term Typing::faulty(int column) const {
  Term term;
  term.column = column;
  term.faulty = true;
  return term;
}

Term Typing::type(const Syntax& syntax) {
  Term term;
  term.column = syntax.column;
  term.value = syntax.value;
  switch (syntax.kind) {
    case Syntax::Kind::kInteger:
      term.shape = Shape::kInteger;
      term.integer = term.lowest = term.highest = syntax.integer;
      return term;
    case Syntax::Kind::kReal:
      term.shape = Shape::kReal;
      return term;
    case Syntax::Kind::kTyped:
      term.type = syntax.type;
      return term;
    case Syntax::Kind::kText:
      return text_term(syntax.column, {std::nullopt, syntax.text});
    case Syntax::Kind::kReference:
      return reference(syntax);
    case Syntax::Kind::kCall:
      return call(syntax);
    case Syntax::Kind::kOperator:
      break;
  }
  Term left = type(syntax.operands[0]);
  if (syntax.operands.size() == 1) return unary(syntax.text, syntax.column, std::move(left));
  Term right = type(syntax.operands[1]);
  return binary(syntax.operation, syntax.text, syntax.column, std::move(left), std::move(right));
}

Term Typing::text_term(int column, TextSource source) const {
  Term term;
  term.shape = Shape::kText;
  term.form = Term::Form::kText;
  term.column = column;
  term.text = std::move(source);
  return term;
}

Term Typing::reference(const Syntax& syntax) {
  std::string whole_text = syntax.text;
  Term index;
  if (!syntax.operands.empty()) {
    index = type(syntax.operands[0]);
    if (!index.faulty && is_integer_literal(index) && index.divisions_by_zero == 0)
      whole_text.replace(whole_text.find("[]") + 1, 0, decimal(index.integer));
    else
      settling_.settle(index, Type::LINT);
    if (index.faulty) return faulty(syntax.column);
  }
  const std::string_view text = whole_text;
  const std::size_t end = std::min(text.find_first_of(".["), text.size());
  const auto path_of = [&](std::string_view whole) {
    std::string_view path = whole.substr(end);
    if (!path.empty() && path.front() == '.') path.remove_prefix(1);
    return path;
  };
  Reference found = scope_.resolve(text.substr(0, end), path_of(text));
  const std::size_t point = text.rfind('.');
  const auto bit = point == std::string_view::npos ? std::nullopt : bit_number(text.substr(point + 1));
  const bool of_bit = !found.signal && bit;
  if (of_bit) found = scope_.resolve(text.substr(0, end), path_of(text.substr(0, point)));
  if (found.text && !of_bit) return text_term(syntax.column, {found.text, {}});
  if (found.text) found.error = quoted(text.substr(0, point)) + " is a text and has no bits";
  if (!found.signal) {
    settling_.error(syntax.column, found.error);
    return faulty(syntax.column);
  }
  Term term;
  term.form = Term::Form::kSignal;
  term.column = syntax.column;
  term.signal = *found.signal;
  if (found.elements.count > 0) {
    term.form = Term::Form::kElement;
    term.elements = found.elements;
    term.operands.push_back(std::move(index));
  }
  term.type = found.signal->value_type();
  if (term.type > Type::DB_ANY) {
    settling_.error(syntax.column, quoted(text) + " is a reference to an object or a tag, not a value");
    return faulty(syntax.column);
  }
  if (term.type == Type::DB_ANY) term.type = Type::UDINT;
  if (!of_bit) return term;
  const int width = lockstep::is_integer(term.type) || is_bit_string(term.type) ? 8 * size_of(term.type) : 0;
  if (*bit >= width) {
    const std::string allowed =
        width == 0 ? "has no bits" : "has the bits .X0 to .X" + std::to_string(width - 1);
    settling_.error(syntax.column, quoted(text.substr(0, point)) + " is of type " +
                                       std::string(type_name(term.type)) + " and " + allowed + ", not ." +
                                       std::string(text.substr(point + 1)));
    return faulty(syntax.column);
  }
  term.signal.bit = static_cast<std::int8_t>(*bit);
  term.type = Type::BOOL;
  return term;
}

Term Typing::no_meaning(std::string_view text, int column, const std::vector<Term>& operands,
                        std::string_view allowed) {
  std::string types;
  for (const Term& operand : operands) {
    if (!types.empty()) types += &operand == &operands.back() ? " and " : ", ";
    types += describe(operand);
  }
  settling_.error(column, std::string(text) + " has no meaning for " + types + "; " + std::string(allowed));
  return faulty(column);
}

std::optional<Common> Typing::join_all(const Term* first, std::size_t count) const {
  std::optional<Common> common = common_of(*first);
  for (std::size_t i = 1; i < count && common; ++i) common = join(*common, common_of(first[i]));
  return common;
}

/// An operation whose result and operands have what is common.
Term Typing::operation(Operation operation, int column, const Common& common, std::vector<Term> operands) {
  Term term;
  term.form = Term::Form::kOperation;
  term.column = column;
  term.operation = operation;
  term.shape = common.shape;
  term.type = common.type;
  term.lowest = common.lowest;
  term.highest = common.highest;
  for (Term& operand : operands) {
    if (common.shape == Shape::kTyped) settling_.settle(operand, common.type);
    term.faulty = term.faulty || operand.faulty;
    if (is_integer(common) && term.division_column == 0) term.division_column = operand.division_column;
  }
  if (operation == Operation::kDivide && is_integer(common)) term.division_column = column;
  term.operands = std::move(operands);
  return term;
}

Term Typing::unary(std::string_view text, int column, Term operand) {
  if (operand.faulty) return operand;
  std::vector<Term> operands;
  if (text == "NOT") {
    operands.push_back(std::move(operand));
    return logic(Operation::kNot, text, column, std::move(operands));
  }
  if (is_integer_literal(operand)) {
    if (text == "-") operand.integer = operand.lowest = operand.highest = -operand.integer;
    operand.column = column;
    return operand;
  }
  const Common common = common_of(operand);
  const bool possible = is_number(common) || is_typed(operand, Type::TIME);
  if (possible && text == "+") return operand;
  operands.push_back(std::move(operand));
  if (!possible)
    return no_meaning("the sign " + std::string(text), column, operands, "allowed are numbers and TIME");
  return operation(Operation::kNegate, column, common, std::move(operands));
}

Term Typing::binary(Operation operation, std::string_view text, int column, Term left, Term right) {
  if (left.faulty || right.faulty) return faulty(column);
  switch (operation) {
    case Operation::kAdd:
    case Operation::kSubtract:
    case Operation::kMultiply:
    case Operation::kDivide:
    case Operation::kModulo:
      return arithmetic(operation, text, column, std::move(left), std::move(right));
    case Operation::kPower:
      return real_operation(operation, text, column, pair_of(std::move(left), std::move(right)));
    case Operation::kAnd:
    case Operation::kOr:
    case Operation::kXor:
      return logic(operation, text, column, pair_of(std::move(left), std::move(right)));
    default:
      return comparison(operation, text, column, std::move(left), std::move(right));
  }
}

Term Typing::arithmetic(Operation operation, std::string_view text, int column, Term left, Term right) {
  if (is_typed(left, Type::TIME) || is_typed(right, Type::TIME))
    return time_arithmetic(operation, text, column, std::move(left), std::move(right));
  if (is_integer_literal(left) && is_integer_literal(right)) return folded(operation, column, left, right);
  const auto common = join(common_of(left), common_of(right));
  const bool modulo = operation == Operation::kModulo;
  const bool division = modulo || operation == Operation::kDivide;
  if (division && common && is_integer(*common) && is_zero(right)) warn_of_zero(column);
  std::vector<Term> operands = pair_of(std::move(left), std::move(right));
  if (!common || !(modulo ? is_integer(*common) : is_number(*common)))
    return no_meaning(text, column, operands,
                      modulo ? "allowed are integers of a common type"
                             : "allowed are numbers of a common type (TO_type converts) and TIME");
  return this->operation(operation, column, *common, std::move(operands));
}

void Typing::warn_of_zero(int column) {
  settling_.warnings.push_back({column, "the divisor is always 0: the result is 0 and counts as an error"});
}

/// The exact result of an operation on two integer literals is a literal again.
Term Typing::folded(Operation operation, int column, const Term& left, const Term& right) {
  Term term = left;
  term.column = column;
  term.divisions_by_zero += right.divisions_by_zero;
  term.division_column = left.division_column != 0 ? left.division_column : right.division_column;
  const bool division = operation == Operation::kDivide || operation == Operation::kModulo;
  bool overflow = false;
  if (operation == Operation::kAdd)
    overflow = __builtin_add_overflow(left.integer, right.integer, &term.integer);
  else if (operation == Operation::kSubtract)
    overflow = __builtin_sub_overflow(left.integer, right.integer, &term.integer);
  else if (operation == Operation::kMultiply)
    overflow = __builtin_mul_overflow(left.integer, right.integer, &term.integer);
  else if (right.integer != 0)
    term.integer =
        operation == Operation::kDivide ? left.integer / right.integer : left.integer % right.integer;
  if (division && right.integer == 0) {
    term.integer = 0;
    ++term.divisions_by_zero;
    warn_of_zero(column);
  }
  if (operation == Operation::kDivide) term.division_column = column;
  if (overflow) {
    settling_.error(column, "the result is larger than any integer type");
    return faulty(column);
  }
  term.lowest = term.highest = term.integer;
  return term;
}

Term Typing::time_arithmetic(Operation operation, std::string_view text, int column, Term left, Term right) {
  const bool left_time = is_typed(left, Type::TIME);
  const bool right_time = is_typed(right, Type::TIME);
  const bool additive = operation == Operation::kAdd || operation == Operation::kSubtract;
  const Common duration{Shape::kTyped, Type::TIME, 0, 0};
  if (additive && left_time && right_time)
    return this->operation(operation, column, duration, pair_of(std::move(left), std::move(right)));
  const Common number = common_of(left_time ? right : left);
  const bool linear = is_number(number) && !is_typed(left_time ? right : left, Type::ULINT);
  if (operation == Operation::kMultiply && linear && left_time != right_time)
    return left_time ? scaled_time(operation, column, std::move(left), std::move(right))
                     : scaled_time(operation, column, std::move(right), std::move(left));
  if (operation == Operation::kDivide && linear && left_time && !right_time)
    return scaled_time(operation, column, std::move(left), std::move(right));
  return no_meaning(text, column, pair_of(std::move(left), std::move(right)),
                    "allowed are TIME + TIME, TIME - TIME, TIME * number, TIME / number (none of ULINT)");
}

Term Typing::scaled_time(Operation operation, int column, Term time, Term number) {
  const bool exact = is_integer(common_of(number));
  Common common{Shape::kTyped, exact ? Type::LINT : Type::LREAL, 0, 0};
  if (operation == Operation::kDivide && exact && is_zero(number)) warn_of_zero(column);
  settling_.settle(number, common.type);
  number.division_column = 0;
  // As nanoseconds: in integers exactly, with a real number rounded to the nearest.
  if (exact)
    time.type = Type::LINT;
  else
    time = converted(std::move(time), Type::LINT, Type::LREAL);
  Term scaled = this->operation(operation, column, common, pair_of(std::move(time), std::move(number)));
  scaled.division_column = 0;
  if (!exact) scaled = converted(std::move(scaled), Type::LREAL, Type::LINT);
  scaled.type = Type::TIME;
  return scaled;
}

Term Typing::real_operation(Operation operation, std::string_view text, int column,
                            std::vector<Term> operands) {
  auto common = join_all(operands.data(), operands.size());
  if (common) common = join(*common, Common{Shape::kReal, Type::REAL, 0, 0});
  if (!common || !is_number(*common))
    return no_meaning(text, column, operands,
                      "allowed are REAL, LREAL and what widens to them (TO_LREAL converts)");
  return this->operation(operation, column, *common, std::move(operands));
}

Term Typing::comparison(Operation operation, std::string_view text, int column, Term left, Term right) {
  const auto common = join(common_of(left), common_of(right));
  const bool equality = operation == Operation::kEqual || operation == Operation::kUnequal;
  const bool texts = left.shape == Shape::kText && right.shape == Shape::kText;
  std::vector<Term> operands = pair_of(std::move(left), std::move(right));
  if (texts && equality) {
    Term term;
    term.form = Term::Form::kTextComparison;
    term.column = column;
    term.operation = operation;
    term.operands = std::move(operands);
    return term;
  }
  if (texts) return no_meaning(text, column, operands, "texts are compared with = and <>");
  if (!common || (common->shape == Shape::kTyped && common->type == Type::BOOL && !equality))
    return no_meaning(
        text, column, operands,
        common ? "BOOL is compared with = and <>" : "both sides need a common type (TO_type converts)");
  Term shaped;
  shaped.shape = common->shape;
  shaped.type = common->type;
  shaped.lowest = common->lowest;
  shaped.highest = common->highest;
  Term term = this->operation(operation, column, Common{Shape::kTyped, default_type(shaped), 0, 0},
                              std::move(operands));
  term.type = Type::BOOL;
  term.division_column = 0;
  return term;
}

Term Typing::logic(Operation operation, std::string_view text, int column, std::vector<Term> operands) {
  auto common = join_all(operands.data(), operands.size());
  if (common && common->shape == Shape::kInteger) {
    // Literals alone: a bit string as narrow as they allow, or as their place asks.
    const auto type = smallest_type(Type::BYTE, common->lowest, common->highest);
    if (type) common->type = *type;
    common->shape = type ? Shape::kBits : Shape::kInteger;
  }
  const bool possible =
      common &&
      (common->shape == Shape::kBits ||
       (common->shape == Shape::kTyped && (common->type == Type::BOOL || is_bit_string(common->type))));
  if (!possible)
    return no_meaning(text, column, operands,
                      "allowed are BOOL and bit strings (BYTE, WORD, DWORD, LWORD; TO_type converts)");
  return this->operation(operation, column, *common, std::move(operands));
}

}  // namespace lockstep
