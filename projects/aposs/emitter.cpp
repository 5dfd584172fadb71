#include "projects/aposs/emitter.hpp"

#include <algorithm>
#include <set>

namespace lockstep::aposs {
namespace {

/// Which operand of an operation is a target; 3: none.
std::size_t target_of(Operation operation) noexcept {
  const OperationRow& row = row_of(operation);
  if (row.a == Operand::kTarget) return 0;
  if (row.b == Operand::kTarget) return 1;
  return row.c == Operand::kTarget ? 2 : 3;
}

}  // namespace

std::uint32_t Emitter::emit(const Place& place, Operation operation, EmittedOperand a, EmittedOperand b,
                            EmittedOperand c) {
  code_.push_back({operation, {a, b, c}, place});
  return next() - 1;
}

void Emitter::aim(std::uint32_t jump, std::uint32_t target) {
  Emitted& emitted = code_[jump];
  emitted.operands[target_of(emitted.operation)] = target;
}

void Emitter::leave(std::uint32_t jump, bool to_main) {
  if (code_[jump].operation != Operation::kJump) return;
  code_[jump].operation = Operation::kLeave;
  code_[jump].operands[1] = std::uint32_t{to_main ? 1U : 0U};
}

Cell Emitter::constant(std::int32_t value) {
  return constants({value});
}

Cell Emitter::constants(const std::vector<std::int32_t>& values) {
  const auto [known, fresh] = sequences_.try_emplace(values, static_cast<std::uint32_t>(constants_.size()));
  if (fresh) constants_.insert(constants_.end(), values.begin(), values.end());
  return {Cell::Space::kConstant, known->second};
}

Cell Emitter::variable(const std::string& folded_name, const std::string& name) {
  reserve_variable(folded_name, name);
  const std::uint32_t cell = variables_.at(folded_name);
  used_[cell] = true;
  return {Cell::Space::kVariable, cell};
}

void Emitter::reserve_variable(const std::string& folded_name, const std::string& name) {
  if (!variables_.try_emplace(folded_name, static_cast<std::uint32_t>(names_.size())).second) return;
  names_.push_back(name);
  used_.push_back(false);
}

Cell Emitter::temporary(std::uint32_t count) {
  const Cell cell{Cell::Space::kTemporary, temporaries_};
  temporaries_ += count;
  maximum_temporaries_ = std::max(maximum_temporaries_, temporaries_);
  return cell;
}

std::uint16_t Emitter::text(const std::string& text) {
  const auto known = std::find(texts_.begin(), texts_.end(), text);
  const auto number = static_cast<std::uint16_t>(known - texts_.begin());
  if (known == texts_.end()) texts_.push_back(text);
  return number;
}

std::uint16_t Emitter::print_list(PrintList list) {
  prints_.push_back(std::move(list));
  return static_cast<std::uint16_t>(prints_.size() - 1);
}

// Whether a turn from one instruction to another only reads what cannot change within a step.
bool Emitter::only_reads(std::uint32_t from, std::uint32_t to) const {
  for (std::uint32_t i = from; i < to; ++i) {
    const Emitted& at = code_[i];
    const auto temporary = [](const EmittedOperand& operand) {
      return operand.is_cell && operand.cell.space == Cell::Space::kTemporary;
    };
    bool harmless = row_of(at.operation).pure && temporary(at.operands[0]);
    if (at.operation == Operation::kLoadElement) harmless = temporary(at.operands[0]);
    if (at.operation == Operation::kCommand)
      harmless = row_of(static_cast<Command>(at.operands[0].number)).pure && temporary(at.operands[2]);
    if (at.operation == Operation::kJump || at.operation == Operation::kJumpIfZero)
      harmless = at.operands[0].number > i;
    if (!harmless) return false;
  }
  return true;
}

void Emitter::rest_where_nothing_changes() {
  for (std::uint32_t i = 0; i < next(); ++i) {
    Emitted& at = code_[i];
    const bool jump = at.operation == Operation::kJump, conditional = at.operation == Operation::kJumpIfZero;
    if ((!jump && !conditional) || at.operands[0].number > i || i - at.operands[0].number > 64) continue;
    if (only_reads(at.operands[0].number, i)) at.operation = jump ? Operation::kRest : Operation::kRestIfZero;
  }
}

std::uint32_t Emitter::place_of(const EmittedOperand& operand) const {
  if (!operand.is_cell) return operand.number;
  const auto variables = static_cast<std::uint32_t>(names_.size());
  switch (operand.cell.space) {
    case Cell::Space::kVariable:
      return operand.cell.index;
    case Cell::Space::kTemporary:
      return variables + operand.cell.index;
    case Cell::Space::kConstant:
      return variables + maximum_temporaries_ + operand.cell.index;
    case Cell::Space::kNone:
      break;
  }
  return kNoCell;
}

// The instruction with the first variable that is one too many.
Place Emitter::place_of_variable_beyond(std::size_t maximum) const {
  std::set<std::uint32_t> seen;
  for (const Emitted& at : code_)
    for (const EmittedOperand& operand : at.operands)
      if (operand.is_cell && operand.cell.space == Cell::Space::kVariable &&
          seen.insert(operand.cell.index).second && seen.size() > maximum)
        return at.place;
  return {};
}

Image Emitter::finish(Messages& messages, std::size_t arrays, std::size_t maximum_variables) {
  rest_where_nothing_changes();
  Image image;
  const auto refuse = [&messages](const std::string& what, std::size_t count, std::size_t maximum,
                                  const Place& place = {}) {
    if (count > maximum)
      messages.error(place, "the program has " + std::to_string(count) + " " + what +
                                "; allowed: " + std::to_string(maximum));
  };
  const auto used = static_cast<std::size_t>(std::count(used_.begin(), used_.end(), true));
  refuse("variables and arrays", used + arrays, maximum_variables,
         place_of_variable_beyond(maximum_variables - std::min(arrays, maximum_variables)));
  refuse("temporaries", maximum_temporaries_, kMaximumTemporaries);
  refuse("internal commands", code_.size(), Image::kMaximumInstructions,
         code_.size() > Image::kMaximumInstructions ? code_[Image::kMaximumInstructions].place : Place{});
  refuse("variables, temporaries and constants", names_.size() + maximum_temporaries_ + constants_.size(),
         Image::kMaximumCells);
  refuse("texts", texts_.size(), Image::kMaximumCells);
  for (const Emitted& at : code_) {
    const auto operand = [&](std::size_t i) { return static_cast<std::uint16_t>(place_of(at.operands[i])); };
    image.code.push_back({at.operation, operand(0), operand(1), operand(2)});
    image.places.push_back(at.place);
  }
  image.variables = std::move(names_);
  image.temporaries = static_cast<std::uint16_t>(maximum_temporaries_);
  image.constants = std::move(constants_);
  image.texts = std::move(texts_);
  image.prints = std::move(prints_);
  return image;
}

}  // namespace lockstep::aposs
