/// One motor of a LinMot controller: set-point generator, position loop, homing, and what the motor moves.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "tech_objects/drive/current_loop.hpp"
#include "tech_objects/drive/linear_motor_plant.hpp"
#include "tech_objects/linmot/curve_player.hpp"
#include "tech_objects/linmot/limiter.hpp"
#include "tech_objects/linmot/thermal.hpp"
#include "tech_objects/linmot_catalogue/parameters.hpp"

namespace lockstep::linmot {

/// What is really there. "Out of the motor" is positive.
struct MotorSettings {
  bool exists = false;          ///< without it the motor follows its set-point exactly, and takes no current
  double force_constant = 0.0;  ///< [N/A] > 0
  LinearMotorPlantSettings plant;
  double start_position = 0.0;           ///< [mm] on the scale of the machine
  int type = -1;                         ///< index of its type; -1: the one that is configured
  const bool* slider_missing = nullptr;  ///< while TRUE
  const bool* too_hot = nullptr;         ///< while TRUE its temperature sensor tells so
  ThermalSettings thermal;
  const bool* trigger = nullptr;  ///< input TRIG
  const LREAL* analog = nullptr;  ///< input ANALOG [V]
};

/// A motion that somebody asks for.
struct Order {
  enum class Kind : std::uint8_t { position, increment, curve };
  Kind kind = Kind::position;
  double position = 0.0;  ///< [mm] absolute, or an increment
  Limits limits{};
  bool follows_filter = false;   ///< the limits are those of Filter Parameter, and change with them
  bool from_actual = false;      ///< the limiter begins at the actual position and velocity
  const Curve* curve = nullptr;  ///< nullptr: the empty one, which moves nothing
  bool cyclic = false;
  bool from_demand = false;  ///< the offset is changed so that the curve begins where the set-point is
};

/// The cycle's thread.
class Motor {
 public:
  /// While loading. @param cycle of the position loop [s]  @param tick servo cycle [s]
  void configure(const MotorSettings& settings, const MotorParameters& parameters, double cycle,
                 double tick) noexcept;
  /// Parameters have changed. Those of the loop, the filter and the curves count at once.
  void take(const MotorParameters& parameters) noexcept;
  /// Limits the current besides Maximal Current: the 2 or 3 A switch [A].
  void limit_current(double current) noexcept { hardware_current_ = current; }

  /// The curves of the controller, `kCurves` of them, which stay.
  void use_curves(const Curve* curves) noexcept { curves_ = curves; }
  /// nullptr: there is none of that number.
  const Curve* curve_of(std::int32_t number) const noexcept {
    return curves_ != nullptr && number > 0 && number < kCurves && curves_[number].exists() ? &curves_[number]
                                                                                            : nullptr;
  }

  bool is_there() const noexcept { return parameters_.type != kNoDrive; }
  const MotorSettings& settings() const noexcept { return settings_; }

  // ---- Requests, in the input phase of a servo tick

  void energise() noexcept;  ///< the generator begins at the actual position, and goes to the demand
  void enter_run() noexcept;
  void switch_off() noexcept {
    energised_ = frozen_ = brakes_ = curve_missing_ = false;
    curve_mode_ = false;
    player_.stop();
    give_up_homing();
  }
  bool energised() const noexcept { return energised_; }
  void execute(const Order& order) noexcept;
  /// Executes an order at the next rising edge of the trigger; a newer one replaces it.
  void arm(const Order& order) noexcept { armed_ = order; }
  void disarm() noexcept { armed_.reset(); }
  /// Of a motor that is not controlled: what counts from RUN on.
  void set_demand(double position) noexcept;
  void stop(double acceleration) noexcept;
  void freeze(bool frozen) noexcept;
  bool frozen() const noexcept { return frozen_; }
  void demand_to_actual() noexcept;
  /// The position has another name from now on; nothing moves. @param distance [mm] that is added
  void move_names(double distance) noexcept;
  void end_cyclic_curve() noexcept { player_.end_cycle(); }
  void run_after_this(const Order& order) noexcept { queued_ = order; }
  void emergency_stop() noexcept;

  void begin_homing() noexcept;
  void end_homing() noexcept;  ///< before it is done: brakes, and is off
  enum class Homing : std::uint8_t { none, leave_trigger, search, check, initial, done, failed };
  Homing homing() const noexcept { return homing_; }
  /// It is on its course.
  bool homes() const noexcept { return homing_ >= Homing::leave_trigger && homing_ <= Homing::initial; }
  bool homed() const noexcept { return homed_; }
  void lose_position() noexcept { homed_ = false; }

  /// Triggers, run modes, homing: once in a servo tick. @param running the state is RUN
  void tick(bool running) noexcept;
  /// The control cycles of a servo tick, of which no other motor sees anything.
  void run(int cycles) noexcept;
  /// Starts the acknowledge time [ticks].
  void acknowledge(int ticks) noexcept { acknowledge_ticks_ = ticks; }

