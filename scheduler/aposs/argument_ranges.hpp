/// What the arguments of commands may be, declared once beside the commands, and what a run does with others:
/// the compiler tells of constants that are none of these.
/// @source MCO 305 Design Guide, command reference; error messages
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

#include "scheduler/aposs/commands.hpp"

namespace lockstep::aposs {

/// From a value to a value, both allowed.
struct ValueSpan {
  std::int32_t lowest, highest;
};
inline constexpr std::int32_t kNoLowest = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int32_t kNoHighest = std::numeric_limits<std::int32_t>::max();

/// How the allowed values are known.
enum class Allowed : std::uint8_t {
  kSpans,           ///< by `spans`
  kEitherSign,      ///< by `spans` too, of the value without its sign: below 0 is the falling edge
  kBits,            ///< the bits of the one span's highest, in any sum
  kUpToNext,        ///< up to what the next argument is
  kWithinArray,     ///< by `spans`, and up to the size of the array that is the next argument
  kSystemVariable,  ///< the index of one that can be read
  kParameter,       ///< one of the option
  kWritten,         ///< one of the option that is not read only
  kValueOfWritten,  ///< what the parameter before it can be
  kPublishedValue,  ///< what the documents give the parameter before it
  kDrive,           ///< a parameter of the simulated drive
  kIndexedDrive,    ///< one of its parameters that has indices: there is none
  kWrittenDrive,    ///< a parameter of the simulated drive that SETVLT changes
  kValueOfDrive,    ///< what the parameter before it can be
  kPidValue,        ///< what the coefficient before it can be
};

struct ArgumentRange {
  Command command;
  std::size_t argument;   ///< from 0; of ON …: what is watched
  std::string_view name;  ///< of the argument
  Allowed allowed;
  std::span<const ValueSpan> spans;
  int error;                 ///< that a run has with any other value; 0: none
  std::string_view outside;  ///< what a run does with it without an error
  bool problem = false;      ///< nothing in a run could tell of it: the program is refused
};

/// In the order of the commands' reference; of one argument the first that is left counts.
std::span<const ArgumentRange> argument_ranges() noexcept;

}  // namespace lockstep::aposs
