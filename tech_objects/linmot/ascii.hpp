/// Commands of the ASCII protocol: what is written in them, what is done, what is answered.
/// @source LinMot release 1.3 addendum, 8
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "tech_objects/linmot_catalogue/ascii_commands.hpp"

namespace lockstep::linmot {

/// A command as it has been read.
struct AsciiRequest {
  const AsciiCommand* command = nullptr;  ///< nullptr: `error` says why
  int error = 0;                          ///< 58 to 60, 65
  bool on = false;                        ///< its sign
  std::int64_t number = 0;
  char target = 0;  ///< 'A' to 'X', '1' to '6'
};

/// What it is answered with.
struct AsciiAnswer {
  enum class Kind : std::uint8_t { done, error, number, status };
  Kind kind = Kind::done;
  std::int32_t number = 0;  ///< a value; the code of an error; of a status that of the error
  char letter = 0;          ///< of a status
  char motor = 0;           ///< of a status: whose error it is; 0: the controller's
};

/// Reads a command without its end. Any thread.
AsciiRequest read_ascii(std::string_view text) noexcept;
/// "#" and what there is to say, without its end. Not in the cycle.
std::string ascii_text(const AsciiAnswer& answer);
/// How many characters that has. Any thread.
std::size_t ascii_length(const AsciiAnswer& answer) noexcept;

}  // namespace lockstep::linmot
