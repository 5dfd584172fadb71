#include "scheduler/expression_steps.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstring>

#include "scheduler/expression_operations.hpp"
#include "scheduler/text.hpp"
#include "tech_objects/data_blocks/array.hpp"

namespace lockstep::expression_steps {
namespace {

using Step = Instruction::Step;

// In the accumulator and the slots a value is 64 bits: integers widened, BOOL 0 or 1, REAL and LREAL as a
// double. So widening among integers, and from REAL to LREAL, costs no instruction.
template <class T>
T decode(Word word) noexcept {
  if constexpr (std::same_as<T, bool>)
    return word != 0;
  else if constexpr (std::floating_point<T>)
    return static_cast<T>(std::bit_cast<double>(word));
  else
    return static_cast<T>(word);
}

template <class T>
Word encode(T value) noexcept {
  if constexpr (std::floating_point<T>)
    return std::bit_cast<Word>(static_cast<double>(value));
  else if constexpr (std::signed_integral<T>)
    return static_cast<Word>(static_cast<std::int64_t>(value));
  else
    return static_cast<Word>(value);
}

Word next(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  return at[1].step(at + 1, accumulator, slots, counters);
}

template <class T, Mode mode>
Word load_value(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  if constexpr (mode == Mode::kResting) slots[at->slot] = accumulator;
  T value;
  std::memcpy(&value, at->operand.address, sizeof value);
  if constexpr (mode == Mode::kOnly)
    return encode(value);
  else
    return next(at, encode(value), slots, counters);
}

template <class T, Mode mode>
Word load_bit(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  if constexpr (mode == Mode::kResting) slots[at->slot] = accumulator;
  T value;
  std::memcpy(&value, at->operand.address, sizeof value);
  const Word bit = (static_cast<Word>(value) >> at->bit) & 1u;
  if constexpr (mode == Mode::kOnly)
    return bit;
  else
    return next(at, bit, slots, counters);
}

Word take_index(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  const Word packed = at->operand.constant;
  const ElementRange range{static_cast<DINT>(packed >> 32), static_cast<std::uint32_t>(packed), at->slot};
  const Word distance = range.offset_of(static_cast<std::int64_t>(accumulator));
  if (distance == ElementRange::kOutside) ++counters.indices_out_of_range;
  return next(at, distance, slots, counters);
}

template <class T, bool one_bit>
Word load_element(const Instruction* at, Word distance, Word* slots, EvaluationCounters& counters) noexcept {
  if (distance == ElementRange::kOutside) return next(at, 0, slots, counters);
  T value;
  std::memcpy(&value, static_cast<const char*>(at->operand.address) + distance, sizeof value);
  if constexpr (one_bit)
    return next(at, (static_cast<Word>(value) >> at->bit) & 1u, slots, counters);
  else
    return next(at, encode(value), slots, counters);
}

template <Mode mode>
Word compare_step(const Instruction* at, Word accumulator, Word* slots,
                  EvaluationCounters& counters) noexcept {
  if constexpr (mode == Mode::kResting) slots[at->slot] = accumulator;
  const bool holds = static_cast<const TextComparison*>(at->operand.address)->holds(counters);
  return next(at, encode(holds), slots, counters);
}

template <Mode mode>
Word take_constant(const Instruction* at, Word accumulator, Word* slots,
                   EvaluationCounters& counters) noexcept {
  if constexpr (mode == Mode::kResting) slots[at->slot] = accumulator;
  if constexpr (mode == Mode::kOnly)
    return at->operand.constant;
  else
    return next(at, at->operand.constant, slots, counters);
}

Word give_result(const Instruction*, Word accumulator, Word*, EvaluationCounters&) noexcept {
  return accumulator;
}

template <class T, Right from>
T right_operand(const Instruction* at, Word accumulator) noexcept {
  if constexpr (from == Right::kAccumulator) return decode<T>(accumulator);
  if constexpr (from == Right::kConstant) return decode<T>(at->operand.constant);
  T value;
  std::memcpy(&value, at->operand.address, sizeof value);
  if constexpr (from == Right::kInvertedFlag) value = !value;
  return value;
}

template <class Op, class T, Right from>
Word binary_step(const Instruction* at, Word accumulator, Word* slots,
                 EvaluationCounters& counters) noexcept {
  const Word left = from == Right::kAccumulator ? slots[at->slot] : accumulator;
  const T right = right_operand<T, from>(at, accumulator);
  return next(at, encode(Op::apply(decode<T>(left), right, counters)), slots, counters);
}

template <Operation operation, class T, bool constant_right>
Word move_bits(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  const Word left = constant_right ? accumulator : slots[at->slot];
  const Word count = constant_right ? at->operand.constant : accumulator;
  const T value = moved<operation>(decode<T>(left), static_cast<std::int64_t>(count));
  return next(at, encode(value), slots, counters);
}

/// One-operand operations on reals; REAL is rounded by a step of its own.
template <double (*function)(double)>
Word real_function(const Instruction* at, Word accumulator, Word* slots,
                   EvaluationCounters& counters) noexcept {
  return next(at, encode(function(decode<double>(accumulator))), slots, counters);
}

template <class T>
Word negated(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  if constexpr (std::floating_point<T>)
    return next(at, encode(-decode<T>(accumulator)), slots, counters);
  else
    return next(at, encode(static_cast<T>(Word{0} - accumulator)), slots, counters);
}

template <class T>
Word inverted(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  if constexpr (std::same_as<T, bool>)
    return next(at, accumulator ^ 1u, slots, counters);
  else
    return next(at, encode(static_cast<T>(~accumulator)), slots, counters);
}

template <class T>
Word absolute(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  const T value = decode<T>(accumulator);
  Word word = encode(value);
  if constexpr (std::floating_point<T>)
    word = encode(std::fabs(value));
  else if constexpr (std::signed_integral<T>)
    if (value < 0) word = encode(static_cast<T>(Word{0} - static_cast<Word>(value)));
  return next(at, word, slots, counters);
}

template <class From, class To>
Word convert_step(const Instruction* at, Word accumulator, Word* slots,
                  EvaluationCounters& counters) noexcept {
  return next(at, encode(converted<From, To>(decode<From>(accumulator))), slots, counters);
}

Word float_bits(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  return next(at, std::bit_cast<std::uint32_t>(decode<float>(accumulator)), slots, counters);
}

Word float_of_bits(const Instruction* at, Word accumulator, Word* slots,
                   EvaluationCounters& counters) noexcept {
  return next(at, encode(std::bit_cast<float>(decode<std::uint32_t>(accumulator))), slots, counters);
}

Word select_step(const Instruction* at, Word accumulator, Word* slots,
                 EvaluationCounters& counters) noexcept {
  return next(at, slots[at->slot + (accumulator != 0 ? 1 : 0)], slots, counters);
}

Word multiplex_step(const Instruction* at, Word accumulator, Word* slots,
                    EvaluationCounters& counters) noexcept {
  const auto wanted = static_cast<std::int64_t>(accumulator);
  const auto chosen = std::clamp<std::int64_t>(wanted, 0, at->bit - 1);
  return next(at, slots[at->slot + chosen], slots, counters);
}

Word count_step(const Instruction* at, Word accumulator, Word* slots, EvaluationCounters& counters) noexcept {
  counters.integer_divisions_by_zero += at->operand.constant;
  return next(at, accumulator, slots, counters);
}

/// Calls `visitor.operator()<T>()` with the C++ type that computes for an IEC type; null for a technology
/// object.
template <class Visitor>
Step visit(Type type, Visitor visitor) {
  switch (type) {
    case Type::BOOL:
      return visitor.template operator()<bool>();
    case Type::SINT:
      return visitor.template operator()<std::int8_t>();
    case Type::INT:
      return visitor.template operator()<std::int16_t>();
    case Type::DINT:
      return visitor.template operator()<std::int32_t>();
    case Type::LINT:
    case Type::TIME:
      return visitor.template operator()<std::int64_t>();
    case Type::USINT:
    case Type::BYTE:
      return visitor.template operator()<std::uint8_t>();
    case Type::UINT:
    case Type::WORD:
      return visitor.template operator()<std::uint16_t>();
    case Type::UDINT:
    case Type::DWORD:
    case Type::DB_ANY:
      return visitor.template operator()<std::uint32_t>();
    case Type::ULINT:
    case Type::LWORD:
      return visitor.template operator()<std::uint64_t>();
    case Type::REAL:
      return visitor.template operator()<float>();
    case Type::LREAL:
      return visitor.template operator()<double>();
    case Type::AXIS:
    case Type::TAG:
    case Type::ARRAY:
      break;
  }
  return nullptr;
}

template <Mode mode>
Step load_of(const Signal& signal) {
  return visit(signal.type, [&]<class T>() -> Step {
    if constexpr (Integer<T>)
      if (signal.bit >= 0) return load_bit<T, mode>;
    return load_value<T, mode>;
  });
}

template <class Op>
Step binary_of(Type type, Right right) {
  return visit(type, [&]<class T>() -> Step {
    if constexpr (requires(T value, EvaluationCounters & counters) { Op::apply(value, value, counters); }) {
      if (right == Right::kConstant) return binary_step<Op, T, Right::kConstant>;
      if (right == Right::kSignal) return binary_step<Op, T, Right::kSignal>;
      if constexpr (std::same_as<T, bool>)
        if (right == Right::kInvertedFlag) return binary_step<Op, T, Right::kInvertedFlag>;
      if (right == Right::kAccumulator) return binary_step<Op, T, Right::kAccumulator>;
    }
    return nullptr;
  });
}

template <Operation operation>
Step move_of(Type type, Right count) {
  return visit(type, [&]<class T>() -> Step {
    if constexpr (Integer<T> && std::unsigned_integral<T>) {
      if (count == Right::kConstant) return move_bits<operation, T, true>;
      if (count == Right::kAccumulator) return move_bits<operation, T, false>;
    }
    return nullptr;
  });
}

template <Operation operation>
Step unary_of(Type type) {
  return visit(type, []<class T>() -> Step {
    if constexpr (operation == Operation::kNegate && Number<T>)
      return negated<T>;
    else if constexpr (operation == Operation::kAbsolute && Number<T>)
      return absolute<T>;
    else if constexpr (operation == Operation::kNot && std::unsigned_integral<T>)
      return inverted<T>;
    else
      return nullptr;
  });
}

template <class From>
Step conversion_from(Type to) {
  return visit(to, []<class To>() -> Step { return convert_step<From, To>; });
}

using RealFunction = double (*)(double);

Step real_step(Operation operation) {
  switch (operation) {
    case Operation::kSquareRoot:
      return real_function<static_cast<RealFunction>(&std::sqrt)>;
    case Operation::kNaturalLog:
      return real_function<static_cast<RealFunction>(&std::log)>;
    case Operation::kDecimalLog:
      return real_function<static_cast<RealFunction>(&std::log10)>;
    case Operation::kExponential:
      return real_function<static_cast<RealFunction>(&std::exp)>;
    case Operation::kSine:
      return real_function<static_cast<RealFunction>(&std::sin)>;
    case Operation::kCosine:
      return real_function<static_cast<RealFunction>(&std::cos)>;
    case Operation::kTangent:
      return real_function<static_cast<RealFunction>(&std::tan)>;
    case Operation::kArcSine:
      return real_function<static_cast<RealFunction>(&std::asin)>;
    case Operation::kArcCosine:
      return real_function<static_cast<RealFunction>(&std::acos)>;
    case Operation::kArcTangent:
      return real_function<static_cast<RealFunction>(&std::atan)>;
    case Operation::kTruncate:
      return real_function<static_cast<RealFunction>(&std::trunc)>;
    case Operation::kFloor:
      return real_function<static_cast<RealFunction>(&std::floor)>;
    case Operation::kCeiling:
      return real_function<static_cast<RealFunction>(&std::ceil)>;
    case Operation::kRound:
      return real_function<static_cast<RealFunction>(&std::nearbyint)>;
    default:
      return nullptr;
  }
}

}  // namespace

Step load(const Signal& signal, Mode mode) noexcept {
  switch (mode) {
    case Mode::kResting:
      return load_of<Mode::kResting>(signal);
    case Mode::kOnly:
      return load_of<Mode::kOnly>(signal);
    default:
      return load_of<Mode::kPlain>(signal);
  }
}

Step constant(Mode mode) noexcept {
  switch (mode) {
    case Mode::kResting:
      return take_constant<Mode::kResting>;
    case Mode::kOnly:
      return take_constant<Mode::kOnly>;
    default:
      return take_constant<Mode::kPlain>;
  }
}

Step binary(Operation operation, Type type, Right right) noexcept {
  switch (operation) {
    case Operation::kAdd:
      return binary_of<Add>(type, right);
    case Operation::kSubtract:
      return binary_of<Subtract>(type, right);
    case Operation::kMultiply:
      return binary_of<Multiply>(type, right);
    case Operation::kDivide:
      return binary_of<Divide>(type, right);
    case Operation::kModulo:
      return binary_of<Modulo>(type, right);
    case Operation::kPower:
      return binary_of<Power>(type, right);
    case Operation::kAtan2:
      return binary_of<Atan2>(type, right);
    case Operation::kLess:
      return binary_of<Less>(type, right);
    case Operation::kLessEqual:
      return binary_of<LessEqual>(type, right);
    case Operation::kGreater:
      return binary_of<Greater>(type, right);
    case Operation::kGreaterEqual:
      return binary_of<GreaterEqual>(type, right);
    case Operation::kEqual:
      return binary_of<Equal>(type, right);
    case Operation::kUnequal:
      return binary_of<Unequal>(type, right);
    case Operation::kAnd:
      return binary_of<And>(type, right);
    case Operation::kOr:
      return binary_of<Or>(type, right);
    case Operation::kXor:
      return binary_of<Xor>(type, right);
    case Operation::kMinimum:
      return binary_of<Minimum>(type, right);
    case Operation::kMaximum:
      return binary_of<Maximum>(type, right);
    case Operation::kShiftLeft:
      return move_of<Operation::kShiftLeft>(type, right);
    case Operation::kShiftRight:
      return move_of<Operation::kShiftRight>(type, right);
    case Operation::kRotateLeft:
      return move_of<Operation::kRotateLeft>(type, right);
    case Operation::kRotateRight:
      return move_of<Operation::kRotateRight>(type, right);
    default:
      return nullptr;
  }
}

Step unary(Operation operation, Type type) noexcept {
  switch (operation) {
    case Operation::kNegate:
      return unary_of<Operation::kNegate>(type);
    case Operation::kNot:
      return unary_of<Operation::kNot>(type);
    case Operation::kAbsolute:
      return unary_of<Operation::kAbsolute>(type);
    default:
      return is_real(type) ? real_step(operation) : nullptr;
  }
}

Step conversion(Type from, Type to) noexcept {
  return visit(from, [to]<class From>() -> Step { return conversion_from<From>(to); });
}

Step index() noexcept {
  return take_index;
}

Step element(const Signal& first) noexcept {
  return visit(first.type, [&]<class T>() -> Step {
    if constexpr (Integer<T>)
      if (first.bit >= 0) return load_element<T, true>;
    return load_element<T, false>;
  });
}

Step bits_of_real() noexcept {
  return float_bits;
}
Step real_of_bits() noexcept {
  return float_of_bits;
}
Step select() noexcept {
  return select_step;
}
Step multiplex() noexcept {
  return multiplex_step;
}
Step compare_texts(Mode mode) noexcept {
  return mode == Mode::kResting ? compare_step<Mode::kResting> : compare_step<Mode::kPlain>;
}
Step count() noexcept {
  return count_step;
}
Step result() noexcept {
  return give_result;
}

}  // namespace lockstep::expression_steps
