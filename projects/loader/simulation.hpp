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

  /// The value at a path: `tag`, `instance.Pin`, `Object.Variable.Path[1]`, `….Xn`; BOOL as 0 or 1, TIME in
  /// seconds.
  /// @throws std::out_of_range with what is wrong with the path
  double read(std::string_view path) const;
  /// Writes a tag, or a variable that a program may set, before the next tick.
  /// @throws std::out_of_range for a path that cannot be written, std::domain_error for a value that does not
  /// fit
  void write(std::string_view path, double value);

  /// Everything else: the controller with its axes, the names, the trace signals.
  Project& project() noexcept { return project_; }

 private:
  explicit Simulation(LoadedProject loaded);
  Operand find(std::string_view path) const;

  Project project_;
};

}  // namespace lockstep
