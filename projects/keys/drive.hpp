/// The keys of drives, of the machines behind them, and of encoders.
#pragma once

#include "projects/json/key.hpp"
#include "tech_objects/axis/axis.hpp"
#include "tech_objects/drive/drive_models.hpp"
#include "tech_objects/drive/drive_settings.hpp"
#include "tech_objects/drive/encoder_source.hpp"

namespace lockstep::keys {

inline constexpr double kFurthest = kPositionRange;  ///< from 0, on the scale of a machine [u]
inline constexpr Range kPlace{-kFurthest, kFurthest};
inline constexpr Range kLength{0.0, kFurthest};
inline constexpr Range kAboveZero{1e-12, 1e12};
inline constexpr Range kNotNegative{0.0, 1e12};
inline constexpr Range kSigned{-1e12, 1e12};
inline constexpr Range kRatio{-1e12, 1e12, 0.0};

inline constexpr auto kZeroMarks = key_table<ZeroMarks>(
    key::number<&ZeroMarks::position>("position", kPlace, "u", "of a zero mark").needed(),
    key::number<&ZeroMarks::period>("period", kLength, "u",
                                    "after which the next one follows; 0: there is one only"));

inline constexpr auto kLimitSwitches =
    key_table<MachineSignals>(key::number<&MachineSignals::limit_min>(
                                  "min", kPlace, "u", "from here downwards the negative one is pressed"),
                              key::number<&MachineSignals::limit_max>(
                                  "max", kPlace, "u", "from here upwards the positive one is pressed"));

inline constexpr auto kDigitalInput = key_table<DigitalInput>(
    key::tag<&DigitalInput::tag>("tag", "BOOL tag that the machine writes in every servo cycle").needed(),
    key::positions<&DigitalInput::range>("range", kPlace, "positions in which it is TRUE").needed());

inline constexpr Word kDirections[] = {{"positive", 1}, {"negative", -1}};
inline constexpr auto kFixedStop = key_table<FixedStop>(
    key::number<&FixedStop::position>("position", kPlace, "u",
                                      "on the scale of the machine, where it is touched")
        .needed(),
    key::number<&FixedStop::stiffness>("stiffness", kAboveZero, "Nm/u or N/u",
                                       "torque at the motor per way into it")
        .needed(),
    key::word<&FixedStop::side>("direction", kDirections, "of the motion that meets it"));

inline constexpr auto kPlant = key_table<MachinePlantSettings>(
    key::number<&MachinePlantSettings::inertia>("inertia", kAboveZero, "kg m²; of a linear motor N s²/u",
                                                "of all that moves, at the motor")
        .needed(),
    key::number<&MachinePlantSettings::friction>(
        "friction", kNotNegative, "Nm or N", "dry friction, as torque at the motor; of a linear motor force"),
    key::number<&MachinePlantSettings::load_torque>("load_torque", kSigned, "Nm or N",
                                                    "pushes the machine, at the motor; positive: forwards"),
    key::number<&MachinePlantSettings::maximum_torque>("maximum_torque", kAboveZero, "Nm or N",
                                                       "of the drive")
        .otherwise_is("no limit"),
    key::structure<&MachinePlantSettings::stop>("fixed_stop", kFixedStop, "something immovable in the way"));

inline constexpr auto kFaults = key_table<SimulatedFaults>(
    key::tag<&SimulatedFaults::drive>("drive", "BOOL tag: while TRUE the drive has a fault"),
    key::tag<&SimulatedFaults::encoder>("encoder", "BOOL tag: while TRUE the encoder tells nothing"),
    key::tag<&SimulatedFaults::communication>("communication", "BOOL tag: while TRUE the drive is not heard"),
    key::tag<&SimulatedFaults::blocked>("blocked", "BOOL tag: while TRUE the machine cannot move"));

inline constexpr auto kSensor = key_table<SimulatedSensor>(
    key::integer("sensor", {2, static_cast<double>(Axis::kSensors)}, "its number, of Sensor[2] to Sensor[4]")
        .needed(),
    key::number<&SimulatedSensor::ratio>("ratio", kRatio, "",
                                         "user units that it tells per unit of the machine"),
    key::number<&SimulatedSensor::resolution>("resolution", kLength, "u", "increment; 0: none"),
    key::boolean<&SimulatedSensor::inverted>("inverted", "it turns the other way round than the machine"),
    key::number<&SimulatedSensor::start_position>("start_position", kPlace, "u",
                                                  "what it tells at the beginning, of an absolute one"),
    key::tag<&SimulatedSensor::fault>("fault", "BOOL tag: while TRUE it tells nothing"));

/// What every drive has that simulates its machine: encoder, marks and switches, faults.
/// @param unit of positions
consteval auto machine_keys(std::string_view unit) {
  return key_table<DriveSettings>(
      key::number<&DriveSettings::resolution>("encoder_resolution", kLength, unit,
                                              "increment of the encoder as the axis reads it; 0: none"),
      key::boolean<&DriveSettings::inverted>(
          "inverted",
          "motor and encoder count the other way round than the machine; Actor.InverseDirection and "
          "Sensor[1].InverseDirection make up for it"),
      key::number<&DriveSettings::signals, &MachineSignals::start_position>(
          "start_position", kPlace, unit,
          "where the machine stands at the start, on its own scale; what an absolute encoder "
          "(Sensor[1].Type 1, 2) reports"),
      key::structure<&DriveSettings::signals, &MachineSignals::zero_marks>("zero_marks", kZeroMarks,
                                                                           "zero marks of the encoder"),
      key::positions<&DriveSettings::signals, &MachineSignals::reference_cam>(
          "reference_cam", kPlace,
          "positions in which the reference cam is active; it counts where homing has no "
          "DigitalInputAddress"),
      key::structure<&DriveSettings::signals>(
          "limit_switches", kLimitSwitches,
          "pressed from there outwards; they count where PositionLimits_HW has no address"),
      key::structure<&DriveSettings::signals, &MachineSignals::digital_inputs>(
          "digital_inputs", kDigitalInput, "switches that are tags; an address in config may name them")
          .list(),
      key::number<&DriveSettings::quick_stop>(
          "quick_stop_deceleration", kNotNegative, unit == "mm" ? "mm/s²" : "u/s²",
          "of a quick stop (OFF3: MC_Power StopMode 1, alarms that remove the enable); 0: as hard as the "
          "drive can"),
      key::structure<&DriveSettings::faults>("faults", kFaults, "what goes wrong, and when"),
      key::structure("sensors", kSensor,
                     "encoders beside that of the drive, at the machine; each needs its Sensor[n].Existent "
                     "in config")
          .list());
}

inline constexpr double kMaximumDeadCycles = 254;   // of MC_Servo, as dead time of a drive
inline constexpr double kLongestServoCycle = 60e9;  // [ns]
inline constexpr auto kSimulatedDrive = joined(
    key_table<DriveSettings>(
        key::selector("model", "kind of the drive"),
        key::duration<&DriveSettings::time_constant>("time_constant", {0, 10e9}, "lag of the velocity loop"),
        key::duration<&DriveSettings::dead_time>("dead_time", {0, kMaximumDeadCycles* kLongestServoCycle},
                                                 "dead time of the velocity loop, up to 254 servo cycles"),
        key::structure<&DriveSettings::plant>("plant", kPlant, "what the drive moves; none: no torque"),
        key::duration<&DriveSettings::position_cycle>(
            "position_cycle", {10e3, 1e9},
            "cycle of the position loop in the drive, with PositionControl.EnableDSC")),
    machine_keys("u"));

inline constexpr auto kDampedStop = key_table<DampedStop>(
    key::number<&DampedStop::position>("position", kPlace, "mm",
                                       "on the scale of the machine, where it is touched")
        .needed(),
    key::number<&DampedStop::stiffness>("stiffness", kAboveZero, "N/m", "force per way into it").needed(),
    key::number<&DampedStop::damping>("damping", kNotNegative, "N s/m",
                                      "force per velocity while it is touched"),
    key::word<&DampedStop::side>("direction", kDirections, "of the motion that meets it"));

inline constexpr auto kCentringSpring = key_table<CentringSpring>(
    key::number<&CentringSpring::position>("position", kPlace, "mm",
                                           "on the scale of the machine, where it is slack")
        .needed(),
    key::number<&CentringSpring::stiffness>("stiffness", kAboveZero, "N/m", "force per way from there")
        .needed());

template <auto Member>
constexpr auto of_loop(std::string_view name, Range range, std::string_view unit, std::string_view text) {
  return key::number<&DriveSettings::linear_motor, &LinearMotorSettings::loop, Member>(name, range, unit,
                                                                                       text);
}
template <auto Member>
constexpr auto of_motor_plant(std::string_view name, Range range, std::string_view unit,
                              std::string_view text) {
  return key::number<&DriveSettings::linear_motor, &LinearMotorSettings::plant, Member>(name, range, unit,
                                                                                        text);
}

/// The names of the position loop are those that the servo controllers of such motors print.
inline constexpr auto kLinearMotor = joined(
    key_table<DriveSettings>(
        key::selector("model", "kind of the drive"),
        key::number<&DriveSettings::linear_motor, &LinearMotorSettings::force_constant>(
            "force_constant", kAboveZero, "N/A", "of the motor")
            .needed(),
        of_motor_plant<&LinearMotorPlantSettings::slider_mass>("slider_mass", kAboveZero, "kg",
                                                               "of the motor itself")
            .needed(),
        of_motor_plant<&LinearMotorPlantSettings::load_mass>("load_mass", kNotNegative, "kg",
                                                             "of what it carries"),
        of_motor_plant<&LinearMotorPlantSettings::friction>("friction", kNotNegative, "N",
                                                            "dry, against every motion"),
        of_motor_plant<&LinearMotorPlantSettings::inclination>(
            "inclination", {-90.0, 90.0}, "°",
            "90: the positive direction is straight upwards, against the weight"),
        key::tag<&DriveSettings::linear_motor, &LinearMotorSettings::plant,
                 &LinearMotorPlantSettings::external_force>(
            "external_force",
            "LREAL tag: pushes besides [N], within ±1e9; positive: in the positive direction", Type::LREAL),
        key::structure<&DriveSettings::linear_motor, &LinearMotorSettings::plant,
                       &LinearMotorPlantSettings::spring>("spring", kCentringSpring, "always in force"),
        key::structure<&DriveSettings::linear_motor, &LinearMotorSettings::plant,
                       &LinearMotorPlantSettings::stops>("fixed_stops", kDampedStop,
                                                         "something immovable in the way")
            .list(),
        of_loop<&CurrentLoopSettings::proportional>("P", kAboveZero, "A/mm", "gain of the following error")
            .needed(),
        of_loop<&CurrentLoopSettings::derivative>("D", kNotNegative, "A/(m/s)",
                                                  "gain of the difference of velocity")
            .needed(),
        of_loop<&CurrentLoopSettings::integral>("I", kNotNegative, "A/(mm s)",
                                                "gain of the summed following error"),
        of_loop<&CurrentLoopSettings::friction>("FF Friction", kNotNegative, "A",
                                                "feed-forward in the direction of the setpoint's motion"),
        of_loop<&CurrentLoopSettings::acceleration>("FF Acceleration", kNotNegative, "mA/(m/s²)",
                                                    "feed-forward while the setpoint becomes faster"),
        of_loop<&CurrentLoopSettings::deceleration>("FF Deceleration", kNotNegative, "mA/(m/s²)",
                                                    "feed-forward while the setpoint becomes slower"),
        of_loop<&CurrentLoopSettings::offset>("Current Offset", kSigned, "A",
                                              "always added, such as for a weight"),
        of_loop<&CurrentLoopSettings::maximum_current>("maximal_current", kAboveZero, "A",
                                                       "in either direction")
            .needed(),
        key::duration<&DriveSettings::linear_motor, &LinearMotorSettings::control_cycle>(
            "control_cycle", {1e3, 1e9}, "cycle of the position loop; 1 to 256 of them are a servo cycle"),
        key::boolean<&DriveSettings::linear_motor, &LinearMotorSettings::brake>(
            "brake", "without current a brake holds the motor once it rests")),
    machine_keys("mm"));

/// Each kind of drive has keys of its own.
inline constexpr KeyVariant kDrives[] = {{"simulated", kSimulatedDrive}, {"linear_motor", kLinearMotor}};
static_assert(
    [] {
      for (std::size_t i = 0; i < std::size(kDrives); ++i)
        if (kDrives[i].name != kDriveModels[i].name) return false;
      return std::size(kDrives) == std::size(kDriveModels);
    }(),
    "a kind of drive without keys");

inline constexpr auto kSimulatedEncoder = key_table<SimulatedEncoderSettings>(
    key::selector("model", "kind of the encoder"),
    key::object<&SimulatedEncoderSettings::follows>("follows", kAnyAxis,
                                                    "axis on whose load it sits; or 'signal'"),
    key::number<&SimulatedEncoderSettings::ratio>("ratio", kRatio, "",
                                                  "user units of the encoder per unit of that axis"),
    key::signal("signal", "number whose value is the position: tag, instance.Pin or Object.Variable"),
    key::tag<&SimulatedEncoderSettings::valid>("valid",
                                               "BOOL tag: whether the signal is heard of; FALSE is a fault "
                                               "of the encoder (411), but for the time before "
                                               "it is TRUE first. With 'signal' only"),
    key::number<&SimulatedEncoderSettings::wrap>("wrap", {0.001, kFurthest}, "u",
                                                 "length at which the signal wraps")
        .otherwise_is("it does not"),
    key::number<&SimulatedEncoderSettings::resolution>("resolution", kLength, "u",
                                                       "increment of the encoder; 0: none"),
    key::number<&SimulatedEncoderSettings::noise>("noise", kLength, "u",
                                                  "largest deviation of a reading to either side"),
    key::structure<&SimulatedEncoderSettings::signals, &MachineSignals::zero_marks>(
        "zero_marks", kZeroMarks, "zero marks, at positions of the encoder"),
    key::positions<&SimulatedEncoderSettings::signals, &MachineSignals::reference_cam>(
        "reference_cam", kPlace, "positions of the encoder in which the reference cam is active"));

inline constexpr KeyVariant kEncoders[] = {{"simulated", kSimulatedEncoder}};

}  // namespace lockstep::keys
