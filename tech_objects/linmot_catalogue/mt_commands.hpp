/// The commands of the state table and of its inputs.
/// @source LinMot release 1.3 addendum, 1.8, 2.3, 2.4
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::linmot {

enum class MtCommand : std::uint8_t {
  no_operation,
  absolute_position,
  absolute_from_actual,
  relative_position,
  absolute_current,
  relative_current,
  curve,
  curve_from_demand,
  start_cam,
  start_cam_from_demand,
  recipe,
  move_home_position,
  redefine_position,
  demand_to_actual,
  stop,
  freeze,
  unfreeze,
  set_current,
  set_current_offset,
  set_feed_forward,
  set_pid,
  set_curve_parameters
};

/// For whom a command is there, and whether it is built.
enum class MtScope : std::uint8_t { linear_motor, magnet_only, later };

struct MtArgument {
  std::string_view name, unit;
};

struct MtRow {
  MtCommand command;
  std::string_view name;
  MtScope scope;
  std::array<MtArgument, 3> arguments;
  std::string_view text;

  std::size_t arity() const noexcept {
    std::size_t count = 0;
    while (count < arguments.size() && !arguments[count].name.empty()) ++count;
    return count;
  }
};

std::span<const MtRow> mt_commands() noexcept;
/// Without regard to case; nullptr: there is none.
const MtRow* find_mt_command(std::string_view name) noexcept;

/// What a code of the inputs does.
enum class InputCommand : std::uint8_t { no_operation, next, previous, repeat, go_to };
struct InputRow {
  InputCommand command;
  std::string_view name, text;
};
std::span<const InputRow> input_commands() noexcept;

inline constexpr int kStates = 64;  ///< rows of the state table
inline constexpr int kCodes = 16;   ///< of four inputs

}  // namespace lockstep::linmot
