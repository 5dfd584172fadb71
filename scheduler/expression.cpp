#include "scheduler/expression.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "scheduler/expression_steps.hpp"

namespace lockstep {
namespace {

using expression_steps::Mode;
using expression_steps::Right;

constexpr std::int64_t kNanosecondsPerMillisecond = 1'000'000;

Instruction instruction(Instruction::Step step, std::uint64_t constant = 0, std::size_t slot = 0,
                        std::size_t bit = 0) {
  Instruction result{};
  result.step = step;
  result.operand.constant = constant;
  result.slot = static_cast<std::uint16_t>(slot);
  result.bit = static_cast<std::uint16_t>(bit);
  return result;
}

Instruction load_instruction(const Signal& signal, Mode mode) {
  Instruction result = instruction(expression_steps::load(signal, mode), 0, 0,
                                   static_cast<std::size_t>(std::max<int>(signal.bit, 0)));
  result.operand.address = signal.address;
  return result;
}

[[gnu::always_inline]] inline std::uint64_t run(const Instruction* code,
                                                EvaluationCounters& counters) noexcept {
  std::uint64_t slots[ExpressionBuilder::kMaximumValues];  // each is written before it is read
  return code->step(code, 0, slots, counters);
}

/// The bit string that a real of the same width exchanges its bits with.
Type bits_of(Type real) {
  return real == Type::REAL ? Type::DWORD : Type::LWORD;
}

/// The unsigned integer as wide as an integer or bit string.
Type unsigned_of(Type type) {
  switch (size_of(type)) {
    case 1:
      return Type::USINT;
    case 2:
      return Type::UINT;
    case 4:
      return Type::UDINT;
    default:
      return Type::ULINT;
  }
}

}  // namespace

bool convertible(Type from, Type to) noexcept {
  const auto special = [](Type type) { return type > Type::TIME; };
  if (special(from) || special(to)) return false;
  if (from == to) return true;
  if (is_real(from) && is_bit_string(to)) return to == bits_of(from);
  if (is_bit_string(from) && is_real(to)) return from == bits_of(to);
  if (from == Type::TIME) return is_numeric(to);
  if (to == Type::TIME) return is_numeric(from);
  return true;
}

Expression::Expression(Type type, Value value)
    : code_{instruction(expression_steps::constant(Mode::kOnly), std::bit_cast<std::uint64_t>(value))},
      type_(type),
      constant_(true) {}

Expression::Expression(const Signal& signal) : Expression(signal, signal.value_type()) {}

Expression::Expression(const Signal& signal, Type type)
    : code_{load_instruction(signal, Mode::kOnly)}, type_(type), constant_(false) {}

const bool* Expression::flag() const noexcept {
  constexpr Signal kFlag{nullptr, Type::BOOL, -1};
  const bool plain = type_ == Type::BOOL && code_.size() == 1 &&
                     code_.front().step == expression_steps::load(kFlag, Mode::kOnly);
  return plain ? static_cast<const bool*>(code_.front().operand.address) : nullptr;
}

Value Expression::evaluate(EvaluationCounters& counters) const noexcept {
  return std::bit_cast<Value>(run(code_.data(), counters));
}

void ExpressionBuilder::push(Instruction::Step plain, Instruction::Step resting, Instruction next,
                             bool is_constant) {
  next.step = plain;
  if (!values_.empty()) {
    next.step = resting;
    next.slot = static_cast<std::uint16_t>(values_.size() - 1);
  }
  if (values_.size() > kMaximumValues) fits_ = false;
  values_.push_back({code_.size(), is_constant});
  code_.push_back(next);
}

void ExpressionBuilder::signal(const Signal& signal) {
  last_signal_ = signal;
  push(expression_steps::load(signal, Mode::kPlain), expression_steps::load(signal, Mode::kResting),
       load_instruction(signal, Mode::kPlain), false);
}

/// Two instructions: the index becomes the distance from the first element, and that the value. The range has
/// space in what the first does not need.
void ExpressionBuilder::element(const Signal& first, const ElementRange& range) {
  const auto packed = std::uint64_t{static_cast<std::uint32_t>(range.lower)} << 32 | range.count;
  code_.push_back(instruction(expression_steps::index(), packed, range.stride));
  Instruction load = instruction(expression_steps::element(first), 0, 0,
                                 static_cast<std::size_t>(std::max<int>(first.bit, 0)));
  load.operand.address = first.address;
  code_.push_back(load);
  values_.back().constant = false;
}

void ExpressionBuilder::compare_texts(TextComparison comparison) {
  const auto& kept = texts_.emplace_back(std::make_shared<const TextComparison>(std::move(comparison)));
  Instruction compare = instruction(nullptr);
  compare.operand.address = kept.get();
  push(expression_steps::compare_texts(Mode::kPlain), expression_steps::compare_texts(Mode::kResting),
       compare, false);
}

void ExpressionBuilder::constant(Value value) {
  push(expression_steps::constant(Mode::kPlain), expression_steps::constant(Mode::kResting),
       instruction(nullptr, std::bit_cast<std::uint64_t>(value)), true);
}

bool ExpressionBuilder::apply(Operation operation, Type type) {
  if (operands_of(operation) == 1) {
    const auto step = expression_steps::unary(operation, type);
    if (step == nullptr) return false;
    unary(step);
    if (type == Type::REAL) unary(expression_steps::conversion(Type::LREAL, Type::REAL));
    return true;
  }
  if (apply_to_constant(operation, type) || apply_to_signal(operation, type)) return true;
  const auto step = expression_steps::binary(operation, type, Right::kAccumulator);
  if (step == nullptr) return false;
  combine(2, instruction(step, 0, values_.size() - 2));
  return true;
}

/// A constant right operand needs no instruction of its own.
bool ExpressionBuilder::apply_to_constant(Operation operation, Type type) {
  if (!values_.back().constant || values_[values_.size() - 2].constant) return false;
  const auto step = expression_steps::binary(operation, type, Right::kConstant);
  if (step == nullptr) return false;
  code_.back() = instruction(step, code_.back().operand.constant);
  values_.pop_back();
  return true;
}

/// Nor does a whole signal of the operation's type, or NOT a BOOL.
bool ExpressionBuilder::apply_to_signal(Operation operation, Type type) {
  const std::size_t start = values_.back().start;
  const auto load = expression_steps::load({nullptr, type, -1}, Mode::kResting);
  if (load == nullptr || code_[start].step != load) return false;
  const bool inverted = code_.size() == start + 2 && type == Type::BOOL &&
                        code_.back().step == expression_steps::unary(Operation::kNot, type);
  if (code_.size() != start + 1 && !inverted) return false;
  const auto step =
      expression_steps::binary(operation, type, inverted ? Right::kInvertedFlag : Right::kSignal);
  if (step == nullptr) return false;
  const Instruction::Operand right = code_[start].operand;
  code_.resize(start + 1);
  code_.back() = instruction(step);
  code_.back().operand = right;
  values_.pop_back();
  values_.back().constant = false;
  return true;
}

void ExpressionBuilder::unary(Instruction::Step step, std::uint64_t constant) {
  code_.push_back(instruction(step, constant));
  if (values_.back().constant) fold();
}

void ExpressionBuilder::combine(std::size_t inputs, Instruction next) {
  bool constants = true;
  for (std::size_t i = 0; i < inputs; ++i) constants = constants && values_[values_.size() - 1 - i].constant;
  values_.resize(values_.size() - inputs + 1);
  values_.back().constant = constants;
  code_.push_back(next);
  if (constants) fold();
}

/// Replaces the code of the last value, which depends on no signal, by the value.
void ExpressionBuilder::fold() {
  const Entry last = values_.back();
  if (!fits_) return;
  EvaluationCounters counters;
  code_.push_back(instruction(expression_steps::result()));
  const std::uint64_t word = run(&code_[last.start], counters);
  code_.pop_back();
  if (counters.integer_divisions_by_zero != 0) {
    values_.back().constant = false;
    return;
  }
  code_.resize(last.start);
  values_.pop_back();
  constant(std::bit_cast<Value>(word));
}

void ExpressionBuilder::convert(Type from, Type to) {
  using expression_steps::conversion;
  if (from == to) return;
  const auto multiply = [&](Type type, std::uint64_t by) {
    unary(expression_steps::binary(Operation::kMultiply, type, Right::kConstant), by);
  };
  const auto divide = [&](Type type, std::uint64_t by) {
    unary(expression_steps::binary(Operation::kDivide, type, Right::kConstant), by);
  };
  constexpr auto whole = static_cast<std::uint64_t>(kNanosecondsPerMillisecond);
  constexpr auto fraction = std::bit_cast<std::uint64_t>(static_cast<double>(kNanosecondsPerMillisecond));
  if (from == Type::TIME && is_real(to)) {
    unary(conversion(Type::LINT, Type::LREAL));
    divide(Type::LREAL, fraction);
    if (to == Type::REAL) unary(conversion(Type::LREAL, Type::REAL));
  } else if (from == Type::TIME) {
    divide(Type::LINT, whole);
    if (to != Type::LINT) unary(conversion(Type::LINT, to));
  } else if (to == Type::TIME && is_real(from)) {
    multiply(Type::LREAL, fraction);
    unary(conversion(Type::LREAL, Type::LINT));
  } else if (to == Type::TIME) {
    multiply(Type::LINT, whole);
  } else if (is_real(from) && is_bit_string(to)) {
    if (from == Type::REAL) unary(expression_steps::bits_of_real());
  } else if (is_bit_string(from) && is_real(to)) {
    if (to == Type::REAL) unary(expression_steps::real_of_bits());
  } else if (from == Type::REAL && to == Type::LREAL) {
    return;  // held as a double anyway
  } else {
    // A wider bit string is filled with zeros, not with the sign.
    if (is_bit_string(to) && is_signed_integer(from) && size_of(to) > size_of(from))
      unary(conversion(from, unsigned_of(from)));
    else
      unary(conversion(from, to));
  }
}

void ExpressionBuilder::select() {
  combine(3, instruction(expression_steps::select(), 0, values_.size() - 3));
}

void ExpressionBuilder::multiplex(int inputs) {
  const auto count = static_cast<std::size_t>(inputs);
  combine(count + 1, instruction(expression_steps::multiplex(), 0, values_.size() - count - 1, count));
}

void ExpressionBuilder::count_divisions_by_zero(int number) {
  code_.push_back(instruction(expression_steps::count(), static_cast<std::uint64_t>(number)));
  values_.back().constant = false;
}

Expression ExpressionBuilder::finish(Type type) && {
  if (values_.back().constant) return {type, std::bit_cast<Value>(code_.front().operand.constant)};
  if (code_.size() == 1 && texts_.empty()) return {last_signal_, type};
  code_.push_back(instruction(expression_steps::result()));
  return {type, std::move(code_), std::move(texts_)};
}

}  // namespace lockstep
