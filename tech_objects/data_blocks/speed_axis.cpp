/// The variables of a TO_SpeedAxis: those of an axis that need no position, as the axis declares them, and
/// what it alone has.
/// @source S7-1500/S7-1500T axis functions, tags of the speed axis
#include <algorithm>
#include <array>
#include <vector>

#include "tech_objects/data_blocks/choices.hpp"
#include "tech_objects/data_blocks/declaration.hpp"
#include "tech_objects/data_blocks/object_bits.hpp"

namespace lockstep {
namespace {

using Data = AxisData;

constexpr Range between(double lowest, double highest) {
  return {lowest, highest};
}

constexpr UDINT kPerMinute = 1083;
constexpr Choice kVelocityUnit[] = {{1082, "1/s"}, {1083, "1/min"}, {1528, "1/h"}};
constexpr Choice kMassUnit[] = {{1088, "kg"}, {1089, "g"}, {1090, "mg"}, {1092, "t"}, {1540, "lb"}};
constexpr Choice kInertiaUnit[] = {{1118, "kg m²"}, {1541, "lb ft²"}};
constexpr Choice kMonitoring[] = {{0, "monitoring deactivated"}, {1, "monitoring activated"}};
constexpr Choice kRemoveEnableReaction[] = {{1, "OFF1: ramp of the drive"},
                                            {3, "OFF2: coast down"},
                                            {5, "OFF3: quick stop"},
                                            {7, "OFF3: quick stop, as up to V7"}};
constexpr Choice kMotionIn[] = {{0, "no MotionIn function active"}, {1, "MC_MotionInVelocity active"}};

constexpr BitNames kStatusNames = only(kStatusBitNames, {0, 1, 2, 3, 4, 6, 9, 10, 12, 13, 14, 25, 26, 27});
constexpr BitNames kStatus2Names = only(kStatus2BitNames, {0});
constexpr BitNames kErrorNames = only(kErrorBitNames, {0, 1, 2, 3, 4, 6, 7, 13, 15});
constexpr BitNames kWarningNames = only(kWarningBitNames, {0, 1, 2, 3, 4, 6, 7, 13, 15});

Value per_minute(const Variable& /*variable*/, std::size_t /*element*/) {
  Value value{};
  value.u = kPerMinute;
  return value;
}

/// What the axis has under another name, with other values, or not at all. In published order.
constexpr Variable kOwn[] = {
    VARIABLE(TorqueLimiting.PositionBasedMonitors, RES, kNone, between(0.0, 1.0),
             "positioning and following error monitoring while the torque is limited", .choices = kMonitoring,
             .later = true),
    VARIABLE(Units.VelocityUnit, RON, kNone, kAny, "unit for speed", .choices = kVelocityUnit),
    VARIABLE(SpeedAxis.MassUnit, RON, kNone, kAny, "unit for mass", .choices = kMassUnit, .later = true),
    VARIABLE(SpeedAxis.IneritaUnit, RON, kNone, kAny, "unit for inertia", .choices = kInertiaUnit,
             .later = true),
    COMPUTED(StatusMotionIn.FunctionState, RON, kNone, between(0.0, 1.0), "active MotionIn function",
             .choices = kMotionIn),
    VARIABLE(SpeedAxis.RemoveEnableReaction, RES, kNone, between(1.0, 7.0),
             "how the drive stops when an alarm removes the enable", .choices = kRemoveEnableReaction,
             .later = true),
    COMPUTED(SpeedAxis.Interpreter, RON, kNone, between(0.0, 65535.0), "interpreter in control",
             .later = true),
    COMPUTED(SpeedAxis.InterpreterStatusWord, RON, kNone, kAny, "X0 controlled, X1 moved by an interpreter",
             .later = true),
    COMPUTED(StatusWord, RON, kNone, kAny, "status information of the technology object",
             .bits = &kStatusNames),
    COMPUTED(StatusWord2, RON, kNone, kAny, "status information of the technology object (second word)",
             .bits = &kStatus2Names),
    COMPUTED(ErrorWord, RON, kNone, kAny, "errors (technology alarms) at the technology object",
             .bits = &kErrorNames),
    COMPUTED(WarningWord, RON, kNone, kAny, "warnings pending at the technology object",
             .bits = &kWarningNames),
};
/// Where the published name is not that of the place.
struct Renamed {
  std::string_view place;
  std::string_view published;
};
constexpr Renamed kRenamed[] = {
    {"TorqueLimiting.PositionBasedMonitors", "TorqueLimiting.PositionBasedMonitorings"},
    {"SpeedAxis.MassUnit", "Units.MassUnit"},
    {"SpeedAxis.IneritaUnit", "Units.IneritaUnit"},
    {"SpeedAxis.RemoveEnableReaction", "Actor.RemoveEnableReaction"},
    {"SpeedAxis.Interpreter", "StatusInterpreterMotion.Interpreter"},
    {"SpeedAxis.InterpreterStatusWord", "StatusInterpreterMotion.StatusWord"},
};

/// All variables in published order.
constexpr std::string_view kPublished[] = {
    "Velocity",
    "ActualSpeed",
    "Acceleration",
    "VelocitySetpoint",
    "Simulation.Mode",
    "VirtualAxis.Mode",
    "Actor.Type",
    "Actor.InverseDirection",
    "Actor.DataAdaption",
    "Actor.Efficiency",
    "Actor.Interface.AddressIn",
    "Actor.Interface.AddressOut",
    "Actor.Interface.EnableDriveOutput",
    "Actor.Interface.EnableDriveOutputAddress",
    "Actor.Interface.DriveReadyInput",
    "Actor.Interface.DriveReadyInputAddress",
    "Actor.Interface.EnableTorqueData",
    "Actor.Interface.TorqueDataAddressIn",
    "Actor.Interface.TorqueDataAddressOut",
    "Actor.DriveParameter.ReferenceSpeed",
    "Actor.DriveParameter.MaxSpeed",
    "Actor.DriveParameter.ReferenceTorque",
    "TorqueLimiting.LimitBase",
    "TorqueLimiting.LimitDefaults.Torque",
    "TorqueLimiting.LimitDefaults.Force",
    "LoadGear.Numerator",
    "LoadGear.Denominator",
    "Units.TimeUnit",
    "Units.TorqueUnit",
    "Units.ForceUnit",
    "DynamicLimits.MaxVelocity",
    "DynamicLimits.Velocity",
    "DynamicLimits.MaxAcceleration",
    "DynamicLimits.MaxDeceleration",
    "DynamicLimits.MaxJerk",
    "DynamicDefaults.Velocity",
    "DynamicDefaults.Acceleration",
    "DynamicDefaults.Deceleration",
    "DynamicDefaults.Jerk",
    "DynamicDefaults.EmergencyDeceleration",
    "Override.Velocity",
    "StatusDrive.InOperation",
    "StatusDrive.CommunicationOK",
    "StatusDrive.Error",
    "StatusDrive.AdaptionState",
    "StatusTorqueData.CommandAdditiveTorqueActive",
    "StatusTorqueData.CommandTorqueRangeActive",
    "StatusTorqueData.ActualTorque",
    "TorqueLimiting.PositionBasedMonitorings",
    "Units.VelocityUnit",
    "Units.MassUnit",
    "Units.IneritaUnit",
    "StatusMotionIn.FunctionState",
    "Actor.RemoveEnableReaction",
    "StatusInterpreterMotion.Interpreter",
    "StatusInterpreterMotion.StatusWord",
    "StatusWord",
    "StatusWord2",
    "ErrorWord",
    "WarningWord",
    "ErrorDetail.Number",
    "ErrorDetail.Reaction",
};

std::vector<Variable> own_variables() {
  std::vector<Variable> own(std::begin(kOwn), std::end(kOwn));
  for (Variable& variable : own) {
    if (variable.path == "Units.VelocityUnit") variable.start = &per_minute;
    for (const Renamed& renamed : kRenamed)
      if (variable.path == renamed.place) variable.path = renamed.published;
  }
  return own;
}

const Variable* find(std::span<const Variable> list, std::string_view path) noexcept {
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const Variable& v) { return v.path == path; });
  return found == list.end() ? nullptr : &*found;
}

/// The two lists, put together once.
struct Lists {
  std::vector<Variable> configuration, status;
  Lists() {
    const std::vector<Variable> own = own_variables();
    for (const std::string_view path : kPublished) {
      const Variable* variable = find(own, path);
      for (const auto list : axis_data_block().lists())
        if (variable == nullptr) variable = find(list, path);
      (variable->computed ? status : configuration).push_back(*variable);
    }
  }
};

}  // namespace

const DataBlock& speed_axis_data_block() {
  static const Lists lists;
  static const DataBlock block{lists.configuration, lists.status};
  return block;
}

}  // namespace lockstep
