/// What an axis does with its parts, job family by job family. Not public: `Axis` is the face.
#pragma once

#include "tech_objects/axis/axis_parts.hpp"

namespace lockstep {

/// The orders that the parts of an axis get. Each section is one source.
class AxisOrders : public AxisParts {
 public:
  using AxisParts::AxisParts;

  /// Raises a technology alarm: shows it and has its reaction carried out.
  void raise(int alarm_number) noexcept;

  /// Whether this axis is `leading` or follows, over any number of couplings, one that is.
  bool led_by_this(const LeadingObject* leading) const noexcept;

 protected:
  // axis.cpp: power, alarms, the cycle
  void take_start_values() noexcept;
  void step_power() noexcept;
  void switch_on() noexcept;
  void take_up_motion() noexcept;
  void begin_braking(PowerStopMode stop_mode) noexcept;
  void switch_off() noexcept;
  void follow_actual() noexcept;
  void set_position_control(bool on) noexcept;
  void raise(int alarm_number, AlarmReaction reaction) noexcept;
  void react(AlarmReaction reaction) noexcept;
  ErrorId reset(bool restart) noexcept;
  void restart() noexcept;
  void step_base() noexcept;
  void guard() noexcept;

  // jobs.cpp: taking jobs over, override rules, ends
  void start(Job& job) noexcept;
  ErrorId check(const Job& job) const noexcept;
  ErrorId check_synchronous(const Job& job) const noexcept;
  int missing_precondition(const Job& job) const noexcept;
  const LeadingValue* find_leading_value(const LeadingObject* master) const noexcept;
  bool override_running(JobClass new_job, Job& job) noexcept;
  void cancel_waiting_shift(Job& job) noexcept;
  ErrorId check_cam(const Job& job) const noexcept;
  void install(Job& job) noexcept;
  void end_job(Slot slot, JobPhase phase, ErrorId error) noexcept;
  void end_all_jobs(JobPhase phase, ErrorId error) noexcept;

  // homing.cpp: MC_Home
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
  void head_for(Job& job, HomingCourse::Phase phase, int direction) noexcept;
  void search_mark(bool active, int direction) noexcept;
  AxisPosition place_of_mark() const noexcept;
  void take_mark() noexcept;
  bool assign_position(AxisPosition place, double position) noexcept;
  bool positions_fit(double by) const noexcept;
  bool homing_reverses() const noexcept { return homing_.seeks() && data.Homing.AutoReversal; }
  void leave_homing() noexcept;
  void home_sensor_beside(Job& job) noexcept;
  std::size_t sensor_of(const Job& job) const noexcept;
  double position_shift(double home_position) const noexcept;
  void shift_positions(double by) noexcept;
  void shift_coupling(double by) noexcept;
  void show_renamed() noexcept;

  // sensors.cpp: what is shown of the encoders, MC_SetSensor, adjustments
  void begin_encoders(AxisPosition here) noexcept;
  AxisPosition adjusted_origin(std::size_t encoder) noexcept;
  void adjust_encoder(std::size_t encoder, bool store) noexcept;
  void show_sensor() noexcept;
  void show_place(std::size_t encoder, AxisPosition place) noexcept;
  void read_encoders(DriveActual& now) noexcept;
  void place_encoder(std::size_t encoder, AxisPosition place) noexcept;
  void switch_encoder(std::size_t encoder, bool aligned) noexcept;
  void deviate(AxisPosition place) noexcept;

  // switches.cpp: signals of the machine, hardware limit switches
  bool signals_always_watched() const noexcept;
  void watch_signals(const DoubleDouble& position) noexcept;
  /// After which way the machine is where it was [u]; 0: never.
  double turn() const noexcept { return modulo_.enabled ? modulo_.length : 0.0; }
  bool on_home_switch(double place) const noexcept;
  void watch_limit_switch(int side, double place, bool signal) noexcept;
  void hold_limit_switches() noexcept;

  // motion.cpp: motion of its own
  Dynamics effective_dynamics(const Job& job) noexcept;
  Dynamics own_dynamics(const Job& job) noexcept;
  double room_to_limit() const noexcept;
  void cut_acceleration() noexcept {
    setpoint_.acceleration = limits_.tolerable_acceleration(setpoint_.acceleration, room_to_limit());
  }
  Dynamics maximum_for_current(Dynamics dynamics) const noexcept;
  ErrorId target_refusal(const Job& job) const noexcept;
  void begin_base_motion(Job& job) noexcept;
  PlanResult plan(Job& job, const Dynamics& dynamics) noexcept;
  PlanResult plan_stop(const StopJob& asked, const Dynamics& given) noexcept;
  void show_target(const AxisPosition& target) noexcept;
  PlanResult move_by(DoubleDouble way, const Job& job, const Dynamics& dynamics) noexcept;
  void begin_stop(const Dynamics& dynamics, bool abort_acceleration) noexcept;
  void step_single_axis() noexcept;
  void follow_changes(Job& job) noexcept;
  void watch_base_job(Job& job) noexcept;
  void watch_positioning() noexcept;
  void take_arrival(Arrival::Verdict verdict) noexcept;
  void watch_standstill() noexcept;

