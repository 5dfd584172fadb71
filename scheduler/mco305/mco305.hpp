/// One motion controller VLT MCO 305 as a technology object: its axis, and the APOSS program that runs in it.
#pragma once

#include <array>
#include <atomic>
#include <climits>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "scheduler/aposs/machine.hpp"
#include "scheduler/mco305/device_commands.hpp"
#include "scheduler/mco305/eeprom.hpp"
#include "scheduler/mco305/program_values.hpp"
#include "scheduler/mco305/unit_line.hpp"
#include "tech_objects/data_blocks/mco305.hpp"
#include "tech_objects/mco305/device.hpp"
#include "tech_objects/mco305_catalogue/system_variables.hpp"
#include "tech_objects/objects/leading_object.hpp"
#include "tech_objects/objects/load_position.hpp"

namespace lockstep {

/// A program of a device.
struct DeviceProgram {
  std::int32_t number = 0;
  bool autostart = false;
  aposs::Image image;
  std::vector<std::string> files;  ///< whose places the image has
  int fault = 0;                   ///< that it raises when it starts: its arrays do not fit the others'
};

/// What turns the master encoder of a device: one of the three, or nothing.
struct DeviceMaster {
  LeadingObject* follows = nullptr;            ///< an axis, an encoder, a proxy or a device
  const DINT* signal = nullptr;                ///< a tag that counts [qc], and wraps
  LeadingObject* encoder_output_of = nullptr;  ///< a device: its virtual master
  double counts = 1.0, units = 1.0;  ///< of what it follows: so many qc for so many user units, both not 0
};

/// Steps every millisecond, whatever the servo cycle: in each tick of so many, so that of ticks that are left
/// out neither its setpoint nor its time passes. Thread: that of the cycle, but for what says otherwise.
class Mco305 final : public LeadingObject {
 public:
  Mco305(std::string object_name, DB_ANY object_number);

  // ---- While loading
  mco305::DeviceSettings settings;
  std::deque<DeviceProgram> programs;
  std::int32_t steps_per_millisecond = 200;
  std::int32_t time_interrupts = 1;  ///< [ms]
  int priority = INT_MAX;            ///< of its programs among the Cyclic ones
  bool repeats = true;               ///< the program that starts by itself begins anew when it has ended
  Eeprom eeprom;
  DeviceMaster master;
  bool leads = false;  ///< an axis or a device follows it
  mco305::ParameterValues& parameters() noexcept { return device_.parameters(); }
  /// From now on parameters may be written from outside, as by a panel: in `data`, between two steps. Without
  /// that nobody looks at them. While loading, or between two ticks.
  void expect_writes() noexcept { expects_writes_ = true; }
  /// The same of what stands there. @param place in `data`
  void expect_writes_at(const void* place) noexcept;
  /// Whether parameters may be written from outside, so that they are kept as a panel keeps them.
  bool has_panel() const noexcept { return has_panel_; }
  /// Once all programs are compiled, with their variables in the same cells: from now on these have paths.
  void declare_values();
  std::span<const OwnVariable> own_variables() const noexcept { return values_.all(); }
  /// Somebody may read a system variable from now on, if it is one: it is computed in each step. Any thread.
  void expect_reads(const Variable& variable) noexcept;
  /// Computes those at once. Between two ticks.
  void bring_up_to_date() noexcept { show_system_variables(); }

  Mco305Data data;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &data; }
  void configure(double servo_period, int ratio) override;
  bool takes_part(Phase phase) const noexcept override {
    return phase == Phase::servo || phase == Phase::programs ||
           (phase == Phase::before_axes && (leads || master.follows != nullptr));
  }
  void servo(std::int64_t now) noexcept override;
  /// Shows axes that follow it where it is: by the position on its counter, which no zero point steps.
  void before_axes() noexcept override;
  void run_program(std::int64_t now) noexcept override;
  int program_priority() const noexcept override { return priority; }
  AxisPosition actual_position() const noexcept override { return {0, measured_line().rounded()}; }
  bool measured_in_servo() const noexcept override { return true; }
  DoubleDouble measured_line() const noexcept override;
  bool leading_value_stands() const noexcept override { return setpoint_.velocity == 0.0; }
  /// A printed line with an error is so many lines and errors that are lost.
  bool take_note(ProgramNote& note) noexcept override;
  void take_line(std::string& line) override;
  void shut_down() noexcept override;
  bool at_rest() const noexcept override;

  mco305::Device& device() noexcept { return device_; }
  aposs::Machine& machine() noexcept { return machine_; }
  /// The program that runs, or ran last; nullptr: none.
  const DeviceProgram* program() const noexcept { return current_; }

 private:
  void start(DeviceProgram& program) noexcept;
  void choose() noexcept;
  void end_program() noexcept;
  void look_at_inputs() noexcept;
  bool may_start() const noexcept;
  DeviceProgram* next_program() noexcept;
  DeviceProgram* find(std::int32_t number) noexcept;
  void go_on() noexcept;
  std::int32_t selected() const noexcept;
  void take_device_errors() noexcept;
  void show() noexcept;
  void show_system_variables() noexcept;
  void share_texts();
  void turn_master(std::int64_t now) noexcept;
  void take_parameters() noexcept;
  void look_at_panel() noexcept;
  void take_unit() noexcept;

  mco305::Device device_;
  DeviceCommands commands_{device_, eeprom, data.Outside, data.ErrorHistory};
  aposs::Arrays arrays_;
  aposs::Machine machine_{commands_, arrays_};
  const DeviceProgram* current_ = nullptr;
  std::uint32_t shown_version_ = 0;
  bool expects_writes_ = false, has_panel_ = false;
  /// Which system variables somebody looks at; the others are not computed.
  std::array<std::atomic<std::uint64_t>, (mco305::kSystemVariableCount + 63) / 64> looked_at_{};
  ProgramValues values_;
  UDINT seen_starts_ = 0, seen_stops_ = 0, seen_resets_ = 0;
  std::array<DINT, mco305::kParameterCount> shown_parameters_{};
  bool program_due_ = false;
  std::int64_t served_ = -1;  // [ns] the last servo tick
  LoadPosition load_;         // of what it follows
  std::int64_t signal_ = 0;   // on a line [qc]
  DINT last_signal_ = 0;
  TO_Struct_Extrapolation extrapolation_{};
  Setpoint step_, last_step_;                // as leading value, at the last two steps
  double actual_ = 0.0, last_actual_ = 0.0;  // [u]
  UnitLine set_line_, actual_line_;          // of both, in the unit of the last step
  double last_led_ = 0.0;                    // [qc] the set position there, without its steps
  std::int64_t last_counts_ = 0;             // [qc] the actual position
  bool start_input_ = false, clear_input_ = false, continue_input_ = false;
  bool start_rises_ = false, continue_rises_ = false;
  bool running_ = false;      // the program's end has not been seen
  std::int32_t wanted_ = -1;  // PRGPAR as the program has left it
  int ticks_per_step_ = 1, tick_ = 0;
  DeviceProgram* autostart_ = nullptr;
  bool choosing_ = true;  // programs may be started by inputs and PRGPAR
  bool told_refusal_ = false;
  bool shutting_down_ = false;
  std::uint32_t lines_ = 0;         // printed, and not told yet
  std::uint64_t lost_ = 0;          // lines and errors that have been told as lost
  std::uint64_t unheard_ = 0;       // errors
  std::vector<std::string> texts_;  // of all programs
};

}  // namespace lockstep
