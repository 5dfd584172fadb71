/// A servo controller LinMot as a technology object: up to four motors, one operating state, and who tells
/// them what to do.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tech_objects/data_blocks/linmot.hpp"
#include "tech_objects/linmot/hardware.hpp"
#include "tech_objects/linmot/line.hpp"
#include "tech_objects/linmot/motor.hpp"
#include "tech_objects/linmot/multi_trigger.hpp"
#include "tech_objects/linmot/process_image.hpp"
#include "tech_objects/linmot/states.hpp"
#include "tech_objects/linmot_catalogue/errors.hpp"
#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

namespace linmot {

/// Tags that are inputs and outputs; nullptr: not wired.
struct Wiring {
  const bool *run = nullptr, *init = nullptr, *freeze = nullptr, *stop = nullptr;
  std::array<bool*, 4> outputs{};  ///< OUT 1 WARNING, 2 ERROR, 3 POS ERR, 4 MSG
  const LREAL *power_voltage = nullptr, *signal_voltage = nullptr;  ///< [V]; none: as they should be
  const bool* heat_sink_hot = nullptr;
};

}  // namespace linmot

/// In the servo phase of each tick: inputs, states, commands; then the motors, each with its control cycles;
/// then what is watched, and outputs. Thread: that of the cycle, but for what says otherwise.
class LinMotController final : public TechnologyObject {
 public:
  static constexpr int kMaximumControlCycles = 256;  ///< in a servo cycle

  LinMotController(std::string object_name, DB_ANY object_number);

  // ---- While loading
  const linmot::Hardware* hardware = &linmot::any_hardware();
  double control_cycle = 100e-6;  ///< [s]
  linmot::Wiring wiring;
  std::array<linmot::MotorSettings, linmot::kMotors> motor_settings{};
  std::array<linmot::Curve, linmot::kCurves> curves{};
  linmot::StateTable table;
  linmot::ProcessImageLayout image;
  std::vector<linmot::Line*> lines;  ///< that it serves, for itself and others

