#include "projects/aposs/expression.hpp"

#include <optional>

#include "scheduler/aposs/arithmetic.hpp"

namespace lockstep::aposs {
namespace {

std::optional<std::int32_t> result_of(Operation operation, std::int32_t a, std::int32_t b) {
  switch (operation) {
    case Operation::kAdd:
      return sum(a, b);
    case Operation::kSubtract:
      return difference(a, b);
    case Operation::kMultiply:
      return product(a, b);
    case Operation::kDivide:
      return b == 0 ? std::nullopt : std::optional(quotient(a, b));
    case Operation::kRemainder:
      return b == 0 ? std::nullopt : std::optional(remainder(a, b));
    case Operation::kDivideRounded:
      return b == 0 ? std::nullopt : std::optional(rounded_quotient(a, b));
    case Operation::kAnd:
      return a & b;
    case Operation::kOr:
      return a | b;
    case Operation::kExclusiveOr:
      return a ^ b;
    case Operation::kShiftLeft:
      return shifted_left(a, b);
    case Operation::kShiftRight:
      return shifted_right(a, b);
    case Operation::kLess:
      return a < b ? 1 : 0;
    case Operation::kGreater:
      return a > b ? 1 : 0;
    case Operation::kLessOrEqual:
      return a <= b ? 1 : 0;
    case Operation::kGreaterOrEqual:
      return a >= b ? 1 : 0;
    case Operation::kEqual:
      return a == b ? 1 : 0;
    case Operation::kUnequal:
      return a != b ? 1 : 0;
    case Operation::kBothTrue:
      return a != 0 && b != 0 ? 1 : 0;
    case Operation::kEitherTrue:
      return a != 0 || b != 0 ? 1 : 0;
    case Operation::kNegate:
      return negative(a);
    case Operation::kInvert:
      return ~a;
    case Operation::kNot:
      return a == 0 ? 1 : 0;
    case Operation::kAbsolute:
      return absolute(a);
    case Operation::kBit:
      return BitOf::of(a, b);
    case Operation::kByte:
      return ByteOf::of(a, b);
    case Operation::kWord:
      return WordOf::of(a, b);
    default:
      return std::nullopt;
  }
}

bool is_constant(const ExpressionPointer& expression) {
  return expression == nullptr || expression->kind == Expression::Kind::kConstant;
}

}  // namespace

ExpressionPointer constant(const Place& place, std::int32_t value) {
  auto expression = std::make_unique<Expression>();
  expression->place = place;
  expression->value = value;
  return expression;
}

ExpressionPointer apply(const Place& place, Operation operation, ExpressionPointer a, ExpressionPointer b) {
  if (is_constant(a) && is_constant(b))
    if (const auto value = result_of(operation, a->value, b ? b->value : 0)) return constant(place, *value);
  auto expression = std::make_unique<Expression>();
  expression->kind = Expression::Kind::kOperation;
  expression->place = place;
  expression->operation = operation;
  expression->operands.push_back(std::move(a));
  if (b) expression->operands.push_back(std::move(b));
  return expression;
}

}  // namespace lockstep::aposs
