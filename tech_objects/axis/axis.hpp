/// An axis: TO_SpeedAxis, TO_PositioningAxis and TO_SynchronousAxis. It owns its motion; a function block
/// only asks.
///
/// In the interpolator each axis goes through start_jobs → step → guard → publish, leading axes before
/// following ones. All functions below "Cycle" run in the thread of the cycle; they neither allocate nor
/// block.
/// @source S7-1500T synchronous operation V7, 4.5, 6, 13.1; S7-1500T axis functions
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tech_objects/arithmetic/axis_position.hpp"
#include "tech_objects/axis/forces.hpp"
#include "tech_objects/data_blocks/standstill.hpp"
#include "tech_objects/data_blocks/variable.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/drive/setpoint_filter.hpp"
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
  double offset =
      0.0;  ///< [u] StatusSensor[].AbsEncoderOffset: position of the axis less that of the encoder
};

class Axis final : public LeadingObject {
 public:
  Axis(ObjectKind kind, std::string name, DB_ANY number);

  // ---- Load time
  // --------------------------------------------------------------------------------------------------

  /// The technology data block. The project sets start values before `configure`; afterwards DIR and CAL
  /// variables may be written in the cycle, the rest is computed.
  alignas(kCacheLine) AxisData data;

  /// The leading values with which this axis is interconnected; only these may be named by jobs.
  std::vector<LeadingValue> leading_values;

  /// Model of the simulated drive; counts unless the axis is virtual.
  SimulatedDriveSettings drive_settings;

  /// The adjustments of absolute encoders that are kept: may be set before `configure`, and read at any time
  /// in the thread of the cycle. Count for Sensor[].Type 1 and 2. A restart of the object keeps them.
  static constexpr std::size_t kSensors = 4;
  std::array<EncoderAdjustment, kSensors> encoder_adjustments;

