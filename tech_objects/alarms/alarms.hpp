/// Error identifiers of function blocks and technology alarms of objects: one table each.
/// @source S7-1500/S7-1500T alarms and error IDs; S7-1500T synchronous operation V7, 13.1.40 to 13.1.42
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "tech_objects/types/declaration.hpp"
#include "tech_objects/types/types.hpp"

namespace lockstep {

/// Why a job was rejected or ended, as shown at the output ErrorID.
enum class ErrorId : std::uint16_t {
  none = 0x0000,
  technology_alarm = 0x8001,
  no_technology_object = 0x8002,
  velocity = 0x8003,
  acceleration = 0x8004,
  deceleration = 0x8005,
  jerk = 0x8006,
  direction = 0x8007,
  distance = 0x8008,
  position = 0x8009,
  mode = 0x800A,
  stop_mode = 0x800B,
  one_instance_only = 0x800C,
  restarting = 0x800D,
  restart_refused = 0x800E,
  locked = 0x800F,
  homing_mode_incremental = 0x8010,
  homing_mode_absolute = 0x8011,
  no_job_memory = 0x8014,
  actual_values_invalid = 0x8016,
  ratio_numerator = 0x8017,
  ratio_denominator = 0x8018,
  recursive_coupling = 0x8019,
  master_offset = 0x8021,
  slave_offset = 0x8022,
  master_scaling = 0x8023,
  slave_scaling = 0x8024,
  leading_distance = 0x8026,
  application_mode = 0x8027,
  master_sync_position = 0x8034,
  slave_sync_position = 0x8035,
  sync_profile_reference = 0x8036,
  slave_position = 0x8037,
  on_position = 0x8040,
  off_position = 0x8041,
  cam_duration = 0x8042,
  torque_limit = 0x8043,
  no_torque_reduction = 0x8044,
  fixed_stop_position_control = 0x8045,
  clamping = 0x8046,
  towards_fixed_stop = 0x8047,
  additive_torque = 0x804A,
  upper_torque_limit = 0x804B,
  lower_torque_limit = 0x804C,
  torque_limits_order = 0x804D,
  torque_limits_exclude = 0x804E,
  no_torque_data = 0x804F,
  sensor = 0x8050,
  reference_sensor = 0x8051,
  control_bits = 0x8055,
  parameter_number = 0x805A,
  limit_switches_missing = 0x805B,
  parameter_type = 0x805C,
  communication_times = 0x805D,
  approach_leading_value = 0x8062,
  no_leading_value = 0x8063,
  no_following_value = 0x8064,
  phase_shift = 0x8070,
  not_position_controlled = 0x8071,
  homing_active = 0x8074,
  no_synchronous_operation = 0x8075,
  simulated = 0x8076,
  no_gear = 0x8077,
  no_cam = 0x8078,
  velocity_gear_active = 0x8079,
  offset = 0x8080,
  offset_distance = 0x8081,
  phasing_distance = 0x8082,
  profile_reference = 0x8083,
  start_position = 0x8084,
  shifts_exclude = 0x808A,
  no_camming = 0x808B,
  leading_value_reversed = 0x808C,
  homing_while_coupled = 0x80A1,
  measuring_range = 0x80A2,
  measuring_while_homing = 0x80A3,
  measuring_range_start = 0x80A5,
  measuring_range_end = 0x80A6,
  outside_measuring_range = 0x80A7,
  phasing_in_time = 0x80A8,
  not_synchronous = 0x80A9,
  cam_empty = 0x80AA,
  cam_in_use = 0x80AB,
  cam_elements_wrong = 0x80AC,
  outside_cam = 0x80AD,
  start_point_cam = 0x80E1,
  start_segment_cam = 0x80E2,
  start_point_array = 0x80E3,
  start_segment_array = 0x80E4,
  number_of_points = 0x80E5,
  number_of_segments = 0x80E6,
  cam_being_copied = 0x80E7,
  cam_in_interpolation = 0x80E8,
  points_array = 0x80E9,
  segments_array = 0x80EA,
  encoder_data_no_space = 0x80EB,
  encoder_data_not_written = 0x80EC,
  encoder_data_instances = 0x80ED,
  encoder_data_being_saved = 0x80EE,
  encoder_data_protected = 0x80EF,
  unspecified = 0x8FFF
};

/// Meaning of an error identifier; empty for an unknown one.
std::string_view error_text(ErrorId id) noexcept;

/// One row of the table of error identifiers.
struct ErrorText {
  ErrorId id;
  std::string_view text;
};
std::span<const ErrorText> error_texts() noexcept;

/// What an alarm does to the axis, as shown in ErrorDetail.Reaction. A higher number of 1 to 4 overrides a
/// lower one.
enum class AlarmReaction : std::uint8_t {
  none = 0,            ///< a warning: the job goes on
  stop_current = 1,    ///< stop with the dynamic values of the running job
  stop_maximum = 2,    ///< stop with DynamicLimits.MaxDeceleration and MaxJerk
  stop_emergency = 3,  ///< stop with DynamicDefaults.EmergencyDeceleration, without jerk limit
  remove_enable = 4,   ///< setpoint zero, the drive is switched off
  track_setpoints = 5  ///< setpoint zero, the setpoint follows the actual value
};

enum class AlarmClass : std::uint8_t {
  warning,          ///< MC_Reset or the end of its cause clears it
  acknowledgeable,  ///< MC_Reset, then new jobs
  fatal             ///< restart of the technology object
};

/// What the values are that come with an alarm, where any do.
struct AlarmValues {
  std::string_view value;  ///< name of what was measured; empty: none
  std::string_view limit;  ///< name of what it was held against; empty: nothing
  Unit unit = Unit::kNone;
};

/// One technology alarm.
struct Alarm {
  int number;
  std::string_view text;
  int reaction;     ///< value of ErrorDetail.Reaction
  int error_bit;    ///< bit of ErrorWord; -1: none
  int warning_bit;  ///< bit of WarningWord; -1: none
  AlarmClass alarm_class;
  std::string_view cause{};       ///< what has happened; empty where nothing raises it
  std::string_view remedy{};      ///< what is to be done about it
  std::string_view not_raised{};  ///< why nothing raises it here; empty: something does
  AlarmValues values{};
};

/// The alarm with a number; nullptr if there is none.
const Alarm* find_alarm(int number) noexcept;
std::span<const Alarm> alarms() noexcept;

/// Numbers of the alarms that the runtime raises.
namespace alarm {
inline constexpr int kSoftwareLimits = 104;
inline constexpr int kVelocityLimitZero = 304;
inline constexpr int kAccelerationLimitZero = 305;
inline constexpr int kJerkLimitZero = 306;
inline constexpr int kPositionRangeReached = 307;
inline constexpr int kPositionRangeExceeded = 308;
inline constexpr int kNotHomed = 321;
inline constexpr int kRestartNotCarriedOut = 322;
inline constexpr int kHomingNotPossible = 323;
inline constexpr int kHomingData = 341;
inline constexpr int kMarkNotFound = 342;
inline constexpr int kHomingNotSupported = 343;
inline constexpr int kEncoder = 411;
inline constexpr int kActualValueRange = 412;
inline constexpr int kDriveFault = 421;
inline constexpr int kCommunication = 431;
inline constexpr int kVelocityLimited = 501;
inline constexpr int kAccelerationLimited = 502;
inline constexpr int kJerkLimited = 503;
inline constexpr int kSpeedSetpointLimited = 504;
inline constexpr int kFollowingError = 521;
inline constexpr int kFollowingErrorWarning = 522;
inline constexpr int kHardwareLimitSwitch = 531;
inline constexpr int kSoftwareLimitReached = 533;
inline constexpr int kSoftwareLimitPassed = 534;
inline constexpr int kPositioning = 541;
inline constexpr int kClamping = 542;
inline constexpr int kVelocityNotReachable = 551;
inline constexpr int kLeadingAxis = 601;
inline constexpr int kLeadingAxisNotPositionControlled = 603;
inline constexpr int kSynchronizing = 608;
inline constexpr int kSwitchingPosition = 700;
inline constexpr int kPositionInvalid = 702;
inline constexpr int kCamTrackData = 703;
inline constexpr int kOutputCamData = 704;
inline constexpr int kMeasuringWhileHoming = 750;
inline constexpr int kMeasuringRangePassed = 752;
inline constexpr int kProbeInUse = 753;
inline constexpr int kProbeConfiguration = 754;
inline constexpr int kMeasuringNotPossible = 755;
inline constexpr int kLeadingValuesInvalid = 900;
inline constexpr int kLeadingModuloChanged = 903;
inline constexpr int kCamNotInterpolated = 612;
inline constexpr int kInternal = 203;
}  // namespace alarm

}  // namespace lockstep
