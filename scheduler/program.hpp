/// Programs: compiled sequences of block calls, assignments and branches, walked by the cycle.
/// @source contract of the project file, sections 1 and 2
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "fb/block.hpp"
#include "scheduler/expression.hpp"
#include "scheduler/text.hpp"
#include "tech_objects/data_blocks/variable.hpp"

namespace lockstep {

/// Organization block in which a program runs.
/// @source S7-1500T: OB1, OB30…, OB67, OB95, OB68
enum class Ob : std::uint8_t { MC_PreServo, MC_PostServo, MC_PreInterpolator, Cyclic, Main };

/// One program. Built at load time by the add functions, in the order in which it is written; then only
/// `run`.
class Program {
 public:
  Program(std::string name, Ob ob, std::int64_t cycle, int priority);
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  const std::string& name() const noexcept { return name_; }
  Ob ob() const noexcept { return ob_; }
  /// Period of a Cyclic or Main program [ns], a whole multiple of the servo cycle.
  std::int64_t cycle() const noexcept { return cycle_; }
  /// Priority of a Cyclic program; the higher runs first.
  int priority() const noexcept { return priority_; }

  /// Assigns the value of an expression of the place's type to a tag or a pin.
  void add_assignment(Expression expression, Signal place);
  /// Assigns to a variable of a technology object: an LREAL out of its range is brought to its limit, any
  /// other value that is not permitted is refused and counted, and the variable keeps what it had.
  void add_assignment(Expression expression, Signal place, const Variable& variable);
  /// Assigns to the element that an index (LINT) chooses when the assignment runs; `first` is the one with
  /// the lowest index. An index out of range is counted and nothing is assigned.
  /// @param variable of a technology object of which `first` is an element; nullptr: an array tag
  void add_assignment(Expression expression, Signal first, const Variable* variable, Expression index,
                      const ElementRange& range);
  /// Assigns a text to a tag.
  void add_assignment(const TextSource& from, Text to);
  void add_call(Block& block);
  /// Begins what runs only if the BOOL expression is TRUE; returns a mark for `end_branch`.
  std::size_t begin_branch(Expression condition);
  /// Ends the part behind a condition and begins its alternative; returns the mark of that.
  std::size_t begin_alternative(std::size_t mark);
  void end_branch(std::size_t mark);

  /// One run, in the thread of the cycle. @param now time of the tick [ns]
  void run(std::int64_t now, EvaluationCounters& counters) const noexcept;

  /// Assignments to variables that were refused since the start.
  std::uint64_t refused_assignments() const noexcept { return refused_; }

 private:
  enum class Op : std::uint8_t {
    call,
    copy_flag,
    copy_flag_and_call,    // the commonest pair: a pin that is wired to a BOOL, and the call of its block
    assign_flag_and_call,  // a pin that gets an expression, and the call
    assign_flag,
    assign,
    assign_variable,
    assign_element,
    assign_text,
    jump,
    jump_unless
  };
  struct Operand {
    Signal signal;
    const Variable* variable = nullptr;
    const Expression* index = nullptr;  // of an element
    ElementRange range{};
  };
  struct TextAssignment {
    TextSource from;
    Text to;
  };
  /// One step; which members count is known from `op`.
  struct Instruction {
    explicit Instruction(Op what, const Expression* value = nullptr) : op(what), expression(value) {}

    Op op;
    std::uint32_t target = 0;  // of a jump
    union {
      const Expression* expression;
      const bool* source;  // of a flag that is copied
    };
    union {
      bool* flag = nullptr;  // a whole BOOL, as most pins with an expression are
      const Operand* place;
      const TextAssignment* text;
    };
    Block* block = nullptr;
  };

  const Expression* keep(Expression expression);
  void assign_variable(const Operand& place, Value value) const noexcept;
  void assign_element(const Operand& place, Value value, EvaluationCounters& counters) const noexcept;

  std::string name_;
  Ob ob_;
  std::int64_t cycle_;
  int priority_;
  std::vector<Instruction> instructions_;
  std::size_t last_target_ = 0;         // of the jumps so far
  std::deque<Expression> expressions_;  // where they are they stay: instructions point at them
  std::deque<Operand> places_;
  std::deque<TextAssignment> texts_;
  mutable std::uint64_t refused_ = 0;
};

}  // namespace lockstep
