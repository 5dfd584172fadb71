/// The axis of an MCO 305: counters, zero points, generator, position controller, drive, limits and errors,
/// in steps of 1 ms. What its program asks for are the members here; the program itself runs above.
/// @source MCO 305 Design Guide; what it leaves open is decided in the README of this folder
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "tech_objects/arithmetic/cache_line.hpp"
#include "tech_objects/drive/count_controller.hpp"
#include "tech_objects/drive/drive.hpp"
#include "tech_objects/drive/simulated_drive.hpp"
#include "tech_objects/mco305/absolute_encoder.hpp"
#include "tech_objects/mco305/inputs_outputs.hpp"
#include "tech_objects/mco305/marker_track.hpp"
#include "tech_objects/mco305/master_input.hpp"
#include "tech_objects/mco305/recent_positions.hpp"
#include "tech_objects/mco305/synchronization.hpp"
#include "tech_objects/mco305/units.hpp"
#include "tech_objects/mco305_catalogue/errors.hpp"
#include "tech_objects/mco305_catalogue/parameters.hpp"
#include "tech_objects/profile/four_slope_profile.hpp"

namespace lockstep::mco305 {

/// What goes wrong at a device while the BOOL is TRUE; nullptr: nothing ever does.
struct DeviceFaults {
  const bool* supply = nullptr;          ///< the external 24 V are missing
  const bool* output = nullptr;          ///< a digital output is overloaded
  const bool* master_encoder = nullptr;  ///< the master encoder tells nothing
  // Added to what absolute encoders tell [qc].
  const std::int32_t* encoder_counts = nullptr;
  const std::int32_t* master_encoder_counts = nullptr;
};

/// What a project says of a device.
struct DeviceSettings {
  bool later_edition = true;      ///< "firmware": "5.00"
  bool has_drive = false;         ///< false: ENCODERTYPE 9, the actual position is the set position
  DriveSettings drive{};          ///< in qc
  double controller_scale = 1.0;  ///< of the parts of the position controller
  std::array<const bool*, InputsOutputs::kInputs> inputs{};  ///< tags; nullptr: not wired
  std::array<bool*, InputsOutputs::kOutputs> outputs{};
  bool has_master = false;             ///< something turns its master encoder
  MarkerTrackSettings markers{};       ///< that the sensor at input 6 sees [qc of the slave]
  MarkerTrackSettings master_marks{};  ///< … at input 5 [qc of the master]
  DeviceFaults faults{};
  std::array<const double*, 2> analog_inputs{};  ///< tags of 53 and 54 [V]; nullptr: 0 V
  double* analog_output = nullptr;               ///< tag of 42 [mA]
};

/// AXEND and what else a program sees of the motion.
enum class MotionMode : std::uint8_t { kHold, kPosition, kSpeed, kStop, kHome, kFollow };

/// One device. Thread: that of the cycle, but for `configure`. Errors are published numbers; 0: none.
class alignas(kCacheLine) Device {
 public:
  /// Call once, with the parameters set. @param servo_period [s]
  void configure(const DeviceSettings& settings, double servo_period);

  /// One servo tick. @param step whether it is one of the device's steps, each 1 ms
  void servo(bool step) noexcept;

  // ---- Parameters

  ParameterValues& parameters() noexcept { return parameters_; }
  int set_parameter(std::int32_t number, std::int32_t value) noexcept;
  /// As from a panel. @return as `ParameterValues::set`
  int change_parameter(std::int32_t number, std::int32_t value) noexcept;
  /// GET, with the read-outs. @return whether there is such a parameter
  bool get_parameter(std::int32_t number, std::int32_t& value) const noexcept;
  /// The end of a program: what it has set and not saved is as it was before.
  void forget_settings() noexcept;

  // ---- Motion

