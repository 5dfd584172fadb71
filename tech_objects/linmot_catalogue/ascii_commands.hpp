/// The commands of the ASCII protocol.
/// @source LinMot release 1.3 addendum, 8.3 to 8.5
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::linmot {

/// What stands behind the two letters of a command.
enum class AsciiForm : std::uint8_t {
  drive,            ///< letter of a motor
  controller,       ///< digit of a controller
  number_drive,     ///< number, letter of a motor
  sign_controller,  ///< + or -, digit of a controller
  sign_any          ///< + or -, digit of a controller or letter of a motor
};

struct AsciiCommand {
  static constexpr std::uint8_t kReads = 1;    ///< answers with a value
  static constexpr std::uint8_t kInRun = 2;    ///< in RUN only
  static constexpr std::uint8_t kMotion = 4;   ///< of a motor in run mode Serial, that runs no cyclic curve
  static constexpr std::uint8_t kArms = 8;     ///< counts from the next rising edge of the trigger on
  static constexpr std::uint8_t kSigned = 16;  ///< its number may be negative

  std::string_view name;  ///< two letters
  AsciiForm form;
  std::int32_t lowest, highest;  ///< of its number
  std::uint8_t flags;
  std::string_view title, text;

  bool is(std::uint8_t flag) const noexcept { return (flags & flag) != 0; }
};

/// By name.
std::span<const AsciiCommand> ascii_commands() noexcept;
/// nullptr: there is none. Lower case is none.
const AsciiCommand* find_ascii_command(std::string_view name) noexcept;

}  // namespace lockstep::linmot
