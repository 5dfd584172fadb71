/// One motion controller VLT MCO 305: its axis, and the APOSS program that runs in it.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "scheduler/aposs/machine.hpp"
#include "scheduler/mco305/device_commands.hpp"
#include "tech_objects/data_blocks/mco305.hpp"
#include "tech_objects/mco305/device.hpp"

namespace lockstep {

/// A program of a device.
struct DeviceProgram {
  std::int32_t number = 0;
  bool autostart = false;
  aposs::Image image;
  std::vector<std::string> files;  ///< whose places the image has
  int fault = 0;                   ///< that it raises when it starts: its arrays do not fit the others'
};

/// Steps every millisecond, whatever the servo cycle, which has to divide it. Thread: that of the cycle, but
/// for what says otherwise.
class Mco305 {
 public:
  // ---- While loading
  mco305::DeviceSettings settings;
  std::deque<DeviceProgram> programs;
  std::int32_t steps_per_millisecond = 200;
  std::int32_t time_interrupts = 1;  ///< [ms]
  mco305::ParameterValues& parameters() noexcept { return device_.parameters(); }

  /// Call once when all of it is there. May allocate. @param servo_period [s]
  void configure(double servo_period);

  /// What others look at, renewed in each step.
  Mco305Data data;

  /// One servo tick: encoders, generator, controller, drive. @param now time of the tick [ns]
  void servo(std::int64_t now) noexcept;
  /// Its program, behind `servo` in the same tick.
  void run_program() noexcept;
  /// The run comes to its end: no program runs any more, and the axis comes to rest.
  void shut_down() noexcept;
  bool at_rest() const noexcept;

  mco305::Device& device() noexcept { return device_; }
  aposs::Machine& machine() noexcept { return machine_; }
  /// The program that runs, or ran last; nullptr: none.
  const DeviceProgram* program() const noexcept { return current_; }

 private:
  static constexpr std::int64_t kStep = 1'000'000;  // [ns]

  void start(const DeviceProgram& program) noexcept;
  void choose() noexcept;
  const DeviceProgram* find(std::int32_t number) const noexcept;
  std::int32_t selected() const noexcept;
  void take_device_errors() noexcept;
  void show() noexcept;

  mco305::Device device_;
  DeviceCommands commands_{device_};
  aposs::Arrays arrays_;
  aposs::Machine machine_{commands_, arrays_};
  const DeviceProgram* current_ = nullptr;
  std::uint32_t shown_version_ = 0;
  bool program_due_ = false;
  bool start_input_ = false, clear_input_ = false;
  bool choosing_ = true;  // programs may be started by inputs and PRGPAR
  bool shutting_down_ = false;
};

}  // namespace lockstep
