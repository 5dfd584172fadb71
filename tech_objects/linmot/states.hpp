/// The operating states of a LinMot controller, and what leads from one to another.
/// @source LinMot release 1.3 addendum, 1.9, 3.8, 8.6
#pragma once

#include <cstdint>

namespace lockstep::linmot {

enum class State : std::uint8_t { wait_for_disable, disable, init, run, stop, error };

/// What the transitions depend on: bits of a word, so that one comparison tells whether anything is new.
namespace fact {
inline constexpr std::uint16_t kRun = 1 << 0, kInit = 1 << 1, kStop = 1 << 2;  ///< requests
inline constexpr std::uint16_t kError = 1 << 3;                                ///< one that is pending
inline constexpr std::uint16_t kCause = 1 << 4;                                ///< of an error, still there
inline constexpr std::uint16_t kHomed = 1 << 5;                                ///< all motors
inline constexpr std::uint16_t kHomingOver = 1 << 6;  ///< nothing of INIT is left to do
inline constexpr std::uint16_t kAutomatic = 1 << 7;   ///< Auto Start, and no request so far
inline constexpr std::uint16_t kWarning = 1 << 8;
inline constexpr std::uint16_t kAnyRequest = kRun | kInit | kStop;
}  // namespace fact
using StateFacts = std::uint16_t;

/// Of power-up.
State first_state(StateFacts facts) noexcept;
/// One step: the first transition of the table that holds, or the state itself.
State next_state(State state, StateFacts facts) noexcept;

}  // namespace lockstep::linmot