  // ---- What there is to see

  double demand() const noexcept { return demand_; }  ///< [mm]
  const LoopSetpoint& setpoint() const noexcept { return setpoint_; }
  double actual() const noexcept { return position_ - shift_; }  ///< [mm]
  double actual_velocity() const noexcept { return velocity_; }  ///< [mm/s]
  double current() const noexcept { return current_; }           ///< [A]
  double following_error() const noexcept { return setpoint_.position - actual(); }
  double heat() const noexcept { return thermal_.heat(); }  ///< [%] as it is calculated
  bool curve_active() const noexcept { return curve_mode_ && player_.running(); }
  bool cyclic_curve() const noexcept { return curve_active() && player_.cyclic(); }
  /// No curve runs, and none waits for its end.
  bool curves_over() const noexcept { return !curve_active() && !queued_; }
  const Limits& filter() const noexcept { return filter_; }  ///< of Filter Parameter
  bool standing() const noexcept { return !curve_active() && limiter_.at_end(); }
  bool in_position() const noexcept;
  bool trigger() const noexcept { return trigger_level(); }
  /// A run mode has asked for a curve that is not there.
  bool curve_missing() const noexcept { return curve_missing_; }
  /// The curve offset has been changed by the motor itself [mm].
  double curve_offset() const noexcept { return offset_; }
  /// From the machine's scale to that of the positions [mm].
  double shift() const noexcept { return shift_; }

 private:
  /// One that is done stays so.
  void give_up_homing() noexcept {
    if (homing_ != Homing::done) homing_ = Homing::none;
  }
  bool trigger_level() const noexcept { return settings_.trigger != nullptr && *settings_.trigger; }
  void apply(const Order& order) noexcept;
  void resume() noexcept;
  void start_curve(const Order& order) noexcept;
  void leave_curve() noexcept;
  void go(double target, const Limits& limits, bool from_actual) noexcept;
  void run_mode(bool rising, bool falling) noexcept;
  void keep_going_to(double target) noexcept;
  void begin_going_to(double target) noexcept;
  double analog_target() const noexcept;
  void take_waiting_orders(bool rising) noexcept;
  void follow_trigger(bool rising, bool falling) noexcept;
  void run_curve(DINT number, bool cyclic) noexcept;
  void home_on() noexcept;
  void search(double direction) noexcept;
  bool arrived() noexcept;
  void assign_home() noexcept;
  void homing_move(Homing to, double target) noexcept;
  double bounded(double position) const noexcept;
  void configure_loop() noexcept;
  void rest(int cycles) noexcept;
  void next_setpoint() noexcept;
  LoopSetpoint step_of_curve() noexcept;
  void next_of_curve() noexcept;
  double direction_of_search() const noexcept;
  bool by_trigger() const noexcept;
  Limits homing_limits() const noexcept;

  // What every control cycle touches.
  LoopSetpoint setpoint_;
  double position_ = 0.0;  // of the slider, on the machine's scale [mm]
  double shift_ = 0.0;     // from names of positions to that scale [mm]
  double current_ = 0.0;
  double cycle_ = 1e-4;
  double force_constant_ = 0.0;
  bool energised_ = false, curve_mode_ = false, frozen_ = false, has_plant_ = false;
  double offset_ = 0.0, amplitude_ = 1.0;
  double lowest_ = 0.0, highest_ = 0.0;  // [mm] between which the set-point is cut
  double bound_ = 0.0;                   // the lower of both
  Limiter limiter_;
  CurvePlayer player_;
  CurrentLoop loop_;
  LinearMotorPlant plant_;
  Thermal thermal_;

  // Once in a tick.
  Order order_;  // of the motion that is under way, or that waits while frozen
  bool has_waiting_order_ = false;
  std::optional<Order> armed_, queued_;
  double demand_ = 0.0;
  double rate_ = 1.0;
  double velocity_ = 0.0, last_position_ = 0.0;
  Limits filter_;
  double tick_ = 1e-3;
  double hardware_current_ = 1e9;
  int acknowledge_ticks_ = 0;
  bool last_trigger_ = false, analog_known_ = false, curve_missing_ = false;
  bool rise_waits_ = false, fall_waits_ = false;  // for the end of a curve
  bool brakes_ = false;                           // and is off when it stands
  DINT running_curve_ = 0;
  const Curve* curves_ = nullptr;
  Homing homing_ = Homing::none;
  bool homed_ = false;
  bool gentle_ = false;  // no more than the current of homing
  int slow_ticks_ = 0;
  int limit_ticks_ = 0;
  std::int64_t homing_ticks_left_ = 0;
  MotorSettings settings_;
  MotorParameters parameters_;
};

}  // namespace lockstep::linmot