  /// Takes over the start values. Call once, after `data` is set and before the first tick.
  /// @param servo_period period of MC_Servo [s]  @param ratio servo ticks per interpolator tick, 1 to 32
  void configure(double servo_period, int ratio) override;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &start_values_; }

  bool is_virtual() const noexcept { return data.VirtualAxis.Mode == 1; }
  /// A TO_SpeedAxis has none: it is moved without position control, and its user unit is the turn of the load
  /// per unit of time (Units.VelocityUnit) and second.
  bool has_position() const noexcept { return has_position_; }

  // ---- Cycle: called by blocks
  // ------------------------------------------------------------------------------------

  /// Hands a job over; it starts at the next interpolator tick. With no space left it fails with 16#8014 at
  /// once. The job stays where it is until it has ended.
  void submit(Job& job) noexcept override;

  bool simulating() const noexcept { return simulated_ != nullptr; }

  /// Requests of the torque blocks, which write them only when nothing is refused, and what has become of
  /// them.
  AxisForces& forces() noexcept { return forces_; }
  ErrorId torque_limiting_refusal(DINT mode) const noexcept;
  ErrorId torque_range_refusal() const noexcept;
  ErrorId torque_additive_refusal() const noexcept;
  /// Drives bits of the control words that the axis does not use itself: STW1 8, 9, 11 to 15, STW2 0 to 11.
  /// They stay until the next call or a restart.
  ErrorId set_control_bits(WORD stw1, WORD stw1_mask, WORD stw2, WORD stw2_mask) noexcept;
  /// What MC_WriteParameter may write at run time.
  ErrorId activate_limit_switches(bool active) noexcept;
  /// MC_SetSensor, at once. @param sensor, reference 1 to 4
  ErrorId set_sensor(DINT sensor, DINT mode, DINT reference) noexcept;

  /// Number of the alarm with a reaction that is pending; 0: none.
  int pending_alarm() const noexcept { return static_cast<int>(data.ErrorDetail.Number); }

  // ---- Cycle: called by the scheduler
  // -----------------------------------------------------------------------------

  /// One servo tick: reads actual values, closes the position loop, writes the setpoint to the drive.
  void servo() noexcept;

  /// Starts the jobs handed over since the last interpolator tick, by the override rules.
  void start_jobs() noexcept;
  bool has_new_jobs() const noexcept { return new_count_ != 0; }

  /// Alarm 601 if the object that leads this axis has been restarted: where it is then has no meaning for it.
  void watch_leading_object() noexcept;

  /// Begins to bring near, while another axis is stepped, what `step` and `publish` touch first.
  void come_near() const noexcept {
    __builtin_prefetch(&power, 1);
    __builtin_prefetch(&setpoint_, 1);
    __builtin_prefetch(&additive_request, 1);
    __builtin_prefetch(running_.data(), 1);
    __builtin_prefetch(&period_, 1);
    __builtin_prefetch(&standstill_, 1);
    __builtin_prefetch(&data.Position, 1);
    __builtin_prefetch(&data.StatusSynchronizedMotion, 1);
    __builtin_prefetch(&data.StatusSynchronizedMotion.EffectiveLeadingValue, 1);
    __builtin_prefetch(&data.StatusWord, 1);
  }

  /// One interpolator cycle: the setpoint of this tick. Leading axes have to be stepped before.
  void step() noexcept;

  /// Checks the setpoint and shows everything in the data block.
  void publish() noexcept;

  /// Leading axes on which this axis depends: the coupled one and the one that a waiting job names; nullptr:
  /// none, or an object that depends on no other.
  Axis* coupled_leading_axis() const noexcept;
  Axis* awaited_leading_axis() const noexcept;
  /// Raises a technology alarm: shows it and has its reaction carried out.
  void raise(int alarm_number) noexcept;

  bool leading_value_stands() const noexcept override {
    const bool stands = setpoint_is_actual() ? !moving(setpoint_.velocity) : setpoint_.velocity == 0.0;
    return stands && (!handing_over_ || hand_over_.finished());
  }

  AxisPosition actual_position() const noexcept override { return actual_; }
  bool measured_in_servo() const noexcept override { return has_drive_; }
  DoubleDouble measured_line() const noexcept override { return encoder_position_; }

  bool stopping() const noexcept {
    return power_state_ == PowerState::braking || power_state_ == PowerState::drive_stops;
  }
  /// False while encoder or communication are lost, until that is acknowledged.
  bool actual_values_valid() const noexcept override { return !sensor_lost_; }
  bool homing() const noexcept override { return homing_now_; }
  const SimulatedDrive& drive() const noexcept { return drive_; }
  /// Whether this axis is `leading` or follows, over any number of couplings, one that is.
  bool led_by_this(const LeadingObject* leading) const noexcept;
  /// Largest distance between actual position and synchronous function while synchronous [u], for the summary
  /// of a run.
  double largest_synchronous_deviation() const noexcept { return largest_deviation_; }
  bool was_synchronous() const noexcept { return was_synchronous_; }

 private:
  // Values of Units.VelocityUnit of a speed axis.
  static constexpr UDINT kTurnsPerSecond = 1082;
  static constexpr UDINT kTurnsPerMinute = 1083;
  /// Value of StatusSensor.State: the actual value is valid.
  static constexpr DINT kSensorValid = 2;
  static constexpr std::uint8_t kNothingShown = 0xFF;

  /// What generates the setpoint.
  enum class Motion : std::uint8_t { none, single_axis, given, synchronizing, synchronous, desynchronizing };
  /// Places of running jobs: the base motion, synchronous and desynchronizing jobs that wait, shifts, what is
  /// superimposed on the base motion, the next base motion, homing in passing.
  enum Slot : std::uint8_t {
    kBase,
    kWaiting,
    kWaitingOut,
    kPhasing,
    kOffset,
    kSuperimposed,
    kBuffered,
    kPassiveHoming,
    kSlots
  };

  // axis.cpp: power, alarms, the cycle
  void take_start_values() noexcept;
  std::int64_t ticks_of(double seconds) const noexcept;
  void step_power() noexcept;
  void switch_on() noexcept;
  void take_up_motion() noexcept;
  void begin_braking(INT stop_mode) noexcept;
  void switch_off() noexcept;
  void follow_actual() noexcept;
  bool moving(double velocity) const noexcept {
    return std::abs(velocity) > data.StandstillSignal.VelocityThreshold;
  }
  void set_position_control(bool on) noexcept;
  void raise(int alarm_number, AlarmReaction reaction) noexcept;
  void react(AlarmReaction reaction) noexcept;
  bool outranked_by_stop(AlarmReaction reaction) const noexcept;
  ErrorId reset(bool restart) noexcept;
  void restart() noexcept;
  void step_base() noexcept;
  void guard() noexcept;

  // axis_jobs.cpp: taking jobs over, override rules, ends
  void start(Job& job) noexcept;
  ErrorId check(const Job& job) const noexcept;
  ErrorId check_synchronous(const Job& job) const noexcept;
  int missing_precondition(const Job& job) const noexcept;
  const LeadingValue* find_leading_value(const LeadingObject* master) const noexcept;
  bool override_running(JobClass new_job, Job& job) noexcept;
  void cancel_waiting_shift(Job& job) noexcept;
  ErrorId check_cam(const Job& job) const noexcept;
  bool runs_or_waits(bool cam) const noexcept;
  void install(Job& job) noexcept;
  void end_job(Slot slot, JobPhase phase, ErrorId error) noexcept;
  void end_all_jobs(JobPhase phase, ErrorId error) noexcept;
  bool locked_by_stop() const noexcept {
    return stop_ != nullptr && (stop_->running() || (stop_->phase == JobPhase::done && stop_->hold));
  }

  // axis_homing.cpp: MC_Home
  enum class HomingPhase : std::uint8_t {
    none,
    approach,  // to the reference cam or switch
    clear,     // off the switch again, to meet its edge from outside
    back,      // beyond a zero mark, to meet it in the homing direction
    search,    // towards the mark, with the homing velocity
    travel     // the mark is known: to the home position
  };
  struct Homing {
    HomingPhase phase = HomingPhase::none;
    int direction = 1;      // in which the mark has to be met
    bool reversed = false;  // at a hardware limit switch
    double mark = 0.0;      // position that the mark gets [u]
    // As they were when the job was taken over; changed later, they count for the next one.
    double approach_velocity = 0.0;     // [u/s]
    double referencing_velocity = 0.0;  // [u/s]
    bool positive_side = false;         // of the switch
  };
  ErrorId check_homing(const Job& job) const noexcept;
  int missing_for_homing(const Job& job) const noexcept;
  HomeSwitch home_switch(bool active) const noexcept;
  void home(Job& job) noexcept;
  void home_directly(Job& job) noexcept;
  void begin_passive_homing(Job& job) noexcept;
  void begin_active_homing(Job& job) noexcept;
  PlanResult plan_homing(const Job& job, const Dynamics& dynamics) noexcept;
  void step_homing() noexcept;
  void guide_active_homing(Job& job) noexcept;
  void reverse_at_limit_switch(Job& job) noexcept;
  void head_for(Job& job, HomingPhase phase, int direction) noexcept;
  void search_mark(bool active, int direction) noexcept;
  void take_mark() noexcept;
  bool assign_position(AxisPosition place, double position) noexcept;
  bool positions_fit(double by) const noexcept;
  bool homing_reverses() const noexcept {
    return homing_.phase != HomingPhase::none && homing_.phase != HomingPhase::travel &&
           data.Homing.AutoReversal;
  }
  void leave_homing(const Job& job) noexcept;
  void home_sensor_beside(Job& job) noexcept;
  std::size_t sensor_of(const Job& job) const noexcept;
  void shift_sensors_beside(double by) noexcept;
  void adjust_encoder(std::size_t sensor, bool store) noexcept;
  double encoder_start(std::size_t sensor) const noexcept;
  void restore_encoder(std::size_t sensor) noexcept;
  bool absolute_encoder(std::size_t sensor) const noexcept {
    return has_drive_ && data.Sensor[sensor].Type != 0;
  }
  bool absolute_encoder() const noexcept { return absolute_encoder(operative_); }
  double position_shift(double home_position) const noexcept;
  void shift_positions(double by) noexcept;
  void shift_coupling(double by) noexcept;
  void show_renamed() noexcept;

  // axis_sensors.cpp: the encoders
  /// An encoder; of the operative one, origin and sign are `encoder_origin_` and `encoder_sign_`.
  struct Encoder {
    AxisPosition origin;    // position where it shows 0
    AxisPosition seen;      // that it shows
    DoubleDouble reading;   // what it has counted, as it lies [u]; of the drive's own: `encoder_position_`
    double sign = 1.0;      // -1: it turns the other way round
    double velocity = 0.0;  // as it lies [u/s]
    double lent = 0.0;      // by what MC_SetSensor has shifted an absolute one, until it is left [u]
    bool failed = false;
  };
  void take_sensors() noexcept;
  void begin_sensors(AxisPosition here) noexcept;
  bool sensor_exists(std::size_t sensor) const noexcept;
  /// @param sensor 1 to 3: those beside the drive's own
  const SimulatedSensor& sensor_model(std::size_t sensor) const noexcept {
    return drive_settings.sensors[sensor - 1];
  }
  double encoder_ratio() const noexcept;
  DoubleDouble travel(std::size_t sensor) const noexcept;
  void show_sensor() noexcept;
  void show_place(std::size_t sensor, AxisPosition place) noexcept;
  void read_sensors(DriveActual& now) noexcept;
  void show_beside(std::size_t sensor, bool failed) noexcept;
  AxisPosition sensor_position(std::size_t sensor) const noexcept;
  void place_sensor(std::size_t sensor, AxisPosition place) noexcept;
  void switch_sensor(std::size_t sensor, bool aligned) noexcept;
  void deviate(AxisPosition place) noexcept;

  // axis_switches.cpp: signals of the machine, hardware limit switches
  struct LimitSwitch {
    bool pressed = false;
    bool beyond = false;   // pressed, or overrun and not yet come back over
    bool locked = false;   // approached in the wrong direction: until a restart
    double entered = 0.0;  // where it was met [u] on the scale of the machine
  };
  bool signals_always_watched() const noexcept;
  void watch_signals(const DoubleDouble& position) noexcept;
  /// After which way the machine is where it was [u]; 0: never.
  double turn() const noexcept { return modulo_.enabled ? modulo_.length : 0.0; }
  bool on_home_switch(double place) const noexcept;
  bool limit_switch_pressed(int side, double place) const noexcept;
  void watch_limit_switch(int side, double place) noexcept;
  void hold_limit_switches() noexcept;
  AlarmReaction limit_switch_reaction() const noexcept;

  // axis_motion.cpp: motion of its own
  double velocity_limit() const noexcept;
  double wanted_velocity(const Job& job) const noexcept;
  void take_defaults(Job& job) const noexcept;
  Dynamics effective_dynamics(const Job& job) noexcept;
  Dynamics own_dynamics(const Job& job) noexcept;
  void keep_below_limit(Dynamics& dynamics) const noexcept;
  void keep_below_limit(Dynamics& dynamics, double acceleration, double room) const noexcept;
  double room_to_limit() const noexcept;
  double room_to_limit(const Setpoint& from, double beside = 0.0) const noexcept;
  double tolerable_acceleration(double acceleration, double room) const noexcept;
  void cut_acceleration() noexcept {
    setpoint_.acceleration = tolerable_acceleration(setpoint_.acceleration, room_to_limit());
  }
  Dynamics maximum_dynamics() const noexcept;
  Dynamics emergency_dynamics() const noexcept;
  Dynamics maximum_for_current(Dynamics dynamics) const noexcept;
  int zero_limit(const Dynamics& dynamics) const noexcept;
  ErrorId target_refusal(const Job& job) const noexcept;
  void begin_base_motion(Job& job) noexcept;
  PlanResult plan(Job& job, const Dynamics& dynamics) noexcept;
  void show_target(const AxisPosition& target) noexcept;
  PlanResult move_by(DoubleDouble way, const Job& job, const Dynamics& dynamics) noexcept;
  DoubleDouble absolute_way(const Job& job, const Dynamics& dynamics) const noexcept;
  double beyond_stopping_distance(double distance, const Dynamics& dynamics) const noexcept;
  double absolute_distance(const Job& job, double here) const noexcept;
  void begin_stop(const Dynamics& dynamics, bool abort_acceleration) noexcept;
  void step_single_axis() noexcept;
  void follow_changes(Job& job) noexcept;
  void remember_limits() noexcept;
  bool limits_changed() const noexcept {
    const TO_Struct_DynamicLimits& now = data.DynamicLimits;
    return data.Override.Velocity != planned_.override_velocity || now.Velocity != planned_.velocity ||
           now.MaxAcceleration != planned_.acceleration || now.MaxDeceleration != planned_.deceleration ||
           now.MaxJerk != planned_.jerk;
  }
  void watch_base_job(Job& job) noexcept;
  void watch_positioning() noexcept;
  void watch_standstill() noexcept;

  // axis_emergency.cpp: the emergency ramp of an axis with a drive, from where it is
  enum class EmergencyRamp : std::uint8_t { none, due, running };
  void ask_for_emergency_ramp() noexcept;
  void step_emergency_ramp() noexcept;
  void brake_from_actual() noexcept;
  void take_actual_state(double commanded) noexcept;
  void stay_within_limits(const Setpoint& before) noexcept;
  double commanded_velocity() const noexcept;
  double smoothed_switchover(double velocity) noexcept;
  void tune_controller(const PositionControlSettings& settings) noexcept;

  // axis_hand_over.cpp: the setpoint as following axes see it where it goes over to another course
  void hand_over(const Setpoint& seen, const Setpoint& now) noexcept;
  void hand_over_to_actual() noexcept;
  bool run_down(Superimposed& part, const Setpoint& ahead) noexcept;
  Setpoint handed_over() const noexcept;
  void lead_with_position_control(bool on) noexcept;
  void step_hand_over() noexcept;

  // axis_synchronous.cpp: motion led by another axis
  void begin_gear_in(Job& job) noexcept;
  void begin_waiting(Job& job) noexcept;
  void watch_waiting() noexcept;
  void activate_waiting(Motion motion) noexcept;
  void look_at_coupling(const Job& job) noexcept;
  void step_synchronous() noexcept;
  void leave_synchronous() noexcept;
  void forget_coupling() noexcept;
  void show_coupling(const Job& job, Motion motion) noexcept;
  void clear_cam_status() noexcept;
  void meet_cam_end() noexcept;
  void take_additive() noexcept;
  void begin_shift(Job& job) noexcept;
  void show_shift(Slot slot, const Shift& shift, Shift::Event event) noexcept;
  void advance_shifts() noexcept;
  bool led() const noexcept { return motion_ >= Motion::synchronizing; }

  // axis_buffer.cpp: a job that waits for the end of another, and blending
  struct Blending {
    double way;         // of the next motion from the target of this one; its direction if endless [u]
    bool endless;       // whether it has no target that it must not pass
    Dynamics dynamics;  // of the next motion
  };
  bool buffer(Job& job) noexcept;
  void watch_buffered() noexcept;
  void speed_up_for_junction() noexcept;
  bool due_to_speed_up(double distance, const Dynamics& dynamics) const noexcept;
  double highest_junction_velocity(double distance, double wanted, const Blending& blending,
                                   const Dynamics& dynamics) const noexcept;
  void plan_blending() noexcept;
  Blending blending_into(const Job& next) noexcept;
  double wanted_blending_velocity(BufferMode mode, double previous, double next) const noexcept;
  bool next_can_take_over(const Blending& next, double velocity) const noexcept;

  // axis_motion_in.cpp: setpoints given by the program
  void begin_motion_in(Job& job) noexcept;
  void step_given() noexcept;
  AxisPosition given_position(double position) const noexcept;
  void show_motion_in_command() noexcept;

  // axis_superimposed.cpp: what is added to the base motion
  void begin_superimposed(Job& job) noexcept;
  ErrorId begin_superimposed_part(Job& job) noexcept;
  void take_position_control() noexcept;
  Dynamics superimposed_room() const noexcept;
  Dynamics left_by_base() const noexcept;
  Dynamics quick_enough(Dynamics room) noexcept;
  Dynamics first_room() noexcept;
  void follow_room() noexcept;
  void replan_stop() noexcept;
  double velocity_left_by_base(int side) const noexcept;
  bool stays_against_superimposed(const Job* job, const Dynamics& dynamics) const noexcept;
  void leave_to_superimposed(const Job* job, Dynamics& dynamics) noexcept;
  bool superimposed_runs_down() const noexcept;
  void step_superimposed() noexcept;
  void advance_superimposed_in_view() noexcept;
  void advance_superimposed() noexcept;
  void follow_given_superimposed(Job& job) noexcept;
  void add_superimposed() noexcept;
  Setpoint with_superimposed(const Setpoint& base) const noexcept;
  void absorb_superimposed() noexcept;
  void show_superimposed_command() noexcept;
  const Setpoint& base_setpoint() const noexcept { return superimposed_.in_use() ? base_ : setpoint_; }

  // axis_desynchronizing.cpp: out of a synchronous motion, and its simulation
  void begin_sync_out(Job& job) noexcept;
  bool watch_sync_out(const Setpoint& candidate) noexcept;
  void activate_sync_out(Job& job, const Dynamics& dynamics) noexcept;
  void end_desynchronizing() noexcept;
  void watch_simulation() noexcept;
  void show_passes() noexcept;
  bool coupling_stands(const Setpoint& setpoint) const noexcept;
  void begin_simulation() noexcept;
  ErrorId check_end_of_simulation() const noexcept;
  void end_simulation() noexcept;
  void end_simulated_gear(JobPhase phase, ErrorId error) noexcept;

  // axis_servo.cpp: drive and position control
  void configure_servo();
  void restart_servo() noexcept;
  void take_servo_settings() noexcept;
  PositionControlSettings control_settings() const noexcept;
  double way_per_motor_turn() const noexcept;
  double motor_angle_per_unit() const noexcept;
  void limit_speed() noexcept;
  void control_position() noexcept;
  void show_execution_time() noexcept;
  double setpoint_delay() const noexcept;
  double control_delay() const noexcept;
  void reset_servo(const ServoSetpoint& setpoint) noexcept;
  void delay_following_error(const PositionControlled& controlled) noexcept;
  void shift_servo(double by) noexcept;
  void idle_servo() noexcept;
  /// Dynamic servo control: the drive closes the position loop, on its own encoder.
  bool loop_in_drive() const noexcept { return data.PositionControl.EnableDSC && operative_ == 0; }

  // axis_backlash.cpp
  double pass_backlash() noexcept;
  double backlash_offset() const noexcept { return data.Sensor[0].Backlash.Enable ? backlash_.passed : 0.0; }
  /// The play lies between the motor, with its encoder, and the load: another encoder sees it by itself.
  bool passes_backlash() const noexcept { return data.Sensor[0].Backlash.Enable && operative_ == 0; }

  // axis_forces.cpp: torque limiting, torque data, fixed stop
  void step_forces() noexcept;
  void show_forces() noexcept;
  double limit_at_motor() const noexcept;
  TorqueBand torque_band() const noexcept;
  bool position_monitoring_off() const noexcept;
  bool pushes_against_a_stop() const noexcept;
  void watch_fixed_stop() noexcept;
  void freeze_setpoint() noexcept;
  void watch_clamping() noexcept;
  void leave_fixed_stop() noexcept;
  ErrorId check_at_fixed_stop(const Job& job) const noexcept;
  static ErrorId away_from_stop(double way, int side) noexcept;

  // axis_faults.cpp: drive and encoder that fail, control words
  void watch_drive(const DriveActual& now) noexcept;
  void raise_drive_alarms(const DriveActual& now) noexcept;
  void lose_sensor() noexcept;
  void regain_sensor() noexcept;
  void acknowledge_drive() noexcept;
  void control_drive(std::uint16_t stw1) noexcept;

  // axis_monitoring.cpp: range of positions, software limit switches, following error
  bool far_from_end_of_range() const noexcept;
  void watch_range() noexcept;
  bool keep_in_range(int side) noexcept;
  void pass_end_of_range() noexcept;
  struct PositionLimits {
    double least;     // [u]
    double greatest;  // [u]
  };
  PositionLimits position_limits() const noexcept;
  void watch_position_limits() noexcept;
  void hold_limits(const PositionLimits& limits, bool rests) noexcept;
  void show_limit(const PositionLimits& limits) noexcept;
  bool keep_within(int side, double limit) noexcept;
  bool turns_in_time(int side, double room, double jerk) const noexcept;
  Dynamics limit_dynamics() const noexcept;
  bool find_braking(int side, double room, Dynamics& dynamics) const noexcept;
  void stop_at_limit(int side, AxisPosition limit, Dynamics dynamics) noexcept;
  AlarmReaction reaction_at_limit() const noexcept;
  void approach_limit(double way, AxisPosition limit, const Dynamics& dynamics) noexcept;
  double permissible_following_error(double velocity) const noexcept;
  void watch_following_error(double velocity) noexcept;

  // axis_publish.cpp: the data block
  void publish_motion() noexcept;
  void publish_awaited() noexcept;
  void publish_synchronous() noexcept;
  void show_shifts() noexcept;
  std::uint32_t bits_of_excess() const noexcept;
  std::uint32_t bits_beyond_limits() const noexcept;
  void watch_deviation() noexcept;
  void publish_status() noexcept;
  void show_drive_state() noexcept;
  std::uint32_t pace_bits() const noexcept;
  std::uint32_t bits_when_on() const noexcept;

  // From here to `additive_`: what every interpolator cycle touches, in lines of the cache.
 public:
  alignas(kCacheLine) AdditiveRequest additive_request;
  SimulationRequest simulation_request;
  /// Whether a control panel has the axis in its hands: it has enabled it, or a job of it runs. Written by
  /// the program of the panel.
  BOOL control_panel{};
  /// Raised when a coupling has changed, so that the order of the axes is built anew.
  bool coupling_changed = false;
  /// Whether the awaited leading axis is stepped before this one; told by the order.
  bool awaited_axis_in_order = true;

 private:
  Motion motion_ = Motion::none;
  bool homed_ = false;
  bool has_drive_ = false;
  std::int8_t limit_side_ = 0;  // software limit switch approached or passed: 1, -1; 0: none
  EmergencyRamp emergency_ramp_ = EmergencyRamp::none;
  bool homing_now_ = false;  // a mark is being looked for, or an active homing is under way

  alignas(kCacheLine) std::array<Job*, kSlots> running_{};

  double period_ = 0.001;          // of the interpolator [s]
  Job* stop_ = nullptr;            // the MC_Stop that may lock the axis
  Job* simulated_ = nullptr;       // the gear that is simulated
  std::int64_t counted_from_ = 0;  // turn that ModuloCycle shows as 0
  AxisPosition actual_;
  double actual_velocity_ = 0.0;  // [u/s]
  int servo_tick_ = 0;            // since the last interpolator tick
  std::uint8_t new_count_ = 0;    // of new_jobs_
  bool signals_watched_ = false;
  bool beyond_limit_switch_ = false;
  std::uint8_t drive_shown_ = kNothingShown;  // of StatusDrive

  /// What leads the axis by `synchronous_`; nullptr without coupling, and without cam.
  struct Coupled {
    LeadingObject* leading = nullptr;
    Cam* cam = nullptr;
  };
  Coupled coupled_;
  SynchronousMotion synchronous_;

  // One line, with the end of the one and the begin of the other.
  Superimposed superimposed_;
  Standstill standstill_;
  double largest_deviation_ = 0.0;
  bool was_synchronous_ = false;
  bool advancing_base_ = false;  // `setpoint_` is that of the base motion alone, within a step
  AdditiveLeadingValues additive_;

  /// What the motion at hand has been planned with. MaxVelocity changes with a restart only.
  struct PlannedLimits {
    double override_velocity = 100.0;  // [%]
    double velocity = 0.0;             // [u/s]
    double acceleration = 0.0;         // [u/s²]
    double deceleration = 0.0;         // [u/s²]
    double jerk = 0.0;                 // [u/s³]
  };
  alignas(kCacheLine) PlannedLimits planned_;
  SingleAxisMotion single_;
  std::array<LimitSwitch, 2> limit_switches_{};  // negative, positive

  // Superimposed motion.
  Setpoint base_;                    // the setpoint without the superimposed part, while there is one
  Dynamics superimposed_wanted_;     // what MC_MoveSuperimposed asks for, before override and limits
  Dynamics superimposed_room_;       // of that, what it has been planned with
  bool base_curbed_ = false;         // the base motion has been planned with less, for what is superimposed
  bool curbed_for_a_while_ = false;  // by what that runs down yet

  // Positioning and limits.
  bool was_controlled_ = false;      // in the last cycle, for the software limit switches
  PositionLimits held_limits_{};     // the software limit switches for the present motion [u]
  std::int8_t approached_side_ = 0;  // while the axis brakes in front of a limit switch
  std::int64_t in_window_ticks_ = 0;
  std::int64_t since_target_ticks_ = 0;
  DoubleDouble beyond_target_;      // way that the axis has made since the target of the motion before [u]
  Job jogged_;                      // inputs of MC_MoveJog that are planned for
  double junction_velocity_ = 0.0;  // for which the running motion has yet to speed up [u/s]; 0: none

  // Jobs.
  static constexpr std::size_t kNewJobs = 16;
  std::array<Job*, kNewJobs> new_jobs_{};  // handed over, in order
  SynchronousMotion awaited_;              // what the waiting job prepares
  Setpoint ghost_;                         // where it would have the axis
  AxisData start_values_;

  // Homing.
  Homing homing_;
  MarkSearch mark_search_;
  bool on_home_switch_ = false;

  // What every servo cycle touches, in lines of the cache.
  alignas(kCacheLine) double servo_period_ = 0.001;  // [s]
  int ratio_ = 1;
  bool several_encoders_ = false;  // there are others
  bool drive_running_ = false;
  bool drive_in_trouble_ = false;
  bool drive_inhibited_ = false;
  AxisPosition encoder_origin_;    // position where the drive is where it was at the beginning
  DoubleDouble encoder_position_;  // way of the drive from there [u], as it counts
  double encoder_sign_ = 1.0;
  double setpoint_sign_ = 1.0;  // -1: the drive turns the other way round

  double way_per_motor_turn_ = 1.0;  // [u]
  double motor_limit_ = 0.0;         // what the motor can do [u/s]
  std::size_t operative_ = 0;        // encoder, from 0
  double actual_torque_ = 0.0;       // at the motor, in the direction of the axis
  AxisPosition last_balanced_;
  bool sensor_lost_ = false;
  std::uint16_t sent_stw1_ = kControlOff;
  FirstOrderLag following_lag_;  // FollowingError.AdditionalSetpointDelayTime
  FirstOrderLag smoothing_;      // of what MC_SetSensor has changed
  FirstOrderLag switchover_;     // of the velocity for the drive, to the emergency ramp
  AxisForces forces_;
  SimulatedDrive drive_;
  PositionController controller_;

  // Servo, seldom of account.
  double xerr_ = 0.0;  // control difference for the position loop of the drive [u]
  double pace_ = 0.0;  // velocity of what that loop is to follow [u/s]
  std::array<Encoder, kSensors> encoders_;
  Superimposed hand_over_;      // what is left between the setpoint and what following axes see of it
  Superimposed return_;         // and of what axes see that follow its position since it was zero to them
  bool hand_over_due_ = false;  // switched off: with the next setpoint, which is the actual value
  DynamicFilter setpoint_filter_;
  struct ControlBits {
    std::uint16_t stw1 = 0;
    std::uint16_t stw2 = 0;
  };
  ControlBits free_bits_;  // of MC_SetAxisSTW
  struct Backlash {
    double passed = 0.0;        // way of the motor that the load has not made: 0, or ∓Size [u]
    std::int8_t direction = 0;  // of the last motion; 0: none yet
  };
  Backlash backlash_;
  Dynamics superimposed_uses_;  // of the limits, in this cycle and from it on
};

}  // namespace lockstep