  // emergency.cpp: the emergency ramp of an axis with a drive, from where it is
  void ask_for_emergency_ramp() noexcept;
  void step_emergency_ramp() noexcept;
  void brake_from_actual() noexcept;
  void take_actual_state(double commanded) noexcept;
  void stay_within_limits(const Setpoint& before) noexcept;
  double commanded_velocity() const noexcept;

  // hand_over.cpp: the setpoint as following axes see it where it goes over to another course
  void hand_over(const Setpoint& seen, const Setpoint& now) noexcept;
  void hand_over_to_actual() noexcept;
  Dynamics hand_over_dynamics() const noexcept;
  void lead_with_position_control(bool on) noexcept;
  void step_hand_over() noexcept;

  // synchronous.cpp: motion led by another axis
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

  // buffer.cpp: a job that waits for the end of another, and blending
  bool buffer(Job& job) noexcept;
  void watch_buffered() noexcept;
  void speed_up_for_junction() noexcept;
  void plan_blending() noexcept;
  NextMotion motion_after_target(const Job& job) noexcept;

  // motion_in.cpp: setpoints given by the program
  void begin_motion_in(Job& job) noexcept;
  void step_given() noexcept;
  void show_motion_in_command() noexcept;

  // superimposed.cpp: what is added to the base motion
  void begin_superimposed(Job& job) noexcept;
  void take_position_control() noexcept;
  BaseMotion base_motion() const noexcept;
  void follow_share() noexcept;
  void replan_stop() noexcept;
  void leave_to_superimposed(const Job* job, Dynamics& dynamics) noexcept;
  void step_superimposed() noexcept;
  void advance_superimposed() noexcept;
  void follow_given_superimposed(Job& job) noexcept;
  void add_superimposed() noexcept;
  void absorb_superimposed() noexcept;
  void show_superimposed_command() noexcept;

  // desynchronizing.cpp: out of a synchronous motion, and its simulation
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

  // servo.cpp: drive and position control
  void configure_servo();
  void restart_servo() noexcept;
  void take_servo_settings() noexcept;
  PositionControlSettings control_settings() const noexcept;
  double way_per_motor_turn() const noexcept;
  double motor_angle_per_unit() const noexcept;
  void read_drive() noexcept;
  ServoSetpoint fine_setpoint_now() const noexcept;
  PositionLoop::Output control_position() noexcept;
  void watch_following_error(double velocity) noexcept;
  void limit_speed() noexcept;
  void show_execution_time() noexcept;
  double setpoint_delay() const noexcept;
  double control_delay() const noexcept;
  void reset_servo(const ServoSetpoint& setpoint) noexcept;
  void shift_servo(double by) noexcept;
  void idle_servo() noexcept;
  /// Dynamic servo control: the drive closes the position loop, on its own encoder.
  bool loop_in_drive() const noexcept { return data.PositionControl.EnableDSC && encoders_.operative() == 0; }
  /// What the motor has passed of the backlash, and the load has not followed [u].
  double play() const noexcept { return backlash_.passed(data.Sensor[0].Backlash); }
  /// The play lies between the motor, with its encoder, and the load: another encoder sees it by itself.
  bool passes_backlash() const noexcept {
    return data.Sensor[0].Backlash.Enable && encoders_.operative() == 0;
  }

  // torque.cpp: torque limiting, torque data, fixed stop
  void step_forces() noexcept;
  bool position_monitoring_off() const noexcept;
  bool pushes_against_a_stop() const noexcept;
  void watch_fixed_stop() noexcept;
  void freeze_setpoint() noexcept;
  void watch_clamping() noexcept;
  ErrorId check_at_fixed_stop(const Job& job) const noexcept;
  static ErrorId away_from_stop(double way, int side) noexcept;

  // faults.cpp: drive and encoder that fail, control words
  void watch_drive(const DriveActual& now) noexcept;
  void raise_drive_alarms(const DriveActual& now) noexcept;
  void lose_sensor() noexcept;
  void regain_sensor() noexcept;
  void acknowledge_drive() noexcept;
  void control_drive(std::uint16_t stw1) noexcept;

  // monitoring.cpp: range of positions, software limit switches
  bool far_from_end_of_range() const noexcept;
  void watch_range() noexcept;
  bool keep_in_range(int side) noexcept;
  void pass_end_of_range() noexcept;
  void watch_position_limits() noexcept;
  bool keep_within(int side, double limit) noexcept;
  bool turns_in_time(int side, double room, double jerk) const noexcept;
  Dynamics limit_dynamics() const noexcept;
  void stop_at_limit(int side, AxisPosition limit, Dynamics dynamics) noexcept;
  AlarmReaction reaction_at_limit() const noexcept;
  void approach_limit(double way, AxisPosition limit, const Dynamics& dynamics) noexcept;

  // publish.cpp: the data block
  void publish_motion() noexcept;
  void publish_awaited() noexcept;
  void publish_synchronous() noexcept;
  void watch_deviation() noexcept;
  void publish_status() noexcept;
  void show_drive_state() noexcept;
  std::uint32_t bits_when_on() const noexcept;
};

}  // namespace lockstep
