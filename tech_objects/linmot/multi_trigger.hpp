/// The state table of the multi-trigger controller, and the code that calls its rows.
/// @source LinMot release 1.3 addendum, 2.2 to 2.5, 6.8
#pragma once

#include <array>
#include <cstdint>

#include "tech_objects/linmot_catalogue/mt_commands.hpp"
#include "tech_objects/linmot_catalogue/parameters.hpp"

namespace lockstep::linmot {

/// What one motor does in a row.
struct Cell {
  MtCommand command = MtCommand::no_operation;
  std::array<double, 3> arguments{};  ///< in the printed units
};

struct StateRow {
  bool exists = false;
  std::array<Cell, kMotors> cells{};
};

struct CodeEntry {
  InputCommand command = InputCommand::no_operation;
  int row = 0;  ///< of `go_to`
};

struct StateTable {
  std::array<StateRow, kStates> rows{};
  std::array<CodeEntry, kCodes> codes{};
  std::uint8_t active = 0;    ///< inputs that count, A is bit 0
  std::uint8_t triggers = 0;  ///< inputs whose change calls
};

/// A code counts once it has been the same for a time.
class CodeFilter {
 public:
  /// Takes a code as it is. @param code that there is
  void begin(std::uint8_t code) noexcept {
    raw_ = stable_ = code;
    ticks_ = 0;
  }
  /// Once in a tick. @param ticks for which a code has to stay  @return whether another code counts now
  bool step(std::uint8_t code, int ticks) noexcept {
    if (code != raw_) {
      raw_ = code;
      ticks_ = 0;
    } else if (ticks_ < ticks) {
      ++ticks_;
    }
    if (ticks_ < ticks || raw_ == stable_) return false;
    before_ = stable_;
    stable_ = raw_;
    return true;
  }
  std::uint8_t code() const noexcept { return stable_; }
  std::uint8_t before() const noexcept { return before_; }

 private:
  std::uint8_t raw_ = 0, stable_ = 0, before_ = 0;
  int ticks_ = 0;
};

}  // namespace lockstep::linmot
