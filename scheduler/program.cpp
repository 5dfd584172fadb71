#include "scheduler/program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep {

Program::Program(std::string name, Ob ob, std::int64_t cycle, int priority)
    : name_(std::move(name)), ob_(ob), cycle_(cycle), priority_(priority) {}

std::uint32_t Program::keep(Expression expression) {
  expressions_.push_back(std::move(expression));
  return static_cast<std::uint32_t>(expressions_.size() - 1);
}

void Program::add_assignment(Expression expression, Signal place) {
  places_.push_back({place, nullptr});
  instructions_.push_back(
      {Op::assign, static_cast<std::uint32_t>(places_.size() - 1), keep(std::move(expression))});
}

void Program::add_assignment(Expression expression, Signal place, const Variable& variable) {
  places_.push_back({place, &variable});
  instructions_.push_back(
      {Op::assign_variable, static_cast<std::uint32_t>(places_.size() - 1), keep(std::move(expression))});
}

void Program::add_call(Block& block) {
  blocks_.push_back(&block);
  instructions_.push_back({Op::call, static_cast<std::uint32_t>(blocks_.size() - 1), 0});
}

std::size_t Program::begin_branch(Expression condition) {
  instructions_.push_back({Op::jump_unless, 0, keep(std::move(condition))});
  return instructions_.size() - 1;
}

std::size_t Program::begin_alternative(std::size_t mark) {
  instructions_.push_back({Op::jump, 0, 0});
  end_branch(mark);
  return instructions_.size() - 1;
}

void Program::end_branch(std::size_t mark) {
  instructions_[mark].operand = static_cast<std::uint32_t>(instructions_.size());
}

void Program::run(std::int64_t now, EvaluationCounters& counters) const noexcept {
  for (std::size_t i = 0; i < instructions_.size();) {
    const Instruction& instruction = instructions_[i++];
    switch (instruction.op) {
      case Op::assign:
        places_[instruction.operand].signal.store(expressions_[instruction.expression].evaluate(counters));
        break;
      case Op::assign_variable:
        assign_variable(places_[instruction.operand],
                        expressions_[instruction.expression].evaluate(counters));
        break;
      case Op::call:
        blocks_[instruction.operand]->call(now);
        break;
      case Op::jump:
        i = instruction.operand;
        break;
      case Op::jump_unless:
        if (expressions_[instruction.expression].evaluate(counters).u == 0) i = instruction.operand;
        break;
    }
  }
}

void Program::assign_variable(const Place& place, Value value) const noexcept {
  const Variable& variable = *place.variable;
  if (place.signal.bit < 0) {
    const double number = as_double(value, variable.type);
    if (is_real(variable.type) && std::isfinite(number)) {
      value.r = std::clamp(number, variable.range.lowest, variable.range.highest);
    } else if (!variable.range.allows(number)) {
      ++refused_;
      return;
    }
  }
  place.signal.store(value);
}

}  // namespace lockstep
