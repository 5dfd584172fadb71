/// What an APOSS program asks of the device that it runs in.
#pragma once

#include <cstdint>

#include "scheduler/aposs/commands.hpp"
#include "scheduler/aposs/frame.hpp"

namespace lockstep::aposs {

/// What the device says to a command.
struct Reply {
  enum class Kind : std::uint8_t {
    kDone,     ///< `value` is that of a function
    kBusy,     ///< begun; whether the program waits for it is a matter of the command and of NOWAIT
    kFailed,   ///< `error` is raised, the next command follows
    kRefused,  ///< the device cannot do this at all: the program ends, and says so
  };
  Kind kind = Kind::kDone;
  std::int32_t value = 0;
  int error = 0;  ///< a published number

  static constexpr Reply done(std::int32_t value = 0) noexcept { return {Kind::kDone, value, 0}; }
  static constexpr Reply busy() noexcept { return {Kind::kBusy, 0, 0}; }
  static constexpr Reply failed(int error) noexcept { return {Kind::kFailed, 0, error}; }
  static constexpr Reply refused() noexcept { return {Kind::kRefused, 0, 0}; }
};

/// Bits whose edges are interrupts.
enum class EdgeSource : std::uint8_t { kInput, kCombit, kStatbit };
/// Positions that are passed.
enum class PositionSource : std::uint8_t { kApos, kMapos, kMcpos };

/// A position, and after what distance it begins again.
struct PositionReading {
  std::int32_t value = 0;
  std::int64_t period = std::int64_t{1} << 31;
};

/// Thread: that of the cycle. Nothing here may allocate, lock or throw. What is read does not change within a
/// step.
class Device {
 public:
  virtual ~Device() = default;

  /// Since power-on [ms].
  virtual std::int64_t milliseconds() noexcept = 0;

  /// Begins a command. `arguments` has those of its row in the table of commands.
  virtual Reply begin(Command command, const std::int32_t* arguments, Arrays& arrays) noexcept = 0;
  /// Asks once a step for the end of a command that the program waits for; `elapsed` since it began [ms].
  virtual Reply proceed(Command command, const std::int32_t* arguments, std::int64_t elapsed) noexcept = 0;
  /// An interrupt ends HOME or INDEX.
  virtual void give_up(Command command) noexcept = 0;

  /// An input, a bit of the process data or of the status; `number` from 1. False if there is none.
  virtual bool level(EdgeSource source, std::int32_t number) noexcept = 0;
  virtual PositionReading position(PositionSource source) noexcept = 0;
  /// How often a parameter has been changed from outside.
  virtual std::uint32_t changes(std::int32_t parameter) noexcept = 0;

  /// An error that has come up since the last step; 0: none.
  virtual int take_error() noexcept = 0;
  /// The program has an error: the reaction of ERRCOND is the device's.
  virtual void error_raised(int error) noexcept = 0;
  /// ERRCLR, which is MOTOR ON as well.
  virtual void error_cleared() noexcept = 0;
};

}  // namespace lockstep::aposs
