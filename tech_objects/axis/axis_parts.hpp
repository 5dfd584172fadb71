/// What an axis consists of: its data block, what blocks ask of it, and the parts that own its state.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "tech_objects/axis/arrival.hpp"
#include "tech_objects/axis/attention.hpp"
#include "tech_objects/axis/axis_requests.hpp"
#include "tech_objects/axis/axis_state.hpp"
#include "tech_objects/axis/backlash.hpp"
#include "tech_objects/axis/blending.hpp"
#include "tech_objects/axis/clamping.hpp"
#include "tech_objects/axis/configured_axis.hpp"
#include "tech_objects/axis/encoders.hpp"
#include "tech_objects/axis/forces.hpp"
#include "tech_objects/axis/homing_course.hpp"
#include "tech_objects/axis/job_slots.hpp"
#include "tech_objects/axis/limit_switches.hpp"
#include "tech_objects/axis/motion_limits.hpp"
#include "tech_objects/axis/position_loop.hpp"
#include "tech_objects/axis/shown_before.hpp"
#include "tech_objects/axis/software_limits.hpp"
#include "tech_objects/axis/superimposed_motion.hpp"
#include "tech_objects/data_blocks/status_bits.hpp"
#include "tech_objects/data_blocks/variable.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/profile/single_axis_motion.hpp"
#include "tech_objects/synchronous/synchronous_motion.hpp"
#include "tech_objects/types/published.hpp"

namespace lockstep {

/// The parts of an axis, each with its own state; what is done with them is the matter of its families. What
/// every interpolator cycle touches lies together, and so does what every servo cycle touches.
class AxisParts : public ConfiguredAxis {
 public:
  using ConfiguredAxis::ConfiguredAxis;

  /// The drive and the machine behind it; they count unless the axis is virtual.
  DriveSettings drive_settings;
  /// Which kind of drive it is; never nullptr.
  const DriveModel* drive_model = nullptr;

  /// The adjustments of absolute encoders that are kept: may be set before `configure`, and read at any time
  /// in the thread of the cycle. Count for Sensor[].Type 1 and 2. A restart of the object keeps them.
  static constexpr std::size_t kSensors = Encoders::kCount;
  std::array<EncoderAdjustment, kSensors> encoder_adjustments;

  bool is_virtual() const noexcept { return data.VirtualAxis.Mode == Activation::active; }
  /// A TO_SpeedAxis has none: it is moved without position control, and its user unit is the turn of the load
  /// per unit of time (Units.VelocityUnit) and second.
  bool has_position() const noexcept { return has_position_; }

  /// Number of the alarm with a reaction that is pending; 0: none.
  int pending_alarm() const noexcept { return static_cast<int>(data.ErrorDetail.Number); }

  bool simulating() const noexcept { return simulated_ != nullptr; }
  /// What leads the axis, or would without the simulation; nullptr: nothing.
  LeadingObject* coupled_to() const noexcept { return led() || simulating() ? coupled_.leading : nullptr; }

 protected:
  /// Whether another object leads the axis.
  bool led() const noexcept { return lockstep::led(motion_); }

  // From here to `additive_`: what every interpolator cycle touches, in lines of the cache.
 public:
  alignas(kCacheLine) AdditiveRequest additive_request;
  SimulationRequest simulation_request;
  /// Whether a control panel has the axis in its hands: it has enabled it, or a job of it runs. Written by
  /// the program of the panel.
  BOOL control_panel{};
  /// Load time. Has every cycle carried out in full, whatever happens in it: for comparisons.
  bool never_plain = false;
  /// Whether the awaited leading axis is stepped before this one; told by the order.
  bool awaited_axis_in_order = true;

 protected:
  AxisMotion motion_ = AxisMotion::none;
  bool homed_ = false;
  bool has_drive_ = false;
  bool always_in_full_ = false;  // its cycles, since it has a drive, or for a comparison
  SoftwareLimits software_limits_;
  EmergencyRamp emergency_ramp_ = EmergencyRamp::none;
  bool control_switched_ = false;  // position control, in this tick
  bool homing_now_ = false;        // a mark is being looked for, or an active homing is under way

  alignas(kCacheLine) JobSlots jobs_;

  double period_ = 0.001;          // of the interpolator [s]
  Job* simulated_ = nullptr;       // the gear that is simulated
  std::int64_t counted_from_ = 0;  // turn that ModuloCycle shows as 0
  AxisPosition actual_;
  double actual_velocity_ = 0.0;  // [u/s]
  int servo_tick_ = 0;            // since the last interpolator tick
  bool signals_watched_ = false;

  Coupled coupled_;
  SynchronousMotion synchronous_;

  // One line, with the end of the one and the begin of the other.
  SuperimposedMotion superimposed_;
  ShownBefore shown_before_;
  AdditiveLeadingValues additive_;

  alignas(kCacheLine) MotionLimits limits_{data};
  SingleAxisMotion single_;
  LimitSwitches limit_switches_;

  // Positioning.
  Arrival arrival_;
  Blending blending_;

  // Jobs.
 public:
  Attention attention;

 protected:
  SynchronousMotion awaited_;  // what the waiting job prepares
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

  double distance_per_motor_turn_ = 1.0;  // [u]
  double motor_limit_ = 0.0;              // what the motor can do [u/s]
  double actual_torque_ = 0.0;            // at the motor, in the direction of the axis
  Encoders encoders_;
  AxisForces forces_;
  Clamping clamping_;
  std::unique_ptr<Drive> drive_;  // nullptr: a virtual axis
  DriveProperties drive_properties_;
  PositionLoop loop_;

  Backlash backlash_;
};

}  // namespace lockstep