  void set_velocity(std::int32_t velocity) noexcept { velocity_ = velocity; }  ///< VEL [1/VELRES]
  void set_acceleration(std::int32_t acceleration) noexcept { acceleration_ = acceleration; }  ///< ACC
  void set_deceleration(std::int32_t deceleration) noexcept { deceleration_ = deceleration; }  ///< DEC
  int position_to(std::int32_t units, bool relative) noexcept;                                 ///< POSA, POSR
  void set_speed(std::int32_t velocity) noexcept;                                              ///< CVEL
  int start_speed() noexcept;                                                                  ///< CSTART
  void stop_speed() noexcept;                                                                  ///< CSTOP
  void motor_on() noexcept;
  void motor_off() noexcept;
  void motor_stop() noexcept;
  void set_reference(std::int32_t reference) noexcept;  ///< OUTAN [1/0x4000 of full scale], after MOTOR OFF
  int go_on() noexcept;                                 ///< CONTINUE
  /// SYNCV, SYNCP, SYNCM.
  int follow(SyncMode mode) noexcept;
  /// DEF SYNCORIGIN: a position of the master [qc] and of the slave [UU].
  void define_sync_origin(std::int32_t master, std::int32_t slave) noexcept;
  void move_sync_origin(std::int32_t by) noexcept { sync_.move_origin(by); }        ///< MOVESYNCORIGIN
  void clear_sync_status(std::int32_t bits) noexcept { sync_.clear_status(bits); }  ///< SYNCSTATCLR
  void restart_markers(bool whole) noexcept { sync_.restart_markers(whole); }       ///< SYNCMARKERSTART
  /// PULSVEL, with the acceleration of PULSACC.
  void turn_own_master(std::int32_t hertz) noexcept;
  /// Whether it has had a master; without one nothing is computed for one.
  bool led() const noexcept { return has_master_; }
  bool later_edition() const noexcept { return settings_.later_edition; }
  MasterInput& master() noexcept { return master_; }
  const MasterInput& master() const noexcept { return master_; }
  /// Whether the axis rests where it was told to: the end of POSA, POSR, MOTOR STOP, WAITAX.
  bool arrived() const noexcept { return arrived_; }

  /// SWAPMENC. @return false: something else turns its master encoder, or an encoder is absolute
  bool swap_encoders(bool swapped) noexcept;

  // ---- The drive in which it sits

  /// GETVLT, SETVLT: 3-03 as 303. @return whether the drive has it; an error
  bool drive_parameter(std::int32_t number, std::int32_t& value) const noexcept;
  int set_drive_parameter(std::int32_t number, std::int32_t value) noexcept;
  /// INAD [10 mV], OUTDA [0.2 µA]. @return whether there is such a terminal
  bool analog_input(std::int32_t terminal, std::int32_t& value) const noexcept;
  bool set_analog_output(std::int32_t terminal, std::int32_t value) noexcept;

  // ---- Zero points, homing, index

  int define_origin() noexcept;                     ///< DEF ORIGIN
  int define_master_origin() noexcept;              ///< DEFMORIGIN
  void set_origin(std::int32_t units) noexcept;     ///< SET ORIGIN
  void reset_origin() noexcept { temporary_ = 0; }  ///< RST ORIGIN
  /// HOME, INDEX. They are over when `homing` is false; then `homing_error` says how.
  int begin_home(bool index_only) noexcept;
  bool homing() const noexcept { return mode_ == MotionMode::kHome; }
  bool following() const noexcept { return mode_ == MotionMode::kFollow; }
  int homing_error() const noexcept { return home_.error; }
  void give_up_home() noexcept;
  /// Whether its position is there at power-up: no DEF ORIGIN, HOME, INDEX, WAITNDX.
  bool is_absolute() const noexcept { return absolute_.present(); }
  /// How many zero pulses or markers have been latched: WAITNDX.
  std::uint32_t latches() const noexcept { return latches_; }

  // ---- Read-outs

