/// Lockstep embedded: a project in virtual time, in a few lines.
///
///     lockstep::Simulation machine("knife.json");
///     machine.write("start", 1.0);
///     machine.run_for(std::chrono::seconds(5));
///     double position = machine.read("Knife.Position");
#pragma once

#include <chrono>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "projects/loader/project.hpp"

namespace lockstep {

/// A project is not valid; the text has every problem on a line of its own.
struct InvalidProject : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The value at a path of a project: `tag`, `instance.Pin`, `Object.Variable.Path[1]`, `….Xn`; BOOL as 0 or
/// 1, TIME in seconds.
/// @throws std::out_of_range with what is wrong with the path
double read_value_of(const Project& project, std::string_view path);
/// Writes a tag, or a variable that a program may set, between two ticks.
/// @throws std::out_of_range for a path that cannot be written, std::domain_error for a value that does not
/// fit
void write_value_of(Project& project, std::string_view path, double value);

/// A project that is stepped by its owner. Deterministic: the same file and calls give the same values, bit
/// for bit. One thread at a time.
class Simulation {
 public:
  /// Loads the file; its stimuli apply.
  /// @throws InvalidProject, UnreadableFile
  explicit Simulation(const std::string& path);
  /// From the text of a project instead of a file.
  static Simulation from_text(std::string_view text);

  /// Runs one servo tick.
  void step() noexcept { project_.controller->tick(); }
  /// Runs the ticks of a duration, which is rounded up to whole ticks.
  void run_for(std::chrono::nanoseconds duration) noexcept;
  /// Time of the next tick.
  std::chrono::nanoseconds now() const noexcept {
    return std::chrono::nanoseconds(project_.controller->now());
  }

  /// See `read_value_of`.
  double read(std::string_view path) const { return read_value_of(project_, path); }
  /// See `write_value_of`; before the next tick.
  void write(std::string_view path, double value) { write_value_of(project_, path, value); }

  /// Everything else: the controller with its axes, the names, the trace signals.
  Project& project() noexcept { return project_; }

 private:
  explicit Simulation(LoadedProject loaded);

  Project project_;
};

}  // namespace lockstep
