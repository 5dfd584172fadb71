/// Compiled expressions of the project and their evaluation in the cycle.
/// @source IEC 61131-3:2013, 6.6.2.5 (standard functions), 7.3.2 (expressions)
///
/// An expression is a flat array of typed instructions. Each instruction is the address of a small function
/// for exactly its operation and type, which ends by calling the next one: nothing asks for a type at run
/// time. The newest value is in the accumulator; older ones rest in numbered slots known when the code is
/// built.
///
/// Semantics, all of them total functions:
/// - integers wrap at the width of their type; a division truncates, MOD has the sign of the dividend, the
///   minimum number divided by -1 wraps; a division by zero gives 0 and is counted;
/// - REAL is rounded to single precision after each operation; a real division gives infinity or NaN;
/// - an element of an array whose index is out of range is 0 or FALSE, which is counted;
/// - with a NaN every comparison but <> is FALSE, and MIN, MAX and LIMIT give NaN;
/// - a real becomes an integer by rounding to the nearest, a half to the even one; out of range it becomes
/// the
///   nearest end of the range, NaN becomes 0;
/// - integers converted to a narrower type keep their low bits; a bit string and an integer of the same width
///   exchange their bits, a wider bit string is filled with zeros.
///
/// SIN, COS, TAN, ASIN, ACOS, ATAN, ATAN2, EXP, LN, LOG and ** are those of the system's mathematical
/// library, which may differ in the last bit between processors; everything else is the same everywhere.
/// Setpoints do not depend on them unless a project feeds such a result to a pin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "scheduler/instruction.hpp"
#include "scheduler/text.hpp"
#include "tech_objects/data_blocks/array.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Whether values of one type can become the other explicitly (`TO_type`). TIME and numbers convert in
/// milliseconds; REAL and DWORD, LREAL and LWORD exchange their bits.
bool convertible(Type from, Type to) noexcept;

/// A compiled expression. Copies are independent. Evaluation neither allocates nor fails.
class Expression {
 public:
  /// The constant FALSE.
  Expression() : Expression(Type::BOOL, Value{}) {}
  /// A constant; the value has to be in the range of the type.
  Expression(Type type, Value value);
  /// A plain reference; the signal has to outlive the expression.
  explicit Expression(const Signal& signal);

  /// The value now. Reads the signals that it names, each where it stands in the text.
  /// Thread: the one that owns those signals (the cycle).
  Value evaluate(EvaluationCounters& counters) const noexcept;

  /// Type of the value: that of the place for which it was compiled.
  Type type() const noexcept { return type_; }
  /// Whether the value never changes and evaluating it counts nothing.
  bool constant() const noexcept { return constant_; }
  std::size_t instructions() const noexcept { return code_.size(); }
  /// Of an expression that is a whole BOOL and nothing else: that BOOL; nullptr for all others.
  const bool* flag() const noexcept;

 private:
  friend class ExpressionBuilder;
  Expression(const Signal& signal, Type type);
  using Texts = std::vector<std::shared_ptr<const TextComparison>>;
  Expression(Type type, std::vector<Instruction> code, Texts texts) noexcept
      : code_(std::move(code)), texts_(std::move(texts)), type_(type), constant_(false) {}

  std::vector<Instruction> code_;
  Texts texts_;  ///< to which instructions point
  Type type_;
  bool constant_;
};

/// Puts an expression together in postfix order while loading: operands first, then what is done with them.
/// Operations on constants alone are done at once, unless they divide by zero, which has to be counted.
class ExpressionBuilder {
 public:
  static constexpr std::size_t kMaximumValues = 64;  ///< values that may rest at the same time

  void signal(const Signal& signal);
  void constant(Value value);
  /// Replaces the last value, an index (LINT), by the element that it chooses.
  /// @param first the element with the lowest index, or a bit of it  @param range stride < 65536
  void element(const Signal& first, const ElementRange& range);
  /// Applies an operation to the last one or two values. `type` is that of the operands (of the left one for
  /// shifts, whose count is a LINT). Returns whether the operation exists for the type.
  [[nodiscard]] bool apply(Operation operation, Type type);
  /// Converts the last value; `convertible(from, to)` has to hold.
  void convert(Type from, Type to);
  /// SEL: of the last three values, the third (a BOOL) chooses the first (FALSE) or the second (TRUE).
  void select();
  /// MUX: the last value chooses among the `inputs` before it, from 0; below 0 the first is taken, above the
  /// last one.
  void multiplex(int inputs);
  /// A BOOL: whether the comparison holds.
  void compare_texts(TextComparison comparison);
  /// Adds to the count of divisions by zero at each evaluation, for those found in literals.
  void count_divisions_by_zero(int number);

  /// The finished expression. There has to be exactly one value, and `fits()`.
  Expression finish(Type type) &&;
  /// Whether no more than kMostValues rested at any time.
  bool fits() const noexcept { return fits_; }

 private:
  struct Entry {
    std::size_t start;  ///< its first instruction
    bool constant;
  };

  void push(Instruction::Step plain, Instruction::Step resting, Instruction instruction, bool is_constant);
  void unary(Instruction::Step step, std::uint64_t constant = 0);
  void combine(std::size_t inputs, Instruction instruction);
  bool apply_to_constant(Operation operation, Type type);
  bool apply_to_signal(Operation operation, Type type);
  void fold();

  std::vector<Instruction> code_;
  std::vector<Entry> values_;
  Expression::Texts texts_;
  Signal last_signal_;
  bool fits_ = true;
};

}  // namespace lockstep