  std::int64_t milliseconds() const noexcept { return now_; }
  std::int32_t actual_units() const noexcept { return shown_units(actual_); }    ///< APOS
  std::int32_t set_units() const noexcept { return shown_units(set_counts()); }  ///< CPOS
  std::int32_t latched_units() const noexcept { return shown_units(latched_); }  ///< IPOS
  std::int32_t following_error() const noexcept;                                 ///< TRACKERR
  std::int32_t velocity_units() const noexcept;                                  ///< AVEL
  void set_velocity_window(std::int32_t milliseconds) noexcept;                  ///< _GETVEL
  std::int32_t sync_error() const noexcept;                                      ///< SYNCERR
  std::int32_t sync_status() const noexcept { return sync_.status(); }           ///< SYNCSTAT
  std::int32_t master_velocity() const noexcept;                                 ///< MAVEL
  /// The 32 flags of SYSVAR 4218, which STATBIT sees.
  std::int32_t flags() const noexcept;
  std::int32_t axis_end() const noexcept;  ///< AXEND
  std::int32_t status() const noexcept;    ///< STAT
  /// The line of its program, for SYSVAR[33].
  void set_program_line(std::int32_t line) noexcept { program_line_ = line; }
  /// SYSVAR[index] = value. @return false: it is none that can be written, or not now
  bool set_system_variable(std::int32_t index, std::int32_t value) noexcept;
  /// SYSVAR. @return whether it is one of those that are there
  bool system_variable(std::int32_t index, std::int32_t& value) const noexcept;
  std::int32_t set_counts_shown() const noexcept { return shown_position(set_counts() - origin_); }
  std::int32_t actual_counts_shown() const noexcept { return shown_position(actual_ - origin_); }
  std::int32_t reference() const noexcept;  ///< of the position controller, ±1,048,575
  SlopePhase phase() const noexcept { return profile_.phase(); }
  double set_position() const noexcept { return profile_.state().position; }      ///< [qc] on the counter
  double set_velocity_now() const noexcept { return profile_.state().velocity; }  ///< [qc/ms]
  bool controlled() const noexcept { return on_; }
  bool encoder_failed() const noexcept { return trouble_.encoder_failed; }  ///< its own
  /// Whether OUTAN turns the drive.
  bool open_loop() const noexcept { return open_loop_ != 0; }
  bool moving() const noexcept { return moving_; }
  /// Whether the axis has been where it is, to a count, for 20 ms.
  bool stands() const noexcept;
  MotionMode mode() const noexcept { return mode_; }
  /// The set position without the steps that it makes where the controller is switched off [qc].
  double led_position() const noexcept { return set_position() - unled_; }
  /// An external marker of the slave at a place of its counter [qc], as by input 6.
  void mark(double place) noexcept;
  std::int64_t actual_position() const noexcept { return actual_; }  ///< [qc] counter
  const UserUnit& unit() const noexcept { return unit_; }
  /// [qc] True place of the machine, on its own scale.
  double machine_position() const noexcept { return machine_; }

  // ---- Inputs, outputs, errors

  InputsOutputs& io() noexcept { return io_; }
  const InputsOutputs& io() const noexcept { return io_; }
  /// An error that has come up since it was asked last; 0: none.
  int take_error() noexcept;
  /// The reaction of ERRCOND.
  void react(int error) noexcept;
  /// ERRCLR, which is MOTOR ON as well.
  void clear_error() noexcept;
  void clear_all_errors() noexcept;
  const PendingErrors& pending() const noexcept { return pending_; }
  /// The end of a program by the user, with [Esc]: ESCCOND.
  void escape() noexcept;
  /// The device raises an error.
  void raise(int error) noexcept;

 private:
  /// The search of HOME and INDEX.
  struct Home {
    enum class Phase : std::uint8_t { kOver, kToSwitch, kOffSwitch, kToIndex, kToZero };
    Phase phase = Phase::kOver;
    bool index_only = false, by_index = false, turns = false;
    bool seen = false;             // the switch, in the direction in which it is left
    double search_velocity = 0.0;  // [qc/ms]
    std::int64_t begin = 0;        // where the search for the index began [qc]
    std::uint32_t latches = 0;
    int error = 0;
  };

