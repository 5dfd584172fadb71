/// One motion controller VLT MCO 305 as a technology object: its axis, and the APOSS program that runs in it.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "scheduler/aposs/machine.hpp"
#include "scheduler/mco305/device_commands.hpp"
#include "scheduler/mco305/eeprom.hpp"
#include "tech_objects/data_blocks/mco305.hpp"
#include "tech_objects/mco305/device.hpp"
#include "tech_objects/objects/technology_object.hpp"

namespace lockstep {

/// A program of a device.
struct DeviceProgram {
  std::int32_t number = 0;
  bool autostart = false;
  aposs::Image image;
  std::vector<std::string> files;  ///< whose places the image has
  int fault = 0;                   ///< that it raises when it starts: its arrays do not fit the others'
};

/// Steps every millisecond, whatever the servo cycle: in each tick of so many, so that of ticks that are left
/// out neither its setpoint nor its time passes. Thread: that of the cycle, but for what says otherwise.
class Mco305 final : public TechnologyObject {
 public:
  Mco305(std::string object_name, DB_ANY object_number);

  // ---- While loading
  mco305::DeviceSettings settings;
  std::deque<DeviceProgram> programs;
  std::int32_t steps_per_millisecond = 200;
  std::int32_t time_interrupts = 1;  ///< [ms]
  bool repeats = true;               ///< the program that starts by itself begins anew when it has ended
  Eeprom eeprom;
  mco305::ParameterValues& parameters() noexcept { return device_.parameters(); }

  Mco305Data data;
  void* data_block() noexcept override { return &data; }
  void* start_values() noexcept override { return &data; }
  void configure(double servo_period, int ratio) override;
  bool takes_part(Phase phase) const noexcept override {
    return phase == Phase::servo || phase == Phase::programs;
  }
  void servo(std::int64_t now) noexcept override;
  void run_program(std::int64_t now) noexcept override;
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
  void share_texts();

  mco305::Device device_;
  DeviceCommands commands_{device_, eeprom};
  aposs::Arrays arrays_;
  aposs::Machine machine_{commands_, arrays_};
  const DeviceProgram* current_ = nullptr;
  std::uint32_t shown_version_ = 0;
  bool program_due_ = false;
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
