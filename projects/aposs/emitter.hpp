/// Puts instructions together: cells, constants, temporaries, jumps to what is not there yet.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "projects/aposs/message.hpp"
#include "scheduler/aposs/image.hpp"

namespace lockstep::aposs {

/// A cell before it is known where variables end and temporaries begin.
struct Cell {
  enum class Space : std::uint8_t { kVariable, kTemporary, kConstant, kNone };
  Space space = Space::kNone;
  std::uint32_t index = 0;
  Cell behind(std::uint32_t count) const noexcept { return {space, index + count}; }
};

/// An operand: a cell, or a number that stands for something else.
struct EmittedOperand {
  EmittedOperand() = default;
  EmittedOperand(Cell value) noexcept : cell(value) {}
  EmittedOperand(std::uint32_t value) noexcept : is_cell(false), number(value) {}
  bool is_cell = true;
  Cell cell{};
  std::uint32_t number = 0;
};

class Emitter {
 public:
  static constexpr std::uint32_t kMaximumTemporaries = 256;

  /// @return the number of the instruction
  std::uint32_t emit(const Place& place, Operation operation, EmittedOperand a = std::uint32_t{0},
                     EmittedOperand b = std::uint32_t{0}, EmittedOperand c = std::uint32_t{0});
  std::uint32_t next() const noexcept { return static_cast<std::uint32_t>(code_.size()); }
  /// Lets a jump go to where the next instruction will stand.
  void land(std::uint32_t jump) { aim(jump, next()); }
  void aim(std::uint32_t jump, std::uint32_t target);
  /// Makes a GOTO one out of a subprogram: into another one, or into the main program.
  void leave(std::uint32_t jump, bool to_main);

  Cell constant(std::int32_t value);
  /// Constants one behind the other.
  Cell constants(const std::vector<std::int32_t>& values);
  Cell variable(const std::string& folded_name, const std::string& name);
  /// The next cell is that of a variable, whether the program has it or not.
  void reserve_variable(const std::string& folded_name, const std::string& name);
  /// Temporaries live until `release` with what `mark` said.
  Cell temporary(std::uint32_t count = 1);
  std::uint32_t mark() const noexcept { return temporaries_; }
  void release(std::uint32_t mark) noexcept { temporaries_ = mark; }

  std::uint16_t text(const std::string& text);
  std::uint16_t print_list(PrintList list);

  /// Moves everything to its place. What is too much is told.
  /// @param arrays each counts as a variable
  Image finish(Messages& messages, std::size_t arrays, std::size_t maximum_variables);

 private:
  struct Emitted {
    Operation operation;
    EmittedOperand operands[3];
    Place place;
  };
  void rest_where_nothing_changes();
  bool only_reads(std::uint32_t from, std::uint32_t to) const;
  std::uint32_t place_of(const EmittedOperand& operand) const;
  Place place_of_variable_beyond(std::size_t maximum) const;

  std::vector<Emitted> code_;
  std::map<std::string, std::uint32_t> variables_;
  std::vector<std::string> names_;
  std::vector<bool> used_;  // of these
  std::uint32_t temporaries_ = 0, maximum_temporaries_ = 0;
  std::vector<std::int32_t> constants_;
  std::map<std::vector<std::int32_t>, std::uint32_t> sequences_;
  std::vector<std::string> texts_;
  std::vector<PrintList> prints_;
};

}  // namespace lockstep::aposs
