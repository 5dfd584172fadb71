/// What compiled expressions are made of.
/// @source IEC 61131-3:2013, 6.6.2.5 (standard functions), 7.3.2 (expressions)
#pragma once

#include <cstdint>

namespace lockstep {

/// What evaluation counts; owned by the cycle, which reports it.
struct EvaluationCounters {
  std::uint64_t integer_divisions_by_zero = 0;  ///< `/` and MOD of integers, TIME / integer
  std::uint64_t indices_out_of_range = 0;       ///< of arrays, read or written
};

/// What an instruction computes. The first group has two operands, the second one.
enum class Operation : std::uint8_t {
  kAdd,           ///< numbers, TIME
  kSubtract,      ///< numbers, TIME
  kMultiply,      ///< numbers, TIME
  kDivide,        ///< numbers, TIME
  kModulo,        ///< integers
  kPower,         ///< reals
  kAtan2,         ///< reals: y, x
  kLess,          ///< all but BOOL
  kLessEqual,     ///< all but BOOL
  kGreater,       ///< all but BOOL
  kGreaterEqual,  ///< all but BOOL
  kEqual,         ///< all
  kUnequal,       ///< all
  kAnd,           ///< BOOL, bit strings
  kOr,            ///< BOOL, bit strings
  kXor,           ///< BOOL, bit strings
  kMinimum,       ///< all but BOOL
  kMaximum,       ///< all but BOOL
  kShiftLeft,     ///< bit string, LINT: a count ≥ the width gives 0, one ≤ 0 changes nothing
  kShiftRight,    ///< bit string, LINT
  kRotateLeft,    ///< bit string, LINT: the count is taken modulo the width, one ≤ 0 changes nothing
  kRotateRight,   ///< bit string, LINT
  kNegate,        ///< numbers, TIME
  kNot,           ///< BOOL, bit strings
  kAbsolute,      ///< numbers; the minimum integer stays what it is
  kSquareRoot,    ///< reals, from here on
  kNaturalLog,
  kDecimalLog,
  kExponential,
  kSine,  ///< angles in radian
  kCosine,
  kTangent,
  kArcSine,
  kArcCosine,
  kArcTangent,
  kTruncate,  ///< towards zero
  kFloor,
  kCeiling,
  kRound  ///< to the nearest, a half to the even one
};

/// Number of operands, 1 or 2.
constexpr int operands_of(Operation operation) noexcept {
  return operation < Operation::kNegate ? 2 : 1;
}

/// One step of a compiled expression; only an ExpressionBuilder makes them.
struct Instruction {
  using Step = std::uint64_t (*)(const Instruction* at, std::uint64_t accumulator, std::uint64_t* slots,
                                 EvaluationCounters& counters) noexcept;
  union Operand {
    const void* address;
    std::uint64_t constant;
  };
  Step step;
  Operand operand;     ///< where a value is loaded from, or the right operand: where it stands or a constant
  std::uint16_t slot;  ///< where the left operand rests, or where the accumulator is put first; of an index:
                       ///< distance of two elements
  std::uint16_t bit;   ///< bit to load, or number of inputs
};

}  // namespace lockstep
