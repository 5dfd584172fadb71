#include "tech_objects/mco305_catalogue/errors.hpp"

#include <algorithm>

namespace lockstep::mco305 {
namespace {

constexpr Error kErrors[] = {
    {102, "No further CAN objects available (CANINI)", 0, 0, "CAN is not built"},
    {103, "Axis not in system", 2, 0, "a suffix of an axis is refused when a program is compiled"},
    {105, "Error not cleared", 1, 1},
    {106, "Home position not yet reached", 1, 2},
    {107, "HOME executed with velocity 0", 1, 16},
    {108, "Following error limit exceeded", 1, 3},
    {109, "Encoder index pulse not found within one revolution", 1, 4},
    {110, "Unknown command", 2, 1},
    {111, "Software end limit activated", 1, 6},
    {112, "Illegal parameter number", 2, 2},
    {113, "Drive not ready while the position controller is on", 1, 0},
    {114, "Too many nested LOOP commands", 2, 3},
    {115, "Saving of option parameters failed", 2, 15},
    {116, "Parameters in EEPROM corrupted", 1, 11},
    {117, "Programs in EEPROM corrupted", 1, 12, "programs are compiled anew at each start"},
    {118, "Watchdog reset", 1, 13, "a process has no watchdog that resets it"},
    {119, "Abort by user", 2, 7},
    {121, "Number of SDO channels exceeded", 0, 0, "CAN is not built"},
    {125, "Hardware end limit activated", 1, 5},
    {149, "Too many interrupt functions", 2, 4},
    {150, "External 24 V supply missing", 1, 7},
    {151, "Too many nested GOSUB", 2, 5},
    {152, "More RETURN than GOSUB", 2, 6},
    {154, "Digital output overloaded", 1, 8},
    {155, "LINKGPAR command failed", 2, 8},
    {156, "Floating-point function with invalid argument", 0, 0, "floating-point numbers are not built"},
    {160, "Interrupt with invalid address", 0, 0,
     "the address of a handler is checked before a program runs"},
    {162, "Verification of EEPROM failed (address given)", 1, 10},
    {170, "DIM does not match existing arrays", 2, 9},
    {171, "Array bound exceeded", 2, 10},
    {175, "No memory for a new DIM array", 0, 0},
    {176, "DIM size differs from existing array", 0, 0},
    {179, "Time-out while waiting for index", 1, 14},
    {183, "Invalid argument ", 0, 0, "what it stands for is not built"},
    {184, "Too many time interrupts", 2, 11},
    {187, "No more room for variables", 2, 12, "variables are counted when a program is compiled"},
    {188, "CAN guarding interrupted", 0, 0, "CAN is not built"},
    {189, "CAN transfer failed", 0, 0, "CAN is not built"},
    {190, "Program memory write-protected", 2, 13},
    {191, "Curve array wrong", 2, 14},
    {192, "Encoder monitoring", 1, 9},
    {193, "Stack too small", 0, 0, "the stack of a program is bounded by GOSUB and LOOP"},
    {194, "No dynamic memory for recording", 0, 0, "recording is not built"},
    {195, "More than 20 recording indices", 0, 0, "recording is not built"},
    {196, "Program compiled for older firmware", 0, 0},
    {198, "Wrong direction after a limit error was cleared", 0, 0},
    {199, "Internal fault", 1, 15, "what it stands for does not exist here"},
};

}  // namespace

std::span<const Error> errors() noexcept {
  return kErrors;
}

const Error* find_error(int number) noexcept {
  for (const Error& error : kErrors)
    if (error.number == number) return &error;
  return nullptr;
}

void PendingErrors::add(int number) noexcept {
  if (count_ < numbers_.size()) numbers_[count_++] = number;
}

void PendingErrors::clear_first() noexcept {
  if (count_ == 0) return;
  std::copy(numbers_.begin() + 1, numbers_.end(), numbers_.begin());
  --count_;
}

bool PendingErrors::has(int number) const noexcept {
  const auto end = numbers_.begin() + static_cast<std::ptrdiff_t>(count_);
  return std::find(numbers_.begin(), end, number) != end;
}

bool PendingErrors::tolerated() const noexcept {
  return std::all_of(
      numbers_.begin(), numbers_.begin() + static_cast<std::ptrdiff_t>(count_), [](int number) {
        return number == kPositionError || number == kSoftwareLimit || number == kHardwareLimit;
      });
}

bool PendingErrors::only(int number) const noexcept {
  return std::all_of(numbers_.begin(), numbers_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [number](int one) { return one == number; });
}

std::int32_t PendingErrors::alarm_word(int word) const noexcept {
  if (count_ == 0) return 0;
  std::uint32_t bits = 0;
  bool other = false;
  for (std::size_t i = 0; i < count_; ++i) {
    const Error* const error = find_error(numbers_[i]);
    if (error == nullptr || error->word == 0) continue;
    if (error->word == word) bits |= 1U << error->bit;
    other = other || error->word == 2;
  }
  if (word == 1 && other) bits |= 1U << 31;
  return static_cast<std::int32_t>(bits);
}

}  // namespace lockstep::mco305
