#include "scheduler/program.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep {

Program::Program(std::string name, Ob ob, std::int64_t cycle, int priority)
    : name_(std::move(name)), ob_(ob), cycle_(cycle), priority_(priority) {}

const Expression* Program::keep(Expression expression) {
  return &expressions_.emplace_back(std::move(expression));
}

void Program::add_assignment(Expression expression, Signal place) {
  const bool whole_flag = place.type == Type::BOOL && place.bit < 0;
  if (!whole_flag) {
    instructions_.emplace_back(Op::assign, keep(std::move(expression))).place =
        &places_.emplace_back(Operand{place, nullptr});
    return;
  }
  const bool* const source = expression.flag();
  Instruction& instruction = instructions_.emplace_back(source != nullptr ? Op::copy_flag : Op::assign_flag);
  instruction.flag = static_cast<bool*>(place.address);
  if (source != nullptr)
    instruction.source = source;
  else
    instruction.expression = keep(std::move(expression));
}

void Program::add_assignment(Expression expression, Signal place, const Variable& variable) {
  instructions_.emplace_back(Op::assign_variable, keep(std::move(expression))).place =
      &places_.emplace_back(Operand{place, &variable});
}

void Program::add_assignment(Expression expression, Signal first, const Variable* variable, Expression index,
                             const ElementRange& range) {
  instructions_.emplace_back(Op::assign_element, keep(std::move(expression))).place =
      &places_.emplace_back(Operand{first, variable, keep(std::move(index)), range});
}

void Program::add_assignment(const TextSource& from, Text to) {
  instructions_.emplace_back(Op::assign_text).text = &texts_.emplace_back(TextAssignment{from, to});
}

void Program::add_call(Block& block) {
  const bool jumped_to = instructions_.empty() || last_target_ == instructions_.size();
  const Op before = jumped_to ? Op::call : instructions_.back().op;
  if (before == Op::copy_flag)
    instructions_.back().op = Op::copy_flag_and_call;
  else if (before == Op::assign_flag)
    instructions_.back().op = Op::assign_flag_and_call;
  else
    instructions_.emplace_back(Op::call);
  instructions_.back().block = &block;
}

std::size_t Program::begin_branch(Expression condition) {
  instructions_.emplace_back(Op::jump_unless, keep(std::move(condition)));
  return instructions_.size() - 1;
}

std::size_t Program::begin_alternative(std::size_t mark) {
  instructions_.emplace_back(Op::jump);
  end_branch(mark);
  return instructions_.size() - 1;
}

void Program::end_branch(std::size_t mark) {
  last_target_ = instructions_.size();
  instructions_[mark].target = static_cast<std::uint32_t>(last_target_);
}

void Program::run(std::int64_t now, EvaluationCounters& counters) const noexcept {
  const Instruction* const first = instructions_.data();
  const Instruction* const end = first + instructions_.size();
  for (const Instruction* at = first; at != end; ++at) {
    const Instruction& instruction = *at;
    // The three commonest come before the others, which are told apart by a table.
    if (instruction.op == Op::call) {
      instruction.block->call(now);
      continue;
    }
    if (instruction.op == Op::copy_flag_and_call) {
      *instruction.flag = *instruction.source;
      instruction.block->call(now);
      continue;
    }
    if (instruction.op == Op::assign_flag_and_call) {
      *instruction.flag = instruction.expression->evaluate(counters).u != 0;
      instruction.block->call(now);
      continue;
    }
    switch (instruction.op) {
      case Op::call:
      case Op::copy_flag_and_call:
      case Op::assign_flag_and_call:
        break;
      case Op::copy_flag:
        *instruction.flag = *instruction.source;
        break;
      case Op::assign_flag:
        *instruction.flag = instruction.expression->evaluate(counters).u != 0;
        break;
      case Op::assign:
        instruction.place->signal.store(instruction.expression->evaluate(counters));
        break;
      case Op::assign_variable:
        assign_variable(*instruction.place, instruction.expression->evaluate(counters));
        break;
      case Op::assign_element:
        assign_element(*instruction.place, instruction.expression->evaluate(counters), counters);
        break;
      case Op::assign_text:
        instruction.text->to.assign(instruction.text->from.view(counters));
        break;
      case Op::jump:
        at = first + instruction.target - 1;
        break;
      case Op::jump_unless:
        if (instruction.expression->evaluate(counters).u == 0) at = first + instruction.target - 1;
        break;
    }
  }
}

void Program::assign_element(const Operand& place, Value value, EvaluationCounters& counters) const noexcept {
  const std::uint64_t distance = place.range.offset_of(place.index->evaluate(counters).i);
  if (distance == ElementRange::kOutside) {
    ++counters.indices_out_of_range;
    return;
  }
  Operand chosen = place;
  chosen.signal.address = static_cast<char*>(place.signal.address) + distance;
  if (place.variable == nullptr)
    chosen.signal.store(value);
  else
    assign_variable(chosen, value);
}

void Program::assign_variable(const Operand& place, Value value) const noexcept {
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