  LinMotData data;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &data; }
  void configure(double servo_period, int ratio) override;
  bool takes_part(Phase phase) const noexcept override { return phase == Phase::servo; }
  void servo(std::int64_t now) noexcept override;
  void shut_down() noexcept override;
  bool at_rest() const noexcept override;

  // ---- For its interfaces
  linmot::State state() const noexcept { return state_; }
  linmot::Motor& motor(std::size_t index) noexcept { return motors_[index]; }
  const linmot::Motor& motor(std::size_t index) const noexcept { return motors_[index]; }
  bool has_motor(std::size_t index) const noexcept {
    return index < hardware->motors && motors_[index].is_there();
  }
  linmot::CommandInterface command_interface() const noexcept {
    return static_cast<linmot::CommandInterface>(data.Parameters.command_interface);
  }
  bool takes_ascii() const noexcept;

  /// A request of a protocol. @return whether it counts: no input and no other interface has it
  enum class Request : std::uint8_t { run, init, stop };
  bool request(Request which, bool on) noexcept;
  /// @param motor -1: of all
  bool request_freeze(int motor, bool on) noexcept;
  /// Bits of GX.
  std::uint16_t flags() const noexcept;
  /// Bits of EX.
  std::uint16_t state_bits() const noexcept;
  std::uint16_t system_errors() const noexcept { return system_errors_; }
  std::uint16_t system_warnings() const noexcept { return system_warnings_; }
  std::uint16_t motor_errors(std::size_t index) const noexcept { return errors_[index]; }
  std::uint16_t motor_warnings(std::size_t index) const noexcept { return warnings_[index]; }
  /// What has led to ERROR: the number of the status, and the motor; -1: the controller.
  int error_number() const noexcept { return error_number_; }
  int error_motor() const noexcept { return error_motor_; }
  /// Parameters of a motor that have been changed through `data`, if they may be as they are; else they are
  /// again what they were.
  bool take_parameters(std::size_t index) noexcept;
  void tell_curve_missing(std::size_t index) noexcept { curve_missing_[index] = true; }
  /// The memory of addresses: segment 0 has the parameters in their published order, a word each at even
  /// offsets, in increments of the protocols; nothing else is there. Both parts are of commands of that
  /// motor.
  /// @param segment 0 to 255  @param offset even, 0 to 65534
  void set_segment(std::size_t index, std::uint32_t segment) noexcept {
    address_[index] = (address_[index] & 0xFFFFu) | segment << 16;
  }
  void set_offset(std::size_t index, std::uint32_t offset) noexcept {
    address_[index] = (address_[index] & ~0xFFFFu) | offset;
  }
  void next_word(std::size_t index) noexcept { address_[index] = (address_[index] + 2) & 0xFFFFFFu; }
  /// 0 where nothing is.
  std::uint16_t read_memory(std::size_t index) const noexcept;
  /// @return whether there is a parameter that may be changed at run time, and the value is one of its
  bool write_memory(std::size_t index, std::uint16_t word) noexcept;
  /// Another name for a position; nothing moves. @return whether the motor was at rest and unfrozen
  bool move_names(std::size_t index, double distance, bool needs_all) noexcept;

 private:
  using State = linmot::State;

  struct Requests {
    bool run = false, init = false, stop = false, freeze = false;
    std::bitset<linmot::kMotors> freeze_motor;
    bool operator==(const Requests&) const = default;
  };

  /// What there is to watch of a motor, as its settings and parameters have it.
  struct Watched {
    std::uint16_t error_mask = 0, warning_mask = 0;  ///< bits that its parameters let pass
    std::uint16_t always = 0;                        ///< causes that its parameters are
    bool only_motion = false;  ///< neither that, nor sensors, nor heat: what it does alone
  };
  /// Of its motors together.
  struct Together {
    std::uint16_t errors = 0, warnings = 0, causes = 0;
    bool homed = true;  ///< all
  };

  linmot::MotorSettings settings_with_inputs(std::size_t index) noexcept;
  std::span<const std::uint8_t> motors_there() const noexcept { return {there_.data(), there_count_}; }
  void keep_parameters(std::size_t index) noexcept;
  void take_changed_parameters() noexcept;
  void read_inputs() noexcept;
  linmot::StateFacts facts() const noexcept;
  bool all_homed() const noexcept;
  bool homing_over() const noexcept { return waits_for_init_.none(); }
  bool has_error() const noexcept { return (system_errors_ | together_.errors) != 0; }
  bool has_warning() const noexcept { return (system_warnings_ | together_.warnings) != 0; }
  void change_state() noexcept;
  void enter(State from) noexcept;
  void begin_init() noexcept;
  void home_next() noexcept;
  void move_motors() noexcept;
  void home_motors() noexcept;
  bool may_sleep() const noexcept;
  bool wakes() const noexcept;
  void freeze_motors() noexcept;
  void read_code() noexcept;
  std::uint8_t raw_code() const noexcept;
  void call_row(int row) noexcept;
  void carry_out(std::size_t index, const linmot::Cell& cell) noexcept;
  void start_curve(std::size_t index, double number, bool from_demand) noexcept;

  void read_words() noexcept;
  void read_word(const linmot::ModulePlace& place) noexcept;
  void read_control(std::uint16_t word) noexcept;
  void read_run_curve(const linmot::ModulePlace& place, std::uint16_t word) noexcept;
  void read_command(std::uint16_t word, std::uint16_t value) noexcept;
  void command_motor(std::size_t index, std::uint8_t id, std::int32_t value) noexcept;
  void write_words() noexcept;
  std::uint16_t status_word() const noexcept;
  void follow_curves() noexcept;

  void watch() noexcept;
  void watch_system() noexcept;
  void watch_supplies(std::uint16_t& causes, std::uint16_t& warnings) noexcept;
  std::uint16_t system_warning_masks() const noexcept;
  void watch_motor(std::size_t index, Together& together) noexcept;
  void watch_closely(std::size_t index, bool follows, bool outside, Together& together) noexcept;
  std::uint16_t causes_of(std::size_t index, std::uint16_t conditions, bool follows) const noexcept;
  std::uint16_t sensors_of(std::size_t index) const noexcept;
  WORD shown_code(const linmot::ErrorRow& row, std::size_t motor) const noexcept;
  void log_warnings() noexcept;
  void find_first_error() noexcept;
  void write_outputs() noexcept;
  bool output(std::size_t index) const noexcept;
  bool output_function(DINT function) const noexcept;
  bool message() const noexcept;
  void show() noexcept;
  void show_curve_offset(std::size_t index) noexcept;

  // What every tick touches stands first.
  State state_ = State::disable;
  State settled_state_ = State::disable;  // with `settled_facts_` nothing leads out of it
  linmot::StateFacts settled_facts_ = 0xFFFF;
  std::uint8_t there_count_ = 0;
  std::array<std::uint8_t, linmot::kMotors> there_{};  // indices of the motors that are there
  bool watches_supplies_ = false, has_outputs_ = false;
  bool asleep_ = false;      // a tick changes nothing
  bool freezes_ = false;     // a motor may be frozen
  bool curves_run_ = false;  // by words: their end is to be told
  Together together_;
  Requests flags_;     // of a protocol
  Requests requests_;  // that count
  Requests slept_;     // that counted when it fell asleep
  std::uint16_t system_errors_ = 0, system_warnings_ = 0, system_causes_ = 0;
  int control_cycles_ = 1;
  double tick_ = 1e-3;
  std::array<Watched, linmot::kMotors> watched_{};
  std::array<linmot::MotorParameters, linmot::kMotors> taken_{};
  std::bitset<linmot::kMotors> frozen_by_row_;
  std::array<bool, linmot::kMotors> curve_missing_{};
  std::bitset<linmot::kMotors> waits_for_init_;
  std::array<std::uint16_t, linmot::kMotors> errors_{}, warnings_{};
  int error_number_ = 0, error_motor_ = -1;
  int hot_ticks_ = 0;
  bool automatic_ = false;
  bool shutting_down_ = false;
  bool out_of_range_ = false;
  linmot::CodeFilter code_;
  std::array<const bool*, linmot::kMotors> wired_triggers_{};  // that count besides the control word
  std::array<bool, linmot::kMotors> bus_triggers_{};           // both
  int row_ = -1;
  bool refused_ = false;                                  // something that was asked for, and is to be logged
  std::array<std::uint32_t, linmot::kMotors> address_{};  // of the memory, as each motor's commands set it
  std::uint16_t unknown_command_ = 0;                     // of PROFIBUS; told once
  std::array<linmot::MotorWords, linmot::kMotors> words_{};
  bool command_toggle_ = false, executed_toggle_ = false;
  std::array<linmot::Motor, linmot::kMotors> motors_{};
};

}  // namespace lockstep
