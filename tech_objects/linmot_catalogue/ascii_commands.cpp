#include "tech_objects/linmot_catalogue/ascii_commands.hpp"

namespace lockstep::linmot {
namespace {

constexpr int kReads = AsciiCommand::kReads, kInRun = AsciiCommand::kInRun, kMotion = AsciiCommand::kMotion,
              kArms = AsciiCommand::kArms, kSigned = AsciiCommand::kSigned;

constexpr AsciiCommand ascii_row(std::string_view name, AsciiForm form, std::int32_t lowest,
                                 std::int32_t highest, int flags, std::string_view title,
                                 std::string_view text) {
  return {name, form, lowest, highest, static_cast<std::uint8_t>(flags), title, text};
}

constexpr AsciiCommand kCommandTable[] = {
    ascii_row("AC", AsciiForm::drive, 0, 0, kReads, "read demand current",
              "Returns the current commanded by the controller"),
    ascii_row("AI", AsciiForm::drive, 0, 0, kReads, "read acceleration resolution",
              "Acceleration increment: LinMot in um/s^2, stepper in 2^-10 steps/s^2"),
    ascii_row("AO", AsciiForm::number_drive, 0, 65534, 0, "set address segment offset",
              "Lower 16 bits of the 24-bit address for word access; must be even"),
    ascii_row("AS", AsciiForm::number_drive, 0, 255, 0, "set address segment number",
              "Upper 8 bits of the 24-bit address"),
    ascii_row("CA", AsciiForm::number_drive, 0, 63, kInRun | kMotion,
              "start curve cyclically from actual position",
              "As CC but from the current demand position; rewrites Curve Position Offset"),
    ascii_row("CB", AsciiForm::number_drive, 0, 63, kInRun | kMotion | kArms,
              "start curve cyclically on next trigger from actual position",
              "As CT but from the current demand position; rewrites Curve Position Offset"),
    ascii_row(
        "CC", AsciiForm::number_drive, 0, 63, kInRun | kMotion, "start curve cyclically",
        "Curve restarts at once whenever it ends, until CS. While cyclic no other motion command may be used "
        "for this motor"),
    ascii_row("CI", AsciiForm::controller, 0, 0, kReads, "read current resolution",
              "Current increment of the controller in uA"),
    ascii_row("CS", AsciiForm::number_drive, 0, 15, 0, "end cyclic curve",
              "The curves of the selected motors run to their end and are not restarted"),
    ascii_row(
        "CT", AsciiForm::number_drive, 0, 63, kInRun | kMotion | kArms,
        "start curve cyclically on next trigger",
        "First start on the rising trigger edge, then cyclic without regard to the trigger, until CS. No "
        "other motion commands meanwhile"),
    ascii_row("DA", AsciiForm::number_drive, 0, 32640, 0, "set ff acceleration of the controller",
              "Sets FF Acceleration of the motor"),
    ascii_row("DB", AsciiForm::number_drive, 0, 32640, 0, "set ff deceleration of the controller",
              "Sets FF Deceleration of the motor"),
    ascii_row(
        "DC", AsciiForm::number_drive, 0, 4096, 0, "set curve amplitude",
        "4096 = 100 %; smaller values shrink the curve linearly. Motor jumps if changed while a curve runs"),
    ascii_row("DD", AsciiForm::number_drive, 0, 32640, 0, "set d of the controller", "Sets D of the motor"),
    ascii_row("DF", AsciiForm::number_drive, 0, 255, 0, "set ff friction of the controller",
              "Sets FF Friction of the motor"),
    ascii_row("DI", AsciiForm::number_drive, 0, 32640, 0, "set i of the controller", "Sets I of the motor"),
    ascii_row("DK", AsciiForm::number_drive, -256, 256, kSigned, "set current offset",
              "Sets the current offset (vertical mounting with load). Resolution via CI"),
    ascii_row("DO", AsciiForm::number_drive, -32256, 32256, kSigned, "set curve offset",
              "Position offset of curves"),
    ascii_row("DP", AsciiForm::number_drive, 0, 32640, 0, "set p of the controller", "Sets P of the motor"),
    ascii_row("DS", AsciiForm::number_drive, 0, 4096, 0, "set curve speed",
              "4096 = as created; smaller values linearly slower; may be changed at any time (also during a "
              "curve)"),
    ascii_row("EA", AsciiForm::drive, 0, 0, kReads, "read ff acceleration of the controller",
              "Returns FF Acceleration of the motor"),
    ascii_row("EB", AsciiForm::drive, 0, 0, kReads, "read ff deceleration of the controller",
              "Returns FF Deceleration of the motor"),
    ascii_row("EC", AsciiForm::drive, 0, 0, kReads, "read curve amplitude", "Returns the curve amplitude"),
    ascii_row("ED", AsciiForm::drive, 0, 0, kReads, "read d of the controller", "Returns D of the motor"),
    ascii_row("EE", AsciiForm::drive, 0, 0, kReads, "read motor error status", "Motor error bits"),
    ascii_row("EF", AsciiForm::drive, 0, 0, kReads, "read ff friction of the controller",
              "Returns FF Friction of the motor"),
    ascii_row("EI", AsciiForm::drive, 0, 0, kReads, "read i of the controller", "Returns I of the motor"),
    ascii_row("EK", AsciiForm::drive, 0, 0, kReads, "read current offset", "Returns the current offset"),
    ascii_row("EO", AsciiForm::drive, 0, 0, kReads, "read curve offset", "Returns the curve offset"),
    ascii_row("EP", AsciiForm::drive, 0, 0, kReads, "read p of the controller", "Returns P of the motor"),
    ascii_row("ES", AsciiForm::drive, 0, 0, kReads, "read curve speed", "Returns the curve speed"),
    ascii_row("EW", AsciiForm::drive, 0, 0, kReads, "read motor warning status", "Motor warning bits"),
    ascii_row("EX", AsciiForm::controller, 0, 0, kReads, "read state flags", "State and In Position bits"),
    ascii_row("GA", AsciiForm::drive, 0, 0, kReads, "read maximum acceleration",
              "Returns the acceleration limit"),
    ascii_row("GC", AsciiForm::drive, 0, 0, kReads, "read maximum current (force)",
              "Returns the maximum current"),
    ascii_row("GD", AsciiForm::drive, 0, 0, kReads, "read demand position",
              "Returns the demand position; not usable while a profile runs"),
    ascii_row("GE", AsciiForm::controller, 0, 0, kReads, "read system error status", "System error bits"),
    ascii_row("GP", AsciiForm::drive, 0, 0, kReads, "read actual position", "Returns the actual position"),
    ascii_row("GS", AsciiForm::controller, 0, 0, kReads, "read status",
              "Letter of the operating state; in ERROR followed by the error number (and motor letter)"),
    ascii_row("GV", AsciiForm::drive, 0, 0, kReads, "read maximum speed", "Returns the speed limit"),
    ascii_row("GW", AsciiForm::controller, 0, 0, kReads, "read system warning status", "System warning bits"),
    ascii_row("GX", AsciiForm::controller, 0, 0, kReads, "read flags", "RUN/INIT/FREEZE/STOP flags"),
    ascii_row("IP", AsciiForm::number_drive, -32768, 32767, kInRun | kMotion | kSigned,
              "increment demand position (relative positioning)",
              "Adds posinc to the demand position. The sum must lie within -32256...32256"),
    ascii_row(
        "MH", AsciiForm::number_drive, -32768, 32767, kInRun | kSigned, "shift reference position",
        "Shifts the reference position by posinc. Minimum/maximum positions are not shifted. Use with care"),
    ascii_row("PI", AsciiForm::drive, 0, 0, kReads, "read position resolution",
              "Position increment: LinMot in pm, stepper in 1/256 step, magnet in uA"),
    ascii_row("PV", AsciiForm::controller, 0, 0, kReads, "read protocol version",
              "Protocol version: release 1.3 = 2 (superset of version 1 of release 1.2)"),
    ascii_row("RA", AsciiForm::number_drive, 0, 63, kInRun | kMotion, "start curve from actual position",
              "As RC but from the current demand position; rewrites Curve Position Offset"),
    ascii_row("RC", AsciiForm::number_drive, 0, 63, kInRun | kMotion, "start curve",
              "Starts a stored profile; when another profile runs, the new one starts at once"),
    ascii_row("RD", AsciiForm::drive, 0, 0, kReads, "read data word",
              "Reads 16 bits at the AO/AS address (changed by WS and RE)"),
    ascii_row("RE", AsciiForm::drive, 0, 0, kReads, "read data word with address increment",
              "As RD, then address + 2"),
    ascii_row("RP", AsciiForm::number_drive, -32256, 32256, kInRun | kSigned, "define new actual position",
              "Sets the actual position to pos. Minimum/maximum positions are not shifted. Use with care"),
    ascii_row("RQ", AsciiForm::drive, 0, 0, 0, "set demand position to actual position",
              "Demand := actual; e.g. after freeze without finishing the motion, or before re-energising"),
    ascii_row("SA", AsciiForm::number_drive, 1, 1536, 0, "set maximum acceleration",
              "Acceleration limit of the V/A limiter"),
    ascii_row("SC", AsciiForm::number_drive, 0, 256, 0, "set maximum current (force)",
              "Sets the maximum current"),
    ascii_row(
        "SF", AsciiForm::sign_any, 0, 0, 0, "set freeze flags",
        "Sets or clears the global or a motor's FREEZE flag. A motor moves only if both the global flag and "
        "its own flag are clear"),
    ascii_row("SI", AsciiForm::sign_controller, 0, 0, 0, "set init flag",
              "Sets or clears the INIT request flag"),
    ascii_row("SP", AsciiForm::number_drive, -32256, 32256, kMotion | kSigned,
              "set demand position (absolute positioning)",
              "Sets the demand position; the motor goes there through the V/A limiter (SV, SA)"),
    ascii_row("SR", AsciiForm::sign_controller, 0, 0, 0, "set run flag",
              "Sets or clears the RUN request flag"),
    ascii_row("SS", AsciiForm::sign_controller, 0, 0, 0, "set stop flag",
              "Sets or clears the STOP request flag"),
    ascii_row("SV", AsciiForm::number_drive, 6, 24576, 0, "set maximum speed",
              "Speed limit of the V/A limiter"),
    ascii_row("SW", AsciiForm::number_drive, -32256, 32256, kMotion | kSigned,
              "go to demand position from actual position (absolute)",
              "As SP, but the V/A limiter starts at the actual position (leaving a press position)"),
    ascii_row("TA", AsciiForm::number_drive, 0, 63, kInRun | kMotion | kArms,
              "start curve on trigger from actual position",
              "As TC but from the current demand position; rewrites Curve Position Offset"),
    ascii_row(
        "TC", AsciiForm::number_drive, 0, 63, kInRun | kMotion | kArms, "start curve on next trigger pulse",
        "Armed curve start on the next rising trigger edge; trigger inputs are very fast so the start is "
        "precise. 0 = empty profile"),
    ascii_row("TI", AsciiForm::number_drive, -32768, 32767, kInRun | kMotion | kArms | kSigned,
              "increment demand position on next trigger",
              "IP armed: executed on the next rising trigger edge; sum within -32256...32256"),
    ascii_row("TP", AsciiForm::number_drive, -32256, 32256, kInRun | kMotion | kArms | kSigned,
              "set demand position on next trigger", "SP armed: executed on the next rising trigger edge"),
    ascii_row("TW", AsciiForm::number_drive, -32256, 32256, kInRun | kMotion | kArms | kSigned,
              "go to demand position from actual position on next trigger",
              "SW armed: executed on the next rising trigger edge"),
    ascii_row("VI", AsciiForm::drive, 0, 0, kReads, "read speed increment",
              "Speed increment: LinMot in nm/s, stepper in 2^-16 step/s, magnet 0"),
    ascii_row("WR", AsciiForm::number_drive, 0, 65535, 0, "write data word",
              "Writes 16 bits at the address set with AO/AS (changed by WS and RE)"),
    ascii_row("WS", AsciiForm::number_drive, 0, 65535, 0, "write data word with address increment",
              "As WR, then address + 2"),
    ascii_row(
        "ZD", AsciiForm::drive, 0, 0, kInRun, "set internal position counter to 0",
        "Position counter := 0, thereby also shifts the home position. Minimum/maximum positions are not "
        "shifted. Use with care"),
};

}  // namespace

std::span<const AsciiCommand> ascii_commands() noexcept {
  return kCommandTable;
}

const AsciiCommand* find_ascii_command(std::string_view name) noexcept {
  for (const AsciiCommand& command : kCommandTable)
    if (command.name == name) return &command;
  return nullptr;
}

}  // namespace lockstep::linmot
