/// lockstep run: what the command line asks for, and the parts that carry it out.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "projects/loader/project.hpp"
#include "projects/runtime/run_options.hpp"

namespace lockstep::cli {

/// What makes a run fail that has otherwise ended as asked.
struct FailOn {
  bool alarm = false;
  bool job = false;  ///< one that has failed or was rejected
};

/// Loads the project and carries the run out; gives the exit status.
int run_project(const RunOptions& options, FailOn fail_on);

/// The same for a system file, of which all controllers run in virtual time.
int run_system(const RunOptions& options, FailOn fail_on);

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
