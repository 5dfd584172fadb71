#include "scheduler/aposs/image.hpp"

#include <algorithm>

#include "scheduler/aposs/interrupt_operands.hpp"

namespace lockstep::aposs {
namespace {

using O = Operand;

constexpr OperationRow binary(Operation operation, std::string_view name) {
  return {operation, name, O::kWrite, O::kRead, O::kRead, true};
}
constexpr OperationRow unary(Operation operation, std::string_view name) {
  return {operation, name, O::kWrite, O::kRead, O::kNone, true};
}
constexpr OperationRow action(Operation operation, std::string_view name, O a = O::kNone, O b = O::kNone,
                              O c = O::kNone) {
  return {operation, name, a, b, c, false};
}

constexpr OperationRow kOperations[] = {
    action(Operation::kEnd, "END"),
    unary(Operation::kMove, "MOVE"),
    binary(Operation::kAdd, "ADD"),
    binary(Operation::kSubtract, "SUB"),
    binary(Operation::kMultiply, "MUL"),
    binary(Operation::kDivide, "DIV"),
    binary(Operation::kRemainder, "MOD"),
    binary(Operation::kDivideRounded, "RND"),
    binary(Operation::kAnd, "BAND"),
    binary(Operation::kOr, "BOR"),
    binary(Operation::kExclusiveOr, "BXOR"),
    binary(Operation::kShiftLeft, "SHL"),
    binary(Operation::kShiftRight, "SHR"),
    binary(Operation::kLess, "LT"),
    binary(Operation::kGreater, "GT"),
    binary(Operation::kLessOrEqual, "LE"),
    binary(Operation::kGreaterOrEqual, "GE"),
    binary(Operation::kEqual, "EQ"),
    binary(Operation::kUnequal, "NE"),
    binary(Operation::kBothTrue, "AND"),
    binary(Operation::kEitherTrue, "OR"),
    unary(Operation::kNegate, "NEG"),
    unary(Operation::kInvert, "INV"),
    unary(Operation::kNot, "NOT"),
    unary(Operation::kAbsolute, "ABS"),
    binary(Operation::kBit, "BIT"),
    binary(Operation::kByte, "BYTE"),
    binary(Operation::kWord, "WORD"),
    action(Operation::kPutBit, "PUTBIT", O::kUpdate, O::kRead, O::kRead),
    action(Operation::kPutByte, "PUTBYTE", O::kUpdate, O::kRead, O::kRead),
    action(Operation::kPutWord, "PUTWORD", O::kUpdate, O::kRead, O::kRead),
    action(Operation::kLoadElement, "LOAD", O::kWrite, O::kArray, O::kRead),
    action(Operation::kStoreElement, "STORE", O::kArray, O::kRead, O::kRead),
    action(Operation::kJump, "JUMP", O::kTarget),
    action(Operation::kJumpIfZero, "JUMPZ", O::kTarget, O::kRead),
    action(Operation::kRest, "REST", O::kTarget),
    action(Operation::kRestIfZero, "RESTZ", O::kTarget, O::kRead),
    action(Operation::kLoop, "LOOP", O::kTarget, O::kRead),
    action(Operation::kGosub, "GOSUB", O::kTarget),
    action(Operation::kReturn, "RETURN"),
    action(Operation::kLeave, "LEAVE", O::kTarget),
    action(Operation::kExit, "EXIT"),
    {Operation::kTime, "TIME", O::kWrite, O::kNone, O::kNone, true},
    {Operation::kErrorNumber, "ERRNO", O::kWrite, O::kNone, O::kNone, true},
    action(Operation::kClearError, "ERRCLR"),
    action(Operation::kDeleteArrays, "DELARR"),
    action(Operation::kDelay, "DELAY", O::kRead),
    action(Operation::kWaitTime, "WAITT", O::kRead),
    action(Operation::kWaitInput, "WAITI", O::kRead, O::kRead),
    action(Operation::kNoWait, "NOWAIT", O::kRead),
    action(Operation::kCommand, "CALL", O::kCommand, O::kArguments, O::kResult),
    action(Operation::kPrint, "PRINT", O::kPrintList, O::kPrinted),
    action(Operation::kPrintDevice, "PRINTDEV", O::kRead),
    action(Operation::kOnError, "ONERROR", O::kTarget),
    action(Operation::kOnInput, "ONINT", O::kRead, O::kTarget),
    action(Operation::kOnPosition, "ONPOS", O::kPosition, O::kRead, O::kTarget),
    action(Operation::kOnCombit, "ONCOMBIT", O::kRead, O::kTarget),
    action(Operation::kOnStatbit, "ONSTATBIT", O::kRead, O::kTarget),
    action(Operation::kOnParameter, "ONPARAM", O::kRead, O::kTarget),
    action(Operation::kOnTime, "ONTIME", O::kRead, O::kTarget),
    action(Operation::kOnPeriod, "ONPERIOD", O::kRead, O::kTarget),
    action(Operation::kOnDelete, "ONDELETE", O::kTarget),
    action(Operation::kDisable, "DISABLE", O::kClass),
    action(Operation::kEnable, "ENABLE", O::kClass),
};

constexpr bool operations_in_order() noexcept {
  for (std::size_t i = 0; i < std::size(kOperations); ++i)
    if (static_cast<std::size_t>(kOperations[i].operation) != i) return false;
  return true;
}
static_assert(operations_in_order(), "an operation is found by its number");

/// Looks at one operand; `instruction` gives the command or list that says how many cells are taken.
bool sound(const Image& image, const Instruction& instruction, Operand kind, std::uint16_t value) noexcept {
  switch (kind) {
    case O::kNone:
      return true;
    case O::kRead:
      return value < image.cells();
    case O::kWrite:
    case O::kUpdate:
      return value < image.writable_cells();
    case O::kArray:
      return value < image.arrays.size();
    case O::kTarget:
      return value < image.code.size();
    case O::kCommand:
      return value < commands().size();
    case O::kArguments:
      return instruction.a < commands().size() &&
             value + row_of(static_cast<Command>(instruction.a)).arity() <= image.cells();
    case O::kResult:
      return value == kNoCell || value < image.writable_cells();
    case O::kPrintList:
      return value < image.prints.size();
    case O::kPrinted:
      return instruction.a < image.prints.size() &&
             value + image.prints[instruction.a].cells() <= image.cells();
    case O::kPosition:
      return value < kPositionInterrupts;
    case O::kClass:
      return value < kInterruptClasses;
  }
  return false;
}

bool sound(const Image& image, const Instruction& instruction) noexcept {
  if (static_cast<std::size_t>(instruction.operation) >= std::size(kOperations)) return false;
  const OperationRow& row = row_of(instruction.operation);
  return sound(image, instruction, row.a, instruction.a) && sound(image, instruction, row.b, instruction.b) &&
         sound(image, instruction, row.c, instruction.c);
}

/// A number that stands for a text or an array has to be that of one: of constants this is known here.
bool sound_arguments(const Image& image, const Instruction& instruction) noexcept {
  if (instruction.operation != Operation::kCommand) return true;
  const CommandRow& row = row_of(static_cast<Command>(instruction.a));
  for (std::size_t i = 0; i < row.arity(); ++i) {
    const bool text = row.arguments[i] == Argument::kText, array = row.arguments[i] == Argument::kArray;
    if (!text && !array) continue;
    const std::size_t cell = instruction.b + i;
    if (cell < image.writable_cells()) continue;  // the machine looks at it when it is there
    const auto number = static_cast<std::uint32_t>(image.constants[cell - image.writable_cells()]);
    if (number >= (text ? image.texts.size() : image.arrays.size())) return false;
  }
  return true;
}

bool goes_on(Operation operation) noexcept {
  return operation != Operation::kEnd && operation != Operation::kJump && operation != Operation::kRest &&
         operation != Operation::kReturn && operation != Operation::kLeave && operation != Operation::kExit;
}

}  // namespace

const OperationRow& row_of(Operation operation) noexcept {
  return kOperations[static_cast<std::size_t>(operation)];
}

std::size_t operation_count() noexcept {
  return std::size(kOperations);
}

std::size_t PrintList::cells() const noexcept {
  return static_cast<std::size_t>(std::count_if(
      items.begin(), items.end(), [](const PrintItem& item) { return item.kind != PrintItem::Kind::kText; }));
}

int Image::fault() const noexcept {
  if (version != kVersion) return 196;
  constexpr int kUnknown = 110;
  if (code.empty() || code.size() > kMaximumInstructions || cells() > kMaximumCells) return kUnknown;
  if (places.size() != code.size() || goes_on(code.back().operation)) return kUnknown;
  for (const Instruction& instruction : code)
    if (!sound(*this, instruction) || !sound_arguments(*this, instruction)) return kUnknown;
  for (const PrintList& list : prints)
    for (const PrintItem& item : list.items)
      if (item.kind == PrintItem::Kind::kText && item.text >= texts.size()) return kUnknown;
  return 0;
}

}  // namespace lockstep::aposs