  void refresh() noexcept;
  void read_drive() noexcept;
  void read_whole_drive() noexcept;
  void show_switches() noexcept;
  void read_absolute() noexcept;
  void latch(double from, double to) noexcept;
  void look_for_latches(double from, double to) noexcept;
  std::int64_t encoder_count(double place) const noexcept;
  bool meets_no_pulse(double from, double to) const noexcept;
  void latch_virtual(double from, double to) noexcept;
  void take_latch(std::int64_t place) noexcept;
  int choose_encoder(std::int32_t number, std::int32_t value) noexcept;
  void step_master() noexcept;
  void sample() noexcept;
  void sample_wired_inputs() noexcept;
  void sample_home_switch() noexcept;
  void generate() noexcept;
  void control() noexcept;
  void control_position() noexcept;
  void look_at_arrival() noexcept;
  void look_into_window() noexcept;
  void note_what_is_watched() noexcept;
  void monitor() noexcept;
  void look_at_limits() noexcept;
  void look_at_position_error() noexcept;
  void look_at_drive() noexcept;
  void look_at_faults() noexcept;
  bool sync_variable(std::int32_t index, std::int32_t& value) const noexcept;
  void write_outputs() noexcept;
  void write_drive() noexcept;

  double counts_per_millisecond(double rpm) const noexcept;
  void scale_drive() noexcept;
  double analog_volts(std::size_t input) const noexcept;

  bool may_move(int& error) const noexcept;
  bool within_limits(std::int64_t target, int& error) const noexcept;
  bool leads_out(double velocity) const noexcept;
  int further_out() const noexcept;
  FourSlopeLimits limits() const noexcept;
  double relative_velocity(std::int32_t velocity) const noexcept;
  void move_to(double target) noexcept;
  void move_with(double velocity) noexcept;
  void stop(double deceleration, MotionMode mode) noexcept;
  FourSlopeState state() const noexcept;

  void step_home() noexcept;
  FourSlopeLimits home_limits() const noexcept;
  void search_with(double velocity) noexcept;
  void home_from_switch() noexcept;
  void to_home(double from) noexcept;
  void search_index() noexcept;
  void end_home(int error) noexcept;

  std::int64_t zero() const noexcept { return origin_ + temporary_; }
  std::int64_t set_counts() const noexcept { return counts_of(profile_.state().position + 0.5); }
  std::int32_t shown_units(std::int64_t counter) const noexcept;
  std::int64_t moved_in_window() const noexcept;

  // In lines of the cache: of many devices it is the lines which a step touches that take its time. First
  // two that every step needs; the third of them holds the end of the controller and what is behind it.
  RecentPositions positions_;
  bool on_ = false, virtual_ = true, moving_ = false, arrived_ = true, was_reset_ = false;
  bool brake_ = false;
  MotionMode mode_ = MotionMode::kHold;
  bool drive_enabled_ = false;            // as the drive has told
  bool reads_position_alone_ = false;     // of its drive: there is nothing else that could change
  bool has_master_ = false;               // something turns here
  bool samples_ = false, shows_ = false;  // inputs, outputs
  bool meets_markers_ = false, meets_pulses_ = false;  // of its own encoder
  bool watches_ = false, watches_inputs_ = false;      // inputs, limits or faults, in every step; inputs
  std::unique_ptr<SimulatedDrive> drive_;
  std::int64_t now_ = -1;             // [ms]
  std::int64_t actual_ = 0;           // [qc] counter
  std::int64_t next_monitoring_ = 0;  // of following error and drive [ms]

  double reference_ = 0.0;  // of the controller, ±1,048,575
  // Of which `drive_velocity_` [u/s] is; not a number: of none.
  double scaled_reference_ = std::numeric_limits<double>::quiet_NaN();
  double drive_velocity_ = 0.0;
  std::int32_t profile_time_ = 1, sampling_ = 1;  // PROFTIME, TIMER [ms]
  FourSlopeProfile profile_;

