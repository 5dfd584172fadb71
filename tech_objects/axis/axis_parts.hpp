/// What an axis consists of: its data block, what blocks ask of it, and the parts that own its state.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/axis/arrival.hpp"
#include "tech_objects/axis/backlash.hpp"
#include "tech_objects/axis/blending.hpp"
#include "tech_objects/axis/clamping.hpp"
#include "tech_objects/axis/course_hand_over.hpp"
#include "tech_objects/axis/encoders.hpp"
#include "tech_objects/axis/forces.hpp"
#include "tech_objects/axis/homing_course.hpp"
#include "tech_objects/axis/job_slots.hpp"
#include "tech_objects/axis/limit_switches.hpp"
#include "tech_objects/axis/motion_limits.hpp"
#include "tech_objects/axis/position_loop.hpp"
#include "tech_objects/axis/software_limits.hpp"
#include "tech_objects/axis/superimposed_motion.hpp"
#include "tech_objects/data_blocks/standstill.hpp"
#include "tech_objects/data_blocks/variable.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/jobs/job.hpp"
#include "tech_objects/jobs/override.hpp"
#include "tech_objects/objects/leading_object.hpp"
#include "tech_objects/profile/single_axis_motion.hpp"
#include "tech_objects/profile/superimposed.hpp"
#include "tech_objects/sensing/homing_marks.hpp"
#include "tech_objects/synchronous/synchronous_motion.hpp"

namespace lockstep {

/// What MC_LeadingValueAdditive and MC_SynchronizedMotionSimulation want; written by the instance that was
/// enabled last.
struct AdditiveRequest {
  const void* owner = nullptr;  ///< nullptr: none is enabled
  bool counts = false;          ///< whether the value counts; else the job waits for the enable of the axis
  AdditiveLeadingValue value;
};
struct SimulationRequest {
  const void* owner = nullptr;  ///< nullptr: no instance has asked yet
  BOOL enable{};
  ErrorId error = ErrorId::none;  ///< written by the axis: why it has not begun, or cannot end
};

/// Adjustment of an absolute encoder, for a store that outlasts the controller.
struct EncoderAdjustment {
  bool adjusted = false;
  /// [u] StatusSensor[].AbsEncoderOffset: position of the axis less that of the encoder.
  double offset = 0.0;
};

/// The parts of an axis, each with its own state; what moves between them is the matter of `AxisOrders`. What
/// every interpolator cycle touches lies together, and so does what every servo cycle touches.
class AxisParts : public LeadingObject {
 public:
  using LeadingObject::LeadingObject;

  /// The technology data block. The project sets start values before `configure`; afterwards DIR and CAL
  /// variables may be written in the cycle, the rest is computed.
  alignas(kCacheLine) AxisData data;

  /// The leading values with which this axis is interconnected; only these may be named by jobs.
  std::vector<LeadingValue> leading_values;

  /// The drive and the machine behind it; they count unless the axis is virtual.
  DriveSettings drive_settings;
  /// Which kind of drive it is; never nullptr.
  const DriveModel* drive_model = nullptr;

  /// The adjustments of absolute encoders that are kept: may be set before `configure`, and read at any time
  /// in the thread of the cycle. Count for Sensor[].Type 1 and 2. A restart of the object keeps them.
  static constexpr std::size_t kSensors = Encoders::kCount;
  std::array<EncoderAdjustment, kSensors> encoder_adjustments;

  bool is_virtual() const noexcept { return data.VirtualAxis.Mode == 1; }
  /// A TO_SpeedAxis has none: it is moved without position control, and its user unit is the turn of the load
  /// per unit of time (Units.VelocityUnit) and second.
  bool has_position() const noexcept { return has_position_; }

  /// Number of the alarm with a reaction that is pending; 0: none.
  int pending_alarm() const noexcept { return static_cast<int>(data.ErrorDetail.Number); }

  bool simulating() const noexcept { return simulated_ != nullptr; }

 protected:
  // Values of Units.VelocityUnit of a speed axis.
  static constexpr UDINT kTurnsPerSecond = 1082;
  static constexpr UDINT kTurnsPerMinute = 1083;
  static constexpr std::uint8_t kNothingShown = 0xFF;
  static constexpr std::uint8_t kOperatingShown = 1;  // in operation, not disabled

  /// What generates the setpoint.
  enum class Motion : std::uint8_t { none, single_axis, given, synchronizing, synchronous, desynchronizing };
  enum class EmergencyRamp : std::uint8_t { none, due, running };

