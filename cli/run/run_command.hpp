/// lockstep run: what the command line asks for, and the parts that carry it out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "projects/loader/project.hpp"

namespace lockstep::cli {

/// The options of `lockstep run`.
struct RunOptions {
  std::string file;
  bool simulate = false;
  std::int64_t duration = -1;  ///< [ns]; negative: until asked to end
  std::string trace_file;      ///< empty: none
  std::vector<std::string> signals;
  bool stimuli = false;
  int cpu = -1;        ///< processor of the cycle; negative: any
  std::string modbus;  ///< HOST:PORT; empty: as the project says
  bool no_modbus = false;
  std::string lcm;  ///< URL; empty: as the project says
  bool no_lcm = false;
  std::string retain;  ///< file; empty: as the project says
  bool no_retain = false;
  std::string audit;  ///< file; empty: as the project says
};

/// Loads the project and carries the run out; gives the exit status.
int run_project(const RunOptions& options);

/// Live values on a terminal; nothing in a pipe. Used by one thread, never the cycle's.
class Display {
 public:
  /// Makes the crossing for the values shown; `project` outlives it.
  Display(Project& project, const std::vector<NamedSignal>& signals, std::int64_t duration);

  /// Draws the line anew. @param time of the run [ns]  @param note further text, such as counts
  void show(std::int64_t time, const std::string& note);
  /// Ends the line, so that messages may follow.
  void close();

 private:
  std::vector<NamedSignal> shown_;
  std::int64_t duration_;
  std::unique_ptr<ProcessImage> image_;
  bool terminal_;
  bool open_ = false;
};

/// Tells how the axes stood at the end.
void tell_axes(const Controller& controller);

}  // namespace lockstep::cli
