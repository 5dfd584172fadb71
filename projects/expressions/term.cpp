#include "projects/expressions/term.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep {
namespace {

/// The number of operands, from the first, that have the type of the result.
std::size_t values_in(const Term& term) {
  switch (term.form) {
    case Term::Form::kSelection:
    case Term::Form::kMultiplexer:
      return term.operands.size() - 1;
    case Term::Form::kOperation:
      // The count of a shift has a type of its own.
      return term.operation >= Operation::kShiftLeft && term.operation <= Operation::kRotateRight
                 ? 1
                 : term.operands.size();
    default:
      return 0;
  }
}

bool is_arithmetic(const Term& term) {
  return term.form == Term::Form::kOperation &&
         (term.operation <= Operation::kPower || term.operation == Operation::kNegate ||
          term.operation == Operation::kAbsolute);
}

bool is_division(const Term& term) {
  return term.form == Term::Form::kOperation &&
         (term.operation == Operation::kDivide || term.operation == Operation::kModulo);
}

std::string name_of(Type type) {
  return std::string(type_name(type));
}

std::string range_of(Type type) {
  return name_of(type) + " (" + decimal(lowest(type)) + " to " + decimal(highest(type)) + ")";
}

Type default_integer(WideInteger low, WideInteger high) {
  for (const Type type : {Type::DINT, Type::LINT})
    if (in_range(low, type) && in_range(high, type)) return type;
  return Type::ULINT;
}

/// What a value of a fixed type has in common with literals.
std::optional<Common> join_typed(Type type, const Common& literal) {
  const auto typed = [](Type found) { return Common{Shape::kTyped, found, 0, 0}; };
  if (literal.shape == Shape::kBits) {
    const auto found = is_bit_string(type) ? common_type(type, literal.type) : std::nullopt;
    return found ? std::optional(typed(*found)) : std::nullopt;
  }
  if (is_real(type)) return typed(type);
  if (literal.shape == Shape::kInteger) {
    if (!is_integer(type) && !is_bit_string(type)) return std::nullopt;
    const auto found = smallest_type(type, literal.lowest, literal.highest);
    return found ? std::optional(typed(*found)) : std::nullopt;
  }
  // A real literal next to an integer: the smallest real type, or that of the place if it is larger.
  if (widens(type, Type::REAL)) return Common{Shape::kReal, Type::REAL, 0, 0};
  if (widens(type, Type::LREAL)) return typed(Type::LREAL);
  return std::nullopt;
}

}  // namespace

Common common_of(const Term& term) {
  return {term.shape, term.type, term.lowest, term.highest};
}

std::optional<Common> join(const Common& a, const Common& b) {
  if (a.shape == Shape::kText || b.shape == Shape::kText) return std::nullopt;
  if (a.shape == Shape::kTyped && b.shape == Shape::kTyped) {
    const auto type = common_type(a.type, b.type);
    return type ? std::optional(Common{Shape::kTyped, *type, 0, 0}) : std::nullopt;
  }
  if (a.shape == Shape::kTyped) return join_typed(a.type, b);
  if (b.shape == Shape::kTyped) return join_typed(b.type, a);
  Common both{std::max(a.shape, b.shape), Type::BYTE, std::min(a.lowest, b.lowest),
              std::max(a.highest, b.highest)};
  if (both.shape != Shape::kBits) return both;
  if (a.shape == Shape::kReal || b.shape == Shape::kReal) return std::nullopt;
  for (const Common* part : {&a, &b})
    if (part->shape == Shape::kBits) both.type = common_type(both.type, part->type).value_or(both.type);
  const auto type = smallest_type(both.type, both.lowest, both.highest);
  if (!type) return std::nullopt;
  both.type = *type;
  return both;
}

std::string describe(const Term& term) {
  if (term.form == Term::Form::kLiteral && term.shape == Shape::kInteger)
    return "the literal " + decimal(term.integer);
  return describe(common_of(term));
}

std::string describe(const Common& common) {
  switch (common.shape) {
    case Shape::kTyped:
      return name_of(common.type);
    case Shape::kInteger:
      return "an integer";
    case Shape::kReal:
      return "a REAL or LREAL number";
    case Shape::kBits:
      return "a bit string";
    case Shape::kText:
      return "a text";
  }
  return "";
}

Type default_type(const Term& term) {
  switch (term.shape) {
    case Shape::kInteger:
      return default_integer(term.lowest, term.highest);
    case Shape::kReal:
      return Type::LREAL;
    default:
      return term.type;
  }
}

Term converted(Term term, Type from, Type to) {
  Term outer;
  outer.form = Term::Form::kConversion;
  outer.column = term.column;
  outer.from = from;
  outer.type = outer.to = to;
  outer.faulty = term.faulty;
  outer.operands.push_back(std::move(term));
  return outer;
}

void Settling::settle(Term& term) {
  if (term.shape == Shape::kText && !term.faulty) {
    error(term.column, describe(term) + " has no number; allowed with a text: = and <> with another one");
    term.faulty = true;
  }
  settle(term, default_type(term));
}

