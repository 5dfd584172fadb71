/// An axis: TO_SpeedAxis, TO_PositioningAxis and TO_SynchronousAxis. It owns its motion; a function block
/// only asks.
///
/// It is an order of calls over its families, and the one place in which a tick begins and ends.
///
/// In the interpolator each axis goes through start_jobs → step → guard → publish, leading axes before
/// following ones. All functions below "Cycle" run in the thread of the cycle; they neither allocate nor
/// block. Data that blocks and the project see directly are declared with the parts.
/// @source S7-1500T synchronous operation V7, 4.5, 6, 13.1; S7-1500T axis functions
#pragma once

#include "tech_objects/axis/axis_families.hpp"

namespace lockstep {

class Axis final : public AxisFamilies {
 public:
  Axis(ObjectKind kind, std::string name, DB_ANY number);

  // ---- Load time

  /// Takes over the start values. Call once, after `data` is set and before the first tick.
  /// @param servo_period period of MC_Servo [s]  @param ratio servo ticks per interpolator tick, 1 to 32
  void configure(double servo_period, int ratio) override;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &start_values_; }

  // ---- Cycle: called by blocks
  // They reach an axis by jobs and by claims alone; everything else they only look at. Claims are requests
  // with an owner: `power`, `additive_request`, `simulation_request` and those of `forces`.

  /// Hands a job over; it starts at the next interpolator tick, and one that acts at once is over already.
  /// With no space left it fails with 16#8014 at once. The job stays where it is until it has ended.
  void submit(Job& job) noexcept override;

  /// Claims of the torque blocks, which write them only when nothing is refused, and what has become of
  /// them.
  AxisForces& forces() noexcept { return forces_; }
  const Clamping& clamping() const noexcept { return clamping_; }
  ErrorId torque_limiting_refusal(TorqueLimitingMode mode) const noexcept;
  ErrorId torque_range_refusal() const noexcept;
  ErrorId torque_additive_refusal() const noexcept;

  /// Raises a technology alarm: shows it and has its reaction carried out.
  void raise(int alarm_number) noexcept { reactions_.raise(alarm_number); }

  // ---- Cycle: called by the scheduler

  /// One servo tick: reads actual values, closes the position loop, writes the setpoint to the drive.
  bool takes_part(Phase phase) const noexcept override { return phase == Phase::servo && !is_virtual(); }
  void servo(std::int64_t now = 0) noexcept override;

  /// Starts the jobs handed over since the last interpolator tick, by the override rules.
  void start_jobs() noexcept;
  bool has_new_jobs() const noexcept { return jobs_.has_new(); }

  /// Alarm 601 if the object that leads this axis has been restarted: where it is then has no meaning for it.
  void watch_leading_object() noexcept;

  /// Begins to bring near, while another axis is stepped, what `step` and `publish` touch first.
  void prefetch() const noexcept {
    __builtin_prefetch(&power, 1);
    __builtin_prefetch(&setpoint_, 1);
    __builtin_prefetch(&additive_request, 1);
    __builtin_prefetch(jobs_.address(), 1);
    __builtin_prefetch(&period_, 1);
    __builtin_prefetch(&shown_before_, 1);
    __builtin_prefetch(&data.Position, 1);
    __builtin_prefetch(&data.StatusSynchronizedMotion, 1);
    __builtin_prefetch(&data.StatusSynchronizedMotion.EffectiveLeadingValue, 1);
    __builtin_prefetch(&data.StatusWord, 1);
  }

  /// One interpolator cycle: `step` and `publish`, in its shortest form. Leading axes have to be through
  /// theirs before.
  void cycle() noexcept;

  /// The setpoint of this tick.
  void step() noexcept;

  /// Checks the setpoint and shows everything in the data block.
  void publish() noexcept;

  /// Leading axes on which this axis depends: the coupled one and the one that a waiting job names; nullptr:
  /// none, or an object that depends on no other.
  Axis* coupled_leading_axis() const noexcept;
  Axis* awaited_leading_axis() const noexcept;

  bool leading_value_stands() const noexcept override {
    const bool stands = setpoint_is_actual() ? !moving(setpoint_.velocity, data) : setpoint_.velocity == 0.0;
    return stands && (!handing_over_ || hand_over_.finished());
  }

  AxisPosition actual_position() const noexcept override { return actual_; }
  bool measured_in_servo() const noexcept override { return has_drive_; }
  DoubleDouble measured_line() const noexcept override { return encoders_.counted(); }

  bool stopping() const noexcept {
    return power_state_ == PowerState::braking || power_state_ == PowerState::drive_stops;
  }
  /// False while encoder or communication are lost, until that is acknowledged.
  bool actual_values_valid() const noexcept override { return !encoders_.lost(); }
  bool homing() const noexcept override { return homing_now_; }
  /// Of an axis that is not virtual, once it has been configured.
  const Drive& drive() const noexcept { return *drive_; }
  /// Largest distance between actual position and synchronous function while synchronous [u], for the summary
  /// of a run.
  double largest_synchronous_deviation() const noexcept { return shown_before_.largest_deviation; }
  bool was_synchronous() const noexcept { return shown_before_.synchronous; }

 private:
  // axis.cpp
  void take_start_values() noexcept;
  void configure_servo();
  void restart_servo() noexcept;
  void restart() noexcept;
  // jobs.cpp
  ErrorId carry_out(const Job& job) noexcept;
  void start(Job& job) noexcept;
  void install(Job& job) noexcept;
  void home(Job& job) noexcept;
  ErrorId reset(bool restart) noexcept;
  // cycle.cpp
  void take_additive() noexcept;
  void step_superimposed() noexcept;
  void step_base() noexcept;
  void step_single_axis() noexcept;
  void step_synchronous() noexcept;
  void step_waiting_to_leave(const Setpoint& candidate) noexcept;
  void meet_cam_end() noexcept;
  void guard() noexcept;
  // plain_cycle.cpp: a cycle in which nothing but the base motion happens
  bool left_alone() const noexcept;
  bool undisturbed() const noexcept;
  void whole_cycle() noexcept;
  void standing_cycle() noexcept;
  void single_axis_cycle() noexcept;
  void synchronous_cycle() noexcept;
  void begin_cycle() noexcept;
  void finish_cycle() noexcept;
  void show_where_it_is() noexcept;
  bool far_inside() const noexcept;
  bool within_range() const noexcept;
  void publish_plainly(std::uint32_t word, std::uint32_t word2) noexcept;
  void publish_no_coupling() noexcept;
  void publish_coupling_plainly() noexcept;
  void show_operation() noexcept;
};

}  // namespace lockstep
