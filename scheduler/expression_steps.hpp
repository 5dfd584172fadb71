/// The functions of which compiled expressions are made: one for each operation and type.
/// Each reads its operands from the accumulator and the slots and ends by calling the next instruction's; an
/// optimising compiler makes that a jump. Null is returned where an operation does not exist for a type.
#pragma once

#include "scheduler/instruction.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep::expression_steps {

/// What a load does around its own work.
enum class Mode {
  kPlain,    ///< loads over the accumulator
  kResting,  ///< puts the accumulator into `slot` first
  kOnly      ///< is the whole expression: calls nothing further
};

/// From where an operation with two operands takes the right one. The left one is in the accumulator, but for
/// kAccumulator, where it rests in `slot`.
enum class Right {
  kAccumulator,
  kConstant,     ///< `constant`
  kSignal,       ///< what stands at `address`, of the operation's type; not for shifts
  kInvertedFlag  ///< NOT the BOOL at `address`; for operations on BOOL
};

Instruction::Step load(const Signal& signal, Mode mode) noexcept;
Instruction::Step constant(Mode mode) noexcept;
/// An index in the accumulator becomes the distance to its element [byte]; `element` loads what is there.
Instruction::Step index() noexcept;
Instruction::Step element(const Signal& first) noexcept;
/// Two operands; null also where the right one cannot come from there.
Instruction::Step binary(Operation operation, Type type, Right right) noexcept;
/// One operand. Functions of reals compute in double precision; REAL has to be rounded by a conversion after.
Instruction::Step unary(Operation operation, Type type) noexcept;
/// From one type's range and representation to the other's; TIME counts as LINT.
Instruction::Step conversion(Type from, Type to) noexcept;
Instruction::Step bits_of_real() noexcept;  ///< REAL to DWORD
Instruction::Step real_of_bits() noexcept;  ///< DWORD to REAL
Instruction::Step select() noexcept;
Instruction::Step multiplex() noexcept;
/// What a TextComparison says: kPlain or kResting.
Instruction::Step compare_texts(Mode mode) noexcept;
Instruction::Step count() noexcept;
Instruction::Step result() noexcept;

}  // namespace lockstep::expression_steps