  CountController controller_;
  double last_velocity_ = 0.0;  // of the set position [qc/ms]
  // `InputsOutputs::changes` that the device has seen, and its master.
  std::uint32_t sampled_inputs_ = 0, master_inputs_ = 0;
  InputsOutputs io_;

  // What one that moves needs besides.
  alignas(kCacheLine) double machine_ = 0.0;  // [qc]
  double machine_start_ = 0.0;                // [qc]
  std::int64_t swap_offset_ = 0;              // from what the drive's encoder has counted to the counter [qc]
  /// What the drive has told last, beside `drive_enabled_` and `trouble_`; its position is in `machine_`.
  struct {
    double velocity = 0.0, torque = 0.0;
  } told_;
  std::int64_t window_since_ = -1;  // [ms]
  // Of the drive [qc/ms]: what it does at full reference, below 0 where POSDRCT turns it round, and at most.
  double full_reference_ = 1.0, speed_limit_ = 0.0;

  // What one needs whose markers are seen.
  double unled_ = 0.0;  // what set positions have stepped [qc]
  MarkerTrack track_;

  // What one that is led needs.
  alignas(kCacheLine) Synchronization sync_;
  MasterInput master_;

  // Seldom of account.
  MotionMode interrupted_ = MotionMode::kHold;  // by MOTOR STOP, an error or MOTOR OFF
  bool checks_limits_ = false, looks_at_faults_ = false;
  bool brake_after_stop_ = false;
  struct {
    bool silent = false, encoder_failed = false, fault = false;
  } trouble_;                             // of the drive, as it has told
  DoubleDouble last_drive_position_{};    // where it has to be read as a whole
  std::int32_t open_loop_ = 0;            // OUTAN
  double velocity_maximum_ = 1.0;         // [qc/ms]
  std::int64_t target_ = 0;               // [qc] counter
  std::int64_t position_error_ = 20'000;  // POSERR [qc]
  PendingErrors pending_;
  struct WiredInput {
    std::size_t number = 0;  // from 1
    const bool* tag = nullptr;
  };
  struct WiredOutput {
    std::size_t number = 0;
    bool* tag = nullptr;
  };
  std::vector<WiredInput> wired_inputs_;
  std::vector<WiredOutput> wired_outputs_;
  std::int32_t marker_type_ = 0, marker_input_ = 6;    // SYNCMTYPS
  double virtual_pulse_ = 0.0;                         // [qc] from one to the next; 0: there are none
  double no_pulse_from_ = 0.0, no_pulse_until_ = 0.0;  // between these [qc]
  bool last_marker_input_ = false;
  AbsoluteEncoder absolute_;
  DeviceSettings settings_;
  ParameterValues parameters_;
  UserUnit unit_;
  double acceleration_maximum_ = 1.0;                                   // [qc/ms²]
  std::int32_t velocity_ = -1, acceleration_ = -1, deceleration_ = -1;  // below 0: as by default
  std::int32_t speed_ = 0;
  std::int32_t program_line_ = 0;
  std::int32_t maximum_reference_ = 0, speed_high_limit_ = -1;   // 3-03, 4-13; 0, -1: not set
  double drive_sign_ = 1.0;                                      // of the reference: POSDRCT
  double analog_output_ = 0.0;                                   // [mA]
  bool swapped_ = false;                                         // SWAPMENC
  double turn_ = 4096.0;                                         // of the motor [qc]
  std::int64_t origin_ = 0, temporary_ = 0, limits_origin_ = 0;  // [qc]
  bool homed_ = false;
  Home home_;
  std::int64_t latched_ = 0;
  std::uint32_t latches_ = 0;
  std::int64_t over_since_ = -1;  // following error [ms]
  std::int64_t window_position_ = 0;
  bool at_negative_end_ = false, at_positive_end_ = false, beyond_ = false, break_input_ = false,
       clear_input_ = false;
  std::array<int, 8> raised_{};
  std::size_t raised_count_ = 0;
  std::int64_t velocity_window_ = 20;
};

}  // namespace lockstep::mco305