  /// Whether a velocity is one beyond the standstill signal.
  bool moving(double velocity) const noexcept {
    return std::abs(velocity) > data.StandstillSignal.VelocityThreshold;
  }
  /// Whether another object leads the axis.
  bool led() const noexcept { return motion_ >= Motion::synchronizing; }
  /// The setpoint without what is superimposed on it.
  const Setpoint& base_setpoint() const noexcept {
    return superimposed_.in_use() ? superimposed_.base() : setpoint_;
  }

  // From here to `additive_`: what every interpolator cycle touches, in lines of the cache.
 public:
  alignas(kCacheLine) AdditiveRequest additive_request;
  SimulationRequest simulation_request;
  /// Whether a control panel has the axis in its hands: it has enabled it, or a job of it runs. Written by
  /// the program of the panel.
  BOOL control_panel{};
  /// Has every cycle carried out in full, whatever happens in it: for comparisons.
  bool never_plain = false;
  /// Raised when a coupling has changed, so that the order of the axes is built anew.
  bool coupling_changed = false;
  /// Whether the awaited leading axis is stepped before this one; told by the order.
  bool awaited_axis_in_order = true;

 protected:
  Motion motion_ = Motion::none;
  bool homed_ = false;
  bool has_drive_ = false;
  SoftwareLimits software_limits_;
  EmergencyRamp emergency_ramp_ = EmergencyRamp::none;
  bool homing_now_ = false;  // a mark is being looked for, or an active homing is under way

  alignas(kCacheLine) JobSlots jobs_;

  double period_ = 0.001;          // of the interpolator [s]
  Job* simulated_ = nullptr;       // the gear that is simulated
  std::int64_t counted_from_ = 0;  // turn that ModuloCycle shows as 0
  AxisPosition actual_;
  double actual_velocity_ = 0.0;  // [u/s]
  int servo_tick_ = 0;            // since the last interpolator tick
  bool signals_watched_ = false;
  std::uint8_t drive_shown_ = kNothingShown;  // of StatusDrive

  /// What leads the axis by `synchronous_`; nullptr without coupling, and without cam.
  struct Coupled {
    LeadingObject* leading = nullptr;
    Cam* cam = nullptr;
  };
  Coupled coupled_;
  SynchronousMotion synchronous_;

  // One line, with the end of the one and the begin of the other.
  SuperimposedMotion superimposed_;
  Standstill standstill_;
  double largest_deviation_ = 0.0;
  bool was_synchronous_ = false;
  AdditiveLeadingValues additive_;

  alignas(kCacheLine) MotionLimits limits_{data};
  SingleAxisMotion single_;
  LimitSwitches limit_switches_;

  // Positioning.
  Arrival arrival_;
  Blending blending_;
  DoubleDouble beyond_target_;  // way that the axis has made since the target of the motion before [u]
  Job jogged_;                  // inputs of MC_MoveJog that are planned for

  // Jobs.
  SynchronousMotion awaited_;  // what the waiting job prepares
  Setpoint ghost_;             // where it would have the axis
  AxisData start_values_;

  // Homing.
  HomingCourse homing_;

  // What every servo cycle touches, in lines of the cache.
  alignas(kCacheLine) double servo_period_ = 0.001;  // [s]
  int ratio_ = 1;
  bool drive_running_ = false;
  bool drive_in_trouble_ = false;
  bool drive_inhibited_ = false;
  double setpoint_sign_ = 1.0;  // -1: the drive turns the other way round

  double way_per_motor_turn_ = 1.0;  // [u]
  double motor_limit_ = 0.0;         // what the motor can do [u/s]
  double actual_torque_ = 0.0;       // at the motor, in the direction of the axis
  std::uint16_t sent_stw1_ = kControlOff;
  Encoders encoders_;
  AxisForces forces_;
  Clamping clamping_;
  std::unique_ptr<Drive> drive_;  // nullptr: a virtual axis
  DriveProperties drive_properties_;
  PositionLoop loop_;

  // Servo, seldom of account.
  CourseHandOver hand_over_;
  struct ControlBits {
    std::uint16_t stw1 = 0;
    std::uint16_t stw2 = 0;
  };
  ControlBits free_bits_;  // of MC_SetAxisSTW
  Backlash backlash_;
};

}  // namespace lockstep
