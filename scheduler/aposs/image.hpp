/// A compiled APOSS program: flat, typed, checked once before it runs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scheduler/aposs/commands.hpp"

namespace lockstep::aposs {

/// One instruction is one internal command: between two of them an interrupt may come.
enum class Operation : std::uint16_t {
  kEnd,
  kMove,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kRemainder,
  kDivideRounded,
  kAnd,
  kOr,
  kExclusiveOr,
  kShiftLeft,
  kShiftRight,
  kLess,
  kGreater,
  kLessOrEqual,
  kGreaterOrEqual,
  kEqual,
  kUnequal,
  kBothTrue,
  kEitherTrue,
  kNegate,
  kInvert,
  kNot,
  kAbsolute,
  kBit,
  kByte,
  kWord,
  kPutBit,
  kPutByte,
  kPutWord,
  kLoadElement,
  kStoreElement,
  kJump,
  kJumpIfZero,
  kRest,  ///< a jump back over pure reads: nothing changes before the next step
  kRestIfZero,
  kLoop,
  kGosub,
  kReturn,
  kLeave,  ///< a GOTO out of a subprogram, whose call is forgotten; `b` not 0: all calls are
  kExit,
  kTime,
  kErrorNumber,
  kClearError,
  kDeleteArrays,
  kDelay,
  kWaitTime,
  kWaitInput,
  kNoWait,
  kCommand,
  kPrint,
  kPrintDevice,
  kOnError,
  kOnInput,
  kOnPosition,
  kOnCombit,
  kOnStatbit,
  kOnParameter,
  kOnTime,
  kOnPeriod,
  kOnDelete,
  kDisable,
  kEnable
};

/// What an operand of an instruction is.
enum class Operand : std::uint8_t {
  kNone,
  kRead,       ///< a cell
  kWrite,      ///< a cell that is no constant
  kUpdate,     ///< a cell that is no constant, read before it is written
  kArray,      ///< an array by its number
  kTarget,     ///< an instruction to go on with
  kCommand,    ///< of the table of commands
  kArguments,  ///< the first of the cells that the command takes
  kResult,     ///< kWrite, or kNoCell for a command without a value
  kPrintList,  ///< of the image
  kPrinted,    ///< the first of the cells that the list takes
  kPosition,   ///< `PositionInterrupt`
  kClass,      ///< `InterruptClass`
};

struct OperationRow {
  Operation operation;
  std::string_view name;
  Operand a, b, c;
  bool pure;  ///< changes nothing but its cell
};
const OperationRow& row_of(Operation operation) noexcept;
std::size_t operation_count() noexcept;

struct Instruction {
  Operation operation = Operation::kEnd;
  std::uint16_t a = 0, b = 0, c = 0;
};

inline constexpr std::uint16_t kNoCell = 0xffff;

/// Where something stands in the text.
struct Place {
  std::uint16_t file = 0;
  std::uint32_t line = 0;  ///< from 1; 0: nowhere
  std::uint32_t column = 0;
};

struct ArrayDeclaration {
  std::string name;
  std::uint32_t size = 0;
};

struct Routine {
  std::string name;
  std::uint16_t entry = 0;
};

/// One item of a PRINT: a text of the image, or the next cell as number or character.
struct PrintItem {
  enum class Kind : std::uint8_t { kText, kNumber, kCharacter };
  Kind kind = Kind::kText;
  std::uint16_t text = 0;
};

struct PrintList {
  std::vector<PrintItem> items;
  bool ends_line = true;
  std::size_t cells() const noexcept;
};

/// Cells: variables, then temporaries, then constants.
struct Image {
  static constexpr std::uint16_t kVersion = 1;
  static constexpr std::size_t kMaximumInstructions = 60'000;
  static constexpr std::size_t kMaximumCells = 60'000;

  std::uint16_t version = kVersion;
  std::vector<Instruction> code;
  std::vector<Place> places;  ///< of each instruction
  std::vector<std::string> variables;
  std::uint16_t temporaries = 0;
  std::vector<std::int32_t> constants;
  std::vector<ArrayDeclaration> arrays;
  std::vector<std::string> texts;
  std::vector<PrintList> prints;
  std::vector<Routine> routines;
  std::vector<std::string> files;

  std::size_t cells() const noexcept { return variables.size() + temporaries + constants.size(); }
  std::size_t writable_cells() const noexcept { return variables.size() + temporaries; }

  /// 0; or the published error: 196 for another version, 110 for what no compiler writes. A program that
  /// passes here never leaves its memory, whatever it computes.
  int fault() const noexcept;
};

}  // namespace lockstep::aposs
