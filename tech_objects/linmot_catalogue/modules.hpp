/// The data modules of PROFIBUS.
/// @source LinMot release 1.3 addendum, 3.7, 3.8
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace lockstep::linmot {

enum class Module : std::uint8_t {
  command,
  control_status,
  get_position,
  get_current,
  max_acceleration,
  max_speed,
  max_current,
  next_drive,
  run_curve,
  run_incremental_curve,
  set_position,
  set_curve_speed,
  set_curve_amplitude,
  set_curve_offset
};

struct ModuleRow {
  Module module;
  std::string_view name;
  int out_words, in_words;
  std::int32_t lowest, highest;  ///< of its word; both 0: any
  std::string_view unit, text;
};
std::span<const ModuleRow> modules() noexcept;
/// Without regard to case; nullptr: there is none.
const ModuleRow* find_module(std::string_view name) noexcept;

/// Of the module Command.
struct ModuleCommand {
  std::uint8_t id;
  std::string_view name;
  std::int32_t lowest, highest;  ///< of its value; both 0: none is looked at
  std::string_view unit;
};
std::span<const ModuleCommand> module_commands() noexcept;

}  // namespace lockstep::linmot