void Settling::settle(Term& term, Type type) {
  if (term.faulty) return;
  switch (term.shape) {
    case Shape::kTyped:
      widen(term, type);
      break;
    case Shape::kInteger:
      settle_integer(term, type);
      break;
    case Shape::kReal:
      settle_real(term, type);
      break;
    case Shape::kBits:
      settle_bits(term, type);
      break;
    case Shape::kText:
      refuse(term, type);
      break;
  }
  for (const Term& operand : term.operands) term.faulty = term.faulty || operand.faulty;
}

void Settling::refuse(Term& term, Type type, const std::string& hint) {
  error(term.column, describe(term) + " does not fit where " + name_of(type) + " is expected" + hint);
  term.faulty = true;
}

void Settling::warn_of_division(const Term& term, Type type) {
  if (term.division_column == 0 || !is_real(type)) return;
  const auto same = [&](const ExpressionError& warning) { return warning.column == term.division_column; };
  if (std::ranges::any_of(warnings, same)) return;
  warnings.push_back({term.division_column, "the integer division truncates before its result becomes " +
                                                name_of(type) + "; TO_" + name_of(type) +
                                                " of an operand keeps the fraction"});
}

void Settling::widen(Term& term, Type type) {
  if (term.type == type) return;
  if (!widens(term.type, type)) {
    const bool possible = convertible(term.type, type);
    refuse(term, type, possible ? "; TO_" + name_of(type) + "(…) converts it" : "");
    return;
  }
  warn_of_division(term, type);
  const Type from = term.type;
  term = converted(std::move(term), from, type);
}

void Settling::settle_values(Term& term, Type type) {
  for (std::size_t i = 0; i < values_in(term); ++i) settle(term.operands[i], type);
  term.shape = Shape::kTyped;
  term.type = type;
}

void Settling::settle_integer(Term& term, Type type) {
  if (term.form == Term::Form::kLiteral) return settle_literal(term, type);
  if (term.form == Term::Form::kRounding) return settle_rounding(term, type);
  const bool fits = is_numeric(type) || (is_bit_string(type) && !is_arithmetic(term));
  if (!fits) return refuse(term, type);
  if (is_real(type) && is_division(term)) {
    // The division stays one of integers; its result becomes a real number.
    const Type integer = default_type(term);
    warn_of_division(term, type);
    settle_values(term, integer);
    term = converted(std::move(term), integer, type);
    return;
  }
  settle_values(term, type);
}

void Settling::settle_literal(Term& term, Type type) {
  if (type == Type::BOOL) return refuse(term, type, "; allowed are TRUE and FALSE");
  if (type == Type::TIME) return refuse(term, type, "; a duration is written T#10ms");
  if (is_real(type)) {
    warn_of_division(term, type);
    // Rounded once, from the exact integer.
    term.value.r = type == Type::REAL ? static_cast<double>(static_cast<float>(term.integer))
                                      : static_cast<double>(term.integer);
  } else if (is_integer(type) || is_bit_string(type)) {
    if (!in_range(term.integer, type)) {
      error(term.column, decimal(term.integer) + " does not fit " + range_of(type));
      term.faulty = true;
      return;
    }
    term.value.u = static_cast<std::uint64_t>(term.integer);
  } else {
    return refuse(term, type);
  }
  term.shape = Shape::kTyped;
  term.type = type;
}

void Settling::settle_rounding(Term& term, Type type) {
  if (!is_numeric(type)) return refuse(term, type);
  Term& operand = term.operands.front();
  if (operand.shape != Shape::kTyped || !is_real(operand.type))
    settle(operand, is_real(type) ? type : Type::LREAL);
  if (operand.faulty) {
    term.faulty = true;
    return;
  }
  const Type real = operand.type;
  term.form = Term::Form::kOperation;
  term.shape = Shape::kTyped;
  term.type = real;
  if (is_integer(type))
    term = converted(std::move(term), real, type);
  else
    widen(term, type);
}

void Settling::settle_real(Term& term, Type type) {
  if (!is_real(type)) {
    const bool possible = convertible(Type::LREAL, type);
    return refuse(term, type, possible ? "; TO_" + name_of(type) + "(…) converts it" : "");
  }
  if (term.form != Term::Form::kLiteral) return settle_values(term, type);
  if (type == Type::REAL) {
    const auto rounded = static_cast<double>(static_cast<float>(term.value.r));
    if (!std::isfinite(rounded) || (rounded == 0.0 && term.value.r != 0.0)) {
      error(term.column, "the literal is out of the range of REAL (1.2E-38 to 3.4E38)");
      term.faulty = true;
      return;
    }
    term.value.r = rounded;
  }
  term.shape = Shape::kTyped;
  term.type = type;
}

void Settling::settle_bits(Term& term, Type type) {
  if (!is_bit_string(type) || !widens(term.type, type)) return refuse(term, type);
  settle_values(term, type);
}

}  // namespace lockstep
