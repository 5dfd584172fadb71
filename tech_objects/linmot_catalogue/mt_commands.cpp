#include "tech_objects/linmot_catalogue/mt_commands.hpp"

#include "tech_objects/linmot_catalogue/spelling.hpp"

namespace lockstep::linmot {
namespace {

using enum MtCommand;

constexpr MtArgument kSpeed{"Speed", "m/s"};
constexpr MtArgument kAcceleration{"Acceleration", "m/s²"};
constexpr MtArgument kCurve{"Curve number", ""};

constexpr MtRow mt_row(MtCommand command, std::string_view name, MtScope scope, std::string_view text,
                       MtArgument first = {}, MtArgument second = {}, MtArgument third = {}) {
  return {command, name, scope, {first, second, third}, text};
}

constexpr MtRow kCommands[] = {
    mt_row(no_operation, "No Operation", MtScope::linear_motor, "what is under way goes on to its end"),
    mt_row(absolute_position, "Abs. Position", MtScope::linear_motor,
           "goes to a position, through the V/A limiter", {"Position", "mm"}, kSpeed, kAcceleration),
    mt_row(absolute_from_actual, "Abs Pos Act Pos", MtScope::linear_motor,
           "the same, and the limiter begins at the actual position: to leave a press position",
           {"Position", "mm"}, kSpeed, kAcceleration),
    mt_row(relative_position, "Rel. Position", MtScope::linear_motor,
           "adds to the demand of the motion that is under way, or to the end of a curve",
           {"Increment", "mm"}, kSpeed, kAcceleration),
    mt_row(absolute_current, "Abs. Current", MtScope::magnet_only, "sets the current of a magnet",
           {"Current", "A"}),
    mt_row(relative_current, "Rel. Current", MtScope::magnet_only, "changes the current of a magnet",
           {"Current increment", "A"}),
    mt_row(curve, "Curve", MtScope::linear_motor, "runs a curve", kCurve),
    mt_row(curve_from_demand, "Curve ActPos", MtScope::linear_motor,
           "runs a curve that begins at the present demand: its offset is changed", kCurve),
    mt_row(start_cam, "Start Cam", MtScope::later, "follows a leading angle", {"Cam number", ""}),
    mt_row(start_cam_from_demand, "Start Cam ActPos", MtScope::later,
           "the same, beginning at the present demand", {"Cam number", ""}),
    mt_row(recipe, "Recipe", MtScope::later, "another set of cams from the next turn on",
           {"Recipe number", ""}),
    mt_row(move_home_position, "Move Home Position", MtScope::linear_motor,
           "moves the zero of positions; nothing moves, and all motors have to rest unfrozen",
           {"Distance", "mm"}),
    mt_row(redefine_position, "Redefine Position", MtScope::linear_motor,
           "the actual position gets another name; nothing moves, and this motor has to be at its demand, "
           "unfrozen",
           {"Position", "mm"}),
    mt_row(demand_to_actual, "SetDPostoAPos", MtScope::linear_motor,
           "the demand becomes the actual position"),
    mt_row(stop, "Stop", MtScope::linear_motor, "brakes to rest", kAcceleration),
    mt_row(freeze, "Freeze", MtScope::linear_motor, "brakes to rest, and what is called meanwhile waits"),
    mt_row(unfreeze, "Unfreeze", MtScope::linear_motor, "goes on, or does what has been called last"),
    mt_row(set_current, "Set Current", MtScope::linear_motor, "sets the maximal current",
           {"Maximum current", "A"}),
    mt_row(set_current_offset, "Set Cur. Offset", MtScope::linear_motor, "sets the current offset",
           {"Current offset", "A"}),
    mt_row(set_feed_forward, "Set FF", MtScope::linear_motor, "sets the feed-forward parameters",
           {"FF Friction", "A"}, {"FF Acceleration", "mA/(m/s²)"}, {"FF Deceleration", "mA/(m/s²)"}),
    mt_row(set_pid, "Set PID", MtScope::linear_motor, "sets the gains of the position loop", {"P", "A/mm"},
           {"I", "A/(mm s)"}, {"D", "A/(m/s)"}),
    mt_row(set_curve_parameters, "Set CP", MtScope::linear_motor,
           "sets offset, amplitude and speed of curves", {"Curve offset", "mm"}, {"Curve amplitude", "%"},
           {"Curve speed", "%"}),
};

constexpr InputRow kInputs[] = {
    {InputCommand::no_operation, "No operation", "the state stays"},
    {InputCommand::next, "Goto next state", "the row behind the present one; first row 0"},
    {InputCommand::previous, "Goto previous state", "the row before the present one"},
    {InputCommand::repeat, "Repeat actual state", "the present row once more"},
    {InputCommand::go_to, "Goto state", "a row"},
};

}  // namespace

std::span<const MtRow> mt_commands() noexcept {
  return kCommands;
}

const MtRow* find_mt_command(std::string_view name) noexcept {
  for (const MtRow& row : kCommands)
    if (same_spelling(row.name, name)) return &row;
  return nullptr;
}

std::span<const InputRow> input_commands() noexcept {
  return kInputs;
}

}  // namespace lockstep::linmot
