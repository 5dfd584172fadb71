#include "tech_objects/linmot_catalogue/modules.hpp"

#include "tech_objects/linmot_catalogue/spelling.hpp"

namespace lockstep::linmot {
namespace {

constexpr ModuleRow module_row(Module module, std::string_view name, int out_words, int in_words,
                               std::int32_t lowest, std::int32_t highest, std::string_view unit,
                               std::string_view text) {
  return {module, name, out_words, in_words, lowest, highest, unit, text};
}

constexpr ModuleRow kModules[] = {
    module_row(
        Module::command, "Command", 2, 0, 0, 0, "",
        "command for the motors of bits 12 to 15 whenever bit 11 changes; the second word is its value"),
    module_row(Module::control_status, "Control/Status", 1, 1, 0, 0, "",
               "requests out, states in; the first module of all"),
    module_row(Module::get_position, "Get Position", 0, 1, -32256, 32256, "19.53125 um",
               "actual position; 16#7FFF while there is none"),
    module_row(Module::get_current, "Get Current", 0, 1, -256, 256, "23.438 mA",
               "current that the position loop asks for"),
    module_row(Module::max_acceleration, "Max. Acceleration", 1, 0, 1, 1536, "238.419 mm/s^2",
               "of the V/A limiter"),
    module_row(Module::max_speed, "Max. Speed", 1, 0, 1, 24576, "190.735 um/s", "of the V/A limiter"),
    module_row(Module::max_current, "Max. Current", 1, 0, 0, 255, "23.438 mA", "maximal current"),
    module_row(Module::next_drive, "Next Drive", 0, 0, 0, 0, "",
               "the next modules are those of the next motor"),
    module_row(
        Module::run_curve, "Run Curve", 1, 0, 0, 0, "",
        "curve of bits 0 to 5 whenever bit 15 changes; bit 14 cyclic, 13 behind the one that runs, 12 from "
        "the "
        "demand"),
    module_row(Module::run_incremental_curve, "Run Incr. Curve", 1, 0, 0, 0, "",
               "the same from the demand; older configurations have it"),
    module_row(Module::set_position, "Set Position", 1, 0, -32256, 32256, "19.53125 um",
               "demand, through the V/A limiter; a curve locks it"),
    module_row(Module::set_curve_speed, "Set Curve Speed", 1, 0, 0, 4096, "1/4096", "rate of curves"),
    module_row(Module::set_curve_amplitude, "Set Curve Amplitude", 1, 0, 0, 4096, "1/4096",
               "amplitude of curves"),
    module_row(Module::set_curve_offset, "Set Curve Offset", 1, 0, -32256, 32256, "19.53125 um",
               "offset of curves"),
};

constexpr ModuleCommand kModuleCommands[] = {
    {0x00, "No Command", 0, 0, ""},
    {0x01, "Redefine Position", -32256, 32256, "19.53125 um"},
    {0x02, "Move Home Position", -32256, 32256, "19.53125 um"},
    {0x03, "Unlock Set Position", 0, 0, ""},
    {0x04, "Set Demand Position to Actual Position", 0, 0, ""},
    {0x10, "Set P", 0, 32640, "2.34 mA/mm"},
    {0x11, "Set I", 0, 32640, "45.7 mA/(mm s)"},
    {0x12, "Set D", 0, 32640, "0.015 A/(m/s)"},
    {0x13, "Set FF Friction", 0, 255, "23.4 mA"},
    {0x14, "Set FF Acceleration", 0, 32640, "0.1 mA/(m/s^2)"},
    {0x15, "Set FF Deceleration", 0, 32640, "0.1 mA/(m/s^2)"},
    {0x16, "Set Current Offset", -256, 256, "23.4 mA"},
};

}  // namespace

std::span<const ModuleRow> modules() noexcept {
  return kModules;
}

const ModuleRow* find_module(std::string_view name) noexcept {
  for (const ModuleRow& row : kModules)
    if (same_spelling(row.name, name)) return &row;
  return nullptr;
}

std::span<const ModuleCommand> module_commands() noexcept {
  return kModuleCommands;
}

}  // namespace lockstep::linmot
